//! Places that rows come back to: readings that lie together in bunches, far from all others.
//!
//! Whoever observes the same targets in several rounds, or reads a pose more than once, has bunches: rows of one lie nearer to
//! each other than to any other row, by far. Rows of a path or of a cloud have none, however dense they lie.

use model_core::{Chain, Quantity, SymbolId, SymbolKind};
use rayon::prelude::*;

use super::joined::Joined;
use super::{Poses, golden};

/// How much further the rows of other places are than those of one are from each other, at least.
const APART: f64 = 2.5;

/// How far apart places are tried to be, as shares of the ranges that the readings cover: from here to there, doubled each time.
const NEAREST: f64 = 1e-9;
const FURTHEST: f64 = 0.1;

/// A chain of rows that is wider than a place is long where it holds more than one of so many rows.
const LONG: usize = 10;

/// Pairs of rows that are compared at most, for each row, and found apart or together: where there are more, rows lie too dense to
/// say.
const FOUND_APART: usize = 64;
const FOUND_TOGETHER: usize = 500;

/// Rows of a sample that tell whether places of a size are worth looking for, and the share of them that is near to another row at
/// least: less than the half that it takes, by more than chance.
const SAMPLE: usize = 4096;
const NEAR: f64 = 0.4;

/// The place of each row, numbered from 0 in the order of the rows; `None` where less than half of the rows share theirs.
///
/// A place is told by joints, and by inputs that are lengths or angles: not by the temperature, the time or the side from which
/// it was approached.
#[must_use]
pub fn places(chain: &Chain, poses: &Poses) -> Option<Vec<u32>> {
    let readings = scaled(chain, poses);
    let rows = readings.first()?.len();
    let line = Line::through(&readings);
    let mut best: Option<(usize, Vec<u32>)> = None;
    let mut apart = NEAREST / 2.0;
    while 2.0 * apart <= FURTHEST {
        apart *= 2.0;
        match line.may_have_places(apart) {
            None => break,
            Some(false) => continue,
            Some(true) => {}
        }
        let Some((linked, links)) = linked(&line, apart) else { break };
        // A link brings two rows together at most.
        if 4 * links >= rows {
            let (shared, of_row) = bunches(linked, &readings, apart / APART);
            if 2 * shared >= rows && best.as_ref().is_none_or(|(most, _)| shared > *most) {
                best = Some((shared, of_row));
            }
        }
    }
    best.map(|(_, of_row)| of_row)
}

/// The readings that tell a place, each over the range that it covers.
fn scaled(chain: &Chain, poses: &Poses) -> Vec<Vec<f64>> {
    let tells = |kind: SymbolKind, quantity: Quantity| match kind {
        SymbolKind::Joint => true,
        SymbolKind::Input => quantity != Quantity::Number,
        _ => false,
    };
    let of_column = |(id, values): &(SymbolId, Vec<f64>)| {
        let symbol = chain.symbol(*id);
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let range = high - low;
        (tells(symbol.kind, symbol.quantity) && range > 0.0 && range.is_finite())
            .then(|| values.iter().map(|value| value / range).collect())
    };
    parallel::each_of(&poses.columns, of_column).into_iter().flatten().collect()
}

/// Rows in the order in which they lie along a line through the space of the readings.
struct Line {
    order: Vec<u32>,
    /// Where they lie, in that order.
    at: Vec<f64>,
    /// Their readings, in that order: rows that are compared lie side by side.
    readings: Vec<Vec<f64>>,
    /// How far apart along it rows can be that differ by one in every reading.
    stretch: f64,
}

impl Line {
    fn through(readings: &[Vec<f64>]) -> Self {
        let rows = readings.first().map_or(0, Vec::len);
        // They add up to the same for hardly any two rows of a grid.
        let weights: Vec<f64> = (0..readings.len()).map(|power| golden::SECTION.powi(power as i32)).collect();
        let of_row = |row: usize| -> f64 {
            readings.iter().zip(&weights).map(|(values, weight)| weight * values[row]).sum()
        };
        let mut placed: Vec<(f64, u32)> =
            (0..rows).into_par_iter().map(|row| (of_row(row), row as u32)).collect();
        placed.par_sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let (at, order): (Vec<f64>, Vec<u32>) = placed.into_iter().unzip();
        let ordered = |values: &Vec<f64>| order.iter().map(|&row| values[row as usize]).collect();
        let readings = parallel::each_of(readings, ordered);
        Self { order, at, readings, stretch: weights.iter().sum() }
    }

    /// Whether two rows are no further than a distance from each other in every reading.
    fn are_near(&self, a: usize, b: usize, distance: f64) -> bool {
        self.readings.iter().all(|values| (values[b] - values[a]).abs() <= distance)
    }

    /// Whether half of the rows may be that near to another, by a sample of them; surely where there are few. `None` where rows lie
    /// too dense.
    fn may_have_places(&self, distance: f64) -> Option<bool> {
        let (rows, reach) = (self.at.len(), self.stretch * distance);
        if rows <= 4 * SAMPLE {
            return Some(true);
        }
        let of_sample = |sample: usize| {
            let row = (golden::share(sample) * rows as f64) as usize;
            let start = self.at.partition_point(|at| self.at[row] - at > reach);
            let end = self.at.partition_point(|at| at - self.at[row] <= reach);
            // Of those that a row would be compared with at most, on either side.
            let most = FOUND_APART + FOUND_TOGETHER;
            let mut others = (row + 1..end).take(most).chain((start..row).rev().take(most));
            (usize::from(others.any(|other| self.are_near(row, other, distance))), end - row - 1)
        };
        let both = |a: (usize, usize), b: (usize, usize)| (a.0 + b.0, a.1 + b.1);
        let (near, compared) = (0..SAMPLE).into_par_iter().map(of_sample).reduce(|| (0, 0), both);
        // Twice as many as are compared, so that a sample does not decide a close case.
        let too_dense = compared > 2 * (FOUND_APART + FOUND_TOGETHER) * SAMPLE;
        (!too_dense).then_some(near as f64 >= NEAR * SAMPLE as f64)
    }
}

/// Rows in chains, link by link no further than a distance from the next in every reading, and how many links it took; `None` where
/// rows lie too dense.
fn linked(line: &Line, distance: f64) -> Option<(Joined, usize)> {
    let rows = line.order.len();
    let (mut linked, mut links) = (Joined::alone(rows), 0);
    let (mut apart, mut together) = (FOUND_APART * rows, FOUND_TOGETHER * rows);
    let reach = line.stretch * distance;
    for row in 0..rows {
        for other in row + 1..rows {
            if line.at[other] - line.at[row] > reach {
                break;
            }
            if line.are_near(row, other, distance) {
                together = together.checked_sub(1)?;
                links += usize::from(linked.join(line.order[row] as usize, line.order[other] as usize));
            } else {
                apart = apart.checked_sub(1)?;
            }
        }
    }
    Some((linked, links))
}

/// How many rows share a place with others, a chain that is no wider than this; and the place of each row. Places too near to each
/// other to be told apart count as one; the rows of a long chain have one each.
fn bunches(mut linked: Joined, readings: &[Vec<f64>], widest: f64) -> (usize, Vec<u32>) {
    let rows = readings.first().map_or(0, Vec::len);
    let roots: Vec<usize> = (0..rows).map(|row| linked.first(row)).collect();
    let mut size = vec![0_usize; rows];
    roots.iter().for_each(|&root| size[root] += 1);
    let mut narrow = vec![true; rows];
    for values in readings {
        let mut ends = vec![[f64::INFINITY, f64::NEG_INFINITY]; rows];
        for (value, &root) in values.iter().zip(&roots) {
            let [low, high] = ends[root];
            ends[root] = [low.min(*value), high.max(*value)];
        }
        narrow.iter_mut().zip(ends).for_each(|(narrow, [low, high])| *narrow &= high - low <= widest);
    }
    let is_place = |root: usize| size[root] > 1 && narrow[root];
    let is_long = |root: usize| !narrow[root] && LONG * size[root] > rows;
    let mut number: Vec<Option<u32>> = vec![None; rows];
    let mut next = 0;
    let mut shared = 0;
    let mut of_row = Vec::with_capacity(rows);
    for (row, &root) in roots.iter().enumerate() {
        let key = if is_long(root) { row } else { root };
        shared += usize::from(is_place(root));
        let place = *number[key].get_or_insert_with(|| {
            next += 1;
            next - 1
        });
        of_row.push(place);
    }
    (shared, of_row)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The places of rows of two joints.
    fn of(joints: impl Fn(usize) -> [f64; 2], rows: usize) -> Option<Vec<u32>> {
        let text = "chain C { body a on ground { motion: Rz(p); motion_error: Rz(e); } body b on a { motion: Rx(q); } \
                    observe o: direction(0, 1, 0) of b; }";
        let Ok(chain) = Chain::from_text(text) else { unreachable!("the declaration is right") };
        let column = |at: usize| (0..rows).map(|row| joints(row)[at]).collect();
        let mut columns: Vec<_> = ["p", "q"]
            .iter()
            .enumerate()
            .filter_map(|(at, name)| Some((chain.find_symbol(name)?, column(at))))
            .collect();
        columns.sort_by_key(|(id, _)| *id);
        places(&chain, &Poses { series: Vec::new(), columns })
    }

    /// Numbers that fill the unit interval evenly.
    fn even(row: usize, step: f64) -> f64 {
        (row as f64 * step).fract()
    }

    #[test]
    fn rounds_are_places() {
        let target = |row: usize| [even(row % 40, 0.754_877_666), even(row % 40, 0.569_840_291)];
        let rounds: Vec<u32> = (0..200).map(|row| row % 40).collect();
        assert_eq!(of(target, 200), Some(rounds.clone()));
        let aimed = |row: usize| target(row).map(|q| q + 0.001 * even(row * row, 0.618_033_99));
        assert_eq!(of(aimed, 200), Some(rounds));
        // Each read to its end.
        let read: Vec<u32> = (0..200).map(|row| row / 5).collect();
        assert_eq!(of(|row| target(row / 5), 200), Some(read));
        // Six poses, four hundred times.
        assert_eq!(of(|row| target(row % 6), 2400), Some((0..2400).map(|row| row % 6).collect()));
    }

    /// Where a sample tells of which size places may be.
    #[test]
    fn places_of_many_rows_are_those_of_few() {
        let rows = 5 * SAMPLE;
        let target = |row: usize| [even(row % 8000, 0.754_877_666), even(row % 8000, 0.569_840_291)];
        let aimed = |row: usize| target(row).map(|q| q + 1e-5 * even(row * row, 0.618_033_99));
        let rounds: Vec<u32> = (0..rows).map(|row| (row % 8000) as u32).collect();
        assert!(of(aimed, rows) == Some(rounds), "five rounds of 8000 targets");
        assert!(of(|row| [even(row, 0.754_877_666), even(row, 0.569_840_291)], rows).is_none(), "a cloud");
    }

    #[test]
    fn clouds_paths_grids_and_points_are_none() {
        let cloud = |row: usize| [even(row, 0.754_877_666), even(row, 0.569_840_291)];
        assert_eq!(of(cloud, 500), None);
        let path = |row: usize| [(row as f64 / 900.0).sin(), (row as f64 / 400.0).cos()];
        assert_eq!(of(path, 3000), None);
        assert_eq!(of(|row| [(row % 20) as f64, (row / 20) as f64], 400), None);
        // Lines of a raster, dense along one joint.
        assert_eq!(of(|row| [(row / 100) as f64, (row % 100) as f64 / 100.0], 1000), None);
        assert_eq!(of(|_| [1.0, 2.0], 50), None);
        assert_eq!(of(|_| [0.0; 2], 0), None);
        assert_eq!(of(|row| [f64::NAN, row as f64], 30), None);
    }
}
