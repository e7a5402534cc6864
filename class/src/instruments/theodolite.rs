//! A theodolite, whose vertical circle counts from the zenith.

use crate::instrument::{Axis, Instrument, Level};

/// The horizontal circle runs clockwise as seen from above.
pub const THEODOLITE: Instrument = Instrument {
    words: "A theodolite. x points east, y north, z up. The horizontal circle runs from north through east, the vertical circle from \
            the zenith downwards. Where the telescope really pointed was measured by known targets.",
    declaration: "\
/// A theodolite. x points east, y north, z up; the vertical circle counts from the zenith.
chain Theodolite {
    input temperature: temperature;
    input second: session;
    body alidade on ground {
        position_error: Rx(tilt_x), Ry(tilt_y);
        motion:         Rz(-horizontal);
        motion_error:   Rz(horizontal_index);
    }
    body telescope on alidade {
        position_error: Ry(trunnion);
        motion:         Rx(pi/2 - zenith);
        motion_error:   Rx(vertical_index);
    }
    body sight on telescope {
        position_error: Rz(collimation);
    }
    observe pointing: direction(0, 1, 0) of sight;
}
",
    first: Axis {
        joint: "horizontal",
        body: "alidade",
        turn: "Rz",
        zero: "Rz(horizontal_index)",
        range_deg: [0.0, 360.0],
    },
    second: Axis {
        joint: "zenith",
        body: "telescope",
        turn: "Rx",
        zero: "Rx(vertical_index)",
        range_deg: [8.0, 84.0],
    },
    levelled: "Ry(tilt_y)",
    level: Level::Zenith,
    raises: 1.0,
    asked: ["tilt_x", "tilt_y"],
};
