//! A frozen model behind a fold: its terms, and what one less or more does to held-out rows.

use crate::words::frozen::{Trial, as_it_is, gains, held, others, terms};
use calibration::diagnose::Diagnosis;
use maud::{Markup, html};

/// The tables; nothing where the study gives no model.
pub fn frozen(diagnosis: &Diagnosis) -> Markup {
    html! {
        @if let Some(model) = diagnosis.frozen.as_ref().filter(|_| diagnosis.verdict.is_usable()) {
            details id="frozen" {
                summary { "The frozen model, with one term less or more" }
                @for note in [as_it_is(model), held(model), gains(model)].iter().flatten() { p { (note) } }
                (table("Terms", ["term", "read as", "held-out RMS without it"], &terms(model)))
                @let others = others(model);
                @if !others.is_empty() {
                    (table("Other effects", ["effect", "gain", "held-out RMS with it"], &others))
                }
            }
        }
    }
}

fn table(name: &str, [what, is, held_out]: [&str; 3], trials: &[Trial]) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label=(name) {
            table {
                thead { tr { th scope="col" { (what) } th scope="col" { (is) } th.number scope="col" { (held_out) } } }
                tbody {
                    @for own in trials { tr { th scope="row" { (own.what) } td { (own.is) } td.number { (own.held_out) } } }
                }
            }
        }
    }
}
