model_macros::chain! {
chain Mount {
    body fork on ground {
        motion: Rz(alpha);
    }
}
chain Other {}
}

fn main() {}
