//! What to do next, step by step.

use super::causes::cause;
use super::columns::{self, implausible_values, misread};
use super::effects::CHANCE;
use super::places::told_places;
use super::rivals::{Rival, rival};
use super::step::Step;
use crate::shell::shell_word;
use calibration::design::Separation;
use calibration::diagnose::few::WANTED;
use calibration::diagnose::{Caution, Diagnosis, EffectFound, Ended, Relation, Verdict};

/// What to do next, in order; `command` wrote the files into the folder, or would.
pub(super) fn steps(diagnosis: &Diagnosis, folder: Option<&str>, command: &str) -> Vec<Step> {
    let step = |title: &str, text: String| Step { title: title.to_owned(), text, command: None };
    let mut steps = Vec::new();
    match diagnosis.verdict {
        Verdict::ColumnMisread if let Some(misread) = misread(diagnosis) => return columns::steps(misread),
        Verdict::FitFailed if implausible_values(diagnosis).is_some() => {
            steps.push(step(
                "Do not correct with it",
                "Compare units, signs and order of the columns with the file. Compare the lengths of the declaration with the instrument. \
                 Then calibrate again."
                    .to_owned(),
            ));
            return steps;
        }
        Verdict::FitFailed if !share_labels(diagnosis) => {
            steps.push(step(
                "Check units, signs and axes",
                "Most often a column is in another unit, or a sign or an axis is reversed. Starting values may also be far from the truth. \
                 Compare the study with the file, row by row."
                    .to_owned(),
            ));
            return steps;
        }
        Verdict::TooFewObservations if !share_labels(diagnosis) => {
            let text = match diagnosis.fit.amended {
                Ended::TooFewObservations { parameters, of_objects, .. } => format!(
                    "At least {}{}. Or fix errors that are known (`[fit] fix`).",
                    rows_more(missing(diagnosis, parameters + of_objects + WANTED)),
                    if of_objects > 0 { ", of the same objects and from the same stations" } else { "" }
                ),
                _ => "Repeat the few rows that show the effect.".to_owned(),
            };
            steps.push(step("Measure more", text));
            return steps;
        }
        _ => {}
    }
    if diagnosis
        .cautions
        .iter()
        .any(|caution| matches!(caution, Caution::OutOfPlace { but_for: Some(_), .. }))
    {
        steps.push(step(
            "Check the outliers",
            "Look for swapped labels, rows of another object or station, and slips. The errors were estimated from the other rows."
                .to_owned(),
        ));
    }
    if let Some(column) = session_column(diagnosis) {
        steps.push(step(
            "Name the column of sessions",
            format!("Write in the study: `group = {column:?}`. Then calibrate again. The errors and their ± will change."),
        ));
    }
    if is_misread(diagnosis) {
        steps.push(step(
            "Do not correct with it yet",
            "First check the data as the cautions ask: units, signs, axes and stated places. Until then the estimated errors and the effects \
             are wrong."
                .to_owned(),
        ));
    } else if let Some(Rival { step: [title, text], .. }) = rival(diagnosis) {
        steps.push(step(title, text.to_owned()));
    } else if is_worse(diagnosis) {
        steps.push(step(
            "Do not correct with it",
            "The effects increase the error on held-out data. Measure more poses, or allow fewer effects (`[search] effects`)."
                .to_owned(),
        ));
    } else if let Some(more) = is_unconfirmed(diagnosis) {
        steps.push(step("Measure more before you correct with it", more));
    } else if shows_nothing(diagnosis) {
        steps.push(step(
            "There is nothing to correct with",
            "These data contain none of the declared errors. Run `trueaxis identify` on the study to see what would show them.".to_owned(),
        ));
    } else {
        steps.push(correct(diagnosis, folder, command));
    }
    let largest = diagnosis.effects.iter().max_by(|a, b| a.standing.total_cmp(&b.standing));
    if let Some(effect) = largest.filter(|_| rival(diagnosis).is_none()) {
        let more = match effect.causes.len() {
            0 | 1 => String::new(),
            2 => " Then check the other cause.".to_owned(),
            count => format!(" Then check the other {} causes.", count - 1),
        };
        steps.push(step(
            "To repair, inspect the instrument for the likeliest cause first",
            format!("Likeliest: {}. {}{more}", cause(&effect.causes[0]), effect.causes[0].check),
        ));
    }
    steps.extend(hold(diagnosis));
    steps.extend(measure(diagnosis));
    if let Some(offer) = diagnosis.remaining.as_ref().and_then(|left| left.offer.as_ref()) {
        let lines = offer.trim_end().to_owned();
        steps.push(Step {
            title: "To add the remaining error to the model".to_owned(),
            text: "Write these lines into the study, then calibrate again:".to_owned(),
            command: Some(lines),
        });
    }
    if diagnosis.verdict == Verdict::NoiseExceedsStated {
        steps.push(step(
            "Check the stated noise",
            "State a larger noise if yours was too small. Otherwise record temperature, time, direction of motion or load, and name \
             these columns under `[search] inputs`."
                .to_owned(),
        ));
    }
    steps
}

/// Rows that are missing to determine some numbers.
fn missing(diagnosis: &Diagnosis, numbers: usize) -> usize {
    let components = diagnosis.instrument.observed.first().map_or(1, |seen| seen.components.len().max(1));
    let there = diagnosis.observations.used * components;
    numbers.saturating_sub(there).div_ceil(components).max(1)
}

fn rows_more(count: usize) -> String {
    let rows = if count == 1 { "row" } else { "rows" };
    format!("{count} more {rows}, at poses spread over the joints")
}

/// A column that the study does not name, whose values show which rows belong together.
fn session_column(diagnosis: &Diagnosis) -> Option<&str> {
    diagnosis.cautions.iter().find_map(|caution| match caution {
        Caution::FollowsOrder { column, .. } => column.as_deref(),
        _ => None,
    })
}

/// What to measure where nothing confirms what was estimated: hardly any number is left to check with, or held-out data are predicted
/// badly.
pub(super) fn is_unconfirmed(diagnosis: &Diagnosis) -> Option<String> {
    diagnosis.cautions.iter().find_map(|caution| match caution {
        Caution::HardlyMoreNumbers { unknowns, .. } => Some(format!(
            "Add at least {}.{}",
            rows_more(missing(diagnosis, unknowns + WANTED.max(*unknowns))),
            if diagnosis.fit.rank[0] < diagnosis.fit.rank[1] {
                " The errors that these data do not show need further rows."
            } else {
                ""
            }
        )),
        Caution::ForetoldBadly { .. } => {
            Some("Add rows at poses spread over the joints, until several rows show each error.".to_owned())
        }
        _ => None,
    })
}

fn correct(diagnosis: &Diagnosis, folder: Option<&str>, command: &str) -> Step {
    let competing = diagnosis
        .effects
        .iter()
        .flat_map(|effect| &effect.causes)
        .any(|cause| cause.relation == Relation::Competing);
    let several = diagnosis.effects.iter().any(|effect| effect.causes.len() > 1);
    let are_unknown = diagnosis.observations.unknown_objects.is_some();
    let text = match (diagnosis.effects.is_empty(), competing, several) {
        (false, true, _) if are_unknown => {
            "Each possible cause explains the observations nearly equally. With another cause, place and size of everything may differ, \
             because the objects were not surveyed."
        }
        (false, false, true) if are_unknown => {
            "Each possible cause explains the observations equally. With another cause, place and size of everything may differ, because \
             the objects were not surveyed."
        }
        (true, ..) => "The declared errors were estimated. Nothing was added.",
        (false, true, _) => "Within the measured range, all these causes give nearly the same correction.",
        (false, false, true) => "Within the measured range, all these causes give the same correction.",
        (false, false, false) => "The amended declaration contains the effect.",
    };
    let (title, text) = match is_hardly_repeated(diagnosis) {
        true => (
            "Measure more before you correct with it",
            "The effect could be chance, and fewer than half of the repeated searches found it. Twice as many rows will decide. To correct \
             anyway:",
        ),
        false => ("Correct with it now", text),
    };
    let apply = |folder: &str| {
        let instrument = format!("{}/instrument.toml", folder.trim_end_matches('/'));
        format!("trueaxis apply {} --data new.csv --out corrected.csv", shell_word(&instrument))
    };
    let command = match (folder, calibrate(command)) {
        (Some(folder), _) => apply(folder),
        (None, Some(written)) => format!("{written} --out result\n{}", apply("result")),
        (None, None) => apply("DIR"),
    };
    Step { title: title.to_owned(), text: text.to_owned(), command: Some(command) }
}

/// The command that calibrates, from the command line of a run that wrote nothing; `None` where a program asked for it.
fn calibrate(command: &str) -> Option<String> {
    let (_, arguments) = command.split_once(' ')?;
    arguments.starts_with("calibrate ").then(|| format!("trueaxis {arguments}"))
}

/// The lines that hold errors at zero, where a simpler model predicts as well.
fn hold(diagnosis: &Diagnosis) -> Option<Step> {
    let spared = diagnosis.cautions.iter().find_map(|caution| match caution {
        Caution::SimplerPredictsBetter { spared, written: false, .. } => Some(spared),
        _ => None,
    })?;
    let held: Vec<String> = spared.iter().map(|name| format!("{name} = 0")).collect();
    Some(Step {
        title: "To use the simpler model".to_owned(),
        text: "Write this line under `[fit]` in the study, then calibrate again:".to_owned(),
        command: Some(format!("fix = {{ {} }}", held.join(", "))),
    })
}

/// Poses that would separate causes, or that none would.
fn measure(diagnosis: &Diagnosis) -> Vec<Step> {
    let mut steps = Vec::new();
    let separating = diagnosis.separating.iter().filter(|s| !s.poses.is_empty()).count();
    if separating > 0 {
        let poses: usize = diagnosis.separating.iter().map(|separation| separation.poses.len()).sum();
        steps.push(Step {
            title: "To separate the causes, measure".to_owned(),
            text: format!(
                "Measure the {poses} poses listed below. There the causes differ by more than the noise."
            ),
            command: None,
        });
    }
    if let Some(text) = inspections(diagnosis) {
        let title = match separating {
            0 => "More measurements cannot separate these causes",
            _ => "More measurements cannot separate the other causes",
        };
        steps.push(Step { title: title.to_owned(), text, command: None });
    }
    if !diagnosis.next_poses.is_empty() {
        steps.push(Step {
            title: "To reduce the uncertainties, measure".to_owned(),
            text: "Measure the poses listed below.".to_owned(),
            command: None,
        });
    }
    if !diagnosis.next_places.is_empty() {
        steps.push(Step {
            title: "To reduce the uncertainties, add to the set-up".to_owned(),
            text: format!(
                "Best is {}. The pointings are listed under Measure next.",
                told_places(&diagnosis.next_places[0])
            ),
            command: None,
        });
    }
    steps
}

/// Inspections that a step names.
const INSPECTIONS: usize = 3;

/// The inspections that separate causes which no pose within the ranges does, the likeliest first, each once.
fn inspections(diagnosis: &Diagnosis) -> Option<String> {
    let apart: Vec<&Separation> =
        diagnosis.separating.iter().filter(|separation| !separation.never.is_empty()).collect();
    let is_meant = |name: &String| apart.iter().any(|own| *name == own.effect || own.never.contains(name));
    let mut told = vec!["Inspect the instrument for each cause."];
    for cause in diagnosis.effects.iter().flat_map(|effect| &effect.causes) {
        let is_new = !cause.check.is_empty() && !told.contains(&cause.check);
        if is_meant(&cause.name) && is_new && told.len() <= INSPECTIONS {
            told.push(cause.check);
        }
    }
    (!apart.is_empty()).then(|| told.join(" "))
}

/// Whether the data show no error, alone or together with others, and no effect.
pub(super) fn shows_nothing(diagnosis: &Diagnosis) -> bool {
    diagnosis.effects.is_empty()
        && !diagnosis.errors.is_empty()
        && diagnosis.errors.iter().all(|error| !error.shown)
}

/// Whether data were likely read in a wrong unit, with a wrong sign or along another axis.
pub(super) fn is_misread(diagnosis: &Diagnosis) -> bool {
    let misread = |caution: &Caution| {
        matches!(
            caution,
            Caution::OutOfPlace { but_for: None, .. }
                | Caution::NotWhereStated { .. }
                | Caution::StationsStrayed(_)
                | Caution::TwoPlaces(_)
        )
    };
    diagnosis.cautions.iter().any(misread)
}

/// Whether most objects are at two places: two of them share a label.
pub(super) fn share_labels(diagnosis: &Diagnosis) -> bool {
    diagnosis.cautions.iter().any(|caution| match caution {
        Caution::TwoPlaces(own) => 2 * own.objects[0] > own.objects[1],
        _ => false,
    })
}

/// Whether every effect may be chance, and most searches without a part of the rows do not find it.
pub(super) fn is_hardly_repeated(diagnosis: &Diagnosis) -> bool {
    let is_repeated = diagnosis.search.is_some_and(|search| search.folds > 1);
    let hardly = |effect: &EffectFound| effect.p_value >= CHANCE && effect.selected_in_folds < 0.5;
    is_repeated && !diagnosis.effects.is_empty() && diagnosis.effects.iter().all(hardly)
}

pub(super) fn is_worse(diagnosis: &Diagnosis) -> bool {
    diagnosis.cautions.iter().any(|caution| matches!(caution, Caution::WorseHeldOut { .. }))
}
