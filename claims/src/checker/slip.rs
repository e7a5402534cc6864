//! The usual slips, in a referee's words.

use model_core::algebra::{Poly, Rational};
use model_core::chain::reading::{Measures, Reading};
use model_core::chain::{Axis, Chain, Factor, ObservableId, TransformKind};
use model_core::print;
use model_core::symbol::SymbolId;

/// What went wrong in one term of a component.
#[derive(Debug, Clone, PartialEq)]
pub enum TermSlip {
    /// The chain has the term, the print has not.
    Missing,
    /// The print has a term of this error, but not all of them.
    PartMissing(Poly),
    /// The chain has no such term.
    Superfluous,
    /// The term is printed, but the error is neglected by the claim itself.
    Neglected,
    /// A product of more errors than the order of the claim.
    BeyondOrder,
    /// The sign is the other one.
    Sign,
    /// The printed term is this multiple of the derived one.
    Factor(Rational),
    /// Sine for cosine, or cosine for sine, of this angle; perhaps the sign with it.
    SineForCosine {
        /// What the print has: `\sin \beta`, in the plain syntax.
        printed: Poly,
        /// What belongs there.
        derived: Poly,
        /// Whether the sign is wrong too.
        sign: bool,
    },
    /// A function of another joint than belongs there.
    OtherAngle {
        /// What the print has.
        printed: Poly,
        /// What belongs there.
        derived: Poly,
        /// Whether the sign is wrong too.
        sign: bool,
    },
    /// A factor too many.
    ExtraFactor(Poly),
    /// A factor is missing.
    MissingFactor(Poly),
    /// The term belongs into another component.
    BelongsTo(Axis),
    /// The term is printed in another component.
    StandsIn(Axis),
}

/// What went wrong with a whole formula, or with all that one error contributes to it.
#[derive(Debug, Clone, PartialEq)]
pub struct FormSlip {
    /// What went wrong.
    pub kind: FormSlipKind,
    /// The one error whose terms it explains; all of them if `None`.
    pub error: Option<SymbolId>,
}

/// What goes wrong with more than a term.
#[derive(Debug, Clone, PartialEq)]
pub enum FormSlipKind {
    /// Two components stand in each other's place.
    SwappedComponents(Axis, Axis),
    /// The components are shifted round.
    ShiftedComponents,
    /// The second component was run together with the first.
    RunTogether(Axis, Axis),
    /// The error was taken as the transform without errors minus the one with them.
    OppositeSign,
    /// Two transforms were multiplied the other way round.
    WrongOrder {
        /// The first of them in the declaration, as `Ry(dtheta_y1) of outer`.
        first: String,
        /// The second.
        second: String,
    },
    /// A transform of the instrument as designed was left out, as `Rx(beta) of middle`.
    LeftOut(String),
    /// A transform of the instrument as designed was made the other way, as `Rx(beta) of middle`.
    Reversed(String),
    /// A component is the error of another reading.
    OtherReading {
        /// What the print gives.
        printed: Reading,
        /// What is claimed.
        derived: Reading,
    },
}

impl TermSlip {
    /// The slip in words, formulas in the style that is asked for.
    #[must_use]
    pub fn describe(&self, chain: &Chain, observable: ObservableId, style: print::Style) -> String {
        let label = |axis: &Axis| chain.observable(observable).label(axis.index());
        let show = |poly: &Poly| print::poly(poly, chain, style);
        let and_sign = |sign: bool| if sign { ", and the other sign" } else { "" };
        match self {
            Self::Missing => "the term is missing".to_owned(),
            Self::PartMissing(part) => format!("a term is missing: {}", show(part)),
            Self::Superfluous => "the chain gives no such term".to_owned(),
            Self::Neglected => "the claim itself neglects this error".to_owned(),
            Self::BeyondOrder => "a product of more errors than the order of the form".to_owned(),
            Self::Sign => "the sign is wrong".to_owned(),
            Self::Factor(factor) => {
                format!("a factor: the printed term is {factor} times the derived one")
            }
            Self::SineForCosine { printed, derived, sign } | Self::OtherAngle { printed, derived, sign } => {
                format!("{} for {}{}", show(printed), show(derived), and_sign(*sign))
            }
            Self::ExtraFactor(factor) => format!("the factor {} is too much", show(factor)),
            Self::MissingFactor(factor) => format!("the factor {} is missing", show(factor)),
            Self::BelongsTo(axis) => format!("the term belongs into component {}", label(axis)),
            Self::StandsIn(axis) => {
                format!("the term is missing here and stands in component {}", label(axis))
            }
        }
    }
}

impl FormSlip {
    /// The slip in words.
    #[must_use]
    pub fn describe(&self, chain: &Chain, observable: ObservableId) -> String {
        let label = |axis: &Axis| chain.observable(observable).label(axis.index());
        let what = match &self.kind {
            FormSlipKind::SwappedComponents(a, b) => {
                format!("components {} and {} stand in each other's place", label(a), label(b))
            }
            FormSlipKind::ShiftedComponents => "the components are shifted round".to_owned(),
            FormSlipKind::RunTogether(a, b) => {
                format!("components {0} and {1} are run together in {0}", label(a), label(b))
            }
            FormSlipKind::OppositeSign => {
                "every sign is the other one: the error is counted the other way".to_owned()
            }
            FormSlipKind::WrongOrder { first, second } => {
                format!("a wrong order of transforms: this follows if {second} comes before {first}")
            }
            FormSlipKind::LeftOut(factor) => format!("a missing frame: this follows without {factor}"),
            FormSlipKind::Reversed(factor) => {
                format!("a reversed transform: this follows if {factor} goes the other way")
            }
            FormSlipKind::OtherReading { printed, derived } => {
                format!(
                    "another reading: this is the error of {}, not of {}",
                    in_words(printed),
                    in_words(derived)
                )
            }
        };
        match self.error {
            Some(error) => format!("all terms of {}: {what}", chain.symbol(error).name),
            None => what,
        }
    }
}

/// A reading with what tells it from the others.
fn in_words(reading: &Reading) -> String {
    match reading.measures {
        Measures::Azimuth { .. } => format!("the {} (\u{394}A)", reading.describe()),
        Measures::CrossElevation { zero, through } => {
            format!(
                "the azimuth from {zero} through {through} times the cosine of the elevation (\u{394}A cos E)"
            )
        }
        _ => format!("the {}", reading.describe()),
    }
}

/// An elementary transform as the declaration writes it: `Ry(dtheta_y1) of outer`.
pub(super) fn factor_name(chain: &Chain, body: &str, factor: &Factor) -> String {
    let kind = match factor.kind {
        TransformKind::Rotation => 'R',
        TransformKind::Translation => 'T',
    };
    format!("{kind}{}({}) of {body}", factor.axis, print::text(&factor.amount, chain))
}
