//! A calibration as one page for a browser: nothing in it comes from elsewhere; without its script only hover, marking
//! of rows and copying are missing.

mod answer;
mod budget;
mod card;
mod chain;
mod contest;
mod distribution;
mod frozen;
mod map;
mod panels;
mod pictures;
mod rows;
pub mod svg;
mod tables;

use crate::words;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use model_core::escape;

use crate::Reported;
use rows::Rows;

/// The hatching of bars that show what was before.
const HATCH: &str = "<svg width=\"0\" height=\"0\" style=\"position:absolute;width:0\" aria-hidden=\"true\"><defs><pattern id=\"h\" \
                     width=\"5\" height=\"5\" patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate(45)\"><path d=\"M0 0V5\" \
                     style=\"stroke:var(--before);stroke-width:2.4\"/></pattern></defs></svg>";

/// What pages look like.
pub const STYLE: &str = include_str!("style.css");

/// The whole page.
#[must_use]
pub fn page(reported: &Reported<'_>) -> String {
    let diagnosis = &reported.calibration.diagnosis;
    let answers = words::answers(diagnosis, reported.folder, &reported.provenance.command);
    let rows = Rows::of(reported);
    let used = &diagnosis.observations;
    document(
        reported,
        &answers,
        &rows,
        html! {
                header {
                    strong { (reported.calibration.chain.name) }
                    p.quiet {
                        "calibrated " (reported.provenance.date) " · " (used.used) " of " (used.rows) " rows used"
                        @if used.groups > 1 && used.groups < used.used { " · " (used.groups) " groups" }
                    }
                    nav aria-label="Contents" {
                        a href="#answer" { "Answer" }
                        @if !diagnosis.effects.is_empty() { a href="#causes" { "Causes" } }
                        a href="#residuals" { "Residuals" }
                        a href="#left" { "What remains" }
                        a href="#values" { "Values" }
                        a href="#details" { "Details" }
                    }
                }
                main {
                    (answer::first_screen(reported, &answers))
                    (tables::causes(reported))
                    (pictures::residuals(reported, &rows))
                    (pictures::left(reported))
                    (tables::values(diagnosis))
                    (tables::details(reported))
                }
                footer.quiet { (provenance(reported)) }
        },
    )
}

/// The first screen and the pictures, as a page of their own.
#[must_use]
pub fn excerpt(reported: &Reported<'_>) -> String {
    let diagnosis = &reported.calibration.diagnosis;
    let answers = words::answers(diagnosis, reported.folder, &reported.provenance.command);
    let rows = Rows::of(reported);
    document(
        reported,
        &answers,
        &rows,
        html! {
            main {
                (answer::first_screen(reported, &answers))
                (pictures::residuals(reported, &rows))
                (pictures::left(reported))
            }
        },
    )
}

/// A page around what it shows.
fn document(reported: &Reported<'_>, answers: &words::Answers, rows: &Rows, body: Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "Calibration of " (reported.calibration.chain.name) ": " (answers.badge) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                (PreEscaped(HATCH))
                (body)
                script type="application/json" id="rows" { (PreEscaped(rows.json())) }
                script { (PreEscaped(include_str!("script.js"))) }
            }
        }
    };
    // What the page's script reads has no such letter left, and its markup has none of its own.
    escape::page(&page.0).into_owned()
}

/// What it takes to make the page again.
fn provenance(reported: &Reported<'_>) -> Markup {
    let made = &reported.provenance;
    html! {
        section aria-labelledby="made" {
            h2 id="made" { "How this page was made" }
            p { "trueaxis " (made.version) ", " (made.date) ": " code { (made.command) } }
            details {
                summary { "Study and files" }
                div.scroll tabindex="0" role="region" aria-label="Files and checksums" {
                    table {
                        thead { tr { th scope="col" { "file" } th scope="col" { "SHA-256" } } }
                        tbody {
                            @for file in &made.files { tr { td { (file.path) } td { code { (file.sha256.as_deref().unwrap_or("no file")) } } } }
                        }
                    }
                }
                pre tabindex="0" { (made.study) }
            }
        }
    }
}
