model_macros::chain! {
chain Mount {
    body ground on ground {
        motion: Rz(alpha), Rx(sin);
        position_error: Rx(type);
    }
    body r#fn on ground {}
    const pi = 3;
    observe _: direction(0, 0, 1) of ground;
}
}

fn main() {}
