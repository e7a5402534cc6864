model_macros::chain! {
chain Mount {
    body fork on ground {
        position_error: Rw(tilt), rx(lean);
        motion:         Rotate(alpha);
    }
}
}

fn main() {}
