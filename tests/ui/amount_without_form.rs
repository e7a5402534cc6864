model_macros::chain! {
chain Mount {
    body fork on ground {
        motion:       Rz(alpha);
        motion_error: Rx(a/0), Ry(a/(1 + alpha)), Rz(a*cos(alpha/2)), Tx((a + b + c + d + e + f + g + h)^32);
    }
}
}

fn main() {}
