//! How much better the residuals become, in sentences.

use super::causes::sentence_case;
use super::ladder::{Stage, stages};
use super::left::remaining;
use super::numbers::{short, times};
use calibration::diagnose::{Diagnosis, Rms, Verdict};
use observe::SiUnit;

/// Outliers hide the other rows where a figure over every row is this many times theirs.
const HIDDEN: f64 = 1.5;

/// How much better, of one unit of residuals after the other.
pub(super) fn better(diagnosis: &Diagnosis) -> String {
    let observed = diagnosis.instrument.observed.first().map_or("residual", |seen| &seen.name);
    let first = of_unit(diagnosis, observed, diagnosis.unit, [diagnosis.before, diagnosis.after]);
    let beside = diagnosis.beside.iter().filter_map(|own| {
        let observed = own.observed.first()?;
        Some(of_unit(diagnosis, observed, own.unit, [own.before, own.after]))
    });
    let mut all: Vec<String> = std::iter::once(first).chain(beside).collect();
    all.extend(diagnosis.every_row.as_ref().and_then(|every| every.validation).map(|left| {
        let [before, after] = [left.before_kept, left.after_kept].map(|rms| short(rms, diagnosis.unit));
        format!(
            "On the {} rows that the search did not use, the error goes from {before} to {after} RMS.",
            left.rows
        )
    }));
    let is_told = diagnosis.verdict.is_usable() && !diagnosis.effects.is_empty();
    all.extend(
        remaining(diagnosis)
            .into_iter()
            .next()
            .filter(|_| is_told)
            .map(|left| format!("{}.", sentence_case(&left))),
    );
    all.join(" ")
}

/// Whether outliers hide what the other held-out rows say.
pub fn hides(after: &Rms) -> bool {
    let is_larger = |(all, kept): (f64, f64)| all > HIDDEN * kept;
    after.held_out_rows > after.held_out_rows_kept
        && after.held_out_rms.zip(after.held_out_rms_kept).is_some_and(is_larger)
}

/// The error of the first observable on held-out rows, from delivery on, beside the noise.
fn by_stages(diagnosis: &Diagnosis, observed: &str, excluding: Option<&String>) -> Option<String> {
    let unit = diagnosis.ladder.as_ref().map(|ladder| ladder.unit)?;
    let own = stages(diagnosis, excluding.is_some());
    let (last, others) =
        own.split_last().filter(|(_, others)| !others.is_empty() && unit == diagnosis.unit)?;
    let told = |stage: &Stage| format!("{} {}", short(stage.rms, unit), stage.what);
    let before: Vec<String> = others.iter().map(told).collect();
    let excluding = excluding.map_or_else(String::new, |own| format!(", {own}"));
    Some(format!(
        "On held-out data{excluding}, the `{observed}` error (RMS) is {} and {}. The noise alone is {}.",
        before.join(", "),
        told(last),
        short(diagnosis.noise.expected_rms, unit)
    ))
}

/// How much better the residuals of an observable are.
fn of_unit(diagnosis: &Diagnosis, observed: &str, unit: SiUnit, [before, after]: [Rms; 2]) -> String {
    let size = |si: f64| format!("{} RMS", short(si, unit));
    if diagnosis.verdict == Verdict::TooFewObservations {
        return "These data are too few to show an improvement.".to_owned();
    }
    if !diagnosis.verdict.is_usable() {
        return before.rms.map_or_else(
            || format!("The fit gives no `{observed}` error."),
            |rms| format!("Nothing improved. The `{observed}` error is {}.", size(rms)),
        );
    }
    let without = after.held_out_rows - after.held_out_rows_kept;
    let excluding = format!("excluding {without} outlier{}", if without == 1 { "" } else { "s" });
    let is_hidden = hides(&after);
    let told =
        (unit == diagnosis.unit).then(|| by_stages(diagnosis, observed, is_hidden.then_some(&excluding)));
    if let Some(told) = told.flatten() {
        return told;
    }
    if diagnosis.effects.is_empty() {
        let (own, held_out, excluding) = match is_hidden {
            true => (after.rms_kept, after.held_out_rms_kept, format!(", {excluding}")),
            false => (after.rms, after.held_out_rms, String::new()),
        };
        let Some(own) = own else { return format!("The fit gives no `{observed}` error.") };
        let held_out = held_out.map_or_else(
            || excluding.clone(),
            |rms| format!(" ({} on held-out data{excluding})", short(rms, unit)),
        );
        return format!("After calibration, the `{observed}` error is {}{held_out}.", size(own));
    }
    let pairs = [
        (
            format!("On held-out data, {excluding}"),
            before.held_out_rms_kept.zip(after.held_out_rms_kept).filter(|_| is_hidden),
        ),
        ("On held-out data".to_owned(), before.held_out_rms.zip(after.held_out_rms)),
        ("On the fitted data".to_owned(), before.rms.zip(after.rms)),
    ];
    let Some((where_, from, to)) =
        pairs.into_iter().find_map(|(where_, pair)| pair.map(|(from, to)| (where_, from, to)))
    else {
        return before.rms.map_or_else(
            || format!("The fit gives no `{observed}` error."),
            |rms| format!("Without the effects, the `{observed}` error is {}.", size(rms)),
        );
    };
    let (goes, by) = match from / to {
        ratio if ratio >= 1.05 => ("falls", format!(" ({} smaller)", times(ratio))),
        ratio if ratio < 1.0 => ("rises", String::new()),
        _ => ("hardly changes,", String::new()),
    };
    format!("{where_}, the `{observed}` error {goes} from {} to {}{by}.", short(from, unit), size(to))
}
