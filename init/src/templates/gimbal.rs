//! Gimbals: pan (yaw) and tilt (pitch), and roll where there is a third axis.

use super::{Beside, Template, has, shown};
use crate::look::Look;
use crate::words::Part;
use crate::{Draft, Frame, Observed};

pub const TEMPLATE: Template = Template {
    name: "gimbal",
    what: "a gimbal or a pan and tilt head, with two axes or three",
    looks_for: "pan, tilt, or yaw, pitch, roll; true_pan, true_tilt, or x, y, z, or offset_cross, offset_along",
    fits: |look| has(look, &[Part::Pan, Part::Tilt]),
    draft,
};

fn draft(look: &Look) -> Result<Draft, String> {
    let mut remarks = Vec::new();
    let pan = look.needed(&[Part::Pan], "pan", "`pan` or `yaw`")?;
    let tilt = look.needed(&[Part::Tilt], "tilt", "`tilt` or `pitch`")?;
    let roll = look.reading(&[Part::Roll])?;
    let all: Vec<_> = [pan, tilt].into_iter().chain(roll).collect();
    let joints = look.angles(&all, &mut remarks)?;
    let sides = [&[Part::Pan, Part::Azimuth][..], &[Part::Tilt, Part::Elevation]];
    let observed = Observed::direction(look, sides, ["azimuth", "elevation"], &mut remarks)?;
    let (frame, unfollowed) = match observed.vectors() {
        Some(vectors) => shown(look, Frame::seen(&joints[0], &joints[1], &vectors), "pan and tilt"),
        None => (Frame::USUAL, None),
    };
    let beside = Beside::of(look);
    let names = ["pan".to_owned(), "tilt".to_owned(), "roll".to_owned()];
    Ok(Draft {
        chain: chain(&frame, &beside.statements, roll.is_some()),
        observable: "sight",
        columns: names.into_iter().zip(joints).chain(beside.columns).collect(),
        observed,
        turned: None,
        estimate: Vec::new(),
        start: frame.starts(["pan_index", "tilt_index"]),
        tolerance: &[],
        inputs: beside.names,
        is_in_order: false,
        unfollowed,
        remarks,
    })
}

fn chain(frame: &Frame, statements: &str, rolls: bool) -> String {
    let scales = frame.scales(&["pan", "tilt"]);
    let (turn, turn_index) = (frame.turns("pan"), frame.turn("pan_index"));
    let (tilt, tilt_index) = (frame.tilts("tilt"), frame.tilt("tilt_index"));
    let (skew, roll, up) = (frame.roll("nonperpendicularity"), frame.roll("roll"), frame.raise("sight_up"));
    let sight = frame.sight();
    let (device, third) = if rolls {
        let third = format!(
            "
    /// What rolls about the direction that it looks in.
    body inner on middle {{
        position_error:
            /// The roll axis against the perpendicular to the tilt axis.
            Rz(roll_axis_side);
        motion: {roll};
        motion_error:
            /// The line of sight against the roll axis, upwards.
            {up},
            /// The line of sight against the roll axis, sideways.
            Rz(sight_side);
    }}
"
        );
        ("inner", third)
    } else {
        ("middle", String::new())
    };
    let collimation = if rolls {
        String::new()
    } else {
        ",
            /// Collimation: the line of sight against the perpendicular to the tilt axis.
            Rz(collimation)"
            .to_owned()
    };
    format!(
        "/// A gimbal: pan about z, then tilt.
chain Gimbal {{
{scales}{statements}    /// What pans.
    body outer on ground {{
        position_error:
            /// Tilt of the pan axis about x.
            Rx(base_tilt_x),
            /// Tilt of the pan axis about y.
            Ry(base_tilt_y);
        motion: {turn};
        motion_error:
            /// Index error of pan: true minus reading.
            {turn_index};
    }}

    /// What tilts.
    body middle on outer {{
        position_error:
            /// Non-perpendicularity of the tilt axis to the pan axis.
            {skew};
        motion: {tilt};
        motion_error:
            /// Index error of tilt: true minus reading.
            {tilt_index}{collimation};
    }}
{third}
    /// Where the line of sight points.
    observe sight: direction({sight}) of {device};
}}
"
    )
}
