//! The five answers that stand first: what happened, what it is, where, how much better, what to do next.

use super::causes::{each_once, sentence_case};
use super::columns::{self, implausible_values, misread};
use super::effects::{chance_of_all, headline, place};
use super::left::{function_form, remaining};
use super::numbers::{short, times};
use super::rivals::rival;
use super::step::Step;
use super::steps::{fits_otherwise, is_misread, is_unconfirmed, is_worse, steps};
use calibration::diagnose::{Caution, Diagnosis, EffectFound, Ended, EveryRow, Rms, Verdict};
use observe::SiUnit;

/// Rows far out hide what became of the others where a figure over every row is so many times theirs.
const HIDDEN: f64 = 1.5;

/// How good the news is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// Found, or nothing to find.
    Good,
    /// Found, but more than one cause fits.
    Ambiguous,
    /// Something is left to do before this can be relied on.
    Careful,
    /// Nothing here can be used.
    Bad,
}

/// The answers.
#[derive(Debug, Clone, PartialEq)]
pub struct Answers {
    /// How good the news is.
    pub tone: Tone,
    /// What happened, in a word or two: `Cause found`.
    pub badge: String,
    /// What happened, in a sentence.
    pub happened: String,
    /// How sure it is; absent where nothing was found.
    pub chance: Option<String>,
    /// What it is, in a sentence for each effect, the largest first.
    pub what: Vec<String>,
    /// The causes that fit, of all effects, each once.
    pub causes: Vec<String>,
    /// Where, one for each effect.
    pub places: Vec<String>,
    /// How much better, in a sentence.
    pub better: String,
    /// What to do next, in order.
    pub next: Vec<Step>,
}

/// The answers to a diagnosis; `folder` is where its files are, if they were written, and `command` how it was asked for.
#[must_use]
pub fn answers(diagnosis: &Diagnosis, folder: Option<&str>, command: &str) -> Answers {
    // Where something else explains a cause better, none beside it is an answer either: all were found without that.
    let rival = rival(diagnosis);
    let are_beaten = rival.as_ref().is_some_and(|rival| !rival.instead_of.is_empty());
    let mut effects: Vec<&EffectFound> = diagnosis.effects.iter().filter(|_| !are_beaten).collect();
    let is_answered_otherwise = effects.is_empty() && rival.is_some();
    effects.sort_by(|a, b| b.standing.total_cmp(&a.standing));
    let mut causes = each_once(effects.iter().flat_map(|effect| &effect.causes));
    if let Some((one, of)) = one_for_several(diagnosis).filter(|_| !are_beaten) {
        let of = if of == effects.len() { "all".to_owned() } else { of.to_string() };
        causes.insert(0, format!("{one}, in place of {of} of them"));
    }
    let usable = diagnosis.verdict.is_usable();
    let what = match (usable && !is_answered_otherwise, &diagnosis.remaining) {
        (false, _) => Vec::new(),
        (true, Some(left)) if effects.is_empty() => left
            .place
            .iter()
            .map(|place| {
                format!(
                    "The body {} moves in {} as {} changes: a {}.",
                    place.body,
                    place.dof,
                    place.driver,
                    function_form(&place.form)
                )
            })
            .collect(),
        (true, _) => effects.iter().map(|effect| headline(effect)).collect(),
    };
    Answers {
        tone: tone(diagnosis),
        badge: badge(diagnosis),
        happened: [Some(happened(diagnosis)), elsewhere(diagnosis), searched(diagnosis)]
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
            .join(" "),
        chance: if usable { chance_of_all(&effects, diagnosis) } else { None },
        what,
        causes,
        places: effects.iter().map(|effect| place(effect, diagnosis)).collect(),
        better: better(diagnosis),
        next: steps(diagnosis, folder, command),
    }
}

/// Where not to correct with it.
fn elsewhere(diagnosis: &Diagnosis) -> Option<String> {
    is_worse_elsewhere(diagnosis).then(|| {
        "Where these data do not lie the effects make it worse: correct only where they do.".to_owned()
    })
}

/// How many rows were searched, where not all were.
fn searched(diagnosis: &Diagnosis) -> Option<String> {
    let EveryRow { rows, files, converged, .. } = diagnosis.every_row.as_ref()?;
    let files = if *files > 1 { format!(", drawn from {files} files") } else { String::new() };
    let errors = if *converged { "; the errors are from every row" } else { "" };
    Some(format!("The search read {} of {rows} rows{files}{errors}.", diagnosis.observations.rows))
}

fn is_worse_elsewhere(diagnosis: &Diagnosis) -> bool {
    diagnosis.cautions.iter().any(|caution| matches!(caution, Caution::WorseElsewhere { .. }))
}

fn tone(diagnosis: &Diagnosis) -> Tone {
    match diagnosis.verdict {
        Verdict::FitFailed | Verdict::ColumnMisread | Verdict::TooFewObservations => Tone::Bad,
        _ if is_worse(diagnosis) => Tone::Bad,
        _ if is_misread(diagnosis)
            || is_worse_elsewhere(diagnosis)
            || rival(diagnosis).is_some()
            || is_unconfirmed(diagnosis).is_some() =>
        {
            Tone::Careful
        }
        Verdict::Explained | Verdict::NothingDetectable => Tone::Good,
        Verdict::Confounded | Verdict::FormNotDetermined => Tone::Ambiguous,
        Verdict::UnnamedFunction | Verdict::StructureRemains | Verdict::NoiseExceedsStated => Tone::Careful,
    }
}

fn badge(diagnosis: &Diagnosis) -> String {
    let count = diagnosis.effects.len();
    match diagnosis.verdict {
        Verdict::ColumnMisread if misread(diagnosis).is_some() => "A column is misread".to_owned(),
        _ if fits_otherwise(diagnosis) => "Likely read wrongly".to_owned(),
        _ if let Some(rival) = rival(diagnosis) => rival.badge.to_owned(),
        _ if is_worse(diagnosis) => "Worse on data that nobody fitted".to_owned(),
        Verdict::Explained if count > 1 => format!("{count} causes found"),
        Verdict::Confounded if count > 1 => format!("{count} effects found"),
        Verdict::Explained | Verdict::Confounded => "Cause found".to_owned(),
        Verdict::FormNotDetermined => "Place found, form open".to_owned(),
        Verdict::UnnamedFunction => "Place found, cause unknown".to_owned(),
        Verdict::StructureRemains => "Something is left".to_owned(),
        Verdict::NoiseExceedsStated => "Noisier than stated".to_owned(),
        Verdict::NothingDetectable if is_unconfirmed(diagnosis).is_some() => "Not confirmed".to_owned(),
        Verdict::NothingDetectable => "Nothing missing found".to_owned(),
        Verdict::TooFewObservations => "Too few observations".to_owned(),
        Verdict::ColumnMisread => "A column is misread".to_owned(),
        Verdict::FitFailed if implausible_values(diagnosis).is_some() => "Model or column wrong".to_owned(),
        Verdict::FitFailed => "The fit failed".to_owned(),
    }
}

/// What explains the data about as well as several effects that were accepted, and of how many it would take the place; the
/// simplest where there are several such.
fn one_for_several(diagnosis: &Diagnosis) -> Option<(&str, usize)> {
    let names = diagnosis.effects.iter().flat_map(|effect| effect.competing_with.iter().flatten());
    let mut best: Option<(&str, usize)> = None;
    for name in names {
        let of = diagnosis
            .effects
            .iter()
            .filter(|effect| effect.competing_with.iter().flatten().any(|other| other == name));
        let of = of.count();
        if of > best.map_or(1, |(_, most)| most) {
            best = Some((name, of));
        }
    }
    best
}

/// The verdict in a sentence.
fn happened(diagnosis: &Diagnosis) -> String {
    let count = diagnosis.effects.len();
    if fits_otherwise(diagnosis) {
        let strayed = diagnosis.cautions.iter().any(|caution| matches!(caution, Caution::StationsStrayed(_)));
        let told = if strayed {
            "The stations come out elsewhere than the study puts them. Where an angle runs the other way, errors have the wrong sign."
        } else {
            "The data, or the places that the study states, are likely read in a way that they were not meant in: no number here means \
             anything."
        };
        return told.to_owned();
    }
    if let Some(rival) = rival(diagnosis) {
        return rival.happened.to_owned();
    }
    if let Verdict::Confounded | Verdict::UnnamedFunction = diagnosis.verdict
        && let Some((one, of)) = one_for_several(diagnosis)
    {
        let of = if of == count { "all".to_owned() } else { of.to_string() };
        return format!("{count} effects found; in place of {of} of them these data fit one as well: {one}.");
    }
    match diagnosis.verdict {
        Verdict::Explained if count == 1 => {
            "Cause found; it alone explains what the declaration left over.".to_owned()
        }
        Verdict::Explained => {
            format!("{count} causes found; together they explain what the declaration left over.")
        }
        Verdict::Confounded if count == 1 => {
            let effect = &diagnosis.effects[0];
            match (effect.causes.len(), effect.competing_with.as_slice()) {
                (0 | 1, [names]) => {
                    format!("Cause found; {} explains these data about as well.", names.join(" or "))
                }
                (0 | 1, others) => {
                    format!("Cause found; {} other models explain these data about as well.", others.len())
                }
                (fit, _) if effect.causes.iter().all(|cause| cause.share.is_none()) => {
                    format!("Cause found; these data fit {fit} physical causes equally well.")
                }
                (fit, _) => {
                    format!("Cause found; these data fit {fit} physical causes. Their shares stand below.")
                }
            }
        }
        Verdict::Confounded => {
            let is_open =
                |effect: &&EffectFound| effect.causes.len() > 1 || !effect.competing_with.is_empty();
            let open = diagnosis.effects.iter().filter(is_open).count();
            format!("{count} effects found; for {open} of them these data fit something else about as well.")
        }
        Verdict::FormNotDetermined if count == 1 => {
            let effect = &diagnosis.effects[0];
            let others: Vec<&str> =
                effect.competing_with.iter().take(2).map(|names| names[0].as_str()).collect();
            format!(
                "Something moves at one place; these data fit several functions of {} about as well: {}, or {}.",
                effect.driver,
                effect.names[0],
                others.join(", or ")
            )
        }
        Verdict::FormNotDetermined => {
            let open = diagnosis.effects.iter().filter(|effect| !effect.form_determined).count();
            format!(
                "{count} effects found; for {open} of them these data fit several functions of a reading about as well."
            )
        }
        Verdict::UnnamedFunction if count > 0 => format!(
            "{count} {} found, but one function at one place fits better than the catalogue, which has no name for it.",
            if count == 1 { "effect" } else { "effects" }
        ),
        Verdict::UnnamedFunction => {
            "Something moves at one place, as a function that the catalogue has no name for.".to_owned()
        }
        Verdict::StructureRemains if count > 0 => format!(
            "{count} {} found, but what is left has structure that nothing in the catalogue explains.",
            if count == 1 { "effect" } else { "effects" }
        ),
        Verdict::StructureRemains => {
            "What the declaration leaves over has structure that nothing in the catalogue explains."
                .to_owned()
        }
        Verdict::NoiseExceedsStated => {
            let ratio =
                diagnosis.noise.over_stated.map_or_else(String::new, |ratio| format!("{} ", times(ratio)));
            format!(
                "The residual is {ratio}as large as the stated noise, and nothing in the catalogue explains it."
            )
        }
        Verdict::NothingDetectable
            if diagnosis
                .cautions
                .iter()
                .any(|caution| matches!(caution, Caution::ResidualIsRounding { .. })) =>
        {
            "The declaration explains these data to the last digit; what is left is rounding.".to_owned()
        }
        Verdict::NothingDetectable => {
            "No effect that the declaration lacks stands out from the noise.".to_owned()
        }
        Verdict::TooFewObservations => too_few(diagnosis),
        Verdict::ColumnMisread => {
            let otherwise = || "The data fit when they are read otherwise than the study says.".to_owned();
            misread(diagnosis).map_or_else(otherwise, columns::told)
        }
        Verdict::FitFailed if let Some(values) = implausible_values(diagnosis) => {
            columns::implausible(values)
        }
        Verdict::FitFailed => {
            let why = match diagnosis.fit.amended {
                Ended::NotConverged { steps } => format!("reached no minimum in {steps} steps"),
                Ended::FarOff { .. } if diagnosis.unit == SiUnit::METRE => {
                    "ended with half of the points further off than a fifth of the way to what they observe: look at columns, labels, \
                     signs, units and stated places"
                        .to_owned()
                }
                Ended::FarOff { .. } => {
                    "ended with half of the directions more than 11° off: look at columns, signs, units and frame"
                        .to_owned()
                }
                Ended::Converged { .. } | Ended::TooFewObservations { .. } => "reached no minimum".to_owned(),
            };
            format!("The fit {why}. Its numbers mean nothing, and no search was made.")
        }
    }
}

fn too_few(diagnosis: &Diagnosis) -> String {
    match diagnosis.fit.amended {
        Ended::TooFewObservations { components, of_objects, .. } => {
            let of_objects = match of_objects {
                0 => String::new(),
                numbers => format!(" and {numbers} numbers of objects and stations"),
            };
            format!(
                "{} observations have {components} measured components, and these data determine {} combinations of {} \
                 errors{of_objects}: nothing is left to judge them by.",
                diagnosis.observations.rows, diagnosis.fit.rank[0], diagnosis.fit.rank[1]
            )
        }
        Ended::Converged { .. } | Ended::NotConverged { .. } | Ended::FarOff { .. } => {
            "An effect stands out, but it rests on fewer than six observations: it was left out.".to_owned()
        }
    }
}

/// How much better, of one unit of residuals after the other.
fn better(diagnosis: &Diagnosis) -> String {
    let observed = diagnosis.instrument.observed.first().map_or("residual", |seen| &seen.name);
    let first = of_unit(diagnosis, observed, diagnosis.unit, [diagnosis.before, diagnosis.after]);
    let beside = diagnosis.beside.iter().filter_map(|own| {
        let observed = own.observed.first()?;
        Some(of_unit(diagnosis, observed, own.unit, [own.before, own.after]))
    });
    let mut all: Vec<String> = std::iter::once(first).chain(beside).collect();
    all.extend(diagnosis.every_row.as_ref().and_then(|every| every.validation).map(|left| {
        let [before, after] = [left.before_kept, left.after_kept].map(|rms| short(rms, diagnosis.unit));
        format!("On the {} rows that the search did not read it goes from {before} to {after}.", left.rows)
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

/// How much better the residuals of an observable are.
fn of_unit(diagnosis: &Diagnosis, observed: &str, unit: SiUnit, [before, after]: [Rms; 2]) -> String {
    let told = |si: f64| short(si, unit);
    let fitted = |rms: Option<f64>| {
        rms.map_or_else(
            || "no number, since the fit left none,".to_owned(),
            |rms| format!("{} (RMS)", told(rms)),
        )
    };
    if !diagnosis.verdict.is_usable() {
        return format!("No better: the {observed} error is {} as fitted.", fitted(before.rms));
    }
    let without = after.held_out_rows - after.held_out_rows_kept;
    let hides = |all: f64, kept: f64| without > 0 && all > HIDDEN * kept;
    let is_hidden =
        after.held_out_rms.zip(after.held_out_rms_kept).is_some_and(|(all, kept)| hides(all, kept));
    let rows = if without == 1 { "row" } else { "rows" };
    if diagnosis.effects.is_empty() {
        let (own, held_out, but_for) = match is_hidden {
            true => (after.rms_kept, after.held_out_rms_kept, format!(", without {without} {rows} far out")),
            false => (after.rms, after.held_out_rms, String::new()),
        };
        let held_out =
            held_out.map_or_else(String::new, |rms| format!("; {} on data that nobody fitted", told(rms)));
        return format!(
            "The {observed} error of the fitted declaration is {}{held_out}{but_for}.",
            fitted(own)
        );
    }
    let pairs = [
        (
            format!("on data that nobody fitted, without {without} {rows} far out,"),
            before.held_out_rms_kept.zip(after.held_out_rms_kept).filter(|_| is_hidden),
        ),
        ("on data that nobody fitted".to_owned(), before.held_out_rms.zip(after.held_out_rms)),
        ("on the data that were fitted".to_owned(), before.rms.zip(after.rms)),
    ];
    let Some((where_, from, to)) =
        pairs.into_iter().find_map(|(where_, pair)| pair.map(|(from, to)| (where_, from, to)))
    else {
        return format!("The {observed} error is {} before.", fitted(before.rms));
    };
    let ratio = match from / to {
        ratio if ratio >= 1.05 => format!(", {} smaller", times(ratio)),
        ratio if ratio < 1.0 => ": it gets worse".to_owned(),
        _ => ", hardly smaller".to_owned(),
    };
    format!("The {observed} error (RMS) {where_} goes from {} to {}{ratio}.", told(from), told(to))
}
