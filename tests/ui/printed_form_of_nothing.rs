model_macros::chain! {
chain Mount {
    body fork on ground {
        position_error: Rx(tilt_x);
        motion:         Rz(alpha);
    }
    symbol tilt_y = "t_y";
    symbol temperature = "T";
}
}

fn main() {}
