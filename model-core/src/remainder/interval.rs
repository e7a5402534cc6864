//! Intervals: pairs of numbers between which a quantity lies, because every operation rounds outward.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};
use std::ops::{Add, Mul, Neg};

/// All numbers from `low` to `high`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Interval {
    pub(super) low: f64,
    pub(super) high: f64,
}

/// What a sine or cosine can be at all.
const WAVE: Interval = Interval { low: -1.0, high: 1.0 };

impl Interval {
    pub(super) const ZERO: Self = Self { low: 0.0, high: 0.0 };
    pub(super) const ONE: Self = Self { low: 1.0, high: 1.0 };

    pub(super) fn new([low, high]: [f64; 2]) -> Self {
        Self { low, high }
    }

    /// An exactly known number.
    pub(super) fn exact(value: f64) -> Self {
        Self { low: value, high: value }
    }

    /// A number known to within one unit in the last place.
    pub(super) fn rounded(value: f64) -> Self {
        Self::outward(value, value)
    }

    /// Results of one operation each, which IEEE arithmetic rounds to nearest. Where one is no number, nothing is known.
    fn outward(low: f64, high: f64) -> Self {
        if low.is_nan() || high.is_nan() {
            return Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
        }
        Self { low: low.next_down(), high: high.next_up() }
    }

    /// The largest size in it.
    pub(super) fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// The smallest size in it.
    pub(super) fn least_size(self) -> f64 {
        if self.low > 0.0 {
            self.low
        } else if self.high < 0.0 {
            -self.high
        } else {
            0.0
        }
    }

    /// The square, which is never negative.
    pub(super) fn square(self) -> Self {
        let square = self * self;
        Self { low: square.low.max(0.0), high: square.high }
    }

    pub(super) fn powi(self, exponent: u32) -> Self {
        let squares = (0..exponent / 2).fold(Self::ONE, |product, _| product * self.square());
        if exponent % 2 == 1 { squares * self } else { squares }
    }

    /// One over it; `None` if it holds zero.
    pub(super) fn recip(self) -> Option<Self> {
        (self.low > 0.0 || self.high < 0.0).then(|| Self::outward(1.0 / self.high, 1.0 / self.low))
    }

    /// The smallest root of what is positive in it.
    pub(super) fn least_root(self) -> f64 {
        if self.low > 0.0 { self.low.sqrt().next_down() } else { 0.0 }
    }

    pub(super) fn sin(self) -> Self {
        self.wave(|angle| angle.sin_cos_of_point().0, 1)
    }

    pub(super) fn cos(self) -> Self {
        self.wave(|angle| angle.sin_cos_of_point().1, 0)
    }

    /// A wave from its values at the two ends, and its tops a whole number of turns from so many quarter turns.
    fn wave(self, at: impl Fn(Self) -> Self, top: i64) -> Self {
        /// Beyond these angles the quarter turns in them are not counted.
        const FAR_RAD: f64 = 1e5;
        /// More than the error of a count of quarter turns.
        const SLACK: f64 = 1e-9;
        let narrow = self.magnitude() < FAR_RAD && self.high - self.low < 6.0;
        if !narrow {
            return WAVE;
        }
        let (one, other) = (at(Self::exact(self.low)), at(Self::exact(self.high)));
        let mut hull = Self { low: one.low.min(other.low), high: one.high.max(other.high) };
        let first = (self.low * FRAC_2_PI - SLACK).ceil() as i64;
        let last = (self.high * FRAC_2_PI + SLACK).floor() as i64;
        for quarter in first..=last {
            match (quarter - top).rem_euclid(4) {
                0 => hull.high = 1.0,
                2 => hull.low = -1.0,
                _ => {}
            }
        }
        Self { low: hull.low.max(-1.0), high: hull.high.min(1.0) }
    }

    /// Sine and cosine of an angle that is one number: the series at the angle less the nearest quarter turns.
    fn sin_cos_of_point(self) -> (Self, Self) {
        /// π/2 lies between these two neighbouring floats.
        const QUARTER: Interval = Interval { low: FRAC_PI_2, high: FRAC_PI_2.next_up() };
        /// More than 0.9¹⁹/19!, what the series leave out.
        const REST: Interval = Interval { low: -2e-18, high: 2e-18 };
        let quarters = (self.low * FRAC_2_PI).round();
        let rest = self + -(Self::exact(quarters) * QUARTER);
        if rest.magnitude() > 0.9 {
            return (WAVE, WAVE);
        }
        let square = rest.square();
        let series = |first: u32| {
            (0..9u32).rev().fold(Self::ONE, |sum, n| {
                let below = f64::from((first + 2 * n) * (first + 2 * n + 1));
                Self::ONE + -(square * sum * Self::rounded(1.0 / below))
            })
        };
        let (sine, cosine) = (rest * series(2) + REST, series(1) + REST);
        match (quarters as i64).rem_euclid(4) {
            0 => (sine, cosine),
            1 => (cosine, -sine),
            2 => (-sine, -cosine),
            _ => (-cosine, sine),
        }
    }

    /// A whole turn, where nothing says where an angle lies.
    pub(super) fn turn() -> [f64; 2] {
        [-PI.next_up(), PI.next_up()]
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        match (self == Self::ZERO, other == Self::ZERO) {
            (true, _) => other,
            (_, true) => self,
            _ => Self::outward(self.low + other.low, self.high + other.high),
        }
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        match (self, other) {
            (one, other) if one == Self::ONE => other,
            (one, other) if other == Self::ONE => one,
            _ => {
                let ends = [
                    self.low * other.low,
                    self.low * other.high,
                    self.high * other.low,
                    self.high * other.high,
                ];
                if ends.iter().any(|end| end.is_nan()) {
                    return Self::outward(f64::NAN, f64::NAN);
                }
                Self::outward(
                    ends.iter().copied().fold(f64::INFINITY, f64::min),
                    ends.iter().copied().fold(f64::NEG_INFINITY, f64::max),
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use dashu_float::{FBig, round::mode::HalfAway};
    use proptest::prelude::*;

    use super::Interval;

    fn far(value: f64) -> FBig<HalfAway, 2> {
        FBig::try_from(value).unwrap().with_precision(140).value()
    }

    proptest! {
        #[test]
        fn verify_waves_hold_what_they_stand_for(low in -40.0f64..40.0, width in 0.0f64..7.0, at in 0.0f64..=1.0) {
            let interval = Interval::new([low, low + width]);
            let angle = (low + width * at).clamp(interval.low, interval.high);
            for (wave, value) in [(interval.sin(), far(angle).sin()), (interval.cos(), far(angle).cos())] {
                prop_assert!(far(wave.low) <= value && value <= far(wave.high), "{wave:?} {angle}");
            }
            // And at a point they are narrow.
            let point = Interval::exact(low);
            prop_assert!(point.sin().high - point.sin().low < 1e-13, "{:?}", point.sin());
            prop_assert!(point.cos().high - point.cos().low < 1e-13, "{:?}", point.cos());
        }

        #[test]
        fn verify_no_operation_loses_a_value(
            a in -3.0f64..3.0, b in -3.0f64..3.0, wide in 0.0f64..2.0, at in 0.0f64..=1.0, power in 0u32..5
        ) {
            let (one, other) = (Interval::new([a, a + wide]), Interval::new([b, b + 2.0 * wide]));
            let (x, y) = ((a + wide * at).min(one.high), (b + 2.0 * wide * at).min(other.high));
            let holds = |interval: Interval, value: FBig<HalfAway, 2>| {
                far(interval.low) <= value && value <= far(interval.high)
            };
            prop_assert!(holds(one + other, far(x) + far(y)));
            prop_assert!(holds(one * other, far(x) * far(y)));
            prop_assert!(holds(-one, -far(x)));
            prop_assert!(holds(one.powi(power), (0..power).fold(far(1.0), |product, _| product * far(x))));
            if let Some(over) = one.recip() {
                prop_assert!(holds(over, far(1.0) / far(x)));
            }
        }
    }
}
