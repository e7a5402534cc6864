//! Printed numbers: what an observable shows, or its error, at one pose with errors of stated sizes.

use super::Checker;
use model_core::chain::ObservableId;
use model_core::exact;

/// That numbers are what comes of the exact form at one pose.
#[derive(Debug, Clone)]
pub struct Values {
    /// Of which observable.
    pub observable: ObservableId,
    /// Whether the numbers are of the error; of what is shown otherwise.
    pub is_error: bool,
    /// Values of all symbols, SI, by symbol.
    pub values: Vec<f64>,
    /// The numbers, SI, each with how far off a rounded print may be.
    pub claimed: Vec<[f64; 2]>,
}

/// What is said of one printed number.
#[derive(Debug, Clone, PartialEq)]
pub struct ValueVerdict {
    /// What the number is of.
    pub label: String,
    /// What comes out, SI.
    pub found: f64,
    /// What is printed, SI.
    pub claimed: f64,
    /// How far off a rounded print may be, SI.
    pub within: f64,
}

impl ValueVerdict {
    /// Whether the printed number is the found one, rounded.
    #[must_use]
    pub fn holds(&self) -> bool {
        (self.found - self.claimed).abs() <= self.within
    }
}

impl Checker<'_> {
    /// The verdict on printed numbers.
    pub(super) fn values(&self, claim: &Values) -> Vec<ValueVerdict> {
        let path = exact::Path::new(self.chain, claim.observable);
        let found = if claim.is_error { path.shown_error(&claim.values) } else { path.shown(&claim.values) };
        let labels = self.chain.observable(claim.observable).labels();
        labels
            .zip(found.into_iter().zip(&claim.claimed))
            .map(|(label, (found, &[claimed, within]))| ValueVerdict {
                label: label.to_owned(),
                found,
                claimed,
                // Of a number that is rounded half up or half even, and of one computed in doubles.
                within: within * (1.0 + 1e-9) + 1e-12 * claimed.abs(),
            })
            .collect()
    }
}
