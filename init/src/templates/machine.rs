//! Machine tools and measuring machines: three slides, and positions that are known better: of a plate of balls, a grid, a tracker.

use super::{Beside, Template};
use crate::look::Look;
use crate::machine_tools::{self, AXES, Test};
use crate::{Draft, Observed, placed};

pub const TEMPLATE: Template = Template {
    name: "machine",
    what: "three slides, against a plate of balls, a grid or a tracker",
    looks_for: "commanded x, y, z and true x, y, z; calibrated x, y, z and machine x, y, z; or x, y, z and deviations dx, dy, dz",
    fits: |look| machine_tools::test(look) == Some(Test::Points),
    draft,
};

/// A place or a turn below this needs no start, m and rad.
const NEAR: f64 = 1e-4;

fn draft(look: &Look) -> Result<Draft, String> {
    let mut remarks = Vec::new();
    let [read, truth] = machine_tools::pair(look, &mut remarks)?;
    let axes = machine_tools::axes(&read);
    if !axes.iter().any(|(_, moves)| *moves) {
        return Err(machine_tools::lacking(look, "no axis moves in these rows: add rows at other positions"));
    }
    let slides = machine_tools::slides(&axes, "bed", true);
    remarks.push(slides.remark);
    remarks.push(
        "where the machine stands in the frame of the true positions, and how it is turned, is estimated too"
            .to_owned(),
    );
    let start = placed::pose(&placed::vectors(&read), &placed::vectors(&truth))
        .filter(|(shift, angles)| shift.iter().chain(angles).any(|size| size.abs() > NEAR))
        .map_or_else(Vec::new, |(shift, angles)| {
            let lengths = shift.iter().map(|size| format!("{size:.5} m")).collect::<Vec<_>>();
            let values = lengths.into_iter().chain(angles.map(|angle| format!("{angle:.6} rad")));
            PLACE.into_iter().zip(values).collect()
        });
    let beside = Beside::of(look);
    let chain = CHAIN
        .replace("STATEMENTS", &beside.statements)
        .replace("SLIDES", &slides.bodies)
        .replace("LAST", &slides.last);
    let columns = AXES.map(str::to_owned).into_iter().zip(read);
    Ok(Draft {
        chain,
        observable: "tip",
        columns: columns.chain(beside.columns).collect(),
        observed: Observed::Point(truth),
        turned: None,
        estimate: vec!["*", "place_*"],
        start,
        tolerance: &[],
        inputs: beside.names,
        is_in_order: false,
        unfollowed: None,
        remarks,
    })
}

const PLACE: [&str; 6] = ["place_x", "place_y", "place_z", "place_rx", "place_ry", "place_rz"];

const CHAIN: &str = "/// A machine with three slides in a row.
chain Machine {
    /// Where the machine stands in the frame of the true positions, and how it is turned: not known beforehand.
    const place_x: length = 0;
    const place_y: length = 0;
    const place_z: length = 0;
    const place_rx: angle = 0;
    const place_ry: angle = 0;
    const place_rz: angle = 0;

STATEMENTS    body bed on ground {
        position: Tx(place_x), Ty(place_y), Tz(place_z), Rx(place_rx), Ry(place_ry), Rz(place_rz);
    }

SLIDES    /// Where the tool or the probe is.
    observe tip: point(0, 0, 0) of LAST;
}
";
