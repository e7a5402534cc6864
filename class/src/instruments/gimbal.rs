//! A pan and tilt head that carries a camera.

use crate::instrument::{Axis, Instrument, Level};

/// The pan angle runs from x towards y.
pub const GIMBAL: Instrument = Instrument {
    words: "A pan and tilt head with a camera. x points ahead, y to the left, z up. The pan angle runs from x towards y, the tilt \
            angle from the horizon upwards. Where the camera really looked was measured by known marks.",
    declaration: "\
/// A pan and tilt head with a camera. x points ahead, y to the left, z up.
chain Gimbal {
    input temperature: temperature;
    input second: session;
    body pan_axis on ground {
        position_error: Rx(tilt_x), Ry(tilt_y);
        motion:         Rz(pan);
        motion_error:   Rz(pan_index);
    }
    body tilt_axis on pan_axis {
        position_error: Rx(nonperpendicularity);
        motion:         Ry(-tilt);
        motion_error:   Ry(tilt_index);
    }
    body camera on tilt_axis {
        position_error: Rz(sight_side);
    }
    observe pointing: direction(1, 0, 0) of camera;
}
",
    first: Axis {
        joint: "pan",
        body: "pan_axis",
        turn: "Rz",
        zero: "Rz(pan_index)",
        range_deg: [0.0, 360.0],
    },
    second: Axis {
        joint: "tilt",
        body: "tilt_axis",
        turn: "Ry",
        zero: "Ry(tilt_index)",
        range_deg: [-30.0, 62.0],
    },
    levelled: "Ry(tilt_y)",
    level: Level::Horizon,
    raises: -1.0,
    asked: ["tilt_x", "tilt_y"],
};
