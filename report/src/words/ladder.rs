//! The ladder of models in words: what each fits, how it predicts held-out rows, and the goal of the study.

use super::numbers::{self, short};
use calibration::diagnose::{Diagnosis, Goal, Ladder, Rung, RungName, WhyNot};
use observe::SiUnit;

/// A model, as the subject of a sentence.
pub(super) fn model(name: RungName) -> &'static str {
    match name {
        RungName::AsDelivered => "the instrument as delivered",
        RungName::Placed => "placing the instrument alone",
        RungName::Zeros => "the simpler model of place and joint zeros",
        RungName::Geometry => "the model of all declared errors",
        RungName::Effects => "the model with effects",
    }
}

/// What marks a line of the table of models.
pub const SIMPLEST: &str =
    "✓ marks the simplest model that no other beats by more than the standard error of the difference.";

/// A line of the table of models.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelLine {
    /// What it fits.
    pub what: &'static str,
    /// How many errors.
    pub errors: String,
    /// RMS on held-out rows, with its standard error.
    pub held_out: String,
    /// Whether it is the simplest that none beats.
    pub is_simplest: bool,
}

/// The models from the instrument as delivered on, each judged on held-out rows.
#[must_use]
pub fn models(ladder: &Ladder) -> Vec<ModelLine> {
    let one = ladder.rungs.iter().map(|rung| ModelLine {
        what: title(rung),
        errors: rung.errors.to_string(),
        held_out: match (rung.held_out_rms_kept, rung.standard_error) {
            (Some(rms), Some(error)) => numbers::estimate(rms, error, ladder.unit),
            (Some(rms), None) => numbers::told(rms, ladder.unit),
            (None, _) => "beyond the measured region".to_owned(),
        },
        is_simplest: rung.name == ladder.simplest,
    });
    one.collect()
}

fn title(rung: &Rung) -> &'static str {
    match rung.name {
        RungName::AsDelivered => "as delivered",
        RungName::Placed => "instrument placed",
        RungName::Zeros => "joint zeros",
        RungName::Geometry => "all declared errors",
        RungName::Effects if rung.adds.len() == 1 => "with the effect",
        RungName::Effects => "with the effects",
    }
}

/// Which models are not in the table, and why.
#[must_use]
pub fn missing_models(ladder: &Ladder) -> Option<String> {
    let own = |why: WhyNot| -> Vec<&str> {
        let of_why = ladder.left_out.iter().filter(|own| own.why == why);
        of_why
            .filter_map(|own| match own.name {
                RungName::Placed => Some("instrument placed"),
                RungName::Zeros => Some("joint zeros"),
                _ => None,
            })
            .collect()
    };
    let mut sentences = Vec::new();
    let nothing = own(WhyNot::AddsNothing);
    if !nothing.is_empty() {
        sentences
            .push(format!("No model of its own: {}. The study fits no such errors.", nothing.join(", ")));
    }
    let failed = own(WhyNot::NotConverged);
    if !failed.is_empty() {
        sentences.push(format!("The fit of {} alone found no minimum.", failed.join(" and of ")));
    }
    (!sentences.is_empty()).then(|| sentences.join(" "))
}

/// A held-out figure, or that it is no size.
pub(super) fn size(rms: f64, unit: SiUnit) -> String {
    if rms.is_finite() { short(rms, unit) } else { "more than the measured region is wide".to_owned() }
}

/// The error from delivery to the effects, on held-out rows: each figure with what it is of.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// `as delivered`, `calibrated`, `with the effect`.
    pub what: &'static str,
    /// RMS, SI.
    pub rms: f64,
}

/// The figures of the first screen; over rows within reach where outliers would hide them.
#[must_use]
pub fn stages(diagnosis: &Diagnosis, without_outliers: bool) -> Vec<Stage> {
    let Some(ladder) = &diagnosis.ladder else { return Vec::new() };
    let figure = |rung: &Rung| if without_outliers { rung.held_out_rms_kept } else { rung.held_out_rms };
    let told = |rung: &Rung| {
        let what = match rung.name {
            RungName::AsDelivered => "as delivered",
            RungName::Effects => title(rung),
            name if name == ladder.written => "calibrated",
            _ => return None,
        };
        Some(Stage { what, rms: figure(rung)? })
    };
    ladder.rungs.iter().filter_map(told).collect()
}

/// Whether the specification is met, in a sentence.
pub(super) fn goal(diagnosis: &Diagnosis) -> Option<String> {
    let Goal { rms, unit, reached, met } = diagnosis.goal?;
    let own = short(rms, unit);
    Some(match reached {
        None => format!("The goal of {own} cannot be judged: no rows were held out."),
        Some(reached) => {
            let is = if met { "met" } else { "not met" };
            // Two figures that look the same would contradict the word between them.
            let reached = match short(reached, unit) {
                same if same == own => numbers::told(reached, unit),
                other => other,
            };
            format!("The goal of {own} is {is}: {reached} on held-out rows.")
        }
    })
}
