//! Evaluators of a chain in another language, with every form.

use codegen::{Calibrated, Covariance, Form, Unit};
use model_core::names::listed;
use model_core::{Chain, ObservableId};

use crate::apply::region;
use crate::instrument::Instrument;
use crate::refusal::Refusal;
use crate::source::{Source, observables};

/// Every form that is written where nobody chooses.
const EVERY_FORM: [Form; 5] = [
    Form::ExactValue,
    Form::ExactError,
    Form::FirstOrderError,
    Form::ExactJacobian,
    Form::FirstOrderJacobian,
];

/// The files that the command writes into a folder where the first is called by the chain's name, with every form of some
/// observables, or of all.
///
/// # Errors
/// There is no such language or observable, or a form cannot be written.
pub fn files(
    source: &Source,
    chain: &Chain,
    language: &str,
    names: &[String],
) -> Result<Vec<codegen::File>, Refusal> {
    let language = language_of(language)?;
    let chosen = observables(chain, names)?;
    let unit = Unit::new(chain, &source.text, &chosen, &EVERY_FORM);
    codegen::generate(&unit, language, &codegen::snake_case(&chain.name)).map_err(Refusal::of)
}

/// The same of an instrument, with its errors and constants written into them, and how sure they are where the file says it.
///
/// # Errors
/// There is no such language, or a form cannot be written.
pub fn files_of_instrument(instrument: &Instrument, language: &str) -> Result<Vec<codegen::File>, Refusal> {
    let language = language_of(language)?;
    let chain = &instrument.chain;
    let chosen = observables(chain, &[])?;
    let (covariance, region) = (instrument.covariance.as_ref(), region(instrument, &chosen)?);
    let forms = forms_of(chain, &chosen, covariance.is_some());
    let calibrated = Calibrated {
        covariance: covariance.map(|known| Covariance { of: &known.of, rows: &known.rows }),
        region: &region,
        valid_until: instrument.valid_until.as_deref(),
    };
    let unit = Unit {
        values: &instrument.named,
        calibrated,
        ..Unit::new(chain, &instrument.declaration.text, &chosen, &forms)
    };
    codegen::generate(&unit, language, &codegen::snake_case(&chain.name)).map_err(Refusal::of)
}

/// Every form that is written where nobody chooses; with uncertainties, if they are known and every observable has derivatives.
#[must_use]
pub fn forms_of(chain: &Chain, chosen: &[ObservableId], is_uncertain: bool) -> Vec<Form> {
    let has_derivatives =
        || chosen.iter().all(|&id| codegen::derivable(chain.observable(id), Form::Uncertainty).is_ok());
    let more = (is_uncertain && has_derivatives()).then_some(Form::Uncertainty);
    EVERY_FORM.into_iter().chain(more).collect()
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
