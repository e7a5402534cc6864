model_macros::chain! {
chain Mount {
    body fork on ground {
        position:       Tx(range), Ty(alpha), Tz(drop);
        position_error: Tz(drop);
        motion:         Rz(alpha);
    }
    input range: length;
}
}

fn main() {}
