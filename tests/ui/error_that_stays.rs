model_macros::chain! {
chain Mount {
    body fork on ground {
        position_error: Rx(tilt + 0.001);
        motion:         Rz(alpha);
        motion_error:   Ry(cos(alpha)), Rz(sag*cos(alpha) + arm);
    }
    const arm = 0.25;
}
}

fn main() {}
