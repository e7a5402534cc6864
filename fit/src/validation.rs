//! How two declarations, each with its errors, foretell rows that neither was fitted to.

use model_core::Chain;

use super::model::Model;
use super::stream::streamed;
use super::sweep::residuals;
use super::{FitError, FitOptions, robust};
use crate::noise::{self, Layout};
use observe::Observations;

/// A declaration with its errors, and rows read by it.
#[derive(Debug, Clone, Copy)]
pub struct Foretelling<'a> {
    /// The declaration.
    pub chain: &'a Chain,
    /// The value of every symbol, SI, by symbol.
    pub values: &'a [f64],
    /// The rows, with the joints and inputs of that declaration.
    pub observations: &'a Observations,
}

/// Sums over rows of one series, SI; those of parts add.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Validation {
    /// Rows at which both declarations have a finite value.
    pub rows: u64,
    /// Those of them that lie within reach of the robust weights of the second; all, where the fit is not robust.
    pub kept: u64,
    /// Squares of the residuals' lengths over all rows, before and after.
    pub squares: [f64; 2],
    /// The same over the rows kept.
    pub squares_kept: [f64; 2],
}

impl std::ops::Add for Validation {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let sum = |one: [f64; 2], other: [f64; 2]| [one[0] + other[0], one[1] + other[1]];
        Self {
            rows: self.rows + other.rows,
            kept: self.kept + other.kept,
            squares: sum(self.squares, other.squares),
            squares_kept: sum(self.squares_kept, other.squares_kept),
        }
    }
}

impl Validation {
    /// Judges a declaration `before` and one `after` on the same rows; `floor` is the standard deviation of each kind of component,
    /// rad or m, or a factor on what the data state.
    ///
    /// # Errors
    /// Rows, values or floors that do not fit the declarations.
    pub fn of(
        before: Foretelling<'_>,
        after: Foretelling<'_>,
        floor: &[f64],
        options: &FitOptions,
    ) -> Result<Self, FitError> {
        let layout = Layout::of(after.observations);
        if layout.kinds != floor.len() {
            let why = format!("{} standard deviations for {} kinds of component", floor.len(), layout.kinds);
            return Err(FitError::WrongShape { why });
        }
        let sigma =
            noise::of_floors(floor.to_vec(), &streamed(&options.noise), after.observations, &layout).sigma;
        let of = |Foretelling { chain, values, observations }: Foretelling<'_>| {
            residuals(&Model::without_columns(chain, &observations.poses), observations, values)
        };
        let (before, after) = (of(before)?, of(after)?);
        let mut sums = Self::default();
        let rows = layout.by_row(&before).zip(layout.by_row(&after)).zip(layout.by_row(&sigma));
        for ((before, after), sigma) in rows {
            let squares = [before, after].map(|own| own.iter().map(|value| value * value).sum::<f64>());
            if !squares.iter().all(|square| square.is_finite()) {
                continue;
            }
            let norm =
                after.iter().zip(sigma).map(|(value, sigma)| (value / sigma).powi(2)).sum::<f64>().sqrt();
            let is_kept = !options.robust || norm < robust::cutoff(after.len());
            sums.rows += 1;
            sums.kept += u64::from(is_kept);
            for (at, square) in squares.into_iter().enumerate() {
                sums.squares[at] += square;
                sums.squares_kept[at] += if is_kept { square } else { 0.0 };
            }
        }
        Ok(sums)
    }
}
