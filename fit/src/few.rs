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
use super::solver::{Course, LONG, Solver};
use super::sweep::Weighting;
use crate::noise::Followed;

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
        let is_followed = || {
            let (_, weight) = self.norms_and_weights(course);
            (self.kept_components(&weight) as f64) < FOR_EACH_NUMBER * self.used(course)
        };
        let has_objects = self.observations.unknowns.is_some();
        course.weighting == Weighting::Biweight && (self.are_few(course) || has_objects && is_followed())
    }

    /// Least squares without the rows that a robust course suspects and that are proven wrong.
    pub(super) fn of_few(&mut self, robust: Course) -> Result<Course, FitError> {
        let (norms, weight) = self.norms_and_weights(&robust);
        let defined = &robust.point.sweep.defined;
        let mut suspects: Vec<usize> =
            (0..norms.len()).filter(|&row| weight[row] < SUSPECT && defined[row]).collect();
        suspects.sort_by(|&a, &b| norms[b].total_cmp(&norms[a]));
        let start = robust.point.values.clone();
        if suspects.is_empty() {
            let all = self.course(&start, Weighting::Full)?;
            return Ok(self.unproven(all, robust));
        }
        let takes_long = self.layout.components() as f64 >= LONG;
        let all = self.without(&start, &[])?;
        // All of them first: those that are wrong hide each other. Beside many that are not, the furthest prove more.
        let (mut count, mut proven) = (suspects.len(), None);
        while count > 0 && proven.is_none() {
            let kept = self.without(&start, &suspects[..count])?;
            if self.proves(&all, &kept, count) {
                proven = Some(kept);
            } else {
                count = if takes_long { 0 } else { count / 2 };
            }
        }
        let Some(mut kept) = proven else {
            self.set_aside(&[]);
            return Ok(self.unproven(all.course, robust));
        };
        // The nearest of them may only be suspected beside the others.
        let mut fewer = if takes_long { 0 } else { count / 2 };
        while fewer > 0 {
            let other = self.without(&start, &suspects[..count - fewer])?;
            if self.proves(&other, &kept, fewer) {
                fewer /= 2;
            } else {
                kept = other;
                count -= fewer;
                fewer = count / 2;
            }
        }
        self.set_aside(&suspects[..count]);
        Ok(kept.course)
    }

    /// Least squares of all rows, where none is proven wrong; the robust course where that alone arrives.
    fn unproven(&self, all: Course, robust: Course) -> Course {
        if self.has_arrived(&all) || !self.has_arrived(&robust) { all } else { robust }
    }

    /// Least squares without some rows, of which nothing else is set aside.
    fn without(&mut self, start: &[f64], rows: &[usize]) -> Result<Kept, FitError> {
        self.set_aside(rows);
        let course = self.course(start, Weighting::Full)?;
        let (norms, weight) = self.norms_and_weights(&course);
        let counted = weight.iter().filter(|weight| **weight > 0.0).count();
        let squares = norms.iter().zip(&weight).filter(|(_, weight)| **weight > 0.0);
        let left = self.kept_components(&weight) as f64 - self.used(&course);
        let mean_square = squares.map(|(norm, _)| norm * norm).sum::<f64>() / left;
        let followed = self.what_is_followed(&course, &weight)?;
        let of_each = |(at, row): (usize, usize)| match &followed {
            _ if weight[row] <= 0.0 => 0.0,
            Followed::Evenly { .. } => 1.0,
            Followed::Each(shares) => (1.0 - shares[at]).max(0.0),
        };
        let left_of_each = self.layout.row_of_each().enumerate().map(of_each).collect();
        Ok(Kept { course, rows: counted, left, left_of_each, mean_square })
    }

    fn set_aside(&mut self, rows: &[usize]) {
        self.aside = vec![false; if rows.is_empty() { 0 } else { self.layout.rows() }];
        rows.iter().for_each(|row| self.aside[*row] = true);
    }

    /// Whether so many rows, which one course has and the other has not, are proven wrong.
    fn proves(&self, all: &Kept, kept: &Kept, rows: usize) -> bool {
        let more = all.left - kept.left;
        let [all_arrived, kept_arrived] = [all, kept].map(|own| self.has_arrived(&own.course));
        if !all_arrived || !kept_arrived {
            return kept_arrived;
        }
        // Beside the noise of rows that are wrong, all may determine less.
        if kept.left < 1.0 || more < 1.0 || kept.course.subspace.rank() < all.course.subspace.rank() {
            return false;
        }
        let ratio = all.mean_square / kept.mean_square * all.times_the_noise_of(kept);
        let f = (ratio * all.left - kept.left) / more;
        let chance = FisherSnedecor::new(more, kept.left).map_or(1.0, |chance| chance.sf(f.max(0.0)));
        chance.ln() + ln_binomial(all.rows as u64, rows as u64) < PROVEN.ln()
    }
}

/// Least squares of some rows.
struct Kept {
    course: Course,
    /// How many rows count.
    rows: usize,
    /// Components less what errors, objects and stations use up of them.
    left: f64,
    /// What is left of each component's own residual, as a share of it; nothing of rows that do not count.
    left_of_each: Vec<f64>,
    /// In units of its own noise.
    mean_square: f64,
}

impl Kept {
    /// By what factor the variances of its noise are larger than those of another's, in the geometric mean: each component counts by what
    /// is left of its residual. Of few rows some can always be chosen that leave next to nothing along azimuths, say, and in units of
    /// that noise all others are wrong.
    fn times_the_noise_of(&self, other: &Self) -> f64 {
        let [own, other] = [self, other].map(|kept| kept.course.noise.sigma_without_memory());
        let each = self.left_of_each.iter().zip(own.iter().zip(other.iter()));
        let sum: f64 = each.map(|(left, (own, other))| left * 2.0 * (own / other).ln()).sum();
        let whole: f64 = self.left_of_each.iter().sum();
        if whole > 0.0 { (sum / whole).exp() } else { 1.0 }
    }
}
