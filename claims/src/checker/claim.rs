//! Claims as data: what somebody says of a chain.

use super::entries::Entries;
use super::equality::Equality;
use super::formula::PrintedVector;
use super::order::Order;
use super::radicand::Total;
use super::ranks::Rank;
use super::sizes::{Bound, Size};
use super::values::Values;
use model_core::algebra::Poly;
use model_core::budget::{Measure, Poses};
use model_core::chain::{Axis, Chain, ObservableId};
use model_core::mistake::Mistake;
use model_core::names;
use model_core::symbol::{SymbolId, SymbolKind};

/// One claim.
#[derive(Debug, Clone)]
pub enum Claim {
    /// A printed formula for the error of an observable.
    ClosedForm(Box<ClosedForm>),
    /// Two printed formulas are one.
    Equality(Box<Equality>),
    /// Formulas of what is there: a pose, a Jacobian, an image point.
    Entries(Box<Entries>),
    /// Numbers at one pose.
    Values(Values),
    /// One error matters less than another.
    Comparison(Comparison),
    /// How many errors of a kind are declared.
    Count(Count),
    /// The length of the error, as a root.
    Total(Box<Total>),
    /// What can be told apart.
    Rank(Rank),
    /// How much errors do, absolutely.
    Size(Size),
    /// How much the first order drops.
    Bound(Bound),
}

impl Claim {
    /// Whether rotations about named axes were read as the table of symbols says.
    #[must_use]
    pub fn is_turned(&self) -> bool {
        match self {
            Self::ClosedForm(form) => form.printed.turned,
            Self::Equality(equality) => equality.is_turned(),
            Self::Entries(entries) => entries.printed.iter().any(|printed| printed.turned),
            _ => false,
        }
    }
}

/// That the error of an observable has this closed form.
#[derive(Debug, Clone)]
pub struct ClosedForm {
    /// Of which observable.
    pub observable: ObservableId,
    /// How many errors a product may have.
    pub order: Order,
    /// The one number that is claimed, by its place among those that are shown, the first being x; all of them if `None`.
    pub only: Option<Axis>,
    /// Combined over two faces, or as it is.
    pub faces: Option<Faces>,
    /// The errors that are not zero, in order.
    pub kept: Vec<SymbolId>,
    /// The formula as printed.
    pub printed: PrintedVector,
}

impl ClosedForm {
    /// Whether this is a form to an order, of one face, in the names of the chain alone.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        let PrintedVector { halves, has_roots, truncated, .. } = &self.printed;
        self.faces.is_none() && self.order != Order::Exact && halves.is_empty() && !has_roots && !truncated
    }
}

/// The same pose taken up a second time in another position of the joints, and what becomes of the two errors.
#[derive(Debug, Clone, PartialEq)]
pub struct Faces {
    /// What each joint is in the second face: amounts of the joint itself, constants and π.
    pub second: Vec<(SymbolId, Poly)>,
    /// How the two are combined.
    pub combined: Combination,
}

/// What becomes of the errors of two faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Combination {
    /// (first + second) / 2
    Mean,
    /// first − second
    Difference,
    /// (first − second) / 2
    HalfDifference,
    /// −first: what has to be added to a reading so that its error goes.
    Correction,
}

/// That the influence of one error is at most `at_most` times that of another.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// On which observable.
    pub observable: ObservableId,
    /// The error that is said to be small.
    pub error: SymbolId,
    /// The error that it is compared with.
    pub against: SymbolId,
    /// Of both errors, in SI: rad for angles, m for lengths.
    pub size: f64,
    /// How an influence is measured over the poses.
    pub measure: Measure,
    /// The largest ratio that the claim allows.
    pub at_most: f64,
    /// Over which poses.
    pub poses: Poses,
}

/// That the chain declares this many errors of a kind.
#[derive(Debug, Clone)]
pub struct Count {
    /// The errors of the kind, in order.
    pub errors: Vec<SymbolId>,
    /// How many there are said to be.
    pub equals: usize,
}

/// The errors of a chain that a name or a pattern (`dtheta_*`) means, in order.
///
/// # Errors
/// A name that is no error of the chain, or a pattern that matches none.
pub fn errors_named(chain: &Chain, pattern: &str) -> Result<Vec<SymbolId>, Mistake<()>> {
    let errors = || chain.symbols_of(SymbolKind::Error);
    let found: Vec<SymbolId> =
        errors().filter(|&error| names::matches(pattern, &chain.symbol(error).name)).collect();
    if !found.is_empty() {
        return Ok(found);
    }
    if names::is_pattern(pattern) {
        let message = format!("the pattern `{pattern}` matches no error of chain {}", chain.name);
        return Err(Mistake::new((), message).with_help("`*` stands for any letters: `da*`, `*_x2`"));
    }
    let mistake = Mistake::new((), format!("chain {} has no error `{pattern}`", chain.name));
    Err(match names::nearest(pattern, errors().map(|error| chain.symbol(error).name.as_str())) {
        Some(near) => mistake.with_help(format!("did you mean `{near}`?")),
        None => mistake,
    })
}
