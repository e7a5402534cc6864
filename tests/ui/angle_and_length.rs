model_macros::chain! {
chain Mount {
    body fork on ground {
        motion:       Rz(alpha), Tx(alpha);
        motion_error: Rx(play), Ty(play);
    }
}
}

fn main() {}
