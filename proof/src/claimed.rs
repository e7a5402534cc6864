//! What is claimed of a chain, with the verdict: which statement that is, or why there is none.

use claims::checker::entries::{Entries, EntriesOf, EntriesVerdict};
use claims::checker::{CheckError, Checker, Claim, Order, Rank, RankSaid, Verdict, extended, only_of};
use model_core::identify::{Holds, identify};
use model_core::symbol::{SymbolId, SymbolKind};

use super::{Certificate, Declared, Refusal};

impl Declared {
    /// The same declaration, ready for these claims: with a small change of each joint that a Jacobian is by, and the axes and the
    /// origin of each body whose matrix is claimed.
    #[must_use]
    pub fn with_changes_of<'c>(mut self, claims: impl Iterator<Item = &'c Claim>) -> Self {
        let mut varied: Vec<SymbolId> = Vec::new();
        for claim in claims {
            let Claim::Entries(entries) = claim else { continue };
            match &entries.of {
                EntriesOf::Jacobian { by, .. } => varied.extend(by),
                EntriesOf::Frame { body, frame, .. } => self.add_columns(*body, *frame),
                EntriesOf::Shown(_) | EntriesOf::Image(_) => {}
            }
        }
        self.with_changes(&varied)
    }
}

impl Certificate<'_> {
    /// States what is claimed and proves the verdict on it.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn claim(&mut self, title: &str, claim: &Claim, verdict: &Verdict) -> Result<(), Refusal> {
        match (claim, verdict) {
            (Claim::ClosedForm(form), Verdict::ClosedForm(found)) => self.closed_form(title, form, found),
            (Claim::Equality(equality), Verdict::Equality(found)) => self.equality(title, equality, found),
            (Claim::Entries(entries), Verdict::Entries(found)) => self.entries(title, entries, found),
            (Claim::Values(values), _) => self.values(title, values, verdict.holds()),
            (Claim::Rank(rank), _) if verdict.holds() => self.rank(rank),
            (Claim::Rank(_), _) => Err(Refusal::RankDiffers),
            (Claim::Comparison(_) | Claim::Size(_), _) => Err(Refusal::Measured),
            (Claim::Bound(_), _) => Err(Refusal::Bound),
            (Claim::Total(_), _) => Err(Refusal::Total),
            (Claim::Count(_), _) => Err(Refusal::Count),
            (Claim::ClosedForm(_) | Claim::Equality(_) | Claim::Entries(_), _) => {
                unreachable!("a formula has a verdict of its own kind")
            }
        }
    }

    /// What is shown, how a body stands, or a Jacobian.
    fn entries(&mut self, title: &str, entries: &Entries, found: &EntriesVerdict) -> Result<(), Refusal> {
        if entries.only.is_some() {
            return Err(Refusal::OneNumber);
        }
        match (&entries.of, entries.order) {
            (EntriesOf::Image(_), _) => Err(Refusal::Image { reading: "pixels".to_owned() }),
            (EntriesOf::Jacobian { .. }, _) => self.jacobian(title, entries),
            (_, Order::Exact) => Err(Refusal::Exact),
            (EntriesOf::Shown(observable), Order::UpTo(order)) => {
                let question = (*observable, order, entries.kept.as_slice());
                self.shown(title, question, &entries.printed, found.differences.is_empty())
            }
            (EntriesOf::Frame { .. }, Order::UpTo(order)) => self.frame(title, order, entries, found),
        }
    }

    /// A Jacobian, column by column.
    fn jacobian(&mut self, title: &str, entries: &Entries) -> Result<(), Refusal> {
        let declared = self.declared;
        let chain = extended(declared.chain());
        let is_error = |id: SymbolId| chain.symbol(id).kind == SymbolKind::Error;
        let standing = |id: SymbolId| if is_error(id) { Some(id) } else { declared.change_of(id) };
        let columns = entries.columns(&chain, standing).ok_or(Refusal::Jacobian)?;
        let mut checker = Checker::new(&chain);
        for column in columns {
            let verdict = checker.closed_form(&column.form)?;
            let observable = &chain.observable(column.observable).name;
            let title = format!("{title}, {observable} by {}", chain.symbol(column.by).name);
            self.closed_form(&title, &column.form, &verdict)?;
        }
        Ok(())
    }

    /// A rank, from above by errors without influence and combinations of others, and from below by independent errors.
    fn rank(&mut self, rank: &Rank) -> Result<(), Refusal> {
        let errors = &rank.errors;
        if let RankSaid::Separable(others) = &rank.said {
            return self.independent(&rank.observables, others, errors);
        }
        let chain = only_of(self.declared.chain(), errors)?;
        let found = identify(&chain, &rank.observables).map_err(CheckError::from)?;
        if found.holds != Holds::Everywhere {
            return Err(Refusal::DeclaredValues);
        }
        self.identifiability(&found, |error| errors.contains(&error));
        Ok(())
    }
}
