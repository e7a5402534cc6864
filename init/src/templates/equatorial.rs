//! Equatorial mounts: hour angle, then declination, with the side of the pier where the data tell it.

use super::{Beside, Template, has, shown};
use crate::look::Look;
use crate::words::Part;
use crate::{Draft, Frame, Observed};

pub const TEMPLATE: Template = Template {
    name: "equatorial",
    what: "an equatorial mount: hour angle, then declination",
    looks_for: "encoder_ha, encoder_dec; true_ha, true_dec, or offset_cross, offset_dec; pier_side (+1, -1)",
    fits: |look| has(look, &[Part::HourAngle, Part::Declination]),
    draft,
};

fn draft(look: &Look) -> Result<Draft, String> {
    let mut remarks = Vec::new();
    let ha = look.needed(&[Part::HourAngle], "the hour angle", "`ha` or `encoder_ha`")?;
    let dec = look.needed(&[Part::Declination], "the declination", "`dec` or `encoder_dec`")?;
    let joints = look.angles(&[ha, dec], &mut remarks)?;
    let sides = [&[Part::HourAngle][..], &[Part::Declination]];
    let observed = Observed::direction(look, sides, ["ha", "dec"], &mut remarks)?;
    let (frame, unfollowed) = match observed.vectors() {
        Some(vectors) => {
            shown(look, Frame::seen(&joints[0], &joints[1], &vectors), "hour angle and declination")
        }
        None => (Frame::USUAL, None),
    };
    let mut beside = Beside::of(look);
    let pier = look.reading(&[Part::Pier])?.filter(|pier| pier.values().iter().all(|side| side.abs() == 1.0));
    if let Some(pier) = pier {
        let statement = "    /// Side of the pier: +1 normal, -1 through the pole, where the tube has rolled by half a turn.\n    \
                         input pier: side;\n\n";
        beside.statements.push_str(statement);
        beside.columns.push(("pier".to_owned(), pier.plain()));
        beside.names.push("pier".to_owned());
    }
    if pier.is_none() {
        remarks.push(
            "no column says the side of the pier: if the mount changed sides, add `pier_side` with 1 and -1"
                .to_owned(),
        );
    }
    if look.latitude_deg.is_none() {
        remarks.push(
            "the latitude in the chain is a guess, on which flexure under gravity and refraction depend: write yours"
                .to_owned(),
        );
    }
    let names = ["ha".to_owned(), "dec".to_owned()];
    let start = frame.starts(["ha_index", if pier.is_some() { "" } else { "dec_index" }]);
    Ok(Draft {
        chain: chain(&frame, &latitude(look), &beside.statements, if pier.is_some() { "pier*" } else { "" }),
        observable: "sight",
        columns: names.into_iter().zip(joints).chain(beside.columns).collect(),
        observed,
        turned: None,
        estimate: Vec::new(),
        start,
        tolerance: &[],
        inputs: beside.names,
        is_in_order: false,
        unfollowed,
        remarks,
    })
}

/// The statement of the latitude: what the file says of it, else a guess.
fn latitude(look: &Look) -> String {
    look.latitude_deg.map_or_else(
        || {
            "    /// Latitude of the observer: a guess, on which flexure under gravity and refraction depend.
    const latitude: angle = pi/4;"
                .to_owned()
        },
        |degrees| {
            // A millionth of a degree is a tenth of a metre on the ground.
            format!(
                "    /// Latitude of the observer, as the data say it.
    const latitude: angle = {} deg;",
                (degrees * 1e6).round() / 1e6
            )
        },
    )
}

fn chain(frame: &Frame, latitude: &str, statements: &str, pier: &str) -> String {
    let scales = frame.scales(&["ha", "dec"]);
    let (turn, tilt, turn_index) = (frame.turns("ha"), frame.tilts("dec"), frame.turn("ha_index"));
    let tilt_index = frame.tilt(&format!("{pier}dec_index"));
    let roll = frame.roll(&format!("{pier}nonperpendicularity"));
    let (sight, down) = (frame.sight(), frame.down());
    format!(
        "/// An equatorial mount: hour angle, then declination. z points to the pole.
chain Equatorial {{
{latitude}
{scales}{statements}    /// What turns in hour angle.
    body fork on ground {{
        position_error:
            /// Tilt of the polar axis about x.
            Rx(polar_tilt_x),
            /// Tilt of the polar axis about y.
            Ry(polar_tilt_y);
        motion: {turn};
        motion_error:
            /// Index error of the hour angle: true minus reading.
            {turn_index};
    }}

    /// What turns in declination: the tube.
    body tube on fork {{
        position_error:
            /// Non-perpendicularity of the declination axis to the polar axis.
            {roll};
        motion: {tilt};
        motion_error:
            /// Index error of the declination: true minus reading.
            {tilt_index},
            /// Collimation: the line of sight against the perpendicular to the declination axis.
            Rz({pier}collimation);
    }}

    gravity: ({down});

    /// Where the line of sight points.
    observe sight: direction({sight}) of tube;
}}
"
    )
}
