//! Total stations, laser trackers and terrestrial scanners: two angles and a distance to targets of known places.

use super::{Beside, Template, has};
use crate::init::look::Look;
use crate::init::words::Part;
use crate::init::{Draft, Observed};

pub const TEMPLATE: Template = Template {
    name: "total-station",
    what: "a total station, laser tracker or terrestrial scanner before targets of known places",
    looks_for: "hz, zenith (or elevation), distance; x, y, z of the target",
    fits: |look| {
        let turns = |part| look.reading(&[part]).is_ok_and(|found| found.is_some());
        let first = [Part::Horizontal, Part::HourAngle, Part::Azimuth].into_iter().any(turns);
        first && has(look, &[Part::Range]) && (turns(Part::Zenith) || turns(Part::Elevation))
    },
    draft,
};

fn draft(look: &Look) -> Result<Draft, String> {
    let mut remarks = Vec::new();
    let horizontal = [Part::Horizontal, Part::HourAngle, Part::Azimuth];
    let horizontal = look.needed(&horizontal, "the horizontal angle", "`hz`")?;
    let zenith = look.reading(&[Part::Zenith])?;
    let vertical = match zenith {
        Some(zenith) => zenith,
        None => look.needed(&[Part::Elevation], "the vertical angle", "`zenith` or `elevation`")?,
    };
    let distance = look.needed(&[Part::Range], "the distance", "`distance [m]`")?;
    let mut columns = look.angles(&[horizontal, vertical], &mut remarks)?;
    columns.extend(look.lengths(&[distance], &mut remarks)?);
    let observed = Observed::point(look, &mut remarks)?;
    let (name, motion) =
        if zenith.is_some() { ("zenith", "Rx(pi/2 - zenith)") } else { ("elevation", "Rx(elevation)") };
    let beside = Beside::of(look);
    let names = ["horizontal", name, "distance"].map(str::to_owned);
    remarks.push("where the station stands, and how it is turned, is estimated too".to_owned());
    Ok(Draft {
        chain: CHAIN.replace("STATEMENTS", &beside.statements).replace("MOTION", motion),
        observable: "target",
        columns: names.into_iter().zip(columns).chain(beside.columns).collect(),
        observed,
        estimate: vec!["*", "station_*"],
        start: Vec::new(),
        inputs: beside.names,
        remarks,
    })
}

const CHAIN: &str = "/// A total station before targets of known places. The horizontal angle runs clockwise, from y through x.
chain TotalStation {
    /// Where the station stands among the targets, and how it is turned: not known beforehand.
    const station_x: length = 0;
    const station_y: length = 0;
    const station_z: length = 0;
    const station_rx: angle = 0;
    const station_ry: angle = 0;
    const station_rz: angle = 0;
    /// The measured distance.
    input distance: range;

STATEMENTS    body station on ground {
        position: Tx(station_x), Ty(station_y), Tz(station_z), Rx(station_rx), Ry(station_ry), Rz(station_rz);
    }

    /// What turns about the standing axis.
    body alidade on station {
        motion: Rz(-horizontal);
    }

    /// What turns about the trunnion axis: the telescope.
    body telescope on alidade {
        position_error:
            /// Error of the trunnion axis: against the perpendicular to the standing axis.
            Ry(trunnion_axis);
        motion: MOTION;
        motion_error:
            /// Index error of the vertical circle; positive raises.
            Rx(vertical_index),
            /// Collimation: the line of sight against the perpendicular to the trunnion axis.
            Rz(collimation),
            /// Zero of the distance: true minus measured.
            Ty(distance_zero),
            /// Scale of the distance: true minus measured, for each metre.
            Ty(distance_scale*distance);
    }

    /// Where the target is.
    observe target: point(0, distance, 0) of telescope;
}
";
