model_macros::chain! {
chain Mount {
    body fork on ground {
        motion: Rz(alpha)
        motion_error: Rx(tilt, 3), Ry(2tilt), Rz(tan gent), Tx(+shift), Ty(shift), ;
        position_error Tz(drop);
    }
    body tube ground { motion: Rx(beta); }
    konst arm = 3;
    const leg = ;
    input temperature
    symbol tilt = alpha;
    observe sight: direction(0, 1) of fork;
    observe lens: point(0, 0; 1) of fork;
    gravity (0, 0, -1);
    #[serde] const toe = 3;
    observe last: direction(0, 0, 1) of fork
}
}

fn main() {}
