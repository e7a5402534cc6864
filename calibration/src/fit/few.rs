//! Few rows: least squares, without rows that are proven to be wrong.
//!
//! Robust weights need the scale of the residuals. With few degrees of freedom the residuals are smaller than the noise, and
//! the weights with them. So a row counts fully or not at all here, and only rows that chance does not explain are set aside. The
//! same where objects and stations follow much of every row, however many rows there are: what robust weights do to estimates is
//! known for many rows a number.
//!
//! Source: N. El Karoui, D. Bean, P. J. Bickel, C. Lim, B. Yu, On robust regression with high-dimensional predictors, PNAS 110 (2013)
//! 14557-14562.

use statrs::distribution::{ContinuousCDF, FisherSnedecor};
use statrs::function::factorial::ln_binomial;

use super::FitError;
use super::solver::{Course, Solver};
use super::sweep::Weighting;

/// Degrees of freedom below which rows count in full or not at all.
const FEW: f64 = 100.0;

/// Components of rows with weight for each number that is estimated, below which rows that observe objects count in full or not at all.
const FOR_EACH_NUMBER: f64 = 5.0;

/// A row is suspected when a robust fit gives it less weight than this.
const SUSPECT: f64 = 0.2;

/// Rows are proven wrong when so many, chosen freely, would look as wrong with less than this chance.
const PROVEN: f64 = 0.001;

impl Solver<'_> {
    /// Whether what a course determines, objects and stations with it, leaves few degrees of freedom.
    pub(super) fn are_few(&self, course: &Course) -> bool {
        (self.layout.components() as f64) < FEW + self.used(course)
    }

    /// Whether rows that have robust weights are to count in full or not at all.
    pub(super) fn counts_in_full(&self, course: &Course) -> bool {
        let (_, weight) = self.norms_and_weights(course);
        let is_followed = (self.kept_components(&weight) as f64) < FOR_EACH_NUMBER * self.used(course);
        let is_few = self.are_few(course) || self.observations.unknowns.is_some() && is_followed;
        is_few && course.weighting == Weighting::Biweight
    }

    /// Least squares of the rows that a robust course does not prove wrong.
    pub(super) fn of_few(&mut self, robust: Course) -> Result<Course, FitError> {
        let (_, weight) = self.norms_and_weights(&robust);
        let suspect: Vec<bool> = weight.iter().map(|&weight| weight < SUSPECT).collect();
        let defined = &robust.point.sweep.defined;
        let suspects = suspect.iter().zip(defined).filter(|&(&suspect, &defined)| suspect && defined).count();
        let all = self.course(&robust.point.values, Weighting::Full)?;
        if suspects == 0 {
            return Ok(all);
        }
        let with_all = self.squares(&all, &robust, &[]);
        self.aside = suspect;
        let kept = self.course(&robust.point.values, Weighting::Full)?;
        let with_kept = self.squares(&kept, &robust, &self.aside);
        // What the rows leave after the errors, objects and stations.
        let left = with_kept.1 - self.used(&kept);
        let more = with_all.1 - self.used(&all) - left;
        // Beside the noise of rows that are wrong, all may determine less.
        if left >= 1.0 && more >= 1.0 && kept.subspace.rank() >= all.subspace.rank() {
            let ratio = (with_all.0 - with_kept.0) / more / (with_kept.0 / left);
            let chance = FisherSnedecor::new(more, left).map_or(1.0, |f| f.sf(ratio.max(0.0)));
            if chance.ln() + ln_binomial(weight.len() as u64, suspects as u64) < PROVEN.ln() {
                return Ok(kept);
            }
        }
        self.aside = Vec::new();
        Ok(all)
    }

    /// The sum of squares of a course's residuals in units of another's noise, and of how many components, without the rows
    /// that are aside.
    fn squares(&self, course: &Course, unit: &Course, aside: &[bool]) -> (f64, f64) {
        let sigma = unit.noise.sigma_without_memory();
        let sweep = &course.point.sweep;
        let components = sweep.residual.iter().zip(sigma.iter()).zip(self.layout.row_of_each());
        let counts = |row: usize| sweep.defined[row] && aside.get(row) != Some(&true);
        components
            .filter(|(_, row)| counts(*row))
            .fold((0.0, 0.0), |sums, ((value, sigma), _)| (sums.0 + (value / sigma).powi(2), sums.1 + 1.0))
    }
}
