//! The five answers that stand first: what happened, what it is, where, how much better, what to do next.

use super::better::better;
use super::causes::{body_in_words, each_once, sentence_case};
use super::columns::{self, implausible_values, misread};
use super::effects::{chance_of_all, headline, look_alike, moves, place};
use super::frozen::fitted;
use super::ladder::goal;
use super::left::function_form;
use super::numbers::{short, times};
use super::rivals::rival;
use super::step::Step;
use super::steps::{
    is_hardly_repeated, is_misread, is_unconfirmed, is_worse, share_labels, shows_nothing, steps,
};
use calibration::diagnose::{Caution, Diagnosis, EffectFound, Ended, EveryRow, Verdict};
use observe::SiUnit;

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
    /// What happened, in a word or two: `Effect found`.
    pub badge: String,
    /// What happened, in a sentence.
    pub happened: String,
    /// How sure it is; absent where nothing was found.
    pub chance: Option<String>,
    /// Whether the specification of the study is met; absent where it states none.
    pub goal: Option<String>,
    /// What it is, in a sentence for each effect, the largest first.
    pub what: Vec<String>,
    /// The causes that fit, of all effects, each once.
    pub causes: Vec<String>,
    /// Where the effects sit, each place once.
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
        causes.insert(0, format!("{one}, instead of {of} of the effects"));
    }
    let usable = diagnosis.verdict.is_usable();
    let what = match (usable && !is_answered_otherwise, &diagnosis.remaining) {
        (false, _) => Vec::new(),
        (true, Some(left)) if effects.is_empty() => left
            .place
            .iter()
            .map(|place| {
                format!(
                    "{} {} as {} changes: a {}.",
                    sentence_case(&body_in_words(&place.body)),
                    moves(&place.dof),
                    place.driver,
                    function_form(&place.form)
                )
            })
            .collect(),
        (true, _) => {
            let told = |effect: &&EffectFound| [Some(headline(effect)), look_alike(effect)];
            effects.iter().flat_map(told).flatten().collect()
        }
    };
    Answers {
        tone: tone(diagnosis),
        badge: badge(diagnosis),
        happened: [Some(happened(diagnosis)), outside(diagnosis), searched(diagnosis)]
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
            .join(" "),
        chance: if usable && diagnosis.frozen.is_none() { chance_of_all(&effects, diagnosis) } else { None },
        goal: if usable { goal(diagnosis) } else { None },
        what,
        causes,
        places: once(effects.iter().map(|effect| place(effect, diagnosis))),
        better: better(diagnosis),
        next: steps(diagnosis, folder, command),
    }
}

/// Texts in their order, each once.
fn once(texts: impl Iterator<Item = String>) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for text in texts {
        if !found.contains(&text) {
            found.push(text);
        }
    }
    found
}

/// Where not to correct with it.
fn outside(diagnosis: &Diagnosis) -> Option<String> {
    is_worse_outside(diagnosis).then(|| {
        "Outside the measured range this correction increases the error. Use the correction only inside that range."
            .to_owned()
    })
}

/// How many rows were searched, where not all were.
fn searched(diagnosis: &Diagnosis) -> Option<String> {
    let EveryRow { rows, files, converged, .. } = diagnosis.every_row.as_ref()?;
    let files = if *files > 1 { format!(" from {files} files") } else { String::new() };
    let errors = if *converged { " The errors are estimated from every row." } else { "" };
    Some(format!("The search used {} of {rows} rows{files}.{errors}", diagnosis.observations.rows))
}

fn is_worse_outside(diagnosis: &Diagnosis) -> bool {
    diagnosis.cautions.iter().any(|caution| matches!(caution, Caution::WorseElsewhere { .. }))
}

fn tone(diagnosis: &Diagnosis) -> Tone {
    match diagnosis.verdict {
        Verdict::FitFailed | Verdict::ColumnMisread | Verdict::TooFewObservations => Tone::Bad,
        _ if is_worse(diagnosis) => Tone::Bad,
        _ if is_misread(diagnosis)
            || is_worse_outside(diagnosis)
            || rival(diagnosis).is_some()
            || is_unconfirmed(diagnosis).is_some()
            || is_hardly_repeated(diagnosis)
            || shows_nothing(diagnosis) =>
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
    let effects = if count == 1 { "effect" } else { "effects" };
    match diagnosis.verdict {
        Verdict::ColumnMisread if misread(diagnosis).is_some() => "A column is misread".to_owned(),
        _ if share_labels(diagnosis) => "Likely read wrongly".to_owned(),
        _ if let Some(rival) = rival(diagnosis) => rival.badge.to_owned(),
        _ if is_worse(diagnosis) => "Worse on held-out data".to_owned(),
        _ if let Some((badge, _)) = fitted(diagnosis) => badge.to_owned(),
        _ if is_hardly_repeated(diagnosis) => "Not enough data".to_owned(),
        Verdict::Confounded if let [effect] = diagnosis.effects.as_slice() => match effect.causes.len() {
            0 | 1 => format!("Effect found, {} possible models", 1 + effect.competing_with.len()),
            causes => format!("Effect found, {causes} possible causes"),
        },
        Verdict::Explained if count == 1 => "Effect found".to_owned(),
        Verdict::Explained | Verdict::Confounded => format!("{count} effects found"),
        Verdict::FormNotDetermined if count == 1 => "Effect located, shape unknown".to_owned(),
        Verdict::FormNotDetermined => {
            format!("{count} effects found, {} of unknown shape", of_unknown_shape(diagnosis))
        }
        Verdict::UnnamedFunction if count == 0 => "Effect located, cause unknown".to_owned(),
        Verdict::UnnamedFunction => format!("{count} {effects} found, one more located"),
        Verdict::StructureRemains if count == 0 => "Unexplained error found".to_owned(),
        Verdict::StructureRemains => format!("{count} {effects} found, more remains"),
        Verdict::NoiseExceedsStated => "Noise larger than stated".to_owned(),
        Verdict::NothingDetectable if is_unconfirmed(diagnosis).is_some() || shows_nothing(diagnosis) => {
            "Not enough data".to_owned()
        }
        Verdict::NothingDetectable => "Nothing missing found".to_owned(),
        Verdict::TooFewObservations => "Not enough data".to_owned(),
        Verdict::ColumnMisread => "A column is misread".to_owned(),
        Verdict::FitFailed if implausible_values(diagnosis).is_some() => "Model or column wrong".to_owned(),
        Verdict::FitFailed => "Fit failed".to_owned(),
    }
}

/// Effects whose function these data do not determine.
fn of_unknown_shape(diagnosis: &Diagnosis) -> usize {
    diagnosis.effects.iter().filter(|effect| !effect.form_determined).count()
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

/// The verdict in sentences, under the badge.
fn happened(diagnosis: &Diagnosis) -> String {
    let count = diagnosis.effects.len();
    if share_labels(diagnosis) {
        return "Most objects are at two places. Do not use any number here.".to_owned();
    }
    if let Some(rival) = rival(diagnosis) {
        return rival.happened.to_owned();
    }
    if is_worse(diagnosis) {
        return "The effects fit these rows, but not the held-out rows.".to_owned();
    }
    if let Some((_, happened)) = fitted(diagnosis) {
        return happened;
    }
    if is_hardly_repeated(diagnosis) {
        return match count {
            1 => "One possible effect could be chance. Fewer than half of the repeated searches found this effect.",
            _ => "Each of the possible effects could be chance. Fewer than half of the repeated searches found them.",
        }
        .to_owned();
    }
    if let Verdict::Confounded | Verdict::UnnamedFunction = diagnosis.verdict
        && let Some((one, of)) = one_for_several(diagnosis)
    {
        let of = if of == count { format!("All {count}") } else { format!("{of} of the {count}") };
        return format!("{of} effects may be a single one: {one}.");
    }
    match diagnosis.verdict {
        Verdict::Explained if count == 1 => "With this effect, the residual looks like noise.".to_owned(),
        Verdict::Explained => format!("With these {count} effects, the residual looks like noise."),
        Verdict::Confounded if count == 1 => {
            let effect = &diagnosis.effects[0];
            match (effect.causes.len(), effect.competing_with.as_slice()) {
                (0 | 1, [names]) => {
                    format!("Another model fits these data nearly equally: {}.", names.join(" or "))
                }
                (0 | 1, others) => format!("{} other models fit these data nearly equally.", others.len()),
                (fit, _) => {
                    let shares = match effect.causes.iter().any(|cause| cause.share.is_some()) {
                        true => " Their shares are listed below.",
                        false => "",
                    };
                    // Another cause puts objects that nobody surveyed at other places.
                    let correction = match diagnosis.observations.unknown_objects {
                        Some(_) => "",
                        None => " The correction is nearly the same for all.",
                    };
                    format!("The data cannot choose between these {fit} causes.{shares}{correction}")
                }
            }
        }
        Verdict::Confounded => {
            let is_open =
                |effect: &&EffectFound| effect.causes.len() > 1 || !effect.competing_with.is_empty();
            let open = diagnosis.effects.iter().filter(is_open).count();
            format!("For {open} of the {count} effects, other causes fit these data nearly equally.")
        }
        Verdict::FormNotDetermined if count == 1 => {
            let effect = &diagnosis.effects[0];
            let others: Vec<&str> =
                effect.competing_with.iter().take(2).map(|names| names[0].as_str()).collect();
            format!(
                "Several functions of {} fit nearly equally: {}, or {}.",
                effect.driver,
                effect.names[0],
                others.join(", or ")
            )
        }
        Verdict::FormNotDetermined => format!(
            "For {} of the {count} effects, several functions of a reading fit nearly equally.",
            of_unknown_shape(diagnosis)
        ),
        Verdict::UnnamedFunction => {
            let place = diagnosis.remaining.as_ref().and_then(|left| left.place.as_ref());
            match place.filter(|_| count > 0) {
                Some(place) => format!(
                    "One more error follows {}: a {}. No known cause has this shape.",
                    place.driver,
                    function_form(&place.form)
                ),
                None => "No known cause has the shape of this error.".to_owned(),
            }
        }
        Verdict::StructureRemains => {
            "The residual has a pattern that nothing in the catalogue explains.".to_owned()
        }
        Verdict::NoiseExceedsStated => {
            let ratio =
                diagnosis.noise.over_stated.map_or_else(String::new, |ratio| format!("{} ", times(ratio)));
            format!(
                "The residual is {ratio}as large as the stated noise. Nothing in the catalogue explains the difference."
            )
        }
        Verdict::NothingDetectable
            if diagnosis
                .cautions
                .iter()
                .any(|caution| matches!(caution, Caution::ResidualIsRounding { .. })) =>
        {
            "The model explains these data to the last digit. Only rounding remains.".to_owned()
        }
        Verdict::NothingDetectable if shows_nothing(diagnosis) => {
            "These data contain none of the declared errors.".to_owned()
        }
        Verdict::NothingDetectable => would_have_shown(diagnosis),
        Verdict::TooFewObservations => too_few(diagnosis),
        Verdict::ColumnMisread => {
            let otherwise = || "The data fit if a column is read in another way.".to_owned();
            misread(diagnosis).map_or_else(otherwise, columns::told)
        }
        Verdict::FitFailed if let Some(values) = implausible_values(diagnosis) => {
            columns::implausible(values)
        }
        Verdict::FitFailed => {
            let why = match diagnosis.fit.amended {
                Ended::NotConverged { steps } => format!("The fit found no minimum in {steps} steps."),
                Ended::FarOff { .. } if diagnosis.unit == SiUnit::METRE => {
                    "After the fit, half of the points miss by more than a fifth of the distance to their target.".to_owned()
                }
                Ended::FarOff { .. } => {
                    "After the fit, half of the directions miss by more than 11°.".to_owned()
                }
                Ended::NoRest { .. } => {
                    "After the fit, most rows are far from where the declaration puts them.".to_owned()
                }
                Ended::Converged { .. } | Ended::TooFewObservations { .. } => {
                    "The fit found no minimum.".to_owned()
                }
            };
            format!("{why} No search was made. Do not use these numbers.")
        }
    }
}

/// From which size on an effect would have shown: one that is not among those that could hide is found four times out of five
/// where it is as large as the residual.
fn would_have_shown(diagnosis: &Diagnosis) -> String {
    let kind = match diagnosis.unit {
        SiUnit::RAD => "rotation",
        SiUnit::METRE => "displacement",
        _ => "effect",
    };
    let size = diagnosis.after.rms_kept.filter(|rms| rms.is_finite() && *rms > 0.0);
    let Some(size) = size.filter(|_| diagnosis.search.is_some()) else {
        return "No missing effect is larger than the noise.".to_owned();
    };
    let shown = format!(
        "A missing {kind} above {} would have been found four times out of five.",
        short(size, diagnosis.unit)
    );
    let hidden = diagnosis.not_shown.iter().filter(|effect| effect.unit == diagnosis.unit).count();
    match hidden {
        0 => shown,
        1 => format!("{shown} One kind of {kind} could not show in these data."),
        hidden => format!("{shown} {hidden} kinds of {kind} could not show in these data."),
    }
}

fn too_few(diagnosis: &Diagnosis) -> String {
    match diagnosis.fit.amended {
        Ended::TooFewObservations { components, of_objects, .. } => {
            let of_objects = match of_objects {
                0 => String::new(),
                numbers => format!(" and {numbers} numbers of objects and stations"),
            };
            let rows = match diagnosis.observations.rows {
                1 => "1 row".to_owned(),
                rows => format!("{rows} rows"),
            };
            format!(
                "{rows} with {components} measured components cannot determine and check {} errors{of_objects}.",
                diagnosis.fit.rank[1]
            )
        }
        Ended::Converged { .. }
        | Ended::NotConverged { .. }
        | Ended::FarOff { .. }
        | Ended::NoRest { .. } => {
            "One effect may be missing, but fewer than six rows support it. The model was not changed."
                .to_owned()
        }
    }
}
