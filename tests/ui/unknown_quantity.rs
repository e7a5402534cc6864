model_macros::chain! {
chain Mount {
    body fork on ground {
        motion: Rz(alpha);
    }
    const arm: lenght = 0.25;
    const gain: volt = 3;
    input temperature: kelvin;
}
}

fn main() {}
