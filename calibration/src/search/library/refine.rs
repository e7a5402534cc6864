//! Thresholds refined: from the grid to where a shape explains most.

use faer::Mat;

use super::grid::Driver;
use super::shape::Shape;

/// How far thresholds are refined, as a share of the readings' range.
const FINEST: f64 = 1.0 / 4000.0;

/// How often thresholds are moved on at one step: from one end of the readings to the other. What explains a little more with
/// every step further has no best place.
const MOVES: usize = 72;

/// What is left of a column's sum of squares below which it is not seen.
const VISIBLE: f64 = 1e-4;

/// What single columns explain of a residual, after a regression.
pub(super) struct Gain<'a> {
    /// Orthonormal columns of the regression.
    pub basis: &'a Mat<f64>,
    /// What it leaves.
    pub residual: &'a [f64],
}

impl Gain<'_> {
    /// What a column takes off the sum of squares.
    pub fn of(&self, column: &[f64]) -> f64 {
        let dot = |a: &[f64]| a.iter().zip(column).map(|(a, b)| a * b).sum::<f64>();
        let whole = dot(column);
        let taken: f64 = (0..self.basis.ncols()).map(|j| dot(self.basis.col_as_slice(j)).powi(2)).sum();
        let left = whole - taken;
        if left > VISIBLE * whole { dot(self.residual).powi(2) / left } else { 0.0 }
    }
}

/// The shape with its thresholds moved to where it explains most, one after the other at ever smaller steps from `step` on.
pub(super) fn refined(
    shape: Shape,
    driver: &Driver,
    mut step: f64,
    gain: &Gain<'_>,
    column: impl Fn(&Shape) -> Mat<f64>,
) -> (Shape, f64) {
    let of = |shape: &Shape| gain.of(column(shape).col_as_slice(0));
    let mut best = (of(&shape), shape);
    let mut moves = 0;
    while step > FINEST * driver.span() {
        let mut moved = false;
        moves += 1;
        for at in 0..best.1.parameters() {
            for sign in [-1.0, 1.0] {
                let mut to = best.1.thresholds();
                to[at] += sign * step;
                let moved_to = best.1.moved(&to);
                let Some(other) = moved_to.filter(|shape| shape.is_seen_between(driver.low, driver.high))
                else {
                    continue;
                };
                let explains = of(&other);
                if explains > best.0 {
                    best = (explains, other);
                    moved = true;
                }
            }
        }
        if !moved || moves == MOVES {
            (step, moves) = (step / 2.0, 0);
        }
    }
    (best.1, best.0)
}

/// Orthonormal columns that span those given, in their order; those that the ones before leave nothing of are left out.
pub(crate) fn orthonormal(columns: impl Iterator<Item = Vec<f64>>, rows: usize) -> Mat<f64> {
    let mut found: Vec<Vec<f64>> = Vec::new();
    for mut column in columns {
        let whole: f64 = column.iter().map(|v| v * v).sum();
        for _ in 0..2 {
            for known in &found {
                let share: f64 = known.iter().zip(&column).map(|(a, b)| a * b).sum();
                column.iter_mut().zip(known).for_each(|(c, k)| *c -= share * k);
            }
        }
        let left: f64 = column.iter().map(|v| v * v).sum();
        if left > 1e-9 * whole && whole > 0.0 {
            let length = left.sqrt();
            column.iter_mut().for_each(|v| *v /= length);
            found.push(column);
        }
    }
    Mat::from_fn(rows, found.len(), |i, j| found[j][i])
}

/// What orthonormal columns leave of a residual.
pub(crate) fn take_out(basis: &Mat<f64>, residual: &mut [f64]) {
    for own in basis.col_iter() {
        let share: f64 = own.iter().zip(&*residual).map(|(a, b)| a * b).sum();
        residual.iter_mut().zip(own.iter()).for_each(|(r, u)| *r -= share * u);
    }
}

#[cfg(test)]
mod tests {
    use model_core::SymbolId;

    use super::*;

    /// The wider the bump, the more it explains of a parabola.
    #[test]
    fn what_explains_ever_more_further_out_comes_to_an_end() {
        let readings: Vec<f64> = (0..200).map(|i| f64::from(i) / 200.0).collect();
        let target: Vec<f64> = readings.iter().map(|&x| 1.0 - (x - 0.5).powi(2) / 1e3).collect();
        let basis = orthonormal(std::iter::empty(), 200);
        let gain = Gain { basis: &basis, residual: &target };
        let column = |shape: &Shape| shape.values(&readings);
        let driver =
            Driver::of_readings(SymbolId(0), &readings, false).expect("readings to be a function of");
        let start = Shape::Bump { middle: 0.5, width: 0.1 };
        let (_, explained) = refined(start, &driver, 1.0 / 36.0, &gain, column);
        assert!(explained.is_finite());
    }

    #[test]
    fn a_threshold_is_found_between_the_points_of_a_grid() {
        let readings: Vec<f64> = (0..2000).map(|i| f64::from(i) / 2000.0).collect();
        let target: Vec<f64> =
            readings.iter().map(|&x| if x >= 0.6173 { 1.0 } else { 0.0 } - 0.3827).collect();
        let basis = orthonormal(std::iter::once(vec![1.0; 2000]), 2000);
        let gain = Gain { basis: &basis, residual: &target };
        let column = |shape: &Shape| shape.values(&readings);
        let driver =
            Driver::of_readings(SymbolId(0), &readings, false).expect("readings to be a function of");
        let (shape, _) = refined(Shape::Step { at: 0.6 }, &driver, 1.0 / 36.0, &gain, column);
        assert!((shape.thresholds()[0] - 0.6173).abs() < 1e-3, "{shape:?}");
    }
}
