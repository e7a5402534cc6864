model_macros::chain! {
chain Mount {
    body fork on ground {
        position: Rx(0.3), Ry(tilt/2), Rz(pi/6), Rx(tilt - pi/2), Rz(arm);
        motion:   Rz(alpha);
    }
    const tilt: angle = pi/7;
    const arm: length = 0.25;
}
}

fn main() {}
