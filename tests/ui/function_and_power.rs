model_macros::chain! {
chain Mount {
    body fork on ground {
        motion:       Rz(alpha);
        motion_error: Rx(sag*cosine(alpha)), Ry(sag*sinc(alpha)), Rz(sag^alpha), Tx(sag^99), Ty(sag*"x"), Tz(sag*1e9999);
    }
}
}

fn main() {}
