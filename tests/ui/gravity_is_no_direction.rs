model_macros::chain! {
chain Mount {
    body fork on ground {
        motion: Rz(alpha);
    }
    gravity: (0, 0, 0);
    gravity: (0, 0, -1);
}
}

fn main() {}
