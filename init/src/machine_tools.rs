//! What tests of machine tools have in common: their columns, and slides in a row with scales and squarenesses.

use std::fmt::Write as _;

use nalgebra::{DMatrix, DVector};
use tables::formats::machine_tools::{Columns, Lack, Three};

use super::look::{Column, Look, Read};
use super::words::Part;

pub const AXES: [&str; 3] = ["x", "y", "z"];
/// An axis whose readings differ by less than this stands still, m.
const STILL_M: f64 = 1e-9;

/// Singular values below this share of the largest entry are rounding.
const ROUNDING: f64 = 1e-12;

/// The three kinds of tests.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Test {
    /// Positions of which both sides are known: a plate, a grid, a tracker.
    Points,
    /// Lengths of a bar.
    Bar,
    /// Positions while axes turn.
    Turning,
}

/// The columns of a table as a test of a machine tool has them.
pub fn columns(look: &Look) -> Columns {
    Columns::of(look.columns.iter().map(|column| &column.name))
}

/// Which test a table plainly is; none of another table.
pub fn test(look: &Look) -> Option<Test> {
    let of_another = |column: &Column| {
        let own = [Part::X, Part::Y, Part::Z, Part::Turn, Part::Temperature];
        let beside = [Part::Name, Part::Group, Part::Station, Part::Cross, Part::Along, Part::Range];
        column.part().is_some_and(|part| !own.contains(&part) && !beside.contains(&part))
    };
    if look.columns.iter().any(of_another) {
        return None;
    }
    let columns = columns(look);
    let is_pair = match columns.pair() {
        Ok(pair) => pair.is_some(),
        Err(_) => columns.bar.is_none(),
    };
    let has_commanded = columns
        .commanded()
        .is_ok_and(|commanded| commanded.is_some_and(|commanded| commanded.iter().flatten().count() > 1));
    match (columns.bar.is_some() && has_commanded, is_pair || look.lacks.is_some()) {
        (true, _) => Some(Test::Bar),
        (false, true) if columns.turns_any() => Some(Test::Turning),
        (false, true) => Some(Test::Points),
        (false, false) => None,
    }
}

/// Whether a table plainly is of a machine tool.
pub fn is_one(look: &Look) -> bool {
    test(look).is_some()
}

/// Why nothing can be begun: what the reader of the file found missing, or else a reason.
pub fn lacking(look: &Look, why: &str) -> String {
    format!("{}: {}", look.file, look.lacks.as_deref().unwrap_or(why))
}

/// Positions that the machine read, and true ones, each of x, y and z.
///
/// # Errors
/// Some are missing.
pub fn pair(look: &Look, remarks: &mut Vec<String>) -> Result<[[Read; 3]; 2], String> {
    let pair = columns(look).pair().map_err(|Lack(why)| lacking(look, &why))?;
    let pair = pair.ok_or_else(|| {
        lacking(
            look,
            "no columns have the positions that were commanded or read and those that were true: write `commanded x [mm]` and `true x [mm]`, \
             or deviations `dx [um]`",
        )
    })?;
    Ok([three(look, pair.read, "read by the machine", remarks)?, three(look, pair.truth, "true", remarks)?])
}

fn three(look: &Look, columns: Three, what: &str, remarks: &mut Vec<String>) -> Result<[Read; 3], String> {
    let mut found = Vec::new();
    for (at, axis) in columns.into_iter().zip(AXES) {
        let at = at.ok_or_else(|| {
            lacking(
                look,
                &format!("a point has three coordinates, and no column has the {axis} that was {what}"),
            )
        })?;
        found.extend(look.lengths(&[&look.columns[at]], remarks)?);
    }
    <[Read; 3]>::try_from(found).map_err(|_| unreachable!("three columns were read"))
}

/// Whether an axis moves in the rows.
pub fn moves(read: &Read) -> bool {
    let (least, most) = read
        .si
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), own| (least.min(*own), most.max(*own)));
    most - least > STILL_M
}

/// Each of x, y and z, with whether it moves.
pub fn axes(read: &[Read; 3]) -> Vec<(usize, bool)> {
    read.iter().enumerate().map(|(axis, read)| (axis, moves(read))).collect()
}

/// The unknowns of normal equations; none of what is not finite, whose decomposition need not end.
pub fn solved(normal: DMatrix<f64>, right: &DVector<f64>) -> Option<DVector<f64>> {
    if !normal.iter().chain(right.iter()).all(|entry| entry.is_finite()) {
        return None;
    }
    let scale = normal.amax();
    normal.svd(true, true).solve(right, ROUNDING * scale).ok()
}

/// A row of slides, the first on a body, with the name of the last.
pub struct Slides {
    /// Their declaration.
    pub bodies: String,
    /// The body of the last.
    pub last: String,
    /// What was assumed of them.
    pub remark: String,
}

/// Slides for some of x, y and z, each with whether it moves, on a body. An axis that stands still shows no error of its own.
pub fn slides(axes: &[(usize, bool)], on: &str, has_scales: bool) -> Slides {
    let mut bodies = String::new();
    let mut last = on.to_owned();
    for (at, &(axis, moves)) in axes.iter().enumerate() {
        let name = AXES[axis];
        let _ = write!(bodies, "    /// What the {name} axis moves.\n    body {name}_slide on {last} {{\n");
        let before = axes[..at].iter().filter(|(_, before)| moves && *before);
        let squares: Vec<String> = before.map(|(before, _)| square(*before, axis)).collect();
        if !squares.is_empty() {
            let _ = writeln!(bodies, "        position_error:\n{};", squares.join(",\n"));
        }
        let _ = writeln!(bodies, "        motion: T{name}({name});");
        if moves && has_scales {
            let _ = write!(
                bodies,
                "        motion_error:\n            /// Scale of {name}: true minus read, for each metre.\n            \
                 T{name}(scale_{name}*{name});\n"
            );
        }
        bodies.push_str("    }\n\n");
        last = format!("{name}_slide");
    }
    let names: Vec<&str> = axes.iter().map(|(axis, _)| AXES[*axis]).collect();
    let still: Vec<&str> = axes.iter().filter(|(_, moves)| !moves).map(|(axis, _)| AXES[*axis]).collect();
    let mut remark = match names.as_slice() {
        [only] => format!("assumed: {only} is the only slide"),
        [first, others @ ..] => {
            let others: Vec<String> = others.iter().map(|name| format!(" carries {name}")).collect();
            format!("assumed: {first}{}, as seen from the workpiece", others.join(", which"))
        }
        [] => String::new(),
    };
    if !still.is_empty() {
        remark += &format!("; {} does not move in these rows, and has no errors", still.join(" and "));
    }
    Slides { bodies, last, remark }
}

/// The squareness of one axis to one below it.
fn square(before: usize, axis: usize) -> String {
    let (about, letter, name) = match (before, axis) {
        (0, 1) => ("z", "C0Y", "square_xy"),
        (0, 2) => ("y", "B0Z", "square_xz"),
        _ => ("x", "A0Z", "square_yz"),
    };
    format!(
        "            /// Squareness of {} to {} ({letter} of ISO 230-1).\n            R{about}({name})",
        AXES[axis], AXES[before]
    )
}
