//! Why no number of poses shows an error: by exact identifiability, or by the limits.

use model_core::algebra::Poly;
use model_core::identify::{self, Identifiability};
use model_core::{Chain, ObservableId, SymbolId, print};
use report::words::numbers;

use super::unit_of;

/// Errors that a sentence names.
const NAMED: usize = 6;

/// What is asked of one observable, worked out where it is asked first.
pub(super) struct Why<'a> {
    chain: &'a Chain,
    observable: ObservableId,
    exact: Option<Option<Identifiability>>,
}

impl<'a> Why<'a> {
    pub fn new(chain: &'a Chain, observable: ObservableId) -> Self {
        Self { chain, observable, exact: None }
    }

    fn seen(&self) -> &str {
        &self.chain.observable(self.observable).name
    }

    fn name(&self, error: SymbolId) -> &str {
        &self.chain.symbol(error).name
    }

    /// Of an error that the observable does not depend on.
    pub fn off_the_way(&self, error: SymbolId) -> String {
        format!("`{}` does not move `{}`. Measure another observable.", self.name(error), self.seen())
    }

    /// Of an error that the poses show only together with others.
    pub fn of(&mut self, error: SymbolId, beside: &[SymbolId], limit: f64) -> String {
        let exact =
            self.exact.get_or_insert_with(|| identify::identify(self.chain, &[self.observable]).ok()).clone();
        let left = match limit.is_finite() {
            true => format!(" The sizes alone leave ± {}.", numbers::told(limit, unit_of(self.chain, error))),
            false => String::new(),
        };
        let why = match exact.as_ref() {
            Some(exact) if exact.invisible.contains(&error) => self.off_the_way(error),
            Some(exact) => self.together(exact, error).unwrap_or_else(|| self.within_limits(error, beside)),
            None => self.within_limits(error, beside),
        };
        format!("{why}{left}")
    }

    /// The combinations that can be measured in its place, where exactly no pose separates it.
    fn together(&self, exact: &Identifiability, error: SymbolId) -> Option<String> {
        let grouped = exact.alike.iter().any(|group| group.iter().any(|own| own.error == error));
        let depends = exact
            .combinations
            .iter()
            .any(|own| own.error == error || own.others.iter().any(|(other, _)| *other == error));
        let own: Vec<String> = exact
            .estimable
            .iter()
            .filter(|terms| terms.len() > 1 && terms.iter().any(|(other, _)| *other == error))
            .map(|terms| {
                let sum = terms
                    .iter()
                    .fold(Poly::zero(), |sum, (error, factor)| &sum + &(&Poly::symbol(*error) * factor));
                format!("`{}`", print::text(&sum, self.chain))
            })
            .collect();
        (grouped || depends).then_some(())?;
        if own.is_empty() {
            return None;
        }
        let name = self.name(error);
        Some(format!(
            "No pose separates `{name}` from other errors. `{}` shows only {}.",
            self.seen(),
            own.join(" and ")
        ))
    }

    fn within_limits(&self, error: SymbolId, beside: &[SymbolId]) -> String {
        let name = self.name(error);
        if beside.is_empty() {
            return format!("No pose within these limits shows `{name}`. Widen --range, or loosen --where.");
        }
        let mut others: Vec<String> =
            beside.iter().take(NAMED).map(|&other| format!("`{}`", self.name(other))).collect();
        if beside.len() > NAMED {
            others.push(format!("{} more", beside.len() - NAMED));
        }
        format!(
            "No pose within these limits separates `{name}` from {}. Widen --range, or loosen --where.",
            others.join(", ")
        )
    }
}
