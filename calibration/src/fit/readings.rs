//! Readings that are not exact: what they bring into the residuals.

use super::solver::Solver;
use super::sweep::residuals;
use super::{FitError, Model};

impl Solver<'_> {
    /// The same model without derivatives.
    pub(super) fn plain(&self) -> &Model {
        self.plain.get_or_init(|| Model::without_columns(self.chain, &self.observations.poses))
    }

    /// Per component the standard deviation, rad or m, that the stated uncertainties of its row's readings bring at some values: each
    /// reading is moved by its own to either side. Empty where all are exact.
    pub(super) fn brought_at(&self, values: &[f64]) -> Result<Vec<f64>, FitError> {
        let stated = &self.observations.reading_sigma;
        if stated.is_empty() {
            return Ok(Vec::new());
        }
        let mut squares = vec![0.0; self.layout.components()];
        let mut moved = self.observations.clone();
        for (id, sigma) in stated {
            // A reading that no observable hangs on brings nothing.
            let Some(at) = moved.poses.columns.iter().position(|(own, _)| own == id) else { continue };
            let read = &self.observations.poses.columns[at].1;
            let mut there = |share: f64| {
                let column = moved.poses.columns[at].1.iter_mut();
                column.zip(read).zip(sigma).for_each(|((to, read), sigma)| *to = read + share * sigma);
                residuals(self.plain(), &moved, values)
            };
            let (more, less) = (there(1.0)?, there(-1.0)?);
            moved.poses.columns[at].1.clone_from(read);
            for (square, (more, less)) in squares.iter_mut().zip(more.iter().zip(less)) {
                *square += (0.5 * (more - less)).powi(2);
            }
        }
        Ok(squares.into_iter().map(f64::sqrt).collect())
    }
}
