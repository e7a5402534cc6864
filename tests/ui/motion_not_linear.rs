model_macros::chain! {
chain Mount {
    body fork on ground {
        motion: Rz(alpha/2), Rx(beta*beta), Ry(cos(beta)), Rz(0), Tx(travel^2), Ty(range), Rz(2*alpha - pi/2);
    }
    input range: length;
}
}

fn main() {}
