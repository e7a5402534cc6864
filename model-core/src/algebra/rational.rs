//! Exact rational numbers: machine integers while they fit, big ones behind that.

use std::cmp::Ordering;
use std::fmt;
use std::num::NonZeroI64;
use std::ops::{Add, Mul, Neg, Sub};

use dashu_int::ops::BitTest;
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// An exact rational number in lowest terms. It never overflows.
///
/// Equal numbers have identical representations: a value is big if and only if it does not fit
/// a pair of `i64`.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Rational(Repr);

#[derive(Clone, PartialEq, Eq, Hash)]
enum Repr {
    /// In lowest terms, the denominator positive. (`NonZero` keeps the number at 16 bytes.)
    Small { numerator: i64, denominator: NonZeroI64 },
    /// Only what does not fit `Small`.
    Big(Box<RBig>),
}

/// Why a text is no decimal number.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum DecimalError {
    /// Something other than digits, one point and an exponent.
    #[error("`{0}` is no decimal number; write it like 12, 0.25 or 1.5e-3")]
    Malformed(String),
    /// More digits, or a longer exponent, than any physical quantity needs.
    #[error("`{0}` has more digits than {MAX_DIGITS} before or after the point")]
    TooLong(String),
}

/// Digits that a decimal may have on either side of its point; `f64` ends at about 324.
const MAX_DIGITS: i64 = 400;

/// The denominator of whole numbers; the second arm is never taken.
const ONE: NonZeroI64 = match NonZeroI64::new(1) {
    Some(one) => one,
    None => NonZeroI64::MAX,
};

impl Rational {
    /// Zero.
    pub const ZERO: Self = Self::integer(0);
    /// One.
    pub const ONE: Self = Self::integer(1);

    const fn integer(value: i64) -> Self {
        Self(Repr::Small { numerator: value, denominator: ONE })
    }

    /// `numerator / denominator`; `None` if the denominator is zero.
    #[must_use]
    pub fn new(numerator: i64, denominator: i64) -> Option<Self> {
        (denominator != 0).then(|| Self::reduce(i128::from(numerator), i128::from(denominator)))
    }

    /// One half, which products of sines and cosines are full of.
    #[must_use]
    pub fn half() -> Self {
        Self::reduce(1, 2)
    }

    /// Reads a decimal exactly: `12`, `0.25`, `1.5e-3`, with a sign if there is one.
    ///
    /// # Errors
    /// If the text is no decimal number, or an absurdly long one.
    pub fn parse_decimal(text: &str) -> Result<Self, DecimalError> {
        let malformed = || DecimalError::Malformed(text.to_owned());
        let too_long = || DecimalError::TooLong(text.to_owned());
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i64>().map_err(|_| malformed())?),
            None => (text, 0),
        };
        let (negative, unsigned) = match mantissa.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, mantissa.strip_prefix('+').unwrap_or(mantissa)),
        };
        let (whole, fraction) = unsigned.split_once('.').unwrap_or((unsigned, ""));
        let digits: String = [whole, fraction].concat().replace('_', "");
        if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
            return Err(malformed());
        }
        let fraction_digits = fraction.bytes().filter(u8::is_ascii_digit).count();
        let shift = i64::try_from(fraction_digits)
            .ok()
            .and_then(|count| exponent.checked_sub(count))
            .ok_or_else(too_long)?;
        let long = usize::try_from(MAX_DIGITS).is_ok_and(|limit| digits.len() > limit);
        if long || shift.unsigned_abs() > MAX_DIGITS.unsigned_abs() {
            return Err(too_long());
        }
        let mut numerator = IBig::from_str_radix(&digits, 10).map_err(|_| malformed())?;
        if negative {
            numerator = -numerator;
        }
        let power = usize::try_from(shift.unsigned_abs()).map_err(|_| too_long())?;
        let scale = UBig::from(10u8).pow(power);
        Ok(Self::from_big(if shift < 0 {
            RBig::from_parts(numerator, scale)
        } else {
            RBig::from(numerator * IBig::from(scale))
        }))
    }

    /// The nearest `f64`.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        /// Integers up to here are exact as `f64`, so that one division rounds once.
        const EXACT: u64 = 1 << f64::MANTISSA_DIGITS;
        match &self.0 {
            Repr::Small { numerator, denominator }
                if numerator.unsigned_abs() <= EXACT && denominator.unsigned_abs().get() <= EXACT =>
            {
                *numerator as f64 / denominator.get() as f64
            }
            _ => self.to_big().to_f64().value(),
        }
    }

    /// Whether this is zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        matches!(self.0, Repr::Small { numerator: 0, .. })
    }

    /// Whether this is one.
    #[must_use]
    pub fn is_one(&self) -> bool {
        *self == Self::ONE
    }

    /// Whether this is below zero.
    #[must_use]
    pub fn is_negative(&self) -> bool {
        match &self.0 {
            Repr::Small { numerator, .. } => *numerator < 0,
            Repr::Big(big) => **big < RBig::ZERO,
        }
    }

    /// How many bits numerator and denominator have together, at most.
    #[must_use]
    pub fn bits(&self) -> usize {
        match &self.0 {
            Repr::Small { .. } => 128,
            Repr::Big(big) => {
                let (numerator, denominator) = (**big).clone().into_parts();
                numerator.bit_len() + denominator.bit_len()
            }
        }
    }

    /// Numerator and denominator modulo a prime below 2⁶².
    #[must_use]
    pub fn residues(&self, prime: u64) -> (u64, u64) {
        let (numerator, denominator) = self.to_big().into_parts();
        let modulus = IBig::from(prime);
        let residue = |number: IBig| {
            let positive = ((number % &modulus) + &modulus) % &modulus;
            match u64::try_from(positive) {
                Ok(residue) => residue,
                Err(_) => unreachable!("a residue is smaller than its modulus"),
            }
        };
        (residue(numerator), residue(IBig::from(denominator)))
    }

    /// As a decimal, where fifteen digits behind the point are exact.
    #[must_use]
    pub fn to_decimal(&self) -> Option<String> {
        /// More digits are no easier to read than a fraction.
        const DIGITS: usize = 15;
        if let Some(whole) = self.to_integer() {
            return Some(whole.to_string());
        }
        let sign = if self.is_negative() { "-" } else { "" };
        let mut scaled = self.abs();
        (1..=DIGITS).find_map(|digits| {
            scaled = &scaled * &Self::from(10);
            let written = format!("{:0>width$}", scaled.to_integer()?, width = digits + 1);
            let (whole, fraction) = written.split_at(written.len() - digits);
            Some(format!("{sign}{whole}.{fraction}"))
        })
    }

    /// The numerator, as text.
    #[must_use]
    pub fn numerator(&self) -> impl fmt::Display + use<> {
        self.to_big().into_parts().0
    }

    /// The denominator, positive, as text.
    #[must_use]
    pub fn denominator(&self) -> impl fmt::Display + use<> {
        self.to_big().into_parts().1
    }

    /// The value as a machine integer, if it is one.
    #[must_use]
    pub fn to_integer(&self) -> Option<i64> {
        match self.0 {
            Repr::Small { numerator, denominator } if denominator == ONE => Some(numerator),
            _ => None,
        }
    }

    /// One over this; `None` for zero.
    #[must_use]
    pub fn recip(&self) -> Option<Self> {
        if self.is_zero() {
            return None;
        }
        Some(match &self.0 {
            Repr::Small { numerator, denominator } => {
                Self::reduce(i128::from(denominator.get()), i128::from(*numerator))
            }
            Repr::Big(big) => Self::from_big(RBig::ONE / (**big).clone()),
        })
    }

    /// The distance from zero.
    #[must_use]
    pub fn abs(&self) -> Self {
        if self.is_negative() { -self } else { self.clone() }
    }

    /// The number whose square this is, not negative; `None` if none is rational, or beyond machine words.
    #[must_use]
    pub fn square_root(&self) -> Option<Self> {
        let root = |square: i64| {
            let root = square.checked_isqrt()?;
            (root * root == square).then_some(root)
        };
        match &self.0 {
            Repr::Small { numerator, denominator } => Self::new(root(*numerator)?, root(denominator.get())?),
            Repr::Big(_) => None,
        }
    }

    /// The largest number of which both are whole multiples; one if a machine word does not hold them.
    #[must_use]
    pub fn common_measure(&self, other: &Self) -> Self {
        match (&self.0, &other.0) {
            (Repr::Small { numerator: a, denominator: b }, Repr::Small { numerator: c, denominator: d }) => {
                let (b, d) = (i128::from(b.get()), i128::from(d.get()));
                let [left, right] = [i128::from(*a) * d, i128::from(*c) * b].map(i128::unsigned_abs);
                Self::reduce(gcd(left, right).cast_signed(), b * d)
            }
            _ => Self::ONE,
        }
    }

    /// `numerator / denominator` in lowest terms; the caller keeps the denominator from zero.
    fn reduce(numerator: i128, denominator: i128) -> Self {
        if denominator == 1
            && let Ok(whole) = i64::try_from(numerator)
        {
            return Self::integer(whole);
        }
        let divisor = gcd(numerator.unsigned_abs(), denominator.unsigned_abs()).cast_signed();
        let divisor = if denominator < 0 { -divisor } else { divisor };
        let (n, d) = (numerator / divisor, denominator / divisor);
        match (i64::try_from(n), i64::try_from(d).ok().and_then(NonZeroI64::new)) {
            (Ok(numerator), Some(denominator)) => Self(Repr::Small { numerator, denominator }),
            _ => Self(Repr::Big(Box::new(RBig::from_parts_signed(IBig::from(n), IBig::from(d))))),
        }
    }

    fn to_big(&self) -> RBig {
        match &self.0 {
            Repr::Small { numerator, denominator } => {
                RBig::from_parts_signed(IBig::from(*numerator), IBig::from(denominator.get()))
            }
            Repr::Big(big) => (**big).clone(),
        }
    }

    fn from_big(big: RBig) -> Self {
        let small = i64::try_from(big.numerator())
            .ok()
            .zip(i64::try_from(big.denominator()).ok().and_then(NonZeroI64::new));
        Self(match small {
            Some((numerator, denominator)) => Repr::Small { numerator, denominator },
            None => Repr::Big(Box::new(big)),
        })
    }
}

/// Greatest common divisor; in 64 bits as soon as both fit, which is nearly always at once.
fn gcd(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        if let (Ok(mut small_a), Ok(mut small_b)) = (u64::try_from(a), u64::try_from(b)) {
            while small_b != 0 {
                (small_a, small_b) = (small_b, small_a % small_b);
            }
            return u128::from(small_a);
        }
        (a, b) = (b, a % b);
    }
    a
}

impl From<i64> for Rational {
    fn from(value: i64) -> Self {
        Self::integer(value)
    }
}

impl Default for Rational {
    fn default() -> Self {
        Self::ZERO
    }
}

impl Add for &Rational {
    type Output = Rational;

    fn add(self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (Repr::Small { numerator: a, denominator: b }, Repr::Small { numerator: c, denominator: d }) => {
                if b == d {
                    let sum = i128::from(*a) + i128::from(*c);
                    return Rational::reduce(sum, i128::from(b.get()));
                }
                // Each product is below 2^126, so the sum stays inside 128 bits.
                let (b, d) = (i128::from(b.get()), i128::from(d.get()));
                Rational::reduce(i128::from(*a) * d + i128::from(*c) * b, b * d)
            }
            _ => Rational::from_big(self.to_big() + other.to_big()),
        }
    }
}

impl Sub for &Rational {
    type Output = Rational;

    fn sub(self, other: &Rational) -> Rational {
        self + &-other
    }
}

impl Mul for &Rational {
    type Output = Rational;

    fn mul(self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (Repr::Small { numerator: a, denominator: b }, Repr::Small { numerator: c, denominator: d }) => {
                Rational::reduce(i128::from(*a) * i128::from(*c), i128::from(b.get()) * i128::from(d.get()))
            }
            _ => Rational::from_big(self.to_big() * other.to_big()),
        }
    }
}

impl Neg for &Rational {
    type Output = Rational;

    fn neg(self) -> Rational {
        match &self.0 {
            Repr::Small { numerator, denominator } => {
                Rational::reduce(-i128::from(*numerator), i128::from(denominator.get()))
            }
            Repr::Big(big) => Rational::from_big(-(**big).clone()),
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Self) -> Ordering {
        let difference = self - other;
        if difference.is_zero() {
            Ordering::Equal
        } else if difference.is_negative() {
            Ordering::Less
        } else {
            Ordering::Greater
        }
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.to_big())
    }
}

impl fmt::Debug for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
