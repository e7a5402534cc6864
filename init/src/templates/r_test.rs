//! R-tests: where a sphere on the tool is against a table that turns, while slides follow.

use std::fmt::Write as _;

use nalgebra::{DMatrix, DVector, Rotation3, Unit, Vector3};

use super::{Beside, Template};
use crate::look::{Look, Read};
use crate::machine_tools::{self, AXES, Test};
use crate::{Draft, Observed, placed};

pub const TEMPLATE: Template = Template {
    name: "r-test",
    what: "three slides and a table that turns, in an R-test",
    looks_for: "commanded x, y, z; c, or a and c, or b and c; displacements dx, dy, dz with a line `# displacement = table`",
    fits: |look| machine_tools::test(look) == Some(Test::Turning),
    draft,
};

const TURNS: [&str; 3] = ["a", "b", "c"];
/// The commanded path is that of a sphere on the table within this, m.
const ON_PATH_M: f64 = 1e-4;
/// An axis that turns by less than this stands still, rad.
const STILL_RAD: f64 = 1e-6;

/// An axis that turns, with its readings.
struct Turning {
    /// About x, y or z.
    about: usize,
    read: Read,
}

impl Turning {
    /// The axes across it.
    fn across(&self) -> [usize; 2] {
        [(self.about + 1) % 3, (self.about + 2) % 3]
    }

    fn turn(&self, row: usize, sign: f64) -> Rotation3<f64> {
        let mut axis = Vector3::zeros();
        axis[self.about] = 1.0;
        Rotation3::from_axis_angle(&Unit::new_unchecked(axis), sign * self.read.si[row])
    }
}

fn draft(look: &Look) -> Result<Draft, String> {
    let mut remarks = Vec::new();
    let [read, truth] = machine_tools::pair(look, &mut remarks)?;
    let turning = turning(look, &mut remarks)?;
    let axes = machine_tools::axes(&read);
    if axes.iter().filter(|(_, moves)| *moves).count() < 2 {
        return Err(machine_tools::lacking(
            look,
            "the commanded positions do not follow the sphere: write those of the machine's slides, not those in the frame of the table",
        ));
    }
    let places = path(look, &read, &turning)?;
    let slides = machine_tools::slides(&axes, "ground", false);
    remarks.push(slides.remark.clone());
    let names: Vec<&str> = turning.iter().map(|turning| TURNS[turning.about]).collect();
    remarks.push(format!(
        "assumed: the table turns by {}, against the sign of the angle (ISO 841), and the scales of the slides are right",
        names.join(", then ")
    ));
    remarks.push("where the axes of the table are was computed from the commanded positions".to_owned());
    let beside = Beside::of(look);
    let chain = chain(&turning, &places, &slides, &beside.statements);
    let columns = AXES.map(str::to_owned).into_iter().zip(read);
    let turns = turning.into_iter().map(|turning| (TURNS[turning.about].to_owned(), turning.read));
    Ok(Draft {
        chain,
        observable: "sphere",
        columns: columns.chain(turns).chain(beside.columns).collect(),
        observed: Observed::Point(truth),
        turned: None,
        estimate: Vec::new(),
        start: Vec::new(),
        tolerance: &[],
        inputs: beside.names,
        is_in_order: false,
        unfollowed: None,
        remarks,
    })
}

/// The axes that turn, the one that carries the other first.
fn turning(look: &Look, remarks: &mut Vec<String>) -> Result<Vec<Turning>, String> {
    let mut found = Vec::new();
    for (about, at) in machine_tools::columns(look).turns.into_iter().enumerate() {
        let Some(at) = at else { continue };
        let Some(read) = look.angles(&[&look.columns[at]], remarks)?.pop() else {
            unreachable!("one column was read")
        };
        let first = read.si.first().copied().unwrap_or_default();
        if read.si.iter().any(|own| (own - first).abs() > STILL_RAD) {
            found.push(Turning { about, read });
        } else if first.abs() > STILL_RAD {
            return Err(machine_tools::lacking(
                look,
                &format!(
                    "{} stands still at another angle than zero: take the rows at {0} = 0",
                    TURNS[about]
                ),
            ));
        }
    }
    match found.as_slice() {
        [] => Err(machine_tools::lacking(look, "no axis turns in these rows")),
        [one, other] if one.about == 0 && other.about == 1 => Err(machine_tools::lacking(
            look,
            "tables that turn by a and by b are not known: a or b carries c",
        )),
        [_] | [_, _] => Ok(found),
        _ => Err(machine_tools::lacking(look, "at most two axes of a table turn")),
    }
}

/// Where each axis of a table is, across itself: that which the commanded path of the tool goes round, m.
fn path(look: &Look, read: &[Read; 3], turning: &[Turning]) -> Result<Vec<[f64; 2]>, String> {
    let points = placed::vectors(read);
    let signs: &[f64] = &[-1.0, 1.0];
    let mut best: Option<(f64, Vec<[f64; 2]>, bool)> = None;
    for first in signs {
        for second in if turning.len() > 1 { signs } else { &signs[..1] } {
            let is_usual = [*first, *second] == [-1.0, -1.0];
            let (off, places) = fitted(&points, turning, [*first, *second]);
            // Where a path goes with both signs, the usual one counts.
            if best.as_ref().is_none_or(|(least, ..)| off < 0.1 * least) {
                best = Some((off, places, is_usual));
            }
        }
    }
    match best {
        Some((off, places, true)) if off <= ON_PATH_M => Ok(places),
        Some((off, _, false)) if off <= ON_PATH_M => Err(machine_tools::lacking(
            look,
            "the commanded positions turn with the sign of an angle, as a head does, and a table turns against the sign: heads are not known; of \
             a table, write the angles with the opposite sign",
        )),
        _ => Err(machine_tools::lacking(
            look,
            "the commanded positions do not go round with the table: write those of the machine's slides, and one place of the sphere a file",
        )),
    }
}

/// The places of axes across themselves at which a sphere on the table is nearest to a path, and how far the farthest row is off.
fn fitted(points: &[Vector3<f64>], turning: &[Turning], signs: [f64; 2]) -> (f64, Vec<[f64; 2]>) {
    let unknowns = 2 * turning.len() + 3;
    let rows = |row: usize| {
        let mut block = DMatrix::zeros(3, unknowns);
        let mut turn = Rotation3::identity();
        for (at, (own, sign)) in turning.iter().zip(signs).enumerate() {
            for (column, axis) in own.across().into_iter().enumerate() {
                block.column_mut(2 * at + column).copy_from(&turn.matrix().column(axis));
            }
            turn *= own.turn(row, sign);
        }
        block.columns_mut(unknowns - 3, 3).copy_from(turn.matrix());
        block
    };
    let mut normal = DMatrix::zeros(unknowns, unknowns);
    let mut right = DVector::zeros(unknowns);
    for (row, point) in points.iter().enumerate() {
        let block = rows(row);
        normal += block.transpose() * &block;
        right += block.transpose() * point;
    }
    let Some(solved) = machine_tools::solved(normal, &right) else {
        return (f64::INFINITY, Vec::new());
    };
    let off = points.iter().enumerate().map(|(row, point)| (rows(row) * &solved - point).amax());
    let farthest = off.fold(0.0, f64::max);
    let places = (0..turning.len()).map(|at| [solved[2 * at], solved[2 * at + 1]]).collect();
    (farthest, places)
}

fn chain(
    turning: &[Turning],
    places: &[[f64; 2]],
    slides: &machine_tools::Slides,
    statements: &str,
) -> String {
    let (mut constants, mut tables, mut back) = (String::new(), String::new(), String::new());
    let mut lower = "ground".to_owned();
    let mut levels = Vec::new();
    for (own, place) in turning.iter().zip(places) {
        let (name, about) = (TURNS[own.about], AXES[own.about]);
        let across = own.across().map(|axis| AXES[axis]);
        for (axis, size) in across.iter().zip(place) {
            let _ = writeln!(constants, "    const {name}_axis_{axis}: length = {:.4} mm;", 1e3 * size);
        }
        let [one, other] = across;
        let [tilt_one, tilt_other] = own.across().map(|axis| TURNS[axis].to_uppercase());
        let [up, up_one, up_other] = [name, one, other].map(str::to_uppercase);
        let _ = write!(
            tables,
            "    /// What turns by {name}.
    body {name}_table on {lower} {{
        position: T{one}({name}_axis_{one}), T{other}({name}_axis_{other});
        position_error:
            /// The axis {name} along {one} ({up_one}0{up} of ISO 230-1).
            T{one}({name}_shift_{one}),
            /// The axis {name} along {other} ({up_other}0{up}).
            T{other}({name}_shift_{other}),
            /// Tilt of the axis {name} about {one} ({tilt_one}0{up}).
            R{one}({name}_tilt_{one}),
            /// Tilt of the axis {name} about {other} ({tilt_other}0{up}).
            R{other}({name}_tilt_{other});
        motion: R{about}(-{name});
    }}

"
        );
        lower = format!("{name}_table");
        levels.push((name, about, across));
    }
    let mut below = "nest".to_owned();
    for (name, about, [one, other]) in levels.iter().rev() {
        let _ = write!(
            back,
            "    body {name}_turned_back on {below} {{
        motion: R{about}({name});
    }}
    body {name}_axes on {name}_turned_back {{
        position: T{one}(-{name}_axis_{one}), T{other}(-{name}_axis_{other});
    }}

"
        );
        below = format!("{name}_axes");
    }
    format!(
        "/// A machine with three slides in a row, and a table that turns.
chain RTest {{
    /// Where the axes of the table are, by the commanded positions.
{constants}
{statements}{}{tables}    /// Where the sphere has its place on the table.
    body nest on {lower} {{
        position_error:
            /// The place of the sphere against the commanded one.
            Tx(nest_x), Ty(nest_y), Tz(nest_z);
    }}

    /// The frame of the table, turned back to the axes of the machine.
{back}    /// Where the sphere on the tool is, as seen from the table.
    observe sphere: point(0, 0, 0) of {} in {below};
}}
",
        slides.bodies, slides.last
    )
}
