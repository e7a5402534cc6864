//! A frozen model in words: its terms, what is held at zero, and what else would gain.

use super::numbers::short;
use calibration::diagnose::{Diagnosis, FrozenModel, OtherTerm, Verdict};

/// The badge of a frozen model, and what happened; `None` where none was given, or its fit cannot be used.
pub(super) fn fitted(diagnosis: &Diagnosis) -> Option<(&'static str, String)> {
    let model = diagnosis.frozen.as_ref()?;
    let badge = match diagnosis.verdict {
        verdict if !verdict.is_usable() => return None,
        Verdict::StructureRemains | Verdict::UnnamedFunction => "Frozen model fitted, more remains",
        _ => "Frozen model fitted",
    };
    let terms = match model.terms.len() {
        1 => "The study's one term was fitted.".to_owned(),
        count => format!("The study's {count} terms were fitted."),
    };
    let gain = match model.others.iter().filter(|own| own.accepted).count() {
        0 => "No other effect would gain.",
        1 => "One other effect would gain, and was not added.",
        _ => "Other effects would gain, and were not added.",
    };
    Some((badge, format!("{terms} {gain}")))
}

/// A line of a table: what, in which words, and a held-out RMS.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Trial {
    /// The term as written, or the effect.
    pub what: String,
    /// What that is.
    pub is: String,
    /// Held-out RMS without the term, or with the effect.
    pub held_out: String,
}

/// The terms, each with the held-out RMS without it.
#[must_use]
pub fn terms(model: &FrozenModel) -> Vec<Trial> {
    let line = |own: &calibration::diagnose::TermFitted| Trial {
        what: own.term.clone(),
        is: match own.term == own.read_as {
            true if own.declared => "declared error".to_owned(),
            true => "effect".to_owned(),
            false => own.read_as.clone(),
        },
        held_out: rms(model, own.held_out_rms_without),
    };
    model.terms.iter().map(line).collect()
}

/// What is no term, the best first, each with the held-out RMS with it.
#[must_use]
pub fn others(model: &FrozenModel) -> Vec<Trial> {
    let line = |own: &OtherTerm| Trial {
        what: called(own),
        is: if own.accepted { "would gain" } else { "no clear gain" }.to_owned(),
        held_out: rms(model, own.held_out_rms_with),
    };
    model.others.iter().map(line).collect()
}

/// `gravity flexure of tube (TPOINT TF)`
fn called(own: &OtherTerm) -> String {
    match own.published.first() {
        Some(name) => format!("{} ({name})", own.effect),
        None => own.effect.clone(),
    }
}

fn rms(model: &FrozenModel, rms: Option<f64>) -> String {
    rms.map_or_else(|| "not measured".to_owned(), |rms| short(rms, model.unit))
}

/// What the figures of both tables are beside: that with all terms.
#[must_use]
pub fn as_it_is(model: &FrozenModel) -> Option<String> {
    let rms = short(model.held_out_rms?, model.unit);
    Some(format!("With exactly these terms, the held-out RMS of {} rows is {rms}.", model.rows))
}

/// Which declared errors are held at zero.
#[must_use]
pub fn held(model: &FrozenModel) -> Option<String> {
    let names: Vec<String> = model.held_at_zero.iter().map(|name| format!("`{name}`")).collect();
    match names.as_slice() {
        [] => None,
        [one] => Some(format!("The declared error {one} is no term and was held at zero.")),
        several => {
            Some(format!("The declared errors {} are no terms and were held at zero.", several.join(", ")))
        }
    }
}

/// Which effects would gain.
#[must_use]
pub fn gains(model: &FrozenModel) -> Option<String> {
    let gains = model.others.iter().filter(|own| own.accepted);
    let told: Vec<String> =
        gains.map(|own| format!("{}, to {}", called(own), rms(model, own.held_out_rms_with))).collect();
    (!told.is_empty()).then(|| format!("Would gain: {}.", told.join("; ")))
}
