//! Reach: what effects do together at the poses of the data, and at poses half a range further out.
//!
//! Effects that cancel each other over the data leave a small sum of large parts. Off the data the parts no longer cancel:
//! an amended chain with them is worse than none. Both sides are in the observation's own unit (each series over its noise),
//! with the declared errors refitted to the data.

mod poses;

use faer::{Mat, MatRef};
use model_core::SymbolId;

pub(crate) use poses::further_out;

/// The share of the poses further out, those where effects do most, that does not count: formulas have poles, at the zenith
/// and at the horizon, where no instrument points.
const POLES: f64 = 0.05;

/// What a unit of each candidate column does at poses of the data and further out.
#[derive(Debug, Clone)]
pub struct Reach {
    inside: Part,
    outside: Part,
}

/// What a unit of each candidate column does at some components.
#[derive(Debug, Clone)]
pub struct Part {
    /// One row a component, one column for each candidate column of the problem, in its order and scale, after what the
    /// declared errors, fitted to the data, take of it.
    pub columns: Mat<f64>,
    /// Which components of the problem's rows, or of the poses further out, they are.
    pub components: Vec<usize>,
    /// The joints, and their readings component by component.
    pub joints: Vec<(SymbolId, Vec<f64>)>,
}

impl Part {
    /// The components that `keep` lets through, by their position here.
    fn kept(&self, keep: impl Fn(usize) -> bool) -> Self {
        let kept: Vec<usize> = (0..self.components.len()).filter(|&at| keep(at)).collect();
        Self {
            columns: Mat::from_fn(kept.len(), self.columns.ncols(), |i, j| self.columns[(kept[i], j)]),
            components: kept.iter().map(|&at| self.components[at]).collect(),
            joints: (self.joints.iter())
                .map(|(id, readings)| (*id, kept.iter().map(|&at| readings[at]).collect()))
                .collect(),
        }
    }

    fn readings(&self, joint: SymbolId) -> &[f64] {
        let own = self.joints.iter().find(|(id, _)| *id == joint);
        own.map_or(&[], |(_, readings)| readings.as_slice())
    }
}

impl Reach {
    /// From components of the data (all, or evenly chosen ones) and of poses further out.
    #[must_use]
    pub fn new(inside: Part, outside: Part) -> Self {
        Self { inside, outside }
    }

    /// As it would be without the data in a part of a joint's range: `keep` says which components of the problem's rows are
    /// left.
    #[must_use]
    pub(crate) fn without(&self, keep: impl Fn(usize) -> bool, joint: SymbolId) -> Self {
        let inside = self.inside.kept(|at| keep(self.inside.components[at]));
        let range = poses::widened(inside.readings(joint));
        let readings = self.outside.readings(joint);
        let outside = self.outside.kept(|at| readings.get(at).is_none_or(|reading| range.contains(reading)));
        Self { inside, outside }
    }

    /// Root mean square over the data of candidate columns with these coefficients, columns numbered from the first
    /// candidate's.
    #[must_use]
    pub fn inside(&self, coefficients: &[(usize, f64)]) -> f64 {
        let squares = squares(self.inside.columns.as_ref(), coefficients);
        root_mean(&squares)
    }

    /// The same over the poses further out, the largest twentieth left out.
    #[must_use]
    pub fn outside(&self, coefficients: &[(usize, f64)]) -> f64 {
        let mut squares = squares(self.outside.columns.as_ref(), coefficients);
        squares.retain(|square| square.is_finite());
        squares.sort_unstable_by(f64::total_cmp);
        squares.truncate(squares.len() - (POLES * squares.len() as f64) as usize);
        root_mean(&squares)
    }
}

/// The square of a sum of columns, row by row.
fn squares(columns: MatRef<'_, f64>, coefficients: &[(usize, f64)]) -> Vec<f64> {
    let mut sum = vec![0.0; columns.nrows()];
    for &(column, coefficient) in coefficients {
        sum.iter_mut().zip(columns.col(column).iter()).for_each(|(s, z)| *s += coefficient * z);
    }
    sum.iter().map(|s| s * s).collect()
}

fn root_mean(squares: &[f64]) -> f64 {
    if squares.is_empty() { 0.0 } else { (squares.iter().sum::<f64>() / squares.len() as f64).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pole_does_not_count_and_a_slope_does() {
        let inside = Mat::from_fn(100, 2, |i, j| if j == 0 { 1.0 } else { i as f64 / 100.0 });
        let outside = Mat::from_fn(100, 2, |i, j| match (i, j) {
            (50, 0) => 1e6,
            (_, 0) => 1.0,
            _ => 4.0 * i as f64 / 100.0,
        });
        let part = |columns| Part { columns, components: (0..100).collect(), joints: Vec::new() };
        let reach = Reach::new(part(inside), part(outside));
        assert!((reach.inside(&[(0, 2.0)]) - 2.0).abs() < 1e-12);
        assert!((reach.outside(&[(0, 2.0)]) - 2.0).abs() < 1e-12);
        assert!(reach.outside(&[(1, 1.0)]) > 3.0 * reach.inside(&[(1, 1.0)]));
    }
}
