//! Mounts and antennas that turn in azimuth, then in elevation: the seven usual terms of a pointing model.

use super::{Beside, Template, has, shown};
use crate::look::Look;
use crate::words::Part;
use crate::{Draft, Frame, Observed};

pub const TEMPLATE: Template = Template {
    name: "alt-azimuth",
    what: "a telescope, antenna or tracker that turns in azimuth, then in elevation",
    looks_for: "encoder_az, encoder_el; true_az, true_el, or x, y, z, or offset_cross, offset_el",
    fits: |look| has(look, &[Part::Azimuth, Part::Elevation]) && !has(look, &[Part::Range]),
    draft,
};

fn draft(look: &Look) -> Result<Draft, String> {
    let mut remarks = Vec::new();
    let azimuth = look.needed(&[Part::Azimuth], "the azimuth", "`az` or `encoder_az`")?;
    let elevation = look.needed(&[Part::Elevation], "the elevation", "`el` or `encoder_el`")?;
    let joints = look.angles(&[azimuth, elevation], &mut remarks)?;
    let sides = [&[Part::Azimuth][..], &[Part::Elevation]];
    let observed = Observed::direction(look, sides, ["azimuth", "elevation"], &mut remarks)?;
    let (frame, unfollowed) = match observed.vectors() {
        Some(vectors) => shown(look, Frame::seen(&joints[0], &joints[1], &vectors), "azimuth and elevation"),
        None => (Frame::USUAL, None),
    };
    let beside = Beside::of(look);
    let names = ["azimuth".to_owned(), "elevation".to_owned()];
    Ok(Draft {
        chain: chain(&frame, &beside.statements),
        observable: "sight",
        columns: names.into_iter().zip(joints).chain(beside.columns).collect(),
        observed,
        turned: None,
        estimate: Vec::new(),
        start: frame.starts(["azimuth_index", "elevation_index"]),
        tolerance: &[],
        inputs: beside.names,
        is_in_order: false,
        unfollowed,
        remarks,
    })
}

fn chain(frame: &Frame, statements: &str) -> String {
    let scales = frame.scales(&["azimuth", "elevation"]);
    let (turn, tilt) = (frame.turns("azimuth"), frame.tilts("elevation"));
    let (turn_index, tilt_index) = (frame.turn("azimuth_index"), frame.tilt("elevation_index"));
    let (roll, droop) = (frame.roll("nonperpendicularity"), frame.raise("droop*cos(elevation)"));
    let sight = frame.sight();
    format!(
        "/// An alt-azimuth mount: it turns in azimuth, then in elevation. z points up.
chain AltAzimuth {{
{scales}{statements}    /// What turns in azimuth.
    body fork on ground {{
        position_error:
            /// Tilt of the azimuth axis about x.
            Rx(tilt_x),
            /// Tilt of the azimuth axis about y.
            Ry(tilt_y);
        motion: {turn};
        motion_error:
            /// Index error of the azimuth encoder: true minus reading.
            {turn_index};
    }}

    /// What turns in elevation: the tube.
    body tube on fork {{
        position_error:
            /// Non-perpendicularity of the elevation axis to the azimuth axis.
            {roll};
        motion: {tilt};
        motion_error:
            /// Index error of the elevation encoder: true minus reading.
            {tilt_index},
            /// Droop of the tube under its weight, largest at the horizon; positive raises the line of sight.
            {droop},
            /// Collimation: the line of sight against the perpendicular to the elevation axis.
            Rz(collimation);
    }}

    /// Where the line of sight points.
    observe sight: direction({sight}) of tube;
}}
"
    )
}
