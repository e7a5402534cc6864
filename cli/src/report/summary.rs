//! A calibration for the terminal: verdict, effects, errors, before and after.

use std::fmt::Write as _;

use calibration::report::{EffectFound, Report, Verdict};
use similar::TextDiff;

use super::{Reported, hidden, next, quantities};
use crate::terminal::{CAREFUL, GOOD, HEADING};

/// Lines of a list that the terminal shows.
const NOT_SHOWN: usize = 5;

/// The whole summary.
#[must_use]
pub fn as_text(reported: &Reported<'_>) -> String {
    let report = &reported.calibration.report;
    let mut text = String::new();
    let style = match report.verdict {
        Verdict::Explained | Verdict::UpToAClass => GOOD,
        _ => CAREFUL,
    };
    let _ = writeln!(text, "{HEADING}verdict:{HEADING:#} {style}{}{style:#}", report.verdict.words());
    let _ = writeln!(text, "{}\n", what_it_means(report));
    for line in cautions(report) {
        let _ = writeln!(text, "{CAREFUL}caution:{CAREFUL:#} {line}\n");
    }
    effects(&mut text, report);
    before_and_after(&mut text, report);
    errors(&mut text, report);
    noise(&mut text, report);
    measure_next(&mut text, reported);
    remarks(&mut text, report);
    if !report.effects.is_empty() {
        let _ =
            writeln!(text, "\n{HEADING}the declaration, amended{HEADING:#}\n{}", diff(reported).trim_end());
    }
    text
}

/// The difference between the declaration and the amended one, as a unified diff; empty if there is none.
#[must_use]
pub fn diff(reported: &Reported<'_>) -> String {
    let file = reported.chain_file;
    TextDiff::from_lines(reported.chain_text, reported.calibration.amended.as_str())
        .unified_diff()
        .context_radius(2)
        .header(file, &format!("{file} (amended)"))
        .to_string()
}

/// A verdict in a sentence.
#[must_use]
pub fn what_it_means(report: &Report) -> &'static str {
    match report.verdict {
        Verdict::Explained => {
            "The effects below explain what the declaration left over; nothing else stands out."
        }
        Verdict::UpToAClass => {
            "The effects below explain what the declaration left over, but these data cannot tell some of them from \
             others: read each with its class and its rivals."
        }
        Verdict::StructureRemains => {
            "Structure remains in the residual that no effect of the catalogue explains."
        }
        Verdict::NothingDetectable => "No effect that the declaration lacks stands out from the noise.",
        Verdict::FewObservations => {
            "An effect rests on fewer than five observations: measure more there first."
        }
    }
}

fn effects(text: &mut String, report: &Report) {
    if report.effects.is_empty() {
        return;
    }
    let _ = writeln!(text, "{HEADING}effects that the declaration lacks{HEADING:#}");
    for (number, effect) in (1..).zip(&report.effects) {
        let _ = writeln!(
            text,
            "  {number}. {} in body {}: {}",
            effect.text,
            effect.body,
            effect.names.join(", ")
        );
        for line in evidence(effect, report) {
            let _ = writeln!(text, "     {line}");
        }
    }
    text.push('\n');
}

/// What speaks for an effect, and what cannot be told from it.
#[must_use]
pub fn evidence(effect: &EffectFound, report: &Report) -> Vec<String> {
    let mut lines = Vec::new();
    for (name, value) in &effect.coefficients {
        let found = report.errors.iter().find(|error| error.name == *name);
        let told = found.map_or_else(
            || format!("{value:?}"),
            |error| quantities::estimate(error.value, error.standard_uncertainty, error.unit),
        );
        lines.push(format!("{name} = {told}"));
    }
    lines.push(format!(
        "chance of as much from noise, with every candidate tried: {}; found in {:.0} % of the folds",
        quantities::chance(effect.p_value),
        100.0 * effect.selected_in_folds
    ));
    lines.extend(hidden::bias(effect, report));
    if !effect.class.is_empty() {
        lines.push(format!("these data cannot tell it from: {}", effect.class.join("; ")));
    }
    if !effect.rivals.is_empty() {
        lines.push(format!("explains these data about as well: {}", effect.rivals.join("; ")));
    }
    lines
}

fn before_and_after(text: &mut String, report: &Report) {
    let told = |si: Option<f64>| si.map_or_else(|| "none".to_owned(), |si| quantities::told(si, report.unit));
    let row = |text: &mut String, name: &str, before: Option<f64>, after: Option<f64>| {
        let _ = writeln!(text, "  {name:30} {:>14} {:>14}", told(before), told(after));
    };
    let _ = writeln!(
        text,
        "{HEADING}{:32} {:>14} {:>14}{HEADING:#}",
        "residual, RMS of its length", "before", "after"
    );
    row(text, "on the data that were fitted", Some(report.before.rms), Some(report.after.rms));
    row(text, "on data that nobody fitted", report.before.held_out_rms, report.after.held_out_rms);
    if report.after.held_out_rms_of_all != report.after.held_out_rms {
        let (before, after) = (report.before.held_out_rms_of_all, report.after.held_out_rms_of_all);
        row(text, "  with the outliers there", before, after);
    }
}

fn errors(text: &mut String, report: &Report) {
    let width = report.errors.iter().map(|error| error.name.len()).max().unwrap_or_default();
    let _ = writeln!(text, "\n{HEADING}errors{HEADING:#}");
    for error in report.errors.iter().filter(|error| error.separable) {
        let told = quantities::estimate(error.value, error.standard_uncertainty, error.unit);
        let _ = writeln!(text, "  {:width$}  {told}", error.name);
    }
    for line in not_separable(report) {
        let _ = writeln!(text, "  {line}");
    }
}

/// The effects that these data could not have shown: first those that would show if they were large enough.
fn not_shown(text: &mut String, report: &Report) {
    let mut hidden: Vec<_> = report.not_shown.iter().filter(|effect| effect.absorbed > 0.0).collect();
    if hidden.is_empty() {
        return;
    }
    hidden.sort_by_key(|effect| effect.smallest.is_none());
    let _ = writeln!(text, "\n{HEADING}what these data could not have shown{HEADING:#}");
    for effect in hidden.iter().take(NOT_SHOWN) {
        let _ = writeln!(text, "  {} {}: {}", effect.name, hidden::size(effect), hidden::fate(effect));
    }
    if hidden.len() > NOT_SHOWN {
        let _ = writeln!(text, "  and {} more; report.json lists all", hidden.len() - NOT_SHOWN);
    }
}

/// What these data do not determine, a line for each set of errors that only combinations of are, and one for
/// all that they do not show.
#[must_use]
pub fn not_separable(report: &Report) -> Vec<String> {
    let (alone, together): (Vec<&Vec<String>>, Vec<&Vec<String>>) =
        report.not_separable.iter().partition(|list| list.len() == 1);
    let mut lines: Vec<String> = together
        .iter()
        .map(|list| format!("these data determine only combinations of {}", list.join(", ")))
        .collect();
    if !alone.is_empty() {
        lines.push(format!(
            "these data do not show {}",
            alone.into_iter().flatten().map(String::as_str).collect::<Vec<_>>().join(", ")
        ));
    }
    lines
}

/// What casts doubt on the whole: a fit that did not end well, data that look misread.
#[must_use]
pub fn cautions(report: &Report) -> Vec<String> {
    let precision = &report.precision;
    let ended =
        (!precision.outcome.starts_with("converged")).then(|| format!("the fit {}", precision.outcome));
    ended.into_iter().chain(precision.hints.iter().cloned()).collect()
}

fn noise(text: &mut String, report: &Report) {
    let _ = writeln!(text, "\n{HEADING}noise{HEADING:#}");
    for line in &report.precision.noise {
        let _ = writeln!(text, "  {line}");
    }
}

fn measure_next(text: &mut String, reported: &Reported<'_>) {
    for table in next::tables(reported) {
        let _ = writeln!(text, "\n{HEADING}measure next{HEADING:#}, {}", table.title);
        if !table.poses.is_empty() {
            let line = |cells: &[String]| cells.iter().map(|cell| format!("{cell:>16}")).collect::<String>();
            let _ = writeln!(text, "{}", line(&table.joints));
            for pose in &table.poses {
                let _ = writeln!(text, "{}", line(pose));
            }
        }
        for note in &table.notes {
            let _ = writeln!(text, "  {note}");
        }
    }
}

fn remarks(text: &mut String, report: &Report) {
    let used = &report.observations;
    if !used.set_aside.is_empty() {
        let _ = writeln!(
            text,
            "\n{HEADING}{} of {} observations set aside{HEADING:#}",
            used.set_aside.len(),
            used.rows
        );
        for aside in used.set_aside.iter().take(NOT_SHOWN) {
            let _ = writeln!(text, "  row {}: {}", aside.row, aside.why);
        }
        if used.set_aside.len() > NOT_SHOWN {
            let _ = writeln!(text, "  and {} more; report.json lists all", used.set_aside.len() - NOT_SHOWN);
        }
    }
    not_shown(text, report);
    let chance = quantities::chance(report.remaining.p_value);
    let sampled = quantities::sampled(report.remaining.rows, used.rows);
    if let Some(place) = &report.remaining.place {
        let _ = writeln!(
            text,
            "\n{HEADING}what is left{HEADING:#} sits in body {}, {}, driven by {}: a {} fits better than the catalogue \
             (chance from noise of what the catalogue leaves{sampled}: {chance})",
            place.body, place.dof, place.driver, place.form
        );
        if let Some(offer) = &report.remaining.offer {
            let _ = writeln!(
                text,
                "  to let the declaration have it, write into the study and calibrate again:\n"
            );
            offer.lines().for_each(|line| {
                let _ = writeln!(text, "    {line}");
            });
        }
    } else if report.verdict == Verdict::StructureRemains {
        let looked = report.remaining.looked.iter();
        if let Some(most) = looked.min_by(|a, b| a.p_value.total_cmp(&b.p_value)) {
            let _ = writeln!(
                text,
                "\n{HEADING}what is left{HEADING:#} has structure that no function at one place explains (chance from \
                 noise{sampled}: {chance}), most of all: {}",
                most.at
            );
        }
    }
}
