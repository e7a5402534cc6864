//! Reading the terms of a frozen model, each against the chain and the catalogue.

use std::ops::Range;

use model_core::{Chain, ObservableId, SymbolId, SymbolKind};

use super::frozen::{Frozen, FrozenTerm};
use super::mistakes::{Gathered, Outcome, Several, every, mistake};
use super::plan::Search;
use super::written::Study;
use effects::catalogue::{NoTerm, Term, catalogue, terms};

/// Names of effects that one mistake lists.
const LISTED: usize = 4;

impl Study {
    /// The terms, where the study gives them.
    pub(super) fn frozen(
        &self,
        chain: &Chain,
        observables: &[ObservableId],
        search: &Search,
    ) -> Outcome<Option<Frozen>> {
        let Some(written) = &self.model.terms else { return Ok(None) };
        let mut mistakes = Gathered::default();
        if let Some(effect) = self.search.effects.first() {
            mistakes.take::<()>(Err(mistake(
                effect.span(),
                "`effects` chooses what may be found, and with `terms` nothing is looked for",
                "leave one of them out",
            )));
        }
        let is_fixed =
            |id: &SymbolId| self.fit.fix.keys().any(|name| *name.get_ref() == chain.symbol(*id).name);
        let names: Vec<String> = written.get_ref().iter().map(|name| name.get_ref().clone()).collect();
        let setting = search.setting(chain, observables);
        let all = catalogue(&setting);
        let read = terms(&setting, &all, &names).into_iter().zip(written.get_ref());
        let read = mistakes.take(every(read.map(|(read, name)| {
            let term = read.map_err(|none| no_term(name.span(), name.get_ref(), none))?;
            match term {
                Term::Error(error) if is_fixed(&error) => Err(mistake(
                    name.span(),
                    format!("`{}` is fixed under [fit], so it is no term", chain.symbol(error).name),
                    "leave it out of one of them",
                )),
                term => Ok(FrozenTerm { written: name.get_ref().clone(), term }),
            }
        })));
        mistakes.none()?;
        let Some(read) = read else { unreachable!("what is missing comes with a mistake") };
        for (at, own) in read.iter().enumerate() {
            if let Some(other) = read[..at].iter().find(|other| other.term == own.term) {
                let message = format!("`{}` and `{}` are the same term", other.written, own.written);
                return Err(mistake(written.get_ref()[at].span(), message, "leave one of them out"));
            }
        }
        if !read.iter().any(|own| matches!(own.term, Term::Error(_))) {
            return Err(mistake(
                written.span(),
                "no term is a declared error",
                "name one of the declaration's errors at least, as its indices: the other ones are held at zero",
            ));
        }
        let is_term = |id: &SymbolId| read.iter().any(|own| own.term == Term::Error(*id));
        let held = chain.symbols_of(SymbolKind::Error).filter(|id| !is_term(id) && !is_fixed(id)).collect();
        Ok(Some(Frozen { terms: read, held }))
    }
}

/// A name that is no term.
fn no_term(place: Range<usize>, name: &str, none: NoTerm) -> Several {
    match none {
        NoTerm::Unknown(near) => {
            let help = near.map_or_else(
                || "write a declared error, an effect of the catalogue, or a term of TPOINT".to_owned(),
                |near| format!("did you mean `{near}`?"),
            );
            mistake(place, format!("no declared error or effect is called `{name}`"), help)
        }
        NoTerm::Several(names) => {
            let first: Vec<String> = names.iter().take(LISTED).map(|name| format!("`{name}`")).collect();
            let message = format!("`{name}` is a family of {} effects", names.len());
            let more = if names.len() > LISTED { " and others" } else { "" };
            mistake(place, message, format!("write the name of one: {}{more}", first.join(", ")))
        }
    }
}
