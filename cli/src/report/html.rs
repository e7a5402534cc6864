//! A calibration as one page for a browser: nothing in it comes from elsewhere, no script runs.

use calibration::diagnose::Diagnosis;
use calibration::report as words;
use calibration::report::numbers as quantities;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::pictures::{self, Axes};
use super::residuals::{self, Component};
use super::{Reported, diff};

/// How the page looks.
const STYLE: &str = "
body { font: 16px/1.5 system-ui, sans-serif; color: #222; max-width: 76rem; margin: 2rem auto; padding: 0 1.5rem; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.2rem; margin-top: 2.2rem; border-bottom: 1px solid #ddd; }
table { border-collapse: collapse; } th, td { text-align: left; padding: .2rem 1.2rem .2rem 0; vertical-align: top; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
tr + tr td { border-top: 1px solid #eee; } code, pre { font-family: ui-monospace, monospace; font-size: .9em; }
pre { background: #f6f6f4; padding: .8rem 1rem; overflow-x: auto; }
.verdict { font-size: 1.3rem; font-weight: 600; } .quiet { color: #666; } .caution { background: #fdf3d8; padding: .4rem .8rem; }
.pictures { display: flex; flex-wrap: wrap; gap: .5rem; }
ins { background: #e2f3e4; text-decoration: none; } del { background: #fbe4e1; text-decoration: none; }
@media print { body { margin: 0; } section { break-inside: avoid; } }
";

/// The whole page.
#[must_use]
pub fn page(reported: &Reported<'_>) -> String {
    let report = &reported.calibration.diagnosis;
    let name = &reported.calibration.chain.name;
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "Calibration of " (name) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "Calibration of " (name) }
                p.quiet {
                    (reported.provenance.date) ", " (reported.chain_file) ", " (report.observations.used) " of "
                    (report.observations.rows) " observations used"
                }
                section {
                    p.verdict { (words::answers(report, reported.folder).happened) }
                    (before_and_after(report))
                    @for caution in &report.cautions { p.caution { (words::caution(caution, report)) } }
                }
                (effects(report))
                (residual_pictures(reported))
                (remaining(report))
                (errors(report))
                (noise(report))
                (measure_next(reported))
                (set_aside(report))
                (not_shown(report))
                (amended(reported))
            }
        }
    }
    .into_string()
}

fn before_and_after(report: &Diagnosis) -> Markup {
    let told = |si: Option<f64>| si.map_or_else(|| "none".to_owned(), |si| quantities::told(si, report.unit));
    html! {
        table {
            tr { th { "Residual, RMS of its length" } th.number { "before" } th.number { "after" } }
            tr {
                td { "on the data that were fitted" }
                td.number { (told(Some(report.before.rms))) }
                td.number { (told(Some(report.after.rms))) }
            }
            tr {
                td { "on data that nobody fitted" }
                td.number { (told(report.before.held_out_rms)) }
                td.number { (told(report.after.held_out_rms)) }
            }
            @if report.after.held_out_rms_kept != report.after.held_out_rms {
                tr {
                    td { "the same without rows out of reach" }
                    td.number { (told(report.before.held_out_rms_kept)) }
                    td.number { (told(report.after.held_out_rms_kept)) }
                }
            }
        }
    }
}

fn effects(report: &Diagnosis) -> Markup {
    html! {
        @if !report.effects.is_empty() {
            section {
                h2 { "Effects that the declaration lacks" }
                @for effect in &report.effects {
                    h3 { code { (effect.text) } " in body " (effect.body) }
                    p { (effect.names.join(", ")) }
                    ul { @for line in words::evidence(effect, report) { li { (line) } } }
                }
            }
        }
    }
}

fn residual_pictures(reported: &Reported<'_>) -> Markup {
    let components = residuals::components(reported);
    html! {
        section {
            h2 { "Residuals" }
            p.quiet {
                "Measured minus what the fitted declaration says. Structure that follows a reading belongs to an \
                 effect; what is left should scatter evenly around zero."
            }
            div.pictures {
                @for component in &components {
                    @for (name, unit, values) in residuals::readings(reported) {
                        (PreEscaped(over_a_reading(component, name, unit, values)))
                    }
                    (PreEscaped(normal(component)))
                }
            }
        }
    }
}

/// The unit in which a component is drawn.
fn unit_of(component: &Component) -> quantities::Reading {
    let largest =
        component.before.iter().chain(&component.after).flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
    quantities::reading(component.unit, largest)
}

fn over_a_reading(
    component: &Component,
    name: &str,
    unit: calibration::data::SiUnit,
    values: &[f64],
) -> String {
    let drawn = unit_of(component);
    let reading = quantities::reading(unit, values.iter().fold(0.0, |a: f64, b| a.max(b.abs())));
    let points = |residuals: &[Option<f64>]| -> Vec<(f64, f64)> {
        let over = values.iter().zip(residuals);
        over.filter_map(|(&at, &residual)| Some((at / reading.in_si, residual? / drawn.in_si))).collect()
    };
    let axes = Axes {
        title: &format!("{} over {name}", component.name),
        x: &quantities::name_with_unit(name, &reading.name),
        y: &quantities::name_with_unit(component.name, &drawn.name),
    };
    pictures::before_and_after(&axes, &points(&component.before), &points(&component.after))
}

fn normal(component: &Component) -> String {
    let drawn = unit_of(component);
    let numbers = |residuals: &[Option<f64>]| -> Vec<f64> {
        residuals.iter().flatten().map(|residual| residual / drawn.in_si).collect()
    };
    let axes = Axes {
        title: &format!("{} against normal noise", component.name),
        x: "quantile of the normal distribution",
        y: &quantities::name_with_unit(component.name, &drawn.name),
    };
    pictures::normal_quantiles(&axes, &numbers(&component.before), &numbers(&component.after))
}

fn remaining(report: &Diagnosis) -> Markup {
    html! {
        section {
            h2 { "What is left" }
            @for line in words::remaining(report) { p { (line) } }
        }
    }
}

fn errors(report: &Diagnosis) -> Markup {
    html! {
        section {
            h2 { "Errors" }
            table {
                tr { th { "error" } th.number { "estimate ± standard uncertainty" } }
                @for line in words::estimates(report).lines {
                    tr { td { code { (line.what) } } td.number { (line.estimate) } }
                }
            }
            @for line in words::estimates(report).notes { p { (line) } }
        }
    }
}

fn noise(report: &Diagnosis) -> Markup {
    html! {
        section {
            h2 { "Noise" }
            ul { @for line in words::noise(report) { li { (line) } } }
        }
    }
}

fn measure_next(reported: &Reported<'_>) -> Markup {
    let tables = words::pose_tables(&reported.calibration.diagnosis);
    html! {
        @if !tables.is_empty() {
            section {
                h2 { "Where to measure next" }
                @for table in &tables {
                    h3 { (table.title) }
                    @if !table.poses.is_empty() {
                        table {
                            tr { @for joint in &table.joints { th.number { (joint) } } }
                            @for pose in &table.poses { tr { @for value in pose { td.number { (value) } } } }
                        }
                    }
                    @for note in &table.notes { p { (note) } }
                }
            }
        }
    }
}

fn set_aside(report: &Diagnosis) -> Markup {
    html! {
        @if !report.observations.set_aside.is_empty() {
            section {
                h2 { "Observations set aside" }
                table {
                    tr { th.number { "row" } th { "why" } }
                    @for aside in &report.observations.set_aside {
                        tr { td.number { (aside.row) } td { (aside.why) } }
                    }
                }
            }
        }
    }
}

fn not_shown(report: &Diagnosis) -> Markup {
    html! {
        @if !report.not_shown.is_empty() {
            section {
                h2 { "What these data could not have shown" }
                table {
                    tr { th { "effect" } th { "does not show" } th { "what becomes of it" } }
                    @for effect in &report.not_shown {
                        tr {
                            td { (effect.name) }
                            td { (words::size(effect)) }
                            td { (words::fate(effect)) }
                        }
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
            section {
                h2 { "The declaration, amended" }
                pre {
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
