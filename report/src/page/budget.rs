//! Uncertainty budgets, behind a fold.

use crate::words::numbers;
use calibration::diagnose::{Budget, BudgetPart, Diagnosis};
use maud::{Markup, html};

/// The budgets; nothing where the study states nothing of the reference.
pub fn budgets(diagnosis: &Diagnosis) -> Markup {
    html! {
        @if !diagnosis.budgets.is_empty() && diagnosis.verdict.is_usable() {
            details id="budgets" {
                summary { "Uncertainty budgets (GUM)" }
                p.quiet {
                    "Type A comes from the scatter of these rows. Type B is stated in the study. Sensitivities are in SI units. "
                    "The expanded uncertainty covers 95 %."
                }
                @for own in &diagnosis.budgets { (budget(own)) }
            }
        }
    }
}

fn budget(own: &Budget) -> Markup {
    let size = |value: f64| numbers::told(value, own.unit);
    html! {
        h3 {
            @if let Some([row, component]) = own.place {
                "Corrected reading of row " (row) ", component " (component) ", whose correction is least certain"
            } @else { code { (own.of) } }
        }
        div.scroll tabindex="0" role="region" aria-label=(format!("Uncertainty budget of {}", own.of)) {
            table {
                thead {
                    tr {
                        th scope="col" { "input" }
                        th scope="col" { "type" }
                        th.number scope="col" { "standard uncertainty" }
                        th.number scope="col" { "sensitivity" }
                        th.number scope="col" { "contribution" }
                        th.number scope="col" { "degrees of freedom" }
                    }
                }
                tbody {
                    @for part in &own.parts {
                        tr {
                            th scope="row" { (part.input) }
                            td { (part.kind) }
                            td.number { (stated(part)) }
                            td.number { (format!("{:.3}", part.sensitivity)) }
                            td.number { (size(part.contribution)) }
                            td.number { (freedom(part.degrees_of_freedom)) }
                        }
                    }
                    tr {
                        th scope="row" { "standard uncertainty" }
                        td {} td {} td {}
                        td.number { (size(own.standard_uncertainty)) }
                        td.number { (freedom(own.effective_degrees_of_freedom)) }
                    }
                    tr {
                        th scope="row" { "expanded, k = " (format!("{:.2}", own.coverage)) }
                        td {} td {} td {}
                        td.number { (size(own.expanded_uncertainty)) }
                        td {}
                    }
                }
            }
        }
    }
}

fn stated(part: &BudgetPart) -> String {
    numbers::told(part.of_input, part.input_unit)
}

fn freedom(known: Option<f64>) -> String {
    known.map_or_else(|| "∞".to_owned(), |freedom| format!("{freedom:.0}"))
}
