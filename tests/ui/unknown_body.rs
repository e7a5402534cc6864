model_macros::chain! {
chain Mount {
    body fork on grond {
        motion: Rz(alpha);
    }
    body tube on frok {
        motion: Rx(beta);
    }
    body camera on focuser {}
    observe sight: direction(0, 0, 1) of tub;
}
}

fn main() {}
