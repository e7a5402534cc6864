//! Scanners on vehicles, of which a trajectory says where they were: boresight and lever arm, from points on planes of unknown places.

use super::Template;
use crate::look::{Column, Look, Read};
use crate::mounting::{Mounting, mounting};
use crate::words::Part;
use crate::{Draft, Observed};
use tables::trajectory::COLUMNS;

pub const TEMPLATE: Template = Template {
    name: "vehicle",
    what: "a scanner on a car, aircraft or vessel, with a trajectory",
    looks_for: "range and one or two angles, or x, y, z in the scanner's frame; plane (a label); and a trajectory, or east, north, up, heading, pitch, roll",
    fits: |look| {
        let own = own(look);
        has_poses(look) && plane(&own).is_ok() && sensed(&own, &mut Vec::new()).is_ok()
    },
    draft,
};

/// Words by which a column names planes, the plainest first.
const PLANES: [&str; 12] = [
    "plane", "wall", "surface", "facade", "roof", "patch", "segment", "object", "target", "label", "feature",
    "class",
];

/// The points as the scanner has them, with what the declaration says of them.
struct Sensed {
    /// The columns of joints and inputs.
    columns: Vec<(&'static str, Read)>,
    inputs: &'static str,
    motion: &'static str,
    /// How the motion is written where the first angle counts the other way.
    reversed: Option<&'static str>,
    point: &'static str,
    points: Vec<[f64; 3]>,
}

/// The columns that a trajectory brings, without their units.
fn poses() -> impl Iterator<Item = &'static str> {
    COLUMNS.iter().filter_map(|name| name.split(" [").next())
}

fn own(look: &Look) -> Look {
    look.without(&poses().collect::<Vec<_>>())
}

fn has_poses(look: &Look) -> bool {
    poses().all(|name| look.named(&[name]).is_some())
}

fn draft(look: &Look) -> Result<Draft, String> {
    let mut remarks = Vec::new();
    if !has_poses(look) {
        return Err(format!(
            "{}: nothing says where the vehicle was: give its trajectory behind the table, as in `trueaxis init points.csv flight.sbet`",
            look.file
        ));
    }
    let own = own(look);
    let plane = plane(&own)?;
    let sensed = sensed(&own, &mut remarks)?;
    let columns = poses().filter_map(|name| look.named(&[name]));
    let (lengths, angles): (Vec<&Column>, Vec<&Column>) =
        columns.partition(|column| ["east", "north", "up"].contains(&column.name.stem.as_str()));
    let read = [look.lengths(&lengths, &mut remarks)?, look.angles(&angles, &mut remarks)?].concat();
    let pose: Vec<&[f64]> = read.iter().map(|read| read.si.as_slice()).collect();
    let Mounting { factors, is_reversed, said } =
        mounting(&pose, &sensed.points, sensed.reversed.is_some(), plane.labels())
            .map_err(|why| format!("{}: {why}", look.file))?;
    remarks.push(said);
    remarks.push("The places of the planes are estimated too. Level roads and roofs show the height of the scanner only where the vehicle tilts.".to_owned());
    let motion = sensed.reversed.filter(|_| is_reversed).unwrap_or(sensed.motion);
    let line = |key: &str, factors: &str| match factors {
        "" => String::new(),
        factors => format!("        {key}: {factors};\n"),
    };
    Ok(Draft {
        chain: CHAIN
            .replace("INPUTS", sensed.inputs)
            .replace("POSITION", &line("position", &factors))
            .replace("MOTION", &line("motion", motion))
            .replace("SEEN", sensed.point),
        observable: "hit",
        columns: sensed.columns.into_iter().map(|(name, read)| (name.to_owned(), read)).collect(),
        observed: Observed::Plane(plane.name.full.clone()),
        turned: None,
        estimate: Vec::new(),
        start: Vec::new(),
        tolerance: &[("lever_*", "2 m"), ("boresight_*", "2 deg")],
        inputs: Vec::new(),
        is_in_order: false,
        unfollowed: None,
        remarks,
    })
}

/// The column that says which plane each row hit.
fn plane(look: &Look) -> Result<&Column, String> {
    let labels: Vec<&Column> = look.columns.iter().filter(|column| column.labels_rows()).collect();
    let by_word = PLANES.iter().find_map(|word| labels.iter().copied().find(|column| column.has_word(word)));
    let texts: Vec<&Column> = labels.iter().copied().filter(|column| column.values().is_empty()).collect();
    let alone = || if let [column] = texts.as_slice() { Some(*column) } else { None };
    by_word.or_else(alone).ok_or_else(|| {
        format!(
            "{}: no column says which plane each row hit: call it `plane`, with a label for each wall, road or roof",
            look.file
        )
    })
}

/// The points in the scanner's frame.
fn sensed(look: &Look, remarks: &mut Vec<String>) -> Result<Sensed, String> {
    if let Some(vector) = vector(look) {
        let read = look.lengths(&vector, remarks)?;
        let points =
            (0..read[0].si.len()).map(|row| std::array::from_fn(|axis| read[axis].si[row])).collect();
        let columns = ["scanner_x", "scanner_y", "scanner_z"].into_iter().zip(read).collect();
        return Ok(Sensed {
            columns,
            inputs: IN_SPACE,
            motion: "",
            reversed: None,
            point: "scanner_x, scanner_y, scanner_z",
            points,
        });
    }
    let range = look.reading(&[Part::Range])?.ok_or_else(|| {
        format!(
            "{}: nothing says where the scanner saw the points: name columns `range [m]` and `angle [deg]`, or `x [m]`, `y [m]` and `z [m]` in \
             its own frame",
            look.file
        )
    })?;
    let mut lengths = look.lengths(&[range], remarks)?;
    let Some(range) = lengths.pop() else { unreachable!("one column was read") };
    let first = look.reading(&[Part::Azimuth, Part::Horizontal, Part::Alpha])?;
    let zenith = look.reading(&[Part::Zenith])?;
    let second = zenith.or(look.reading(&[Part::Elevation, Part::Beta])?);
    let (Some(first), Some(second)) = (first, second) else {
        let turn = [Part::Turn, Part::Azimuth, Part::Horizontal, Part::Elevation, Part::Alpha, Part::Zenith];
        let turn = look.needed(&turn, "the angle of the scanner's mirror", "`angle [deg]`")?;
        let mut angles = look.angles(&[turn], remarks)?;
        let Some(angle) = angles.pop() else { unreachable!("one column was read") };
        let points = range.si.iter().zip(&angle.si).map(|(r, a)| [r * a.sin(), 0.0, r * a.cos()]).collect();
        let columns = vec![("angle", angle), ("range", range)];
        return Ok(Sensed {
            columns,
            inputs: WITH_A_RANGE,
            motion: "Ry(angle)",
            reversed: None,
            point: "0, 0, range",
            points,
        });
    };
    let angles = look.angles(&[first, second], remarks)?;
    let up = |angle: f64| if zenith.is_some() { std::f64::consts::FRAC_PI_2 - angle } else { angle };
    let place = |row: usize| {
        let (azimuth, elevation, r) = (angles[0].si[row], up(angles[1].si[row]), range.si[row]);
        [r * azimuth.sin() * elevation.cos(), r * azimuth.cos() * elevation.cos(), r * elevation.sin()]
    };
    let points = (0..range.si.len()).map(place).collect();
    let (name, motion, reversed) = match zenith {
        Some(_) => ("zenith", "Rz(-azimuth), Rx(pi/2 - zenith)", "Rz(azimuth), Rx(pi/2 - zenith)"),
        None => ("elevation", "Rz(-azimuth), Rx(elevation)", "Rz(azimuth), Rx(elevation)"),
    };
    let columns = ["azimuth", name, "range"].into_iter().zip(angles.into_iter().chain([range])).collect();
    Ok(Sensed {
        columns,
        inputs: WITH_A_RANGE,
        motion,
        reversed: Some(reversed),
        point: "0, range, 0",
        points,
    })
}

/// Three columns whose names differ in the axis alone.
fn vector(look: &Look) -> Option<[&Column; 3]> {
    let of = |axis: &'static str| {
        look.columns.iter().filter_map(move |column| Some((column.words_without(axis)?, column)))
    };
    of("x").find_map(|(stem, x)| {
        let beside = |axis: &'static str| of(axis).find(|(own, _)| *own == stem).map(|(_, column)| column);
        Some([x, beside("y")?, beside("z")?])
    })
}

const IN_SPACE: &str = "    /// The point that was measured, in the scanner's own frame.
    input scanner_x: length;
    input scanner_y: length;
    input scanner_z: length;
";

const WITH_A_RANGE: &str = "    /// The measured distance.
    input range: length;
";

const CHAIN: &str = "/// A scanner on a vehicle. The trajectory says where the vehicle was when each point was measured.
///
/// The vehicle's axes are x right, y forward, z up. Lever arm and boresight are counted as trajectories are: forward, right, down; and
/// roll, pitch, heading.
chain Vehicle {
INPUTS
    /// The vehicle, as its trajectory has it: east, north, up.
    body vehicle on ground {
        motion: Tx(east), Ty(north), Tz(up), Rz(-heading), Rx(pitch), Ry(roll);
    }

    /// Where the scanner sits on the vehicle.
    body mounting on vehicle {
        position_error:
            /// Lever arm: the scanner's centre, forward of the trajectory's point.
            Ty(lever_forward),
            /// Lever arm, to the right.
            Tx(lever_right),
            /// Lever arm, down.
            Tz(-lever_down),
            /// Boresight, heading: clockwise seen from above.
            Rz(-boresight_heading),
            /// Boresight, pitch: forward goes up.
            Rx(boresight_pitch),
            /// Boresight, roll: right goes down.
            Ry(boresight_roll);
    }

    /// The scanner, with the axes that its readings have.
    body scanner on mounting {
POSITIONMOTION    }

    /// The point that was hit.
    observe hit: point(SEEN) of scanner;
}
";
