model_macros::chain! {
chain Mount {
    input zenith: angle = between(star, down);
    body fork on ground {
        motion: Rz(alpha);
    }
    observe sky: direction(0, 0, 1) of fork, bent up by tan(alpha);
}
}

fn main() {}
