//! A combination of errors that the data determine: its value, and how wide the interval is that holds it.

use model_core::SymbolId;
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

/// A combination that the data determine.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimable {
    /// Parameters with their factors (SI), the first 1.
    pub combination: Vec<(SymbolId, f64)>,
    /// Its value, SI, in the unit of the first.
    pub value: f64,
    /// Its standard uncertainty; `None` without degrees of freedom.
    pub standard_uncertainty: Option<f64>,
    /// The degrees of freedom of that; infinite where the noise is stated.
    pub degrees_of_freedom: f64,
}

impl Estimable {
    /// Half the width of the interval that holds the value with this confidence (0.95, say), SI; `None` where nothing is known.
    #[must_use]
    pub fn half_width(&self, confidence: f64) -> Option<f64> {
        half_width(self.standard_uncertainty?, self.degrees_of_freedom, confidence)
    }
}

/// The variance of a combination of numbers, each by its place with its factor, from the entries of their covariance.
pub fn variance_of(combination: &[(usize, f64)], covariance: impl Fn(usize, usize) -> f64) -> f64 {
    let pairs = combination.iter().flat_map(|one| combination.iter().map(move |other| (one, other)));
    pairs.map(|((i, a), (j, b))| a * b * covariance(*i, *j)).sum()
}

/// From here on the quantile of Student's t is that of the normal distribution with one correction, to 1e-8; the library's
/// search for it does not end at very many degrees of freedom.
const NEARLY_NORMAL: f64 = 1e4;

/// By Student's t.
///
/// Source: the first term of the expansion in M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions, 26.7.5.
pub(super) fn half_width(uncertainty: f64, degrees_of_freedom: f64, confidence: f64) -> Option<f64> {
    let share = f64::midpoint(1.0, confidence);
    let reach = if degrees_of_freedom < NEARLY_NORMAL {
        StudentsT::new(0.0, 1.0, degrees_of_freedom).ok()?.inverse_cdf(share)
    } else {
        let z = Normal::standard().inverse_cdf(share);
        z + (z.powi(3) + z) / (4.0 * degrees_of_freedom)
    };
    Some(reach * uncertainty).filter(|width| width.is_finite())
}
