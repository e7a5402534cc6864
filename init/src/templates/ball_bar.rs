//! Ball bars: the length of a bar between a point of the table and the tool while this goes round a circle.

use std::fmt::Write as _;

use nalgebra::{DMatrix, DVector, Vector3};
use tables::formats::machine_tools::Lack;

use super::{Beside, Template};
use crate::look::{Look, Read};
use crate::machine_tools::{self, AXES, Test};
use crate::{Draft, Observed};

pub const TEMPLATE: Template = Template {
    name: "ball-bar",
    what: "slides that go round a circle, with a ball bar",
    looks_for: "commanded x, y (z), or an angle; radial deviation with a line `# radius = 150 mm`, or bar length",
    fits: |look| machine_tools::test(look) == Some(Test::Bar),
    draft,
};

/// Commanded positions are on a circle where their distances from its centre differ by less than this share.
const ROUND: f64 = 1e-3;
/// The bar is as long as the circle's radius within this share.
const AS_LONG: f64 = 0.02;
/// A row follows the one before it where they are nearer than this share of the radius.
const STEP: f64 = 0.5;
/// Rows are on a path where this share of them follow each other.
const MOST_STEPS: f64 = 0.9;
/// A centre this near to zero is at zero, m.
const AT_ZERO_M: f64 = 1e-7;

fn draft(look: &Look) -> Result<Draft, String> {
    let mut remarks = Vec::new();
    let columns = machine_tools::columns(look);
    let commanded = columns.commanded().map_err(|Lack(why)| machine_tools::lacking(look, &why))?;
    let (Some(commanded), Some(bar)) = (commanded, columns.bar) else {
        return Err(machine_tools::lacking(
            look,
            "a ball bar has columns `commanded x [mm]` and `commanded y [mm]`, or `angle [deg]`, and `radial deviation [um]` with a line \
             `# radius = 150 mm` above the header, or `bar length [mm]`",
        ));
    };
    let mut read: Vec<(usize, Read)> = Vec::new();
    for (axis, at) in commanded.into_iter().enumerate() {
        if let Some(at) = at {
            read.extend(look.lengths(&[&look.columns[at]], &mut remarks)?.into_iter().map(|own| (axis, own)));
        }
    }
    let Some(length) = look.lengths(&[&look.columns[bar]], &mut remarks)?.pop() else {
        unreachable!("one column was read")
    };
    let axes: Vec<(usize, bool)> =
        read.iter().map(|(axis, own)| (*axis, machine_tools::moves(own))).collect();
    let moving: Vec<usize> = axes.iter().filter(|(_, moves)| *moves).map(|(axis, _)| *axis).collect();
    let centre = centre(look, &read, &moving, &length)?;
    let is_in_order = follow(&read, &length);
    if is_in_order {
        remarks.push(
            "assumed: the rows are in the order in which they were taken, so that backlash is looked for"
                .to_owned(),
        );
    }
    let slides = machine_tools::slides(&axes, "ground", true);
    remarks.push(slides.remark);
    remarks.push(
        "the stated length of the bar is taken as exact: a longer one looks like a scale of all axes"
            .to_owned(),
    );
    let beside = Beside::of(look);
    let (mut statements, mut places) = (String::new(), Vec::new());
    for axis in 0..3 {
        if centre[axis].abs() > AT_ZERO_M {
            let name = AXES[axis];
            let _ = writeln!(statements, "    const circle_{name}: length = {:.4} mm;", 1e3 * centre[axis]);
            places.push(format!("T{name}(circle_{name})"));
        }
    }
    if !statements.is_empty() {
        statements.insert_str(0, "    /// Where the centre of the circle was commanded.\n");
        statements.push('\n');
    }
    let position =
        if places.is_empty() { String::new() } else { format!("        position: {};\n", places.join(", ")) };
    let errors: Vec<String> = moving.iter().map(|axis| format!("T{0}(centre_{0})", AXES[*axis])).collect();
    let chain = format!(
        "/// A machine with slides in a row, and a ball bar from the table to its tool.
chain BallBar {{
{}{statements}    /// The ball on the table.
    body centre on ground {{
{position}        position_error:
            /// The ball against the commanded centre.
            {};
    }}

{}    /// How long the bar is.
    observe bar: range of point(0, 0, 0) of {} in centre;
}}
",
        beside.statements,
        errors.join(", "),
        slides.bodies,
        slides.last
    );
    let columns = read.into_iter().map(|(axis, own)| (AXES[axis].to_owned(), own));
    Ok(Draft {
        chain,
        observable: "bar",
        columns: columns.chain(beside.columns).collect(),
        observed: Observed::Range(length),
        turned: None,
        estimate: Vec::new(),
        start: Vec::new(),
        tolerance: &[],
        inputs: beside.names,
        is_in_order,
        unfollowed: None,
        remarks,
    })
}

/// Whether nearly all rows are near the one before them, as on a path.
fn follow(read: &[(usize, Read)], bar: &Read) -> bool {
    let steps = bar.si.len().saturating_sub(1);
    let step =
        |row: usize| read.iter().map(|(_, own)| (own.si[row + 1] - own.si[row]).powi(2)).sum::<f64>().sqrt();
    let near = (0..steps).filter(|row| step(*row) <= STEP * bar.si[*row]).count();
    near as f64 >= MOST_STEPS * steps as f64
}

/// The centre of the circle or the sphere that the commanded positions are on, m; an axis that stands still has its own position.
fn centre(look: &Look, read: &[(usize, Read)], moving: &[usize], bar: &Read) -> Result<Vector3<f64>, String> {
    let of = |axis: usize| read.iter().find(|(own, _)| *own == axis).map(|(_, read)| &read.si);
    let at = |row: usize| Vector3::from_fn(|axis, _| of(axis).map_or(0.0, |si| si[row]));
    let rows = bar.si.len();
    if moving.len() < 2 || rows < moving.len() + 1 {
        return Err(machine_tools::lacking(
            look,
            "a ball bar needs two axes that move, and four rows at least",
        ));
    }
    // |p|² = 2 p·c + (r² - |c|²), about the middle, which keeps digits.
    let middle = (0..rows).map(at).sum::<Vector3<f64>>() / rows as f64;
    let system = DMatrix::from_fn(rows, moving.len() + 1, |row, column| {
        moving.get(column).map_or(1.0, |axis| 2.0 * (at(row) - middle)[*axis])
    });
    let squares = DVector::from_fn(rows, |row, _| (at(row) - middle).norm_squared());
    let normal = system.transpose() * &system;
    let right = system.transpose() * squares;
    let solved = machine_tools::solved(normal, &right).ok_or_else(|| {
        machine_tools::lacking(look, "the commanded positions are too far apart: correct their units")
    })?;
    let mut centre = middle;
    for (own, axis) in solved.iter().zip(moving) {
        centre[*axis] += own;
    }
    let distances: Vec<f64> = (0..rows).map(|row| (at(row) - centre).norm()).collect();
    let mean = |of: &[f64]| of.iter().sum::<f64>() / rows as f64;
    let (radius, length) = (mean(&distances), mean(&bar.si));
    if !distances.iter().all(|own| (own - radius).abs() <= ROUND * radius) {
        return Err(machine_tools::lacking(
            look,
            "the commanded positions are on no circle: a file has one place of the ball on the table",
        ));
    }
    let is_as_long = (length - radius).abs() <= AS_LONG * radius;
    if !is_as_long {
        return Err(machine_tools::lacking(
            look,
            &format!(
                "the circle has a radius of {:.4} mm, and the bar a length of {:.4} mm: correct the stated length, or the units of the columns",
                1e3 * radius,
                1e3 * length
            ),
        ));
    }
    Ok(centre)
}
