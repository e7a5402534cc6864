//! Reading the terms of a model that somebody wrote as a list: declared errors and effects, by their names or by those of other fields.

use model_core::{SymbolId, SymbolKind, names};

use super::names::names_of_errors;
use super::{Name, known_names};
use crate::candidate::{Effect, EffectId, Setting};
use crate::families::FAMILIES;

/// What a term is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Term {
    /// A declared error.
    Error(SymbolId),
    /// An effect of the catalogue.
    Effect(EffectId),
}

/// Why a name is no term.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoTerm {
    /// Nothing is called so; the nearest name, where one is near.
    Unknown(Option<String>),
    /// Several effects are called so: their names.
    Several(Vec<String>),
}

/// What each of some names means: a declared error before an effect, an own name before that of another field. Of effects that share
/// the name of another field it is the first of those with the fewest functions.
pub fn terms(setting: &Setting<'_>, catalogue: &[Effect], wanted: &[String]) -> Vec<Result<Term, NoTerm>> {
    let of_errors = names_of_errors(setting);
    let of_effects = known_names(setting, catalogue);
    let is_called = |names: &[Name], wanted: &str| {
        names.iter().any(|name| name.name == wanted || name.to_string() == wanted)
    };
    let read = |wanted: &String| {
        let declared = || setting.chain.symbols_of(SymbolKind::Error);
        let own = declared().find(|&id| setting.chain.symbol(id).name == *wanted);
        let theirs = || of_errors.iter().find(|(_, names)| is_called(names, wanted)).map(|(id, _)| *id);
        if let Some(error) = own.or_else(theirs) {
            return Ok(Term::Error(error));
        }
        if let Some(effect) = catalogue.iter().position(|effect| effect.name == *wanted) {
            return Ok(Term::Effect(EffectId(effect)));
        }
        let theirs = (0..catalogue.len()).filter(|&effect| is_called(&of_effects[effect], wanted));
        if let Some(effect) = theirs.min_by_key(|&effect| catalogue[effect].functions.len()) {
            return Ok(Term::Effect(EffectId(effect)));
        }
        let family = (0..catalogue.len()).filter(|&effect| catalogue[effect].family == *wanted);
        match family.collect::<Vec<_>>().as_slice() {
            [one] => Ok(Term::Effect(EffectId(*one))),
            [] => {
                let errors = declared().map(|id| setting.chain.symbol(id).name.as_str());
                let fields = of_errors.iter().map(|(_, names)| names).chain(&of_effects).flatten();
                let all = errors.chain(fields.map(|name| name.name.as_str()));
                let all = all.chain(catalogue.iter().map(|effect| effect.name.as_str()));
                let all = all.chain(FAMILIES.iter().map(|family| family.name));
                Err(NoTerm::Unknown(names::nearest(wanted, all).map(str::to_owned)))
            }
            several => {
                Err(NoTerm::Several(several.iter().map(|effect| catalogue[*effect].name.clone()).collect()))
            }
        }
    };
    wanted.iter().map(read).collect()
}
