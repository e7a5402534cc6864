//! The tables of the page: causes, values, and the details behind folds.

use crate::words::{self, numbers};
use calibration::diagnose::{Cause, Diagnosis, EffectFound, Relation};
use maud::{Markup, html};

use crate::{Reported, diff};

/// Cells of the correlation matrix at most; beyond, only strong correlations are listed.
const MATRIX: usize = 40;

/// Rows of a long list that the page shows.
const LISTED: usize = 200;

/// Effects whose causes are not folded away.
const OPEN: usize = 3;

/// A table that scrolls by itself where it is broad.
fn scrolled(name: &str, table: &Markup) -> Markup {
    html! { div.scroll tabindex="0" role="region" aria-label=(name) { (table) } }
}

/// Every accepted effect, the largest first, with its causes and their checks; small ones folded.
pub fn causes(reported: &Reported<'_>) -> Markup {
    let diagnosis = &reported.calibration.diagnosis;
    let mut effects: Vec<&EffectFound> = diagnosis.effects.iter().collect();
    effects.sort_by(|a, b| b.standing.total_cmp(&a.standing));
    let (first, more) = effects.split_at(effects.len().min(OPEN));
    html! {
        @if !effects.is_empty() {
            section id="causes" {
                h2 { "Possible causes, and how to check them" }
                @for effect in first { (effect_card(effect, diagnosis)) }
                @if !more.is_empty() {
                    details {
                        summary { (more.len()) " smaller" }
                        @for effect in more { (effect_card(effect, diagnosis)) }
                    }
                }
            }
        }
    }
}

/// Causes that look the same and are checked the same way, in the order of the first of each.
fn alike(causes: &[Cause]) -> Vec<Vec<&Cause>> {
    let mut groups: Vec<Vec<&Cause>> = Vec::new();
    for cause in causes {
        match groups.iter_mut().find(|group| group[0].looks == cause.looks && group[0].check == cause.check) {
            Some(group) => group.push(cause),
            None => groups.push(vec![cause]),
        }
    }
    groups
}

fn effect_card(effect: &EffectFound, diagnosis: &Diagnosis) -> Markup {
    let headline = words::headline(effect);
    html! {
        section.card style="margin-top:14px" {
            h3 { (headline) }
            p.quiet { (words::sentence_case(&words::place(effect, diagnosis))) "." }
            @if let Some(alike) = words::look_alike(effect) { p.quiet { (alike) } }
            (scrolled(&format!("Possible causes: {headline}"), &html! {
                table.stack role="table" {
                    thead role="rowgroup" {
                        tr role="row" {
                            th scope="col" role="columnheader" { "cause" }
                            th scope="col" role="columnheader" { "looks like" }
                            th scope="col" role="columnheader" { "check" }
                        }
                    }
                    tbody role="rowgroup" {
                        @for group in alike(&effect.causes) {
                            tr role="row" {
                                th scope="row" role="rowheader" {
                                    @for cause in &group {
                                        div {
                                            (words::sentence_case(&words::cause(cause)))
                                            @if cause.relation == Relation::Competing { span.quiet { " (fits nearly equally)" } }
                                            @if !cause.published.is_empty() { br; span.quiet { (cause.published.join(", ")) } }
                                        }
                                    }
                                }
                                td role="cell" { b.name { "Looks like: " } (group[0].looks) }
                                td role="cell" { b.name { "Check: " } (group[0].check) }
                            }
                        }
                    }
                }
            }))
            details {
                summary { "Formula and statistics" }
                pre tabindex="0" { (effect.text) }
                p { "Names: " (effect.names.join(", ")) "." }
                ul { @for line in words::evidence(effect, diagnosis) { li { (line) } } }
            }
        }
    }
}

/// Errors and combinations with their values.
pub fn values(diagnosis: &Diagnosis) -> Markup {
    let estimates = words::estimates(diagnosis);
    html! {
        section id="values" {
            h2 { "Values" }
            @if diagnosis.verdict.is_usable() {
                (scrolled("Errors with standard uncertainties", &html! {
                    table {
                        thead {
                            tr {
                                th scope="col" { "error or combination" }
                                th.number scope="col" { "estimate ± standard uncertainty" }
                            }
                        }
                        tbody {
                            @for line in &estimates.lines {
                                tr {
                                    th scope="row" { code { (line.what) } @if line.found { span.quiet { " found" } } }
                                    td.number { (line.estimate) }
                                }
                            }
                        }
                    }
                }))
                @for note in &estimates.notes { p { (super::answer::coded(&words::sentence_case(note))) "." } }
            } @else {
                p.caution role="note" { "The fit cannot be used, so no values are shown. Follow the steps above first." }
            }
        }
    }
}

/// Everything else, each behind a fold.
pub fn details(reported: &Reported<'_>) -> Markup {
    let diagnosis = &reported.calibration.diagnosis;
    html! {
        section id="details" {
            h2 { "Details" }
            (amended(reported))
            (super::frozen::frozen(diagnosis))
            (super::budget::budgets(diagnosis))
            (super::contest::contest(diagnosis))
            details { summary { "Noise" } ul { @for line in words::noise(diagnosis) { li { (line) } } } }
            (poses(diagnosis))
            (correlations(diagnosis))
            (leverage(diagnosis))
            (set_aside(diagnosis))
            (not_shown(diagnosis))
            @if let Some(search) = &diagnosis.search {
                details {
                    summary { "How the search was made" }
                    p {
                        "The search compared " (search.candidates) " candidates in " (search.sets) " sets that these data can separate. It used "
                        (search.flips) " sign flips, " (search.folds) " folds and seed " (search.seed) ". The chance of a false alarm is at most "
                        (search.false_alarm) "."
                    }
                }
            }
        }
    }
}

fn amended(reported: &Reported<'_>) -> Markup {
    let difference = diff(reported);
    html! {
        @if !difference.is_empty() {
            details {
                summary { "The declaration, amended" }
                pre tabindex="0" {
                    @for line in difference.lines() {
                        @match line.as_bytes().first() {
                            Some(b'+') => ins { (line) },
                            Some(b'-') => del { (line) },
                            _ => { (line) }
                        }
                        "\n"
                    }
                }
            }
        }
    }
}

fn poses(diagnosis: &Diagnosis) -> Markup {
    html! {
        @for table in words::pose_tables(diagnosis) {
            details {
                summary { "Measure next, " (table.title) }
                @if !table.poses.is_empty() {
                    (scrolled(&table.title, &html! {
                        table {
                            thead { tr { @for joint in &table.joints { th.number scope="col" { (joint) } } } }
                            tbody { @for pose in &table.poses { tr { @for value in pose { td.number { (value) } } } } }
                        }
                    }))
                }
                @for note in &table.notes { p { (words::sentence_case(note)) "." } }
            }
        }
    }
}

fn correlations(diagnosis: &Diagnosis) -> Markup {
    let precision = &diagnosis.precision;
    let names: Vec<&str> = precision.determined.iter().map(|d| d.name.as_str()).collect();
    html! {
        @if names.len() > 1 {
            details {
                summary { "Correlations of the estimates" }
                @if names.len() <= MATRIX {
                    (scrolled("Correlation matrix, in percent", &html! {
                        table.matrix {
                            caption.quiet { "In percent. Bold from 90 on." }
                            thead { tr { td {} @for name in &names { th scope="col" { (name) } } } }
                            tbody {
                                @for (name, row) in names.iter().zip(&precision.correlation_matrix) {
                                    tr {
                                        th scope="row" { (name) }
                                        @for value in row {
                                            td.strong[value.abs() >= 0.9 && value.abs() < 0.999_999_9] { (format!("{:.0}", 100.0 * value).replace('-', "−")) }
                                        }
                                    }
                                }
                            }
                        }
                    }))
                }
                ul {
                    @for (a, b, value) in &precision.correlations {
                        li { (a) " and " (b) ": " (format!("{value:.3}").replace('-', "−")) }
                    }
                }
            }
        }
    }
}

/// Rows that carry more than their share.
fn leverage(diagnosis: &Diagnosis) -> Markup {
    let rows = &diagnosis.precision.leverage;
    html! {
        @if !rows.is_empty() {
            details {
                summary { "Most influential rows (leverage)" }
                p.quiet {
                    "The leverage of a row is at most its number of components. At that limit the estimates follow the row, and its residual \
                     hides a mistake. Check these rows first."
                }
                (scrolled("Most influential rows", &html! {
                    table {
                        thead { tr { th.number scope="col" { "row" } th.number scope="col" { "leverage" } } }
                        tbody { @for (row, leverage) in rows.iter().take(LISTED) { tr { td.number { (row) } td.number { (format!("{leverage:.2}")) } } } }
                    }
                }))
                @if rows.len() > LISTED { p { "The first " (LISTED) " of " (rows.len()) " are shown. All are listed in report.json." } }
            }
        }
    }
}

fn set_aside(diagnosis: &Diagnosis) -> Markup {
    let aside = &diagnosis.observations.set_aside;
    html! {
        @if !aside.is_empty() {
            details {
                summary { (crate::outliers(aside.len())) " excluded" }
                (scrolled("Outliers", &html! {
                    table {
                        thead { tr { th scope="col" { "row" } th scope="col" { "why" } } }
                        tbody { @for aside in aside.iter().take(LISTED) { tr { td { (words::row(aside)) } td { (aside.why) } } } }
                    }
                }))
                @if aside.len() > LISTED { p { "The first " (LISTED) " of " (aside.len()) " are shown. All are listed in report.json." } }
            }
        }
    }
}

fn not_shown(diagnosis: &Diagnosis) -> Markup {
    html! {
        @if !diagnosis.not_shown.is_empty() {
            details {
                summary { "Effects that these data could not show" }
                (scrolled("Effects that could not show", &html! {
                    table {
                        thead { tr { th scope="col" { "effect" } th scope="col" { "cannot show" } th scope="col" { "why" } } }
                        tbody {
                            @for effect in diagnosis.not_shown.iter().take(LISTED) {
                                tr { td { (effect.name) } td { (words::size(effect)) } td { (words::fate(effect)) } }
                            }
                        }
                    }
                }))
                @if diagnosis.noise.expected_rms > 0.0 {
                    p.quiet { "Noise of one row: " (numbers::told(diagnosis.noise.expected_rms, diagnosis.unit)) "." }
                }
            }
        }
    }
}
