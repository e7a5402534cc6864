#![deny(deprecated)]

model_macros::chain! {
chain Mount {
    body fork on ground {
        motion:       Rz(azimuth);
        motion_error: Rz(scale*azimuht);
    }
    observe sight: direction(1, 0, 0) of fork;
}
}

fn main() {}
