model_macros::chain! {
chain Mount {
    body fork on ground {
        position_error: Tz(drop);
        motion:         Rz(alpha);
    }
    observe sight: dirction(0, 0, 1) of fork;
    observe plane: normal(0, 0, 1) of fork;
    observe pier:  point(0, 0, 0) of ground;
    observe lens:  point(0, alpha, drop) of fork;
    observe still: direction(0, 1 - 1, 0) of fork;
}
}

fn main() {}
