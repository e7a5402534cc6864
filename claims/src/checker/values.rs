//! Printed numbers: what an observable shows, or its error, at one pose with errors of stated sizes.

use super::Checker;
use model_core::algebra::{Poly, Rational};
use model_core::chain::ObservableId;
use model_core::exact;
use model_core::symbol::SymbolId;

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
    /// The same without rounding; `None` where the file writes a number that cannot be said so.
    pub exactly: Option<Exactly>,
}

/// The numbers of a claim without rounding, SI: rational numbers and multiples of π.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Exactly {
    /// The values that the file gives.
    pub given: Vec<Given>,
    /// The printed numbers, each with how far off a rounded print may be.
    pub claimed: Vec<[Poly; 2]>,
    /// The printed numbers as they are written.
    pub written: Vec<String>,
}

/// A value that a file gives a symbol.
#[derive(Debug, Clone, PartialEq)]
pub struct Given {
    /// The symbol.
    pub symbol: SymbolId,
    /// Its value, SI.
    pub value: Poly,
    /// The same as it is written.
    pub written: String,
}

impl Exactly {
    /// With one more value, where it is known.
    pub(crate) fn giving(mut self, symbol: SymbolId, value: Option<Poly>, written: &str) -> Option<Self> {
        self.given.retain(|given| given.symbol != symbol);
        self.given.push(Given { symbol, value: value?, written: written.to_owned() });
        Some(self)
    }
}

/// How much further off a number may be that is rounded half up or half even: relative to how far off a rounded print may be, and, of
/// one computed in doubles, to the number itself. As powers of ten.
const LEEWAY: [i64; 2] = [1_000_000_000, 1_000_000_000_000];

/// How far off a printed number may be.
fn leeway(claimed: f64, within: f64) -> f64 {
    let [of_within, of_number] = LEEWAY.map(|power| 1.0 / power as f64);
    within * (1.0 + of_within) + of_number * claimed.abs()
}

/// The same without rounding; `None` for what is no number or multiple of π.
#[must_use]
pub fn exact_leeway([claimed, within]: &[Poly; 2]) -> Option<Poly> {
    let [of_within, of_number] = LEEWAY.map(|power| Rational::new(1, power));
    let (of_within, of_number) = (of_within?, of_number?);
    let size = if claimed.terms().next().is_some_and(|term| term.coefficient.is_negative()) {
        -claimed
    } else {
        claimed.clone()
    };
    (claimed.terms().count() <= 1)
        .then(|| &within.scale(&(&Rational::ONE + &of_within)) + &size.scale(&of_number))
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
                within: leeway(claimed, within),
            })
            .collect()
    }
}
