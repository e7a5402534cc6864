model_macros::chain! {
body fork on ground {
    motion: Rz(alpha);
}
}

fn main() {}
