model_macros::chain! {
chain Mount {
    /// The frame that turns.
    body fork on ground {
        motion: Rz(alpha); /// by a motor
    }
    observe axis: direction(0, 0, 1) of fork;
    /// The end.
}
}

fn main() {}
