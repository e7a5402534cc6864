model_macros::chain! {
chain Mount {
    body fork on ground {
        motoin: Rz(alpha);
        wobble: Rx(tilt);
        motion_error: Rx(tilt*cos(alpha));
    }
}
}

fn main() {}
