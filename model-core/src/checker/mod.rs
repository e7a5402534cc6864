//! The checker: whether what somebody published of a chain is what the chain implies.
//!
//! A [`Claim`] is data; [`Checker::check`] gives its [`Verdict`]. Closed forms are decided by exact algebra, term by term
//! (`compare`, in canonical form, never by sampling), and a difference is traced to the slip behind it
//! (`diagnosis` for terms, `misreading` for the order of transforms and left-out frames). Comparisons are measured on
//! the exact form ([`crate::budget`]). Claims files are read elsewhere; a claim that cannot be read is a
//! [`Mistake`](crate::mistake::Mistake), never a verdict.

mod assert;
mod claim;
mod compare;
mod diagnosis;
mod formula;
mod misreading;
mod slip;
mod terms;
mod verdict;

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use crate::algebra::Poly;
use crate::budget::{self, BudgetError};
use crate::chain::{Chain, ObservableId};
use crate::forms::{self, FormError};
use crate::print;
use compare::Columns;
use diagnosis::Case;
use misreading::Misreading;

pub use assert::assert_closed_form;
pub use claim::{Claim, ClosedForm, Comparison, Count, errors_named};
pub use formula::{PrintedComponent, PrintedVector, TextPlace, lower};
pub use slip::{FormSlip, FormSlipKind, TermSlip};
pub use verdict::{Counted, Difference, FormVerdict, Measured, Verdict};

/// Checks claims about one chain; what it derives for one claim it keeps for the next.
#[derive(Debug)]
pub struct Checker<'a> {
    chain: &'a Chain,
    forms: BTreeMap<(ObservableId, u32), Columns>,
    misreadings: BTreeMap<(ObservableId, u32), Vec<Misreading>>,
}

/// Why a claim that was read cannot be decided.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CheckError {
    /// The chain has no closed form.
    #[error(transparent)]
    Form(#[from] FormError),
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
    /// The chain has no closed form.
    pub fn closed_form(&mut self, claim: &ClosedForm) -> Result<FormVerdict, FormError> {
        let chain = self.chain;
        let printed =
            claim.printed.components.each_ref().map(|component| compare::parts(chain, &component.value));
        let derived = compare::kept(self.columns(claim.observable, claim.order)?, claim);
        let zero = Poly::zero();
        let pairs = compare::differing(&printed, &derived, &zero);
        let mut differences = Vec::with_capacity(pairs.len());
        let case = Case { chain, claim, printed: &printed, derived: &derived };
        let mut terms = None;
        for pair in &pairs {
            // Terms of a component are multiplied out once, and only if something differs there.
            if terms.as_ref().is_none_or(|(axis, _)| *axis != pair.component) {
                let expression = &claim.printed.components[pair.component.index()].expression;
                terms = Some((pair.component, terms::expand(expression).unwrap_or_default()));
            }
            let terms = terms.as_ref().map_or(&[][..], |(_, terms)| terms);
            let finding = case.diagnose(*pair, terms);
            differences.push(Difference {
                component: pair.component,
                error: pair.error.clone(),
                printed: pair.printed.clone(),
                derived: pair.derived.clone(),
                place: finding.place,
                slip: finding.slip,
            });
        }
        let slips = if differences.len() < 2 {
            Vec::new()
        } else {
            misreading::explain(claim, &printed, &derived, self.misreadings(claim.observable, claim.order))
        };
        Ok(FormVerdict { differences, slips, derived: derived.each_ref().map(compare::total) })
    }

    fn columns(&mut self, observable: ObservableId, order: u32) -> Result<&Columns, FormError> {
        let key = (observable, order);
        if !self.forms.contains_key(&key) {
            let form = forms::derive(self.chain, observable, order)?;
            self.forms.insert(key, compare::columns(self.chain, &form));
        }
        Ok(&self.forms[&key])
    }

    fn misreadings(&mut self, observable: ObservableId, order: u32) -> &[Misreading] {
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

impl FormVerdict {
    /// The formula that the chain implies, in LaTeX, one text a component, in the printed forms of `chain`.
    #[must_use]
    pub fn corrected(&self, chain: &Chain) -> [String; 3] {
        self.derived.each_ref().map(|component| print::latex(component, chain))
    }
}
