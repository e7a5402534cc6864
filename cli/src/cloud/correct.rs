//! Points moved by what the errors of the chain add, after it was seen that the chain without errors has them where the file says.
//!
//! Where the file's coordinate is the chain's, rounded, the chain's own takes its place, so that nothing is rounded twice. Where it
//! is another within what was allowed, whoever wrote it had finer readings than the file has, and what it differs by stays.

use model_core::{Chain, ObservableId};
use rayon::prelude::*;
use service::evaluation::{Evaluator, Exactness, Quantity};

use super::header::{Header, field};
use super::points::{Cloud, Points};
use super::readings::{Columns, Readings};
use crate::failure::Failure;

/// Points that one processor looks at or moves at a time.
const PIECE: usize = 1 << 13;

/// Steps that rounding to whole ones takes away at most, with a little for the rounding of what is compared.
const ROUNDING: f64 = 0.501;

/// Points that are farther apart are other points, and no coarse readings, m.
const NEAR_M: f64 = 0.1;

/// What corrects the points of a cloud.
pub struct Corrector<'c> {
    chain: &'c Chain,
    /// The readings of each point.
    pub readings: Readings,
    /// The chain with its errors.
    pub amended: Evaluator,
    nominal: Evaluator,
    /// How far the file may be from the chain without errors, m; its own steps and those of its readings, if not said.
    tolerance_m: Option<f64>,
    /// Smallest and largest coordinate that was written of each axis; none yet.
    pub bounds: Option<[[f64; 2]; 3]>,
}

/// Columns of x, y and z.
type Coordinates = Vec<Vec<f64>>;

impl<'c> Corrector<'c> {
    /// What corrects with these values of the errors and constants.
    pub fn new(
        chain: &'c Chain,
        observable: ObservableId,
        values: &[f64],
        readings: Readings,
        tolerance_m: Option<f64>,
    ) -> Self {
        let evaluator = |values: &[f64]| {
            Evaluator::new(chain, vec![observable], Exactness::Exact, Quantity::Value, values)
        };
        let (amended, nominal) = (evaluator(values), evaluator(&chain.nominal_values()));
        Self { chain, readings, amended, nominal, tolerance_m, bounds: None }
    }

    /// Moves some points.
    ///
    /// # Errors
    /// A point that is not where the chain without errors has it, that goes to no place or to one that the file has no numbers
    /// for.
    pub fn correct(&mut self, cloud: &Cloud, points: &mut Points, columns: &Columns) -> Result<(), Failure> {
        let count = points.bytes.len() / cloud.header.record_length;
        let nominal = evaluate(&self.nominal, columns, count)?;
        let amended = evaluate(&self.amended, columns, count)?;
        self.agree(cloud, points, columns, &nominal, &amended)?;
        let (header, long) = (&cloud.header, cloud.header.record_length);
        type Moved = Result<[[i32; 2]; 3], (usize, [f64; 3])>;
        let moved: Vec<Moved> = points
            .bytes
            .par_chunks_mut(PIECE * long)
            .enumerate()
            .map(|(piece, bytes)| {
                let mut reach = [[i32::MAX, i32::MIN]; 3];
                for (row, point) in bytes.chunks_exact_mut(long).enumerate() {
                    let row = piece * PIECE + row;
                    for axis in 0..3 {
                        let stored = i32::from_le_bytes(field(point, 4 * axis));
                        let apart = coordinate(header, axis, stored) - nominal[axis][row];
                        let is_rounding = apart.abs() <= ROUNDING * header.scale[axis];
                        let kept = if is_rounding { 0.0 } else { apart };
                        let steps = steps(header, axis, amended[axis][row] + kept);
                        let steps = steps.ok_or_else(|| (row, at(&amended, row)))?;
                        point[4 * axis..4 * axis + 4].copy_from_slice(&steps.to_le_bytes());
                        reach[axis] = [reach[axis][0].min(steps), reach[axis][1].max(steps)];
                    }
                }
                Ok(reach)
            })
            .collect();
        for piece in moved {
            let reach = piece.map_err(|(row, place)| no_place(cloud, points.first + row as u64, place))?;
            let more = [0, 1, 2].map(|axis: usize| reach[axis].map(|steps| coordinate(header, axis, steps)));
            self.bounds = Some(self.bounds.map_or(more, |bounds| {
                [0, 1, 2].map(|axis: usize| {
                    [bounds[axis][0].min(more[axis][0]), bounds[axis][1].max(more[axis][1])]
                })
            }));
        }
        Ok(())
    }

    /// Refuses points that are not where the chain without errors has them.
    fn agree(
        &self,
        cloud: &Cloud,
        points: &Points,
        columns: &Columns,
        nominal: &Coordinates,
        amended: &Coordinates,
    ) -> Result<(), Failure> {
        let (header, long) = (&cloud.header, cloud.header.record_length);
        let of_axis = |point, axis| coordinate(header, axis, i32::from_le_bytes(field(point, 4 * axis)));
        let stored: Vec<[f64; 3]> = points
            .bytes
            .par_chunks_exact(long)
            .map(|point| [0, 1, 2].map(|axis| of_axis(point, axis)))
            .collect();
        let first_apart = |reach: &(dyn Fn(usize) -> [f64; 3] + Sync)| {
            (0..stored.len())
                .into_par_iter()
                .find_first(|&row| !self.is_near(stored[row], at(nominal, row), reach(row)))
        };
        if first_apart(&|_| header.scale).is_none() {
            return if self.tolerance_m.is_some() && is_corrected(header, &stored, nominal, amended) {
                Err(cloud.wrong(
                    "its points are much nearer to where the chain has them with the errors than without: it is corrected already",
                ))
            } else {
                Ok(())
            };
        }
        // What coarse readings explain is worked out only where something is to be explained.
        let reach = self.reach(header, points, columns, nominal)?;
        let Some(row) = first_apart(&|row| reach[row]) else { return Ok(()) };
        let (file, chain, number) = (stored[row], at(nominal, row), points.first + row as u64);
        if chain.iter().any(|part| !part.is_finite()) {
            return Err(cloud.wrong(format_args!(
                "point {number}: the chain without errors has no place for it: it has a pole at these readings"
            )));
        }
        let mut why = format!(
            "point {number}: it is at {}, and the chain without errors has it at {}, {} away",
            place(file),
            place(chain),
            length(distance(file, chain))
        );
        if (0..3).all(|axis| (file[axis] - amended[axis][row]).abs() <= reach[row][axis]) {
            why += ": the file is corrected already, with this model";
            return Err(cloud.wrong(why));
        }
        why += &match self.tolerance_m {
            Some(tolerance) => format!(", more than the {} that were allowed", length(tolerance)),
            None => ", more than rounding explains".to_owned(),
        };
        why +=
            ": the coordinates are in another frame or unit, or these are not the readings of these points";
        for doubt in self.readings.doubts(self.chain, columns) {
            why += &format!("; {doubt}");
        }
        let is_apart = |row: &usize| !self.is_near(stored[*row], at(nominal, *row), reach[*row]);
        let farthest =
            (0..stored.len()).map(|row| distance(stored[row], at(nominal, row))).fold(0.0, f64::max);
        why += &format!(
            ". Of the points {} to {}, {} are that far apart, up to {}",
            points.first,
            points.first + stored.len() as u64 - 1,
            (0..stored.len()).filter(is_apart).count(),
            length(farthest)
        );
        if farthest < NEAR_M {
            why += ". If the readings are no better than that, say so with --tolerance";
        }
        Err(cloud.wrong(why))
    }

    /// How far each point may be from the chain's: one step of its own, and what a step of each reading moves.
    fn reach(
        &self,
        header: &Header,
        points: &Points,
        columns: &Columns,
        nominal: &Coordinates,
    ) -> Result<Vec<[f64; 3]>, Failure> {
        let mut reach = vec![header.scale; nominal[0].len()];
        for (symbol, steps) in self.readings.steps(points) {
            let mut moved = columns.clone();
            for (_, column) in moved.iter_mut().filter(|(id, _)| *id == symbol) {
                column.iter_mut().zip(&steps).for_each(|(value, step)| *value += step);
            }
            let moved = evaluate(&self.nominal, &moved, reach.len())?;
            for (row, reach) in reach.iter_mut().enumerate() {
                let (there, here) = (at(&moved, row), at(nominal, row));
                (0..3).for_each(|axis| reach[axis] += (there[axis] - here[axis]).abs());
            }
        }
        Ok(reach)
    }

    fn is_near(&self, file: [f64; 3], chain: [f64; 3], reach: [f64; 3]) -> bool {
        match self.tolerance_m {
            Some(tolerance) => distance(file, chain) <= tolerance,
            None => (0..3).all(|axis| (file[axis] - chain[axis]).abs() <= reach[axis]),
        }
    }
}

/// Whether points lie where the chain has them with its errors, and not where it has them without: by squared distances, a quarter
/// at most, where without errors they are more than a step away.
fn is_corrected(header: &Header, stored: &[[f64; 3]], nominal: &Coordinates, amended: &Coordinates) -> bool {
    let sum = |chain: &Coordinates| -> f64 {
        stored.iter().enumerate().map(|(row, file)| distance(*file, at(chain, row)).powi(2)).sum()
    };
    let (without, with) = (sum(nominal), sum(amended));
    let step: f64 = header.scale.iter().map(|scale| scale * scale).sum();
    4.0 * with < without && without > step * stored.len() as f64
}

fn evaluate(evaluator: &Evaluator, columns: &Columns, count: usize) -> Result<Coordinates, Failure> {
    let columns: Vec<_> = columns.iter().map(|(id, column)| (*id, column.as_slice())).collect();
    Ok(evaluator.columns(&columns, count)?)
}

fn at(coordinates: &Coordinates, row: usize) -> [f64; 3] {
    [0, 1, 2].map(|axis: usize| coordinates[axis][row])
}

fn coordinate(header: &Header, axis: usize, steps: i32) -> f64 {
    f64::from(steps) * header.scale[axis] + header.offset[axis]
}

/// The steps nearest to a coordinate; none where the file has no number for it.
fn steps(header: &Header, axis: usize, coordinate: f64) -> Option<i32> {
    let steps = ((coordinate - header.offset[axis]) / header.scale[axis]).round();
    let is_held = steps >= f64::from(i32::MIN) && steps <= f64::from(i32::MAX);
    #[allow(clippy::cast_possible_truncation, reason = "the steps are whole and within the range")]
    is_held.then_some(steps as i32)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

fn place(parts: [f64; 3]) -> String {
    // Further away than any number of micrometres has digits.
    let shown = parts.map(|part| if part.abs() < 1e9 { format!("{part:.6}") } else { format!("{part:.6e}") });
    format!("({})", shown.join(", "))
}

fn length(metres: f64) -> String {
    if metres < 0.1 { format!("{:.3} mm", 1e3 * metres) } else { format!("{metres:.3} m") }
}

/// A point that goes where the file has no number for it.
fn no_place(cloud: &Cloud, number: u64, to: [f64; 3]) -> Failure {
    if to.iter().any(|part| !part.is_finite()) {
        return cloud.wrong(format_args!(
            "point {number}: the chain with its errors has no place for it: it has a pole at these readings"
        ));
    }
    let header = &cloud.header;
    let ends = |steps| place([0, 1, 2].map(|axis| coordinate(header, axis, steps)));
    cloud.wrong(format_args!(
        "point {number}: it moves to {}, and with its scale and offset the file has numbers for {} to {} only: write it again with \
         other ones first",
        place(to),
        ends(i32::MIN),
        ends(i32::MAX)
    ))
}
