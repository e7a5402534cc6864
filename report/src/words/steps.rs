//! What to do next, step by step.

use super::causes::{cause, sentence_case};
use super::columns::{self, implausible_values, misread};
use super::effects::CHANCE;
use super::places::told_places;
use super::rivals::{Rival, rival};
use super::step::Step;
use crate::shell::shell_word;
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
                "Compare units, signs and order of the columns with the file, and the lengths of the declaration with the instrument. Then \
                 calibrate again."
                    .to_owned(),
            ));
            return steps;
        }
        Verdict::FitFailed if !fits_otherwise(diagnosis) => {
            steps.push(step(
                "Check units, signs and axes",
                "A fit that reaches no minimum has mostly been given a column in another unit, a sign or an axis the other \
                 way round, or starting values far off: compare the study with the file, row by row."
                    .to_owned(),
            ));
            return steps;
        }
        Verdict::TooFewObservations if !fits_otherwise(diagnosis) => {
            let text = match diagnosis.fit.amended {
                Ended::TooFewObservations { parameters, of_objects, .. } => format!(
                    "At least {}{}; or fix errors that are known (`[fit] fix`).",
                    observations_more(missing(diagnosis, parameters + of_objects + WANTED)),
                    if of_objects > 0 { ", of objects and from stations that are there" } else { "" }
                ),
                _ => "Repeat the observations that the effect rests on.".to_owned(),
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
            "Look at the rows that were set aside",
            "They are far off: labels that are swapped, rows of another object or station, a slip. What was estimated rests on the others."
                .to_owned(),
        ));
    }
    if let Some(column) = session_column(diagnosis) {
        steps.push(step(
            "Say which rows belong together",
            format!("Write in the study: `group = {column:?}`. Then calibrate again: the errors and their ± change."),
        ));
    }
    if is_misread(diagnosis) {
        steps.push(step(
            "Do not correct with it yet",
            "The first thing is what the cautions say of the data: a column in another unit, a sign, an axis, a place that is stated \
             wrongly. Errors that were estimated from that are wrong, and so is what was found beside them."
                .to_owned(),
        ));
    } else if let Some(Rival { step: [title, text], .. }) = rival(diagnosis) {
        steps.push(step(title, text.to_owned()));
    } else if is_worse(diagnosis) {
        steps.push(step(
            "Do not correct with it",
            "On data that nobody fitted the effects make it worse. Measure more poses, or allow fewer effects \
             (`[search] effects`)."
                .to_owned(),
        ));
    } else if let Some(more) = is_unconfirmed(diagnosis) {
        steps.push(step("Measure more before you correct with it", more));
    } else if shows_nothing(diagnosis) {
        steps.push(step(
            "There is nothing to correct with",
            "These data show none of the declared errors: what would show them is what `identify` says of the study.".to_owned(),
        ));
    } else {
        steps.push(correct(diagnosis, folder, command));
    }
    let largest = diagnosis.effects.iter().max_by(|a, b| a.standing.total_cmp(&b.standing));
    if let Some(effect) = largest.filter(|_| rival(diagnosis).is_none()) {
        let more = match effect.causes.len() {
            0 | 1 => String::new(),
            2 => " The other cause that fits has a check of its own.".to_owned(),
            count => format!(" The other {} causes that fit have checks of their own.", count - 1),
        };
        steps.push(step(
            "To repair, check the likeliest cause first",
            format!("{}: {}{more}", sentence_case(&cause(&effect.causes[0])), effect.causes[0].check),
        ));
    }
    steps.extend(measure(diagnosis));
    if let Some(offer) = diagnosis.remaining.as_ref().and_then(|left| left.offer.as_ref()) {
        let lines = offer.trim_end().to_owned();
        steps.push(Step {
            title: "To let the declaration have what is left".to_owned(),
            text: "Write this into the study, and calibrate again:".to_owned(),
            command: Some(lines),
        });
    }
    if diagnosis.verdict == Verdict::NoiseExceedsStated {
        steps.push(step(
            "Look at the noise",
            "State a larger noise if it was stated too small; else record what else may move the instrument (temperature, \
             time, direction of motion, load) and name it under `[search] inputs`."
                .to_owned(),
        ));
    }
    steps
}

/// Observations that are missing for so many numbers.
fn missing(diagnosis: &Diagnosis, numbers: usize) -> usize {
    let components = diagnosis.instrument.observed.first().map_or(1, |seen| seen.components.len().max(1));
    let there = diagnosis.observations.used * components;
    numbers.saturating_sub(there).div_ceil(components).max(1)
}

fn observations_more(count: usize) -> String {
    let observations = if count == 1 { "observation" } else { "observations" };
    format!("{count} {observations} more, at poses spread over the joints")
}

/// A column that the study does not name, whose values say which rows belong together.
fn session_column(diagnosis: &Diagnosis) -> Option<&str> {
    diagnosis.cautions.iter().find_map(|caution| match caution {
        Caution::FollowsOrder { column, .. } => column.as_deref(),
        _ => None,
    })
}

/// What to measure where nothing confirms what was estimated: hardly any number is left over, or data that nobody fitted are foretold
/// badly.
pub(super) fn is_unconfirmed(diagnosis: &Diagnosis) -> Option<String> {
    diagnosis.cautions.iter().find_map(|caution| match caution {
        Caution::HardlyMoreNumbers { numbers, unknowns } => Some(format!(
            "{numbers} numbers for {unknowns} unknowns leave too few to judge the noise by: add at least {}.{}",
            observations_more(missing(diagnosis, unknowns + WANTED.max(*unknowns))),
            if diagnosis.fit.rank[0] < diagnosis.fit.rank[1] { " Errors that they show beside these take more." } else { "" }
        )),
        Caution::ForetoldBadly { .. } => Some(
            "Data that nobody fitted are foretold badly, since single rows decide what comes out: add observations at poses spread over \
             the joints, until each error is seen from several."
                .to_owned(),
        ),
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
            "Each cause that fits explains what was observed about as well. With another one place and size of everything may differ: \
             nobody knows those of the objects."
        }
        (false, false, true) if are_unknown => {
            "Each cause explains what was observed the same. With another one place and size of everything may differ: nobody knows those \
             of the objects."
        }
        (true, ..) => "The declared errors were estimated; nothing was added.",
        (false, true, _) => "Where these data lie, the causes that fit make about the same correction.",
        (false, false, true) => "The correction is the same whichever cause it is, where these data lie.",
        (false, false, false) => "The effect is in the amended declaration.",
    };
    let (title, text) = match is_hardly_found_again(diagnosis) {
        true => (
            "Measure more before you correct with it",
            "What was found could be chance, and searches without a part of the rows mostly do not find it again. With twice the rows it \
             will stand out or be gone. If you correct all the same:",
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

/// Poses that would tell causes apart, or that none would.
fn measure(diagnosis: &Diagnosis) -> Vec<Step> {
    let mut steps = Vec::new();
    let telling = diagnosis.separating.iter().filter(|s| !s.poses.is_empty()).count();
    if telling > 0 {
        let poses: usize = diagnosis.separating.iter().map(|separation| separation.poses.len()).sum();
        steps.push(Step {
            title: "To tell the causes apart, measure".to_owned(),
            text: format!(
                "{poses} poses are listed below; they make the causes differ by more than the noise."
            ),
            command: None,
        });
    } else if diagnosis.separating.iter().any(|separation| !separation.never.is_empty()) {
        steps.push(Step {
            title: "More poses will not tell".to_owned(),
            text: "No pose within the ranges sets the causes apart; a check at the instrument does."
                .to_owned(),
            command: None,
        });
    }
    if !diagnosis.next_poses.is_empty() {
        steps.push(Step {
            title: "To make the errors surer, measure".to_owned(),
            text: "The poses that the study asks for are listed below.".to_owned(),
            command: None,
        });
    }
    if !diagnosis.next_places.is_empty() {
        steps.push(Step {
            title: "To make the errors surer, add to the set-up".to_owned(),
            text: format!(
                "Best is {}. What to aim at stands under Measure next.",
                told_places(&diagnosis.next_places[0])
            ),
            command: None,
        });
    }
    steps
}

/// Whether the data show no error, alone or together with others, and no effect.
fn shows_nothing(diagnosis: &Diagnosis) -> bool {
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
                | Caution::DegreesAsRadians { .. }
                | Caution::NotWhereStated { .. }
                | Caution::FitsOtherwise(_)
                | Caution::StationsStrayed(_)
                | Caution::TwoPlaces(_)
        )
    };
    diagnosis.cautions.iter().any(misread)
}

/// Whether a mistake in reading explains the data.
pub(super) fn fits_otherwise(diagnosis: &Diagnosis) -> bool {
    diagnosis.cautions.iter().any(|caution| match caution {
        Caution::FitsOtherwise(_) => true,
        Caution::StationsStrayed(own) => !own.mistakes.is_empty(),
        Caution::TwoPlaces(own) => 2 * own.objects[0] > own.objects[1],
        _ => false,
    })
}

/// Whether all that was found may be chance, and most searches without a part of the rows find none of it.
fn is_hardly_found_again(diagnosis: &Diagnosis) -> bool {
    let is_repeated = diagnosis.search.is_some_and(|search| search.folds > 1);
    let hardly = |effect: &EffectFound| effect.p_value >= CHANCE && effect.selected_in_folds < 0.5;
    is_repeated && !diagnosis.effects.is_empty() && diagnosis.effects.iter().all(hardly)
}

pub(super) fn is_worse(diagnosis: &Diagnosis) -> bool {
    diagnosis.cautions.iter().any(|caution| matches!(caution, Caution::WorseHeldOut { .. }))
}
