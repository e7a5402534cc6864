model_macros::chain! {
chain RampOfNoJoint {
    const arm: length = 0.25;
    input ambient;
    body arm_body on ground {
        motion: Rz(alpha);
        motion_error: Rx(give*ramp(arm, 0, 1)), Ry(flop*ramp(alpha, ambient, 1)), Rz(hinge*ramp(alpha, 0, flop));
    }
}
}

fn main() {}
