//! Whole columns without what the objects could explain of them.
//!
//! An object's rows are rotated so that its numbers move only the first of them; these are put to zero. What is left is
//! as white as the rows were, and has no part of any object: a column of the search is then one that objects would not
//! have followed, in rows that were held out as well, where each object is estimated anew from its own rows alone.

use std::ops::Range;

use faer::{Mat, Side};
use nalgebra::Vector3;

use super::lanes::{add, dot};
use super::within::Within;
use observe::unknowns::{Freedom, Unknowns, WIDTH};

/// A direction of an object of which less than this share is left by those before moves nothing of its own.
const NOTHING: f64 = 1e-8;

/// A combination of stations' columns of length one of which this share of the sum of squares is left moves nothing of its own.
const MOVED: f64 = 1e-10;

/// Rows that are multiplied at a time.
const CHUNK: usize = 8192;

/// What one object's rows are rotated by.
#[derive(Debug, Clone)]
struct Turned {
    /// The object's components.
    at: Vec<usize>,
    /// Unit vectors of reflections, one a column.
    reflections: Mat<f64>,
    /// The triangle of the object's numbers.
    factor: Mat<f64>,
    /// Derivatives by the object's numbers before whitening.
    columns: Mat<f64>,
    /// Which of the numbers the rows move.
    moves: Vec<bool>,
    /// Whitened orthonormal columns that span what those do.
    units: Vec<Vec<f64>>,
}

/// The rotation of all objects' rows.
#[derive(Debug, Clone)]
pub struct Reduction {
    turned: Vec<Turned>,
    /// Objects that are stated to within an uncertainty, where that counts.
    within: Vec<Within>,
    /// What whitening and the robust weight multiply each component by.
    scale: Vec<f64>,
}

impl Reduction {
    /// Of components that belong to `row`s of the observations, each with its derivatives by what is unknown before
    /// whitening and what whitening multiplies it by. Objects are unknown, whatever is stated of them.
    pub fn new(unknowns: &Unknowns, row: &[u32], unknown: &[[f64; WIDTH]], scale: Vec<f64>) -> Self {
        let objects = components_of(unknowns, row).into_iter().zip(&unknowns.objects);
        let turned =
            parallel::each_of(objects, |(at, object)| Turned::new(at, object.numbers(), unknown, &scale));
        Self { turned: turned.into_iter().flatten().collect(), within: Vec::new(), scale }
    }

    /// The same, but objects that are stated to within an uncertainty move no further than that lets them, and exact points that alone
    /// hold the frame move together.
    pub fn as_stated(unknowns: &Unknowns, row: &[u32], unknown: &[[f64; WIDTH]], scale: Vec<f64>) -> Self {
        let (mut turned, mut within) = (Vec::new(), Vec::new());
        let components = components_of(unknowns, row);
        let (at, columns) = moved_together(unknowns, &components, unknown);
        turned.extend(Turned::of(at, columns, &scale));
        for (at, object) in components.into_iter().zip(&unknowns.objects) {
            if let Freedom::Within { shift_m, .. } = object.freedom {
                let columns = Mat::from_fn(at.len(), object.numbers(), |i, j| unknown[at[i]][j]);
                within.extend(Within::new(at, columns, &scale, shift_m));
            } else {
                turned.extend(Turned::new(at, object.numbers(), unknown, &scale));
            }
        }
        Self { turned, within, scale }
    }

    /// Rotates a whitened and weighted column, and puts to zero what objects explain.
    pub fn reduce(&self, column: &mut [f64]) {
        let mut own = Vec::new();
        for turned in &self.turned {
            turned.gather(column, &mut own);
            turned.turn(&mut own);
            own.iter_mut()
                .zip(&turned.moves)
                .filter(|(_, moves)| **moves)
                .for_each(|(value, _)| *value = 0.0);
            turned.at.iter().zip(&own).for_each(|(&at, value)| column[at] = *value);
        }
        self.within.iter().for_each(|within| within.reduce(column));
    }

    /// Takes out of a column before whitening what the objects, each estimated from its own rows, explain of it.
    pub fn estimate_anew(&self, column: &mut [f64]) {
        for turned in &self.turned {
            let k = turned.moves.len();
            let mut own: Vec<f64> = turned.at.iter().map(|&at| column[at] * self.scale[at]).collect();
            turned.turn(&mut own);
            let mut numbers = vec![0.0; k];
            for row in (0..k).rev().filter(|&row| turned.moves[row]) {
                let behind: f64 = (row + 1..k).map(|j| turned.factor[(row, j)] * numbers[j]).sum();
                numbers[row] = (own[row] - behind) / turned.factor[(row, row)];
            }
            for (i, &at) in turned.at.iter().enumerate() {
                column[at] -=
                    numbers.iter().enumerate().map(|(j, b)| turned.columns[(i, j)] * b).sum::<f64>();
            }
        }
        self.within.iter().for_each(|within| within.estimate_anew(column, &self.scale));
    }
}

impl Reduction {
    /// Takes out of whitened columns what objects and stations explain of them, in place.
    pub fn project(
        &self,
        unknowns: &Unknowns,
        row: &[u32],
        unknown: &[[f64; WIDTH]],
        columns: &mut Mat<f64>,
    ) {
        self.take_out(columns);
        let mut stations = unknowns.station_columns(row, unknown);
        for column in stations.col_iter_mut() {
            column.iter_mut().zip(&self.scale).for_each(|(value, scale)| *value *= scale);
        }
        self.take_out(&mut stations);
        let root = root(&products(&stations, &stations));
        let taken = &root * (root.transpose() * products(&stations, columns));
        let parts = in_chunks(stations.nrows(), |rows| stations.subrows(rows.start, rows.len()) * &taken);
        let mut at = 0;
        for explained in parts {
            let count = explained.nrows();
            let mut columns = columns.subrows_mut(at, count);
            columns -= &explained;
            at += count;
        }
    }

    /// Takes out of whitened columns what objects explain of them.
    fn take_out(&self, columns: &mut Mat<f64>) {
        let without = |j: usize| {
            let mut column = columns.col_as_slice(j).to_vec();
            let mut own = Vec::new();
            for turned in &self.turned {
                turned.gather(&column, &mut own);
                for unit in &turned.units {
                    let share = dot(unit, &own);
                    add(&mut own, -share, unit);
                }
                turned.at.iter().zip(&own).for_each(|(&at, value)| column[at] = *value);
            }
            column
        };
        let columns_without: Vec<Vec<f64>> = parallel::each(columns.ncols(), without);
        for (j, column) in columns_without.into_iter().enumerate() {
            columns.col_as_slice_mut(j).copy_from_slice(&column);
        }
    }
}

/// The components of each object.
fn components_of(unknowns: &Unknowns, row: &[u32]) -> Vec<Vec<usize>> {
    let mut components: Vec<Vec<usize>> = vec![Vec::new(); unknowns.objects.len()];
    for (component, &row) in row.iter().enumerate() {
        if let Some(object) = unknowns.object[row as usize] {
            components[object as usize].push(component);
        }
    }
    components
}

/// The components of exact points that alone hold the frame, and their derivatives by a shift and a turn of all of these: where they are
/// is no more known than where everything else is, and only how far from each other says something of the errors.
fn moved_together(
    unknowns: &Unknowns,
    components: &[Vec<usize>],
    unknown: &[[f64; WIDTH]],
) -> (Vec<usize>, Mat<f64>) {
    let points = unknowns.points_of_frame();
    let own = points.iter().flat_map(|&object| components[object].iter().map(move |&at| (at, object)));
    let own: Vec<(usize, usize)> = own.collect();
    let columns = own.iter().map(|&(at, object)| {
        let [x, y, z, ..] = unknown[at];
        let by_shift = Vector3::new(x, y, z);
        let by_turn = unknowns.objects[object].place.cross(&by_shift);
        [x, y, z, by_turn.x, by_turn.y, by_turn.z]
    });
    let columns: Vec<[f64; 6]> = columns.collect();
    let count = columns.len().min(6);
    (own.into_iter().map(|(at, _)| at).collect(), Mat::from_fn(columns.len(), count, |i, j| columns[i][j]))
}

/// What `f` makes of some rows at a time, in order.
fn in_chunks<T: Send>(rows: usize, f: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
    let chunk = |number: usize| number * CHUNK..((number + 1) * CHUNK).min(rows);
    parallel::each(rows.div_ceil(CHUNK), |number| f(chunk(number)))
}

/// The inner products of the columns of one matrix with those of another.
fn products(a: &Mat<f64>, b: &Mat<f64>) -> Mat<f64> {
    let parts = in_chunks(a.nrows(), |rows| {
        a.subrows(rows.start, rows.len()).transpose() * b.subrows(rows.start, rows.len())
    });
    parts.into_iter().fold(Mat::zeros(a.ncols(), b.ncols()), |sum, part| sum + part)
}

/// A matrix that makes of columns with these inner products orthonormal ones that span them.
fn root(products: &Mat<f64>) -> Mat<f64> {
    let count = products.ncols();
    let length = |j: usize| products[(j, j)].sqrt();
    let kept: Vec<usize> = (0..count).filter(|&j| length(j) > 0.0).collect();
    if kept.is_empty() {
        // No station is unknown, or none moves anything.
        return Mat::zeros(count, 0);
    }
    let scaled = Mat::from_fn(kept.len(), kept.len(), |i, j| {
        products[(kept[i], kept[j])] / (length(kept[i]) * length(kept[j]))
    });
    let Ok(eigen) = scaled.self_adjoint_eigen(Side::Lower) else { return Mat::zeros(count, 0) };
    let values = eigen.S().column_vector();
    let largest = values.iter().copied().fold(0.0, f64::max);
    let seen: Vec<usize> = (0..kept.len()).filter(|&at| values[at] > MOVED * largest).collect();
    let mut root = Mat::zeros(count, seen.len());
    for (to, &at) in seen.iter().enumerate() {
        for (i, &row) in kept.iter().enumerate() {
            root[(row, to)] = eigen.U()[(i, at)] / values[at].sqrt() / length(row);
        }
    }
    root
}

impl Turned {
    /// Of the components of an object of so many numbers; none where it has none, or no rows.
    fn new(at: Vec<usize>, numbers: usize, unknown: &[[f64; WIDTH]], scale: &[f64]) -> Option<Self> {
        let columns = Mat::from_fn(at.len(), numbers.min(at.len()), |i, j| unknown[at[i]][j]);
        Self::of(at, columns, scale)
    }

    /// Of components with their derivatives by what moves them; none where nothing does.
    fn of(at: Vec<usize>, columns: Mat<f64>, scale: &[f64]) -> Option<Self> {
        let k = columns.ncols();
        if k == 0 {
            return None;
        }
        let mut matrix = Mat::from_fn(at.len(), k, |i, j| columns[(i, j)] * scale[at[i]]);
        let (reflections, moves) = reflected(&mut matrix);
        let factor = Mat::from_fn(k, k, |i, j| if i <= j { matrix[(i, j)] } else { 0.0 });
        let units = units(&reflections, &moves);
        Some(Self { at, reflections, factor, columns, moves, units })
    }

    /// The object's part of a column.
    fn gather(&self, column: &[f64], own: &mut Vec<f64>) {
        own.clear();
        own.extend(self.at.iter().map(|&at| column[at]));
    }

    fn turn(&self, own: &mut [f64]) {
        for number in (0..self.moves.len()).filter(|&number| self.moves[number]) {
            let v = self.reflections.col_as_slice(number);
            let share = dot(v, own);
            add(own, -2.0 * share, v);
        }
    }
}

/// Whitened unit columns that span what an object moves: what reflections make of the first of their coordinates.
pub(super) fn units(reflections: &Mat<f64>, moves: &[bool]) -> Vec<Vec<f64>> {
    let moving = || (0..moves.len()).filter(|&number| moves[number]);
    let unit = |number: usize| {
        let mut unit = vec![0.0; reflections.nrows()];
        unit[number] = 1.0;
        for number in moving().rev() {
            let v = reflections.col_as_slice(number);
            let share = dot(v, &unit);
            add(&mut unit, -2.0 * share, v);
        }
        unit
    };
    moving().map(unit).collect()
}

/// Turns a matrix into a triangle in place; the reflections, and which columns had anything of their own.
pub(super) fn reflected(matrix: &mut Mat<f64>) -> (Mat<f64>, Vec<bool>) {
    let (rows, columns) = matrix.shape();
    let mut reflections = Mat::zeros(rows, columns);
    let mut moves = vec![false; columns];
    let lengths: Vec<f64> = matrix.col_iter().map(|column| column.norm_l2()).collect();
    for j in 0..columns {
        let left = matrix.col(j).subrows(j, rows - j).norm_l2();
        if left <= NOTHING * lengths[j] || left == 0.0 {
            continue;
        }
        moves[j] = true;
        let mut v = vec![0.0; rows];
        (j..rows).for_each(|i| v[i] = matrix[(i, j)]);
        v[j] += left.copysign(v[j]);
        let length = v.iter().map(|value| value * value).sum::<f64>().sqrt();
        v.iter_mut().for_each(|value| *value /= length);
        for column in j..columns {
            let share: f64 = 2.0 * (j..rows).map(|i| v[i] * matrix[(i, column)]).sum::<f64>();
            (j..rows).for_each(|i| matrix[(i, column)] -= share * v[i]);
        }
        reflections.col_as_slice_mut(j).copy_from_slice(&v);
    }
    (reflections, moves)
}

#[cfg(test)]
mod tests {
    use super::*;
    use observe::unknowns::{Object, Shape, Station};

    /// What an object explains is gone, and a column that it does not follow keeps its length.
    #[test]
    fn an_objects_own_columns_vanish() {
        let unknowns = Unknowns {
            objects: vec![
                Object::unknown("A".to_owned(), Shape::Plane),
                Object::unknown("B".to_owned(), Shape::Plane),
            ],
            stations: vec![Station::ground()],
            object: (0..12).map(|row| (row != 5).then_some(row % 2)).collect(),
            station: vec![0; 12],
        };
        let row: Vec<u32> = (0..12).collect();
        let derivative = |i: usize, j: usize| ((i * 7 + j * 5) as f64 * 0.9).sin();
        let unknown: Vec<[f64; WIDTH]> =
            (0..12).map(|i| std::array::from_fn(|j| if j < 3 { derivative(i, j) } else { 0.0 })).collect();
        let scale: Vec<f64> = (0..12).map(|i| 1.0 + f64::from(i) * 0.1).collect();
        let reduction = Reduction::new(&unknowns, &row, &unknown, scale.clone());
        // Different amounts of the numbers of either object, and something in the row that has none.
        let explained =
            |i: usize| (0..3).map(|j| (1.0 + (i % 2) as f64) * (j as f64 + 1.0) * unknown[i][j]).sum::<f64>();
        let physical: Vec<f64> = (0..12).map(|i| if i == 5 { 3.0 } else { explained(i) }).collect();
        let mut white: Vec<f64> = physical.iter().zip(&scale).map(|(value, scale)| value * scale).collect();
        reduction.reduce(&mut white);
        let left: f64 = white.iter().enumerate().filter(|(i, _)| *i != 5).map(|(_, x)| x * x).sum();
        assert!(left < 1e-24 && (white[5] - 3.0 * scale[5]).abs() < 1e-12, "{white:?}");
        let mut anew = physical;
        reduction.estimate_anew(&mut anew);
        assert!(anew.iter().enumerate().all(|(i, x)| i == 5 || x.abs() < 1e-12) && anew[5] == 3.0);
    }
}
