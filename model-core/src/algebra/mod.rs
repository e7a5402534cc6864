//! Exact algebra of trigonometric polynomials: one canonical form, in which equality is a decision.
//!
//! - [`Rational`][]: coefficients.
//! - [`Poly`][]: the canonical form, with sums, products, powers, reciprocals of sines and cosines.
//! - [`AngleSum`][]: what a sine or cosine may be taken of.
//! - [`Term`][]: a look inside, for printers and code generators.
//! - [`Fraction`][]: a quotient of two canonical forms.
//! - [`crate::amount`]: from an expression as written.

mod angle;
mod atom;
mod calculus;
mod circle;
mod divide;
mod fourier;
mod fraction;
mod grading;
mod multiply;
mod poly;
mod rational;
mod root;
mod terms;

pub use angle::AngleSum;
pub use fraction::Fraction;
pub use grading::BasisFunction;
pub(crate) use multiply::Budget;
pub use poly::Poly;
pub use rational::{DecimalError, Rational};
pub use terms::{Pole, Term, Wave, WaveFactor};

/// Products of terms that one checked operation, or a typed expression as a whole, may take.
pub const SIZE_LIMIT: usize = 200_000;
/// The highest power of a symbol, or of a sine or cosine in a denominator, that a checked product may lead to.
pub const DEGREE_LIMIT: u32 = 1000;
/// The most bits that numerator and denominator of a coefficient may have together; an `f64` ends at about 2100.
pub const BITS_LIMIT: usize = 20_000;
/// The highest multiple of an angle that a sine or cosine may be taken of.
pub const HARMONIC_LIMIT: u32 = 1_000_000;

/// Why the algebra cannot do what it was asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum AlgebraError {
    /// Sine or cosine of something other than whole multiples of symbols plus quarter turns.
    #[error(
        "the angle of a sine or cosine must be a sum of whole multiples of angles and of pi/2; \
         declare a constant for any other angle"
    )]
    NotAnAngle,
    /// A division by something other than numbers, sines and cosines of single angles.
    #[error("only numbers, and sines and cosines of a single angle, can be divided by")]
    NotDivisible,
    /// A power or product beyond [`SIZE_LIMIT`], [`DEGREE_LIMIT`], [`BITS_LIMIT`] or [`HARMONIC_LIMIT`].
    #[error("the expression is too large when multiplied out")]
    TooLarge,
}
