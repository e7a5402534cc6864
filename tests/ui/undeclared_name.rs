model_macros::chain! {
chain Mount {
    body fork on ground {
        position:     Tz(hight), Tx(arm);
        motion:       Rz(alpha);
    }
    const height: length = 1.5;
    observe lens: point(0, 0, rnge) of fork;
    gravity: (0, sin(latitude), 0);
    input range: length;
}
}

fn main() {}
