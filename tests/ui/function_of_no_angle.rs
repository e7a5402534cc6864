model_macros::chain! {
chain Mount {
    body fork on ground {
        position:     Tz(0.1);
        motion:       Rz(alpha), Tx(travel);
        motion_error: Rx(sag*cos(alpha + phase)), Ry(sag*sin(alpa)), Rz(sag*cos(travel)),
                      Tx(wave*cos(pitch)), Ty(wave*cos(temperature)), Tz(wave*sin(alpha/3));
    }
    const pitch = 3;
    input temperature;
}
}

fn main() {}
