//! Chances of sums of squares, where the noise is known or estimated with some degrees of freedom.

use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};
use statrs::function::beta::beta_reg;
use statrs::function::gamma::ln_gamma;

/// Degrees of freedom of a noise beyond which it counts as known: quantiles differ by less than one part in 10⁵ then.
const KNOWN: f64 = 1e6;

/// The distribution of a sum of squares of whitened numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Squares {
    /// How many independent numbers.
    pub count: f64,
    /// The degrees of freedom of their noise; none where it is known.
    pub noise: Option<f64>,
}

impl Squares {
    /// Of so many numbers.
    #[must_use]
    pub fn new(count: usize, noise: Option<f64>) -> Self {
        Self { count: count as f64, noise: noise.filter(|own| *own < KNOWN) }
    }

    /// The chance of a sum at least as large from noise alone.
    #[must_use]
    pub fn beyond(&self, sum: f64) -> f64 {
        self.beyond_of(sum, 0.0)
    }

    /// The same, where what the numbers are without noise has this sum of squares itself.
    ///
    /// Source: N. L. Johnson, S. Kotz, N. Balakrishnan, Continuous Univariate Distributions, vol. 2 (1995), sections 29.2 and 30.3: the mixture
    /// over a Poisson number of further degrees of freedom.
    #[must_use]
    pub fn beyond_of(&self, sum: f64, noncentrality: f64) -> f64 {
        let half = noncentrality / 2.0;
        if !half.is_finite() {
            return 1.0;
        }
        let last = half + 12.0 * half.sqrt() + 40.0;
        let first = (half - 12.0 * half.sqrt() - 1.0).max(0.0).floor();
        let (mut number, mut total) = (first, 0.0);
        while number <= last {
            let ln_weight = if half > 0.0 { number * half.ln() - half - ln_gamma(number + 1.0) } else { 0.0 };
            total += ln_weight.exp() * self.central(sum, 2.0 * number);
            if half == 0.0 {
                break;
            }
            number += 1.0;
        }
        total.clamp(0.0, 1.0)
    }

    fn central(&self, sum: f64, more: f64) -> f64 {
        let count = self.count + more;
        if sum <= 0.0 {
            return 1.0;
        }
        match self.noise {
            Some(noise) => beta_reg(noise / 2.0, count / 2.0, noise / (noise + sum)),
            None => ChiSquared::new(count).map_or(1.0, |own| own.sf(sum)),
        }
    }

    /// The sum that noise alone exceeds with this chance.
    #[must_use]
    pub fn exceeded(&self, chance: f64) -> f64 {
        match self.noise {
            Some(noise) => FisherSnedecor::new(self.count, noise)
                .map_or(f64::INFINITY, |own| self.count * own.inverse_cdf(1.0 - chance)),
            None => ChiSquared::new(self.count).map_or(f64::INFINITY, |own| own.inverse_cdf(1.0 - chance)),
        }
    }

    /// The sum of squares without noise that is found with a power, at a level.
    #[must_use]
    pub fn needed(&self, level: f64, power: f64) -> f64 {
        let limit = self.exceeded(level);
        let (mut low, mut high) = (0.0, 1.0);
        while self.beyond_of(limit, high) < power && high < 1e9 {
            high *= 2.0;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.beyond_of(limit, middle) < power { low = middle } else { high = middle }
        }
        high
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// Counts of numbers, degrees of freedom of the noise, sums, noncentralities, and the chance of more.
    const REFERENCE: [(usize, Option<f64>, f64, f64, f64); 6] = [
        (4, None, 11.0, 0.0, 0.026_564_014_35),
        (4, None, 11.0, 9.5, 0.595_623_382_322),
        (20, None, 34.0, 25.0, 0.822_587_486_271),
        (4, Some(60.0), 11.0, 0.0, 0.036_197_041_344_3),
        (4, Some(60.0), 11.0, 9.5, 0.597_161_639_441),
        (1, Some(8.0), 6.0, 3.0, 0.292_756_066_367),
    ];

    /// Counts, degrees of freedom, levels, and the sums that are exceeded with them.
    const LIMITS: [(usize, Option<f64>, f64, f64); 3] = [
        (4, None, 0.025, 11.143_286_781_9),
        (4, Some(60.0), 0.025, 12.030_637_473_6),
        (20, Some(500.0), 0.05, 31.832_040_602_1),
    ];

    /// Reference: `service/tests/verify/reference.py` (SciPy).
    #[test]
    fn validate_against_an_independent_program() {
        for (count, noise, sum, noncentrality, expected) in REFERENCE {
            let own = Squares::new(count, noise);
            assert_relative_eq!(own.beyond_of(sum, noncentrality), expected, max_relative = 1e-8);
        }
        for (count, noise, level, expected) in LIMITS {
            assert_relative_eq!(Squares::new(count, noise).exceeded(level), expected, max_relative = 1e-6);
        }
    }

    #[test]
    fn what_is_needed_is_found_with_the_power() {
        for (count, noise) in [(1, None), (4, Some(30.0)), (20, Some(500.0)), (12, None)] {
            let own = Squares::new(count, noise);
            let needed = own.needed(0.025, 0.8);
            assert_relative_eq!(own.beyond_of(own.exceeded(0.025), needed), 0.8, epsilon = 1e-9);
        }
    }
}
