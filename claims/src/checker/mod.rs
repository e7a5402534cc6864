//! The checker: whether what somebody published of a chain is what the chain implies.
//!
//! A [`Claim`] is data; [`Checker::check`] gives its [`Verdict`]. Closed forms are decided by exact algebra, term by term
//! (`compare`, in canonical form, never by sampling), and a difference is traced to the slip behind it
//! (`diagnosis` for terms, `misreading` for the order of transforms and left-out frames). Equalities of two formulas
//! (`equality`), total errors (`total`) and what can be told apart (`ranks`) are decided, too. Comparisons and absolute sizes (`sizes`) are measured on the exact form
//! ([`model_core::budget`]), bounds proven ([`model_core::remainder`]); a verdict says by which means it came about. Claims files are read elsewhere; a claim that cannot be read is a
//! [`Mistake`](model_core::mistake::Mistake), never a verdict.

mod algebraic;
mod angles;
mod assert;
mod claim;
mod columns;
mod compare;
mod diagnosis;
pub mod entries;
mod equality;
mod formula;
pub mod hand;
mod lowering;
mod misreading;
mod order;
mod other_reading;
mod radicand;
mod ranks;
mod series;
mod sizes;
mod slip;
mod terms;
mod total;
mod turn;
mod values;
mod verdict;
mod written;

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use compare::{Columns, Implied};
use diagnosis::Case;
use misreading::Misreading;
use model_core::algebra::{AlgebraError, Poly};
use model_core::budget::{self, BudgetError};
use model_core::chain::{Chain, ObservableId};
use model_core::forms::{self, FormError};
use model_core::identify::IdentifyError;
use model_core::print;
use model_core::remainder::DomainError;

pub use algebraic::extended;
pub use assert::assert_closed_form;
pub use claim::{Claim, ClosedForm, Combination, Comparison, Count, Faces, errors_named};
pub use columns::Column;
pub use equality::{Equality, EqualityVerdict};
pub use formula::{PrintedComponent, PrintedVector};
pub use lowering::lower;
pub use model_core::algebra::Fraction;
pub use order::Order;
pub use radicand::{Radicand, Total};
pub use ranks::{Rank, RankSaid, RankVerdict, only_of};
pub use sizes::{Bound, BoundVerdict, Combined, Limits, Outcome, Size, SizeMeasure, SizeVerdict};
pub use slip::{FormSlip, FormSlipKind, TermSlip};
pub use total::TotalVerdict;
pub use turn::PrintedTurn;
pub use values::{Exactly, Given, ValueVerdict, Values, exact_leeway};
pub use verdict::{Counted, Difference, FormVerdict, Means, Measured, Verdict};
pub use written::TextPlace;
pub(crate) use written::prints_letters;

/// Checks claims about one chain; what it derives for one claim it keeps for the next.
#[derive(Debug)]
pub struct Checker<'a> {
    chain: &'a Chain,
    forms: BTreeMap<(ObservableId, Order), Implied>,
    misreadings: BTreeMap<(ObservableId, Order), Vec<Misreading>>,
}

/// Why a claim that was read cannot be decided.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CheckError {
    /// The chain has no closed form.
    #[error(transparent)]
    Form(#[from] FormError),
    /// The derived form cannot be said in the terms of the printed one: half angles below a stroke, or too many terms.
    #[error("the derived form cannot be said in the terms of the printed one: {0}")]
    Terms(#[from] AlgebraError),
    /// A mean over faces of quotients.
    #[error("faces are combined where the algebra can divide; here {0} stands below")]
    FacesOfQuotient(String),
    /// The sign of a root in the second face cannot be told.
    #[error("whether {0} is positive or negative in the second face cannot be told from its first")]
    SignInFace(String),
    /// In the second face a ramp or the angle of a line of sight would be another one.
    #[error("a ramp or the angle of a line of sight that follows {0} has no form in the second face")]
    Derived(String),
    /// What data can tell apart has no answer.
    #[error(transparent)]
    Identify(#[from] IdentifyError),
    /// A bound has no domain.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// What a print takes for granted can be read in two ways, and only one of them holds.
    #[error(
        "`{0}` can turn vectors or axes; as a turn of vectors the formula differs, as one of axes it holds. Say which: \
         `rotations = \"axes\"` or `rotations = \"vectors\"` above the claims"
    )]
    TwoReadings(String),
    /// The poses of a comparison do not give the observable a value.
    #[error(transparent)]
    Budget(#[from] BudgetError),
}

impl<'a> Checker<'a> {
    /// A checker that has derived nothing yet.
    #[must_use]
    pub fn new(chain: &'a Chain) -> Self {
        Self { chain, forms: BTreeMap::new(), misreadings: BTreeMap::new() }
    }

    /// The verdict on a claim about this chain.
    ///
    /// # Errors
    /// The claim cannot be decided: see [`CheckError`].
    pub fn check(&mut self, claim: &Claim) -> Result<Verdict, CheckError> {
        match claim {
            Claim::ClosedForm(claim) => Ok(Verdict::ClosedForm(self.closed_form(claim)?)),
            Claim::Comparison(claim) => Ok(Verdict::Comparison(self.comparison(claim)?)),
            Claim::Equality(claim) => Ok(Verdict::Equality(self.equality(claim)?)),
            Claim::Total(claim) => Ok(Verdict::Total(self.total(claim)?)),
            Claim::Entries(claim) => Ok(Verdict::Entries(self.entries(claim)?)),
            Claim::Values(claim) => Ok(Verdict::Values(self.values(claim))),
            Claim::Rank(claim) => Ok(Verdict::Rank(self.rank(claim)?)),
            Claim::Size(claim) => Ok(Verdict::Size(self.size(claim)?)),
            Claim::Bound(claim) => Ok(Verdict::Bound(self.bound(claim)?)),
            Claim::Count(claim) => Ok(Verdict::Count(Counted {
                found: claim.errors.len(),
                claimed: claim.equals,
                names: claim.errors.iter().map(|&error| self.chain.symbol(error).name.clone()).collect(),
            })),
        }
    }

    /// The verdict on a printed formula.
    ///
    /// # Errors
    /// The chain has no closed form, or it cannot be said in the terms of the print.
    pub fn closed_form(&mut self, claim: &ClosedForm) -> Result<FormVerdict, CheckError> {
        let chain = self.chain;
        let below = claim.printed.components.each_ref().map(|component| &component.value.below);
        let above = claim
            .printed
            .components
            .each_ref()
            .map(|component| compare::parts(chain, &component.value.above));
        let implied = claimed(chain, claim, self.columns(claim.observable, claim.order)?)?;
        // Both sides are multiplied by what stands below on either.
        let printed = compare::multiplied(&above, implied.below.each_ref());
        let derived = compare::multiplied(&implied.columns, below);
        let zero = Poly::zero();
        let pairs = compare::differing(&printed, &derived, &zero);
        let mut differences = Vec::with_capacity(pairs.len());
        let scale: [Poly; 3] = std::array::from_fn(|place| below[place] * &implied.below[place]);
        let case = Case { chain, claim, printed: &printed, derived: &derived, below: scale.each_ref() };
        let mut terms = None;
        let shown = |poly: &Poly| algebraic::in_wholes(poly, chain);
        let quotient = |above: &Poly, below: &Poly| {
            let quotient = Fraction::new(shown(above), shown(below));
            quotient.unwrap_or_else(|| unreachable!("no formula stands over zero"))
        };
        for pair in &pairs {
            // Terms of a component are multiplied out once, and only if something differs there.
            if terms.as_ref().is_none_or(|(axis, _)| *axis != pair.component) {
                let expression = &claim.printed.components[pair.component.index()].expression;
                terms = Some((pair.component, terms::expand(expression).unwrap_or_default()));
            }
            let terms = terms.as_ref().map_or(&[][..], |(_, terms)| terms);
            let finding = case.diagnose(*pair, terms);
            let place = pair.component.index();
            let part = |columns: &Columns| columns[place].get(pair.error).unwrap_or(&zero).clone();
            differences.push(Difference {
                component: pair.component,
                error: pair.error.clone(),
                printed: quotient(&part(&above), below[place]),
                derived: quotient(&part(&implied.columns), &implied.below[place]),
                place: finding.place,
                term: finding.term,
                slip: finding.slip,
            });
        }
        let mut slips = Vec::new();
        if differences.len() > 1 {
            // A misreading that divides by something else is compared with no print.
            let prepare = |other: &Implied| {
                let other = claimed(chain, claim, other).ok()?;
                (other.below == implied.below).then(|| compare::multiplied(&other.columns, below))
            };
            let misreadings = self.misreadings(claim.observable, claim.order);
            slips = misreading::explain(claim, &printed, &derived, misreadings, prepare);
        }
        if !differences.is_empty() {
            slips.extend(other_reading::explain(chain, claim, &above, &differences));
        }
        let count = chain.observable(claim.observable).shown.len();
        let derived =
            (0..count).map(|place| quotient(&compare::total(&implied.columns[place]), &implied.below[place]));
        let mut positive: Vec<Poly> = Vec::new();
        for root in implied.positive.concat() {
            if !positive.contains(&root) {
                positive.push(root);
            }
        }
        Ok(FormVerdict { differences, slips, derived: derived.collect(), positive })
    }

    fn columns(&mut self, observable: ObservableId, order: Order) -> Result<&Implied, FormError> {
        let key = (observable, order);
        if !self.forms.contains_key(&key) {
            let implied = derived(self.chain, observable, order)?;
            self.forms.insert(key, implied);
        }
        Ok(&self.forms[&key])
    }

    fn misreadings(&mut self, observable: ObservableId, order: Order) -> &[Misreading] {
        let chain = self.chain;
        self.misreadings
            .entry((observable, order))
            .or_insert_with(|| misreading::of_chain(chain, observable, order))
    }

    /// Measures a comparison on the exact form.
    ///
    /// # Errors
    /// The poses do not give the observable a value.
    fn comparison(&self, claim: &Comparison) -> Result<Measured, BudgetError> {
        let measure = |error: usize| -> Result<f64, BudgetError> {
            let mut sizes = vec![0.0; self.chain.symbols.len()];
            sizes[error] = claim.size;
            let budget = budget::Budget::measure(self.chain, claim.observable, &sizes, &claim.poses)?;
            Ok(budget.influences.first().map_or(0.0, |influence| influence.summary.size(claim.measure)))
        };
        let (error, against) = (measure(claim.error.index())?, measure(claim.against.index())?);
        let ratio = (against > 0.0).then(|| error / against);
        let holds = error <= claim.at_most * against;
        Ok(Measured { error, against, ratio, at_most: claim.at_most, holds })
    }
}

/// What the errors add to what an observable shows, as far as an order goes.
fn derived(chain: &Chain, observable: ObservableId, order: Order) -> Result<Implied, FormError> {
    let (components, positive) = match order {
        Order::UpTo(order) => {
            let form = forms::derive(chain, observable, order)?;
            (form.components, form.positive)
        }
        Order::Exact => {
            let exact = forms::exact_symbolic(chain, observable)?;
            (exact.into_iter().map(Fraction::whole).collect(), Vec::new())
        }
    };
    Ok(Implied::new(chain, &components, &positive))
}

/// What the chain implies, as the claim has it: kept errors, faces, one component, terms of the print.
fn claimed(chain: &Chain, claim: &ClosedForm, implied: &Implied) -> Result<Implied, CheckError> {
    let mut implied = Implied { columns: compare::kept(chain, &implied.columns, claim)?, ..implied.clone() };
    if let Some(faces) = &claim.faces {
        if let Some(joint) = compare::derived_of(chain, &implied.columns, faces) {
            return Err(CheckError::Derived(chain.symbol(joint).name.clone()));
        }
        implied = compare::over_faces(chain, &implied, faces)?;
    }
    if let Some(only) = claim.only {
        implied.clear_but(only);
    }
    Ok(compare::translated(chain, &implied, claim)?)
}

impl FormVerdict {
    /// The formula that the chain implies, in LaTeX, one text for each number that is shown, in the printed forms of
    /// `chain`.
    #[must_use]
    pub fn corrected(&self, chain: &Chain) -> Vec<String> {
        self.derived.iter().map(|component| component.show(chain, print::Style::Latex)).collect()
    }
}
