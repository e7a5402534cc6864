//! The stated noise against the noise that was found. While the two agree, the stated one is used.

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Chance of a disagreement where there is none, on either side.
const BY_CHANCE: f64 = 0.005;

/// A noise larger or smaller by less than this factor disagrees with nothing, however many rows show it.
const ALIKE: f64 = 1.1;

/// A stated noise, and what the residuals say of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stated {
    /// What was found over what was stated, as standard deviations.
    pub ratio: f64,
    /// Degrees of freedom of what was found.
    pub degrees_of_freedom: f64,
    /// Whether the two agree.
    pub agreement: Agreement,
}

/// Whether a stated noise agrees with that of the residuals.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Agreement {
    /// It does: uncertainties are by what is stated.
    Agrees,
    /// The residuals are larger: something is missing, or the statement is wrong. Uncertainties are by the residuals.
    Larger,
    /// The residuals are smaller. Uncertainties are by the residuals.
    Smaller,
}

impl Stated {
    /// Compares a ratio of variances with so many degrees of freedom with one.
    #[must_use]
    pub fn compared(variance_ratio: f64, degrees_of_freedom: f64) -> Self {
        let ratio = variance_ratio.sqrt();
        let sum = variance_ratio * degrees_of_freedom;
        let tails = ChiSquared::new(degrees_of_freedom).map(|known| [known.cdf(sum), known.sf(sum)]);
        let agreement = match tails {
            Ok([_, above]) if above < BY_CHANCE && ratio > ALIKE => Agreement::Larger,
            Ok([below, _]) if below < BY_CHANCE && ratio < 1.0 / ALIKE => Agreement::Smaller,
            // Without degrees of freedom nothing contradicts the statement.
            _ => Agreement::Agrees,
        };
        Self { ratio, degrees_of_freedom, agreement }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Source: tables of the chi-squared distribution; with 10 degrees of freedom the upper 0.5 % point is 25.188, the lower
    /// 2.156.
    #[test]
    fn chance_is_no_disagreement() {
        let of = |sum: f64| Stated::compared(sum / 10.0, 10.0).agreement;
        assert_eq!(
            [of(2.1), of(2.2), of(10.0), of(25.1), of(25.3)],
            [Agreement::Smaller, Agreement::Agrees, Agreement::Agrees, Agreement::Agrees, Agreement::Larger]
        );
        // Many rows show that 2 arcsec are 2.05; nobody needs to know.
        assert_eq!(Stated::compared(1.05, 1e6).agreement, Agreement::Agrees);
        assert_eq!(Stated::compared(5.0, 0.0).agreement, Agreement::Agrees);
    }
}
