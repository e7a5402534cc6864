//! Evaluators of a chain in another language, with every form.

use codegen::{Form, Unit};
use model_core::names::listed;
use model_core::{Chain, ObservableId, SymbolId};

use crate::refusal::Refusal;
use crate::source::{Source, observables};

/// Every form that is written where nobody chooses.
pub const EVERY_FORM: [Form; 5] = [
    Form::ExactValue,
    Form::ExactError,
    Form::FirstOrderError,
    Form::ExactJacobian,
    Form::FirstOrderJacobian,
];

/// The files that the command writes into a folder where the first is called by the chain's name, with every form of some
/// observables, or of all; `values` of errors and constants are written into them.
///
/// # Errors
/// There is no such language or observable, or a form cannot be written.
pub fn files(
    source: &Source,
    chain: &Chain,
    values: &[(SymbolId, f64)],
    language: &str,
    names: &[String],
) -> Result<Vec<codegen::File>, Refusal> {
    let language = language_of(language)?;
    let chosen = observables(chain, names)?;
    let unit = Unit { values, ..Unit::new(chain, &source.text, &chosen, &EVERY_FORM) };
    codegen::generate(&unit, language, &codegen::snake_case(&chain.name)).map_err(Refusal::of)
}

/// A language by its name.
fn language_of(name: &str) -> Result<codegen::Language, Refusal> {
    let names = || codegen::LANGUAGES.iter().map(|&(name, _)| name);
    if let Some(&(_, language)) = codegen::LANGUAGES.iter().find(|&&(known, _)| known == name) {
        return Ok(language);
    }
    let instead = match model_core::names::nearest(name, names()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("write one of {}", listed(names())),
    };
    Err(Refusal::Input(format!("there is no language `{name}`; {instead}")))
}

/// One observable in C that can be loaded, with every form that it has.
///
/// # Errors
/// A form cannot be written.
pub fn loadable(
    source: &Source,
    chain: &Chain,
    observable: ObservableId,
) -> Result<codegen::Loadable, Refusal> {
    let mut forms = EVERY_FORM.to_vec();
    forms.retain(|&form| codegen::derivable(chain.observable(observable), form).is_ok());
    let chosen = [observable];
    // A plain name: that of a chain may hold letters that a file system does not take.
    codegen::generate_loadable(&Unit::new(chain, &source.text, &chosen, &forms), "chain").map_err(Refusal::of)
}
