//! Verdicts: what the algebra, or the exact form, says of a claim.

use std::ops::Range;

use super::compare;
use super::entries::EntriesVerdict;
use super::equality::EqualityVerdict;
use super::ranks::RankVerdict;
use super::sizes::{BoundVerdict, Outcome, SizeVerdict};
use super::slip::{FormSlip, TermSlip};
use super::total::TotalVerdict;
use super::values::ValueVerdict;
use model_core::algebra::{Fraction, Poly};
use model_core::chain::{Axis, Chain};
use model_core::print;
use model_core::symbol::SymbolId;

/// What is said of one claim.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// Of a printed formula.
    ClosedForm(FormVerdict),
    /// Of an equality of two formulas.
    Equality(EqualityVerdict),
    /// Of a comparison.
    Comparison(Measured),
    /// Of a count.
    Count(Counted),
    /// Of a total error.
    Total(TotalVerdict),
    /// Of what can be told apart.
    Rank(RankVerdict),
    /// Of an absolute size.
    Size(SizeVerdict),
    /// Of a bound.
    Bound(BoundVerdict),
    /// Of formulas of what is there.
    Entries(EntriesVerdict),
    /// Of numbers at one pose.
    Values(Vec<ValueVerdict>),
}

/// How a verdict was come by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Means {
    /// By exact algebra.
    Decided,
    /// By numbers at one pose.
    Computed,
    /// By numbers over many poses.
    Sampled,
    /// By a bound that holds everywhere, or an example against it.
    Proven,
}

impl Verdict {
    /// Whether the claim holds, for certain.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.outcome() == Outcome::Holds
    }

    /// What becomes of the claim.
    #[must_use]
    pub fn outcome(&self) -> Outcome {
        let holds = match self {
            Self::ClosedForm(form) => form.differences.is_empty(),
            Self::Equality(equality) => equality.difference.is_zero(),
            Self::Comparison(measured) => measured.holds,
            Self::Count(counted) => counted.found == counted.claimed,
            Self::Total(total) => total.differences.is_empty(),
            Self::Entries(entries) => entries.differences.is_empty(),
            Self::Values(values) => values.iter().all(ValueVerdict::holds),
            Self::Rank(rank) => rank.holds,
            Self::Size(size) => return size.outcome,
            Self::Bound(bound) => return bound.outcome,
        };
        if holds { Outcome::Holds } else { Outcome::Differs }
    }

    /// How it was come by.
    #[must_use]
    pub fn means(&self) -> Means {
        match self {
            Self::ClosedForm(_)
            | Self::Equality(_)
            | Self::Count(_)
            | Self::Total(_)
            | Self::Rank(_)
            | Self::Entries(_) => Means::Decided,
            Self::Comparison(_) | Self::Size(_) => Means::Sampled,
            Self::Values(_) => Means::Computed,
            Self::Bound(_) => Means::Proven,
        }
    }
}

/// What is said of a printed formula. It holds if there is no difference.
#[derive(Debug, Clone, PartialEq)]
pub struct FormVerdict {
    /// Every term that differs, by component, then by error.
    pub differences: Vec<Difference>,
    /// What explains several differences at once.
    pub slips: Vec<FormSlip>,
    /// The formula that the chain implies: one for each number that is shown.
    pub derived: Vec<Fraction>,
    /// What has to be positive for that to be right: see [`model_core::forms::Form::positive`].
    pub positive: Vec<Poly>,
}

/// A term that differs.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// In which component; for readings the place among those that are shown, the first being x.
    pub component: Axis,
    /// The error, or the product of errors: symbols and powers, by symbol. Empty for what has no error in it.
    pub error: Vec<(SymbolId, u32)>,
    /// What multiplies it in print; zero if it is missing there.
    pub printed: Fraction,
    /// What multiplies it by the algebra; zero if it does not belong there.
    pub derived: Fraction,
    /// Where in the text of the component, if the term is printed.
    pub place: Option<Range<usize>>,
    /// The whole term in that text, if it is printed in one piece; `place` may be a part of it.
    pub term: Option<Range<usize>>,
    /// What went wrong, if it is one of the usual slips.
    pub slip: Option<TermSlip>,
}

impl Difference {
    /// The product of errors as an amount; one for what has no error in it.
    #[must_use]
    pub fn error_product(&self) -> Poly {
        compare::product(&self.error)
    }

    /// The product of errors by its names: `dtheta_x1`, `dx1*dg2`; `1` for what has no error in it.
    #[must_use]
    pub fn error_name(&self, chain: &Chain) -> String {
        print::text(&self.error_product(), chain)
    }
}

/// Two influences, measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// Influence of the error that is said to be small: rad for directions, m for points.
    pub error: f64,
    /// Influence of the other one, in the same unit.
    pub against: f64,
    /// The one over the other; `None` if the other has no influence at all.
    pub ratio: Option<f64>,
    /// The largest ratio that the claim allows.
    pub at_most: f64,
    /// Whether the claim holds.
    pub holds: bool,
}

/// A count.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Counted {
    /// How many there are.
    pub found: usize,
    /// How many there are said to be.
    pub claimed: usize,
    /// Their names, in order.
    pub names: Vec<String>,
}
