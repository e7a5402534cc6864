model_macros::chain! {
chain Mount {
    body fork on ground {
        motion: Rz(alpha);
    }
    body fork on ground {
        motion: Rz(beta);
    }
    const arm: length = 0.25;
    input arm: length;
    symbol alpha = "A";
    symbol alpha = "B";
    observe sight: direction(0, 0, 1) of fork;
    observe sight: point(0, 0, arm) of fork;
}
}

fn main() {}
