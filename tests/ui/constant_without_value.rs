model_macros::chain! {
chain Mount {
    body fork on ground {
        position: Tx(arm), Ty(leg), Tz(toe);
        motion:   Rz(alpha);
    }
    const arm: length = 1/0;
    const leg: length = 2*arm;
    const toe: length;
}
}

fn main() {}
