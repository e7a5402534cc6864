//! Turntables and rate tables: one axis, and a pointer or mirror on it whose direction is measured.

use super::{Beside, Template, shown};
use crate::look::Look;
use crate::machine_tools;
use crate::words::Part;
use crate::{Draft, Frame, Observed};

pub const TEMPLATE: Template = Template {
    name: "turntable",
    what: "a turntable or rate table with a pointer, mirror or target on it",
    looks_for: "angle (or azimuth); x, y, z of a unit vector",
    fits: |look| {
        let others = [Part::Elevation, Part::Tilt, Part::Beta, Part::Zenith, Part::Declination];
        let turns = |part| look.reading(&[part]).is_ok_and(|found| found.is_some());
        turns(Part::Turn) ^ turns(Part::Azimuth)
            && !others.into_iter().any(turns)
            && look.columns.iter().any(|column| column.part() == Some(Part::Z))
            && !machine_tools::is_one(look)
    },
    draft,
};

fn draft(look: &Look) -> Result<Draft, String> {
    let mut remarks = Vec::new();
    let angle = look.needed(&[Part::Turn, Part::Azimuth], "the angle of the table", "`angle`")?;
    let joints = look.angles(&[angle], &mut remarks)?;
    let observed = Observed::direction(
        look,
        [&[Part::Azimuth], &[Part::Elevation]],
        ["azimuth", "elevation"],
        &mut remarks,
    )?;
    let vectors = observed.vectors().ok_or_else(|| {
        format!("{}: a table's pointer is told by x, y, z of a unit vector, not by offsets", look.file)
    })?;
    let (frame, unfollowed) =
        shown(look, joints.first().and_then(|joint| Frame::turning(joint, &vectors)), "the table");
    let beside = Beside::of(look);
    Ok(Draft {
        chain: chain(&frame, &beside.statements),
        observable: "pointing",
        columns: ["angle".to_owned()].into_iter().zip(joints).chain(beside.columns).collect(),
        observed,
        turned: None,
        estimate: Vec::new(),
        start: frame.starts(["index", "rise"]),
        tolerance: &[],
        inputs: beside.names,
        is_in_order: false,
        unfollowed,
        remarks,
    })
}

fn chain(frame: &Frame, statements: &str) -> String {
    let scales = frame.scales(&["angle"]);
    let (turn, index, rise, sight) =
        (frame.turns("angle"), frame.turn("index"), frame.raise("rise"), frame.sight());
    format!(
        "/// A turntable with a pointer on it. z points along its axis.
chain Turntable {{
{scales}{statements}    /// What turns.
    body table on ground {{
        position_error:
            /// Tilt of the axis about x.
            Rx(tilt_x),
            /// Tilt of the axis about y.
            Ry(tilt_y);
        motion: {turn};
        motion_error:
            /// Index error: true minus reading.
            {index},
            /// The pointer against the perpendicular to the axis; positive upwards.
            {rise};
    }}

    /// Where the pointer points.
    observe pointing: direction({sight}) of table;
}}
"
    )
}
