//! Why something cannot be certified.

use claims::checker::CheckError;
use model_core::algebra::AlgebraError;
use model_core::forms::FormError;

use super::expanded;

/// Why something cannot be certified.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// The chain has no closed form.
    #[error(transparent)]
    Form(#[from] FormError),
    /// What the algebra refuses.
    #[error(transparent)]
    Algebra(#[from] AlgebraError),
    /// A sine or cosine of a high multiple of an angle.
    #[error(
        "a formula contains the sine or cosine of {multiple} times an angle. Certificates go up to {} times",
        expanded::HARMONIC_LIMIT
    )]
    Harmonic {
        /// The multiple.
        multiple: u32,
    },
    /// More than Coq calculates with in reasonable time.
    #[error(
        "a vector of {terms} terms stands on the way through the chain. Certificates go up to {limit}, with which Coq is busy for \
         minutes. A claim that keeps few errors has fewer terms"
    )]
    TooLarge {
        /// How many terms there are.
        terms: usize,
        /// How many there may be.
        limit: usize,
    },
    /// Nowhere among rational points and quarter turns is the difference a number other than zero.
    #[error("no place with rational values was found at which the printed and the derived value differ")]
    NoWitness,
    /// A formula of ours that does not read back as it was printed; a defect of trueaxis.
    #[error("the formula `{text}` does not read back")]
    Unreadable {
        /// The formula.
        text: String,
    },
    /// Nowhere among rational points and quarter turns do the errors show themselves as independent.
    #[error("no poses with rational values were found at which the errors show themselves as independent")]
    NoMinor,
    /// Too many unknowns for the linear arithmetic of Coq.
    #[error("the statement is about {unknowns} errors together. Certificates solve for up to {limit}")]
    ManyUnknowns {
        /// How many there are.
        unknowns: usize,
        /// How many there may be.
        limit: usize,
    },
    /// A difference that only values of a ramp would show.
    #[error(
        "printed and derived differ in what stands beside a ramp. Certificates do not put numbers into ramps"
    )]
    Ramp,
    /// A line of sight that is bent, or an error that follows its angle from up.
    #[error(
        "the line of sight of `{name}` is bent or has an angle from up, of which certificates do not speak"
    )]
    LineOfSight {
        /// The observable.
        name: String,
    },
    /// A claim of another kind than certificates speak of.
    #[error(
        "certificates speak of forms to an order, of one face, without half angles and roots, and of vectors without quotients \
         by sums"
    )]
    Claim,
    /// An image point.
    #[error(
        "certificates do not know image points yet, as the {reading} of a camera. Claim the point in the frame of the camera"
    )]
    Image {
        /// The reading in words.
        reading: String,
    },
    /// How a body is turned.
    #[error(
        "certificates speak of vectors, and not of the {reading} of an orientation. Claim the directions of its three axes"
    )]
    Orientation {
        /// The reading in words.
        reading: String,
    },
    /// An angle or a length beyond first order.
    #[error(
        "the claim is of the {reading} to order {order}. Certificates state angles and lengths to first order"
    )]
    ReadingToOrder {
        /// The reading in words.
        reading: String,
        /// The order.
        order: u32,
    },
    /// A quotient that exists nowhere, or not where the claim is looked at.
    #[error(
        "it divides by something other than products of numbers, symbols, sines and cosines of single angles"
    )]
    Divisor,
    /// A claim that the checker cannot decide.
    #[error(transparent)]
    Check(#[from] CheckError),
    /// What is measured over poses.
    #[error("influences are measured over poses in floating point, and not proved. Claim the formula")]
    Measured,
    /// What the first order drops.
    #[error(
        "the bound comes from interval arithmetic in rounded numbers over all poses, which certificates do not repeat. \
         Claim the second order by `components`, which has a certificate"
    )]
    Bound,
    /// How many errors are declared.
    #[error("a count is of names in the declaration, and no formula")]
    Count,
    /// The length of the error.
    #[error("a total error is a root. Claim the components, which have certificates")]
    Total,
    /// A rank that is not what the print says.
    #[error("a rank that differs has no theorem. Claim the rank that was found")]
    RankDiffers,
    /// What is known at the declared values of the constants only.
    #[error("the answer is at the declared values of the constants, and a theorem would be of all values")]
    DeclaredValues,
    /// A matrix of four rows of which the last is another one.
    #[error(
        "the last row of the printed matrix is not 0 0 0 1. Claim the other rows as a matrix of three columns"
    )]
    LastRow,
    /// One number of a vector.
    #[error("certificates speak of whole vectors, and not of one of their numbers. Claim all of them")]
    OneNumber,
    /// The exact form.
    #[error("certificates speak of forms to an order, and not of the exact form. Claim it to first order")]
    Exact,
    /// A Jacobian of something else.
    #[error("certificates speak of Jacobians of points and directions, by errors and joints")]
    Jacobian,
    /// Numbers of something else than a vector.
    #[error(
        "the values are of the {reading}. Certificates speak of the numbers x, y and z of a point or direction"
    )]
    ValueOf {
        /// The reading in words.
        reading: String,
    },
    /// A number that is not written as a decimal or a multiple of π.
    #[error(
        "{what} is no decimal with a unit and no amount of numbers and π, so that its exact value is not known"
    )]
    NoExactValue {
        /// What has no exact value.
        what: String,
    },
    /// A ramp at numbers.
    #[error("the value has a ramp on its way. Certificates do not put numbers into ramps")]
    RampValue,
}
