//! A telescope on an alt-azimuth mount.

use crate::instrument::{Axis, Instrument, Level};

/// The azimuth runs from north through east.
pub const TELESCOPE: Instrument = Instrument {
    words: "A telescope on two axes. x points east, y north, z up. The azimuth runs from north through east, the elevation from the \
            horizon upwards. Where the telescope really pointed was measured by stars.",
    declaration: "\
/// A telescope on two axes. x points east, y north, z up; the azimuth runs from north through east.
chain Telescope {
    input temperature: temperature;
    input second: session;
    body azimuth_axis on ground {
        position_error: Rx(tilt_x), Ry(tilt_y);
        motion:         Rz(-azimuth);
        motion_error:   Rz(azimuth_index);
    }
    body elevation_axis on azimuth_axis {
        position_error: Ry(nonperpendicularity);
        motion:         Rx(elevation);
        motion_error:   Rx(elevation_index);
    }
    body tube on elevation_axis {
        position_error: Rz(collimation);
    }
    observe pointing: direction(0, 1, 0) of tube;
}
",
    first: Axis {
        joint: "azimuth",
        body: "azimuth_axis",
        turn: "Rz",
        zero: "Rz(azimuth_index)",
        range_deg: [0.0, 360.0],
    },
    second: Axis {
        joint: "elevation",
        body: "elevation_axis",
        turn: "Rx",
        zero: "Rx(elevation_index)",
        range_deg: [12.0, 82.0],
    },
    levelled: "Ry(tilt_y)",
    level: Level::Horizon,
    raises: 1.0,
    asked: ["tilt_x", "tilt_y"],
};
