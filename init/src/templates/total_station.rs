//! Total stations, laser trackers and terrestrial scanners: two angles and a distance to targets, of known places or of unknown ones.

use super::{Beside, Template, has};
use crate::look::Look;
use crate::words::Part;
use crate::{Draft, Observed};

pub const TEMPLATE: Template = Template {
    name: "total-station",
    what: "a total station, laser tracker or terrestrial scanner before targets",
    looks_for: "hz, zenith (or elevation), distance; x, y, z of the target, or target (its label) and station",
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
    let (name, motion) =
        if zenith.is_some() { ("zenith", "Rx(pi/2 - zenith)") } else { ("elevation", "Rx(elevation)") };
    let beside = Beside::of(look);
    let names = ["horizontal", name, "distance"].map(str::to_owned);
    let unknown = Observed::target(look)?;
    // Of unknown targets nothing shows a scale, and the study says where the stations stood.
    let (places, distance, [constants, station, below]) = match unknown {
        Some(_) => ("unknown", ZERO.to_owned(), ["", "", "ground"]),
        None => ("known", format!("{ZERO}{SCALE}"), STANDS),
    };
    let chain = CHAIN
        .replace("PLACES", places)
        .replace("CONSTANTS", constants)
        .replace("STATION", station)
        .replace("BELOW", below)
        .replace("DISTANCE", &distance);
    let (observed, estimate) = match unknown {
        Some(unknown) => {
            remarks.push(
                "where the targets are, and where the stations stood, is estimated too; a scale of the distances shows only where two \
                 of these places or one length are known"
                    .to_owned(),
            );
            (unknown, Vec::new())
        }
        None => {
            let observed = Observed::point(look, &mut remarks)?;
            remarks.push("where the station stands, and how it is turned, is estimated too".to_owned());
            (observed, vec!["*", "station_*"])
        }
    };
    Ok(Draft {
        chain: chain.replace("STATEMENTS", &beside.statements).replace("MOTION", motion),
        observable: "target",
        columns: names.into_iter().zip(columns).chain(beside.columns).collect(),
        observed,
        turned: None,
        estimate,
        start: Vec::new(),
        tolerance: &[],
        inputs: beside.names,
        is_in_order: false,
        unfollowed: None,
        remarks,
    })
}

/// What a declaration says of where the station stands, with the body that it hangs on.
const STANDS: [&str; 3] = [
    "    /// Where the station stands among the targets, and how it is turned: not known beforehand.
    const station_x: length = 0;
    const station_y: length = 0;
    const station_z: length = 0;
    const station_rx: angle = 0;
    const station_ry: angle = 0;
    const station_rz: angle = 0;
",
    "    body station on ground {
        position: Tx(station_x), Ty(station_y), Tz(station_z), Rx(station_rx), Ry(station_ry), Rz(station_rz);
    }

",
    "station",
];

const ZERO: &str = "            /// Zero of the distance: true minus measured.
            Ty(distance_zero)";

const SCALE: &str = ",
            /// Scale of the distance: true minus measured, for each metre.
            Ty(distance_scale*distance)";

const CHAIN: &str = "/// A total station before targets of PLACES places. The horizontal angle runs clockwise, from y through x.
chain TotalStation {
CONSTANTS    /// The measured distance.
    input distance: range;

STATEMENTSSTATION    /// What turns about the standing axis.
    body alidade on BELOW {
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
DISTANCE;
    }

    /// Where the target is.
    observe target: point(0, distance, 0) of telescope;
}
";
