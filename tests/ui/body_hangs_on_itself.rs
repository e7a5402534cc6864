model_macros::chain! {
chain Mount {
    body fork on fork {
        motion: Rz(alpha);
    }
    body tube on camera {
        motion: Rx(beta);
    }
    body camera on tube {}
}
}

fn main() {}
