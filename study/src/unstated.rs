//! Inputs that do not say what they are, while their names sound as if: no family of effects takes them for it.

use std::fmt;

use model_core::{Chain, Meaning, SymbolId, SymbolKind};

/// Words in names, and what they sound like.
const WORDS: &[(&str, Meaning)] = &[
    ("temp", Meaning::Temperature),
    ("temperature", Meaning::Temperature),
    ("celsius", Meaning::Temperature),
    ("kelvin", Meaning::Temperature),
    ("time", Meaning::Time),
    ("elapsed", Meaning::Time),
    ("hours", Meaning::Time),
    ("days", Meaning::Time),
    ("mjd", Meaning::Time),
    ("face", Meaning::Side),
    ("pier", Meaning::Side),
    ("side", Meaning::Side),
    ("direction", Meaning::Direction),
    ("rate", Meaning::Rate),
    ("turns", Meaning::Turns),
    ("phase", Meaning::Phase),
    ("inverse", Meaning::Inverse),
    ("rotator", Meaning::Rotator),
    ("derotator", Meaning::Rotator),
    ("session", Meaning::Session),
    ("night", Meaning::Session),
    ("setup", Meaning::Session),
];

/// An input whose name sounds like a meaning that it does not state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unstated {
    name: String,
    sounds: String,
}

impl fmt::Display for Unstated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, sounds } = self;
        write!(
            f,
            "{name} does not say what it is, and counts as a plain number; if it is one, write meaning = \"{sounds}\" at its \
             column, or `input {name}: {sounds};` in the chain"
        )
    }
}

/// Those among the inputs that effects may use.
pub(super) fn unstated(chain: &Chain, inputs: &[SymbolId]) -> Vec<Unstated> {
    let own = inputs.iter().map(|&id| chain.symbol(id));
    own.filter(|symbol| symbol.kind == SymbolKind::Input && symbol.meaning.is_none())
        .filter_map(|symbol| {
            let meaning = symbol.name.to_lowercase().split('_').find_map(|word| {
                WORDS.iter().find(|(known, _)| *known == word).map(|(_, meaning)| *meaning)
            })?;
            let of = match meaning.subject() {
                Some(model_core::Subject::Joint) => " of JOINT",
                Some(model_core::Subject::Length) => " of RANGE",
                None => "",
            };
            Some(Unstated { name: symbol.name.clone(), sounds: format!("{}{of}", meaning.word()) })
        })
        .collect()
}
