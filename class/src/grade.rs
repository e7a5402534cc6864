//! Points for what a student handed in, each with its reason.

use std::collections::BTreeMap;

use model_core::escape::clipped;
use model_core::{SymbolId, TransformKind};
use serde::Serialize;

use crate::answer::{Answer, ItemError, Number};
use crate::cause::Cause;
use crate::design::Design;
use crate::key::{Key, KeyError, Student};
use crate::misread::{Reading, Row};
use crate::model::Model;
use crate::policy::{ARCSEC_RAD, EXCLUDED};
use crate::refit::unseen_rms_rad;
use crate::rubric::{Item, LOOSE, NEAR, PREDICTS_BETTER, PREDICTS_WELL, RIGHT_WITHIN, RUBRIC, TIGHT};
use crate::sentence::{SENTENCES, right};
use crate::task::{Asked, Effect, Task};

/// What lay in the folder of a student; a text that could not be read has its reason.
#[derive(Debug, Clone, PartialEq)]
pub struct Handed {
    /// `answer.toml`.
    pub answer: Result<String, String>,
    /// `amended.chain`.
    pub declaration: Result<String, String>,
}

/// The points of one item.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Grade {
    /// Of what.
    pub item: Item,
    /// Points, in steps of one half.
    pub points: f64,
    /// The most that there are.
    pub of: f64,
    /// Why.
    pub why: String,
}

/// What one student gets.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Marked {
    /// As the list of names has it.
    pub name: String,
    /// The folder.
    pub folder: String,
    /// All points together.
    pub points: f64,
    /// Every item, in the order of the rubric; none where nothing could be graded.
    pub grades: Vec<Grade>,
    /// Why nothing could be graded.
    pub not_graded: Option<String>,
    /// Keys of the answer that no item has.
    pub left_out: Vec<String>,
    /// The secret.
    pub secret: Vec<String>,
}

/// A declaration that was handed in, or why there is none.
type Declared<'a> = Result<&'a Model, &'a String>;

/// Grades what a student handed in.
///
/// # Errors
/// The key is of another version. Whatever is wrong with the answer costs points and is told there.
pub fn grade(key: &Key, student: &Student, handed: &Handed) -> Result<Marked, KeyError> {
    let task = key.task(student)?;
    let (grades, not_graded, left_out) = match read(key, student, handed) {
        Ok(answer) => (grades(&task, &answer, &handed.declaration), None, answer.unknown()),
        Err(why) => (Vec::new(), Some(why), Vec::new()),
    };
    Ok(Marked {
        name: student.name.clone(),
        folder: student.folder.clone(),
        // The sum of nothing is −0 otherwise.
        points: grades.iter().fold(0.0, |sum, grade| sum + grade.points),
        grades,
        not_graded,
        left_out,
        secret: student.secret.clone(),
    })
}

/// The answer of a student's own sheet.
fn read(key: &Key, student: &Student, handed: &Handed) -> Result<Answer, String> {
    let text = handed.answer.as_ref().map_err(Clone::clone)?;
    let answer = Answer::of(text).map_err(|error| error.to_string())?;
    let mark = answer.mark.trim();
    if mark == student.mark {
        return Ok(answer);
    }
    Err(match key.students.iter().find(|other| other.mark == mark) {
        Some(other) => {
            format!("the answer carries the mark of the sheet of {} ({})", other.name, other.folder)
        }
        None => "the answer carries the mark of no sheet of this class".to_owned(),
    })
}

fn grades(task: &Task, answer: &Answer, declaration: &Result<String, String>) -> Vec<Grade> {
    let reading = answer.reading();
    let read_as = *reading.as_ref().unwrap_or(&Reading::AsLabelled);
    let model = declaration
        .clone()
        .and_then(|text| Model::of(&text, &task.instrument).map_err(|error| error.to_string()));
    let of_item = |item: Item| match item {
        Item::Place => {
            let (share, why) = place(task, model.as_ref(), read_as);
            let unread = reading.as_ref().err().map_or_else(String::new, |error| format!(" {error}."));
            (share, why + &unread)
        }
        Item::Cause => match answer.causes() {
            Ok(named) => {
                let (share, why) = cause(task, &named, read_as);
                let counted =
                    |word: String| format!(" `{word}` is no cause of the sheet and counts as a wrong one.");
                (share, why + &answer.no_causes().into_iter().map(counted).collect::<String>())
            }
            Err(error) => (0.0, format!("{error}.")),
        },
        Item::Size => number(answer.number("size"), task.numbers[0]),
        Item::Error => number(answer.number("error"), task.numbers[1]),
        Item::Prediction => number(answer.number("prediction"), task.numbers[2]),
        Item::Unseen => unseen(task, model.as_ref(), read_as),
        Item::Honesty => honesty(task, answer.sentence()),
    };
    let graded = |(item, of): (Item, f64)| {
        let (share, why) = of_item(item);
        Grade { item, points: (2.0 * share * of).round() / 2.0, of, why }
    };
    RUBRIC.into_iter().map(graded).collect()
}

/// A place in a chain: a body, and how it is moved.
type Place = (String, String);

/// What a declaration has beyond the declared errors, by place: the errors there.
fn added(model: &Model, task: &Task) -> BTreeMap<Place, Vec<SymbolId>> {
    let is_new = |id: &SymbolId| task.declared.iter().all(|(name, _)| *name != model.chain.symbol(*id).name);
    let new: Vec<SymbolId> = model.errors().into_iter().filter(is_new).collect();
    let mut places: BTreeMap<Place, Vec<SymbolId>> = BTreeMap::new();
    for passed in model.chain.way(model.pointing) {
        let kind = if passed.factor.kind == TransformKind::Rotation { 'R' } else { 'T' };
        let place = (model.chain.body(passed.body).name.clone(), format!("{kind}{}", passed.factor.axis));
        for id in model.chain.symbols_in(&passed.factor.amount).into_iter().filter(|id| new.contains(id)) {
            let ids = places.entry(place.clone()).or_default();
            if !ids.contains(&id) {
                ids.push(id);
            }
        }
    }
    places
}

/// The places of every cause that the data allow for an effect.
fn places_of(task: &Task, effect: &Effect) -> Vec<Place> {
    let additions = effect.possible.iter().flat_map(|cause: &Cause| cause.additions(&task.instrument));
    additions.map(|own| (own.body.to_owned(), own.moves.to_owned())).collect()
}

fn place(task: &Task, model: Declared<'_>, reading: Reading) -> (f64, String) {
    let model = match model {
        Ok(model) => model,
        Err(why) => return (0.0, format!("No place can be read: {why}.")),
    };
    let added = added(model, task);
    let columns = |ids: &[SymbolId]| {
        let mut columns = model.columns(&task.instrument, &task.poses, ids);
        columns.iter_mut().flatten().for_each(|number| *number /= task.noise_rad());
        columns
    };
    let is_declared = |id: &SymbolId| added.values().all(|new| !new.contains(id));
    let declared: Vec<SymbolId> = model.errors().into_iter().filter(is_declared).collect();
    let declared = columns(&declared);
    let own: BTreeMap<&Place, Vec<Vec<f64>>> =
        added.iter().map(|(place, ids)| (place, columns(ids))).collect();
    let does = |place: &Place, effect: &Effect| {
        places_of(task, effect).contains(place)
            || Design::new(declared.iter().chain(&own[place])).left_of(&effect.signature) < EXCLUDED
    };
    let found = task.effects.iter().filter(|effect| added.keys().any(|place| does(place, effect))).count();
    let is_idle = |place: &&Place| !task.effects.iter().any(|effect| does(place, effect));
    let idle: Vec<&Place> = added.keys().filter(is_idle).collect();
    let is_misread = usize::from(task.reading != Reading::AsLabelled);
    let right = found + usize::from(is_misread == 1 && reading == task.reading);
    let is_read_wrongly = reading != Reading::AsLabelled && reading != task.reading;
    let wrong = idle.len() + usize::from(is_read_wrongly);
    let all = task.effects.len() + is_misread;
    let mut why = format!("{right} of {all} found.");
    for (body, moves) in idle {
        why += &format!(" No effect needs what you added as `{moves}` in `{}`.", clipped(body));
    }
    if is_read_wrongly {
        why += &format!(" The reading `{}` is wrong.", reading.word());
    }
    (right as f64 / (all + wrong) as f64, why)
}

fn cause(task: &Task, named: &[Vec<Option<Cause>>], reading: Reading) -> (f64, String) {
    let mut sets: Vec<&[Cause]> = task.effects.iter().map(|effect| effect.possible.as_slice()).collect();
    let why = sets.iter().map(|set| format!("`{}`", words(set))).collect::<Vec<_>>().join(" and ");
    let mut earned = 0.0;
    // Whole sets first, so that a part of one does not take the place of another.
    let mut partly = Vec::new();
    for own in named {
        match sets.iter().position(|set| set.iter().copied().map(Some).eq(own.iter().copied())) {
            Some(at) => {
                sets.remove(at);
                earned += 1.0;
            }
            None => partly.push(own),
        }
    }
    for own in partly {
        if let Some(at) = sets.iter().position(|set| own.iter().flatten().any(|cause| set.contains(cause))) {
            sets.remove(at);
            earned += 0.5;
        }
    }
    let is_misread = task.reading != Reading::AsLabelled;
    if is_misread && reading == task.reading {
        earned += 1.0;
    }
    let all = task.effects.len() + usize::from(is_misread);
    let told = named.len() + usize::from(reading != Reading::AsLabelled);
    let reading =
        if is_misread { format!("; the reading is `{}`", task.reading.word()) } else { String::new() };
    let share = earned / all.max(told) as f64;
    let rule = if share < 1.0 {
        " One cause of several counts half, and a cause too many counts against it."
    } else {
        ""
    };
    (share, format!("The data allow {why}{reading}.{rule}"))
}

fn words(causes: &[Cause]) -> String {
    causes.iter().map(|cause| cause.word()).collect::<Vec<_>>().join(" or ")
}

fn number(given: Result<Option<Number>, ItemError>, asked: Asked) -> (f64, String) {
    let Asked { truth_arcsec: truth, uncertainty_arcsec: possible } = asked;
    let truth_is = format!("The true value is {}, and these data allow ± {}", shown(truth), shown(possible));
    let Number { value, uncertainty } = match given {
        Ok(Some(number)) => number,
        Ok(None) => return (0.0, format!("Not answered. {truth_is}.")),
        Err(error) => return (0.0, format!("{error}. {truth_is}.")),
    };
    if !(value.is_finite() && uncertainty.is_finite() && uncertainty > 0.0) {
        return (0.0, format!("A value and a ± above zero are needed. {truth_is}."));
    }
    let off = (value - truth).abs();
    let is_right = off <= RIGHT_WITHIN * uncertainty;
    let (share, verdict) = match uncertainty / possible {
        width if is_right && width <= TIGHT => (1.0, "is right"),
        width if is_right && width <= LOOSE => (0.5, "is right, with too wide a ±"),
        _ if is_right => (0.0, "is right, with a ± too wide for points"),
        _ if off <= NEAR * possible => (0.5, "is near, with too small a ±"),
        _ => (0.0, "is wrong by more than its ± allows"),
    };
    let slip = if share > 0.0 || is_right { "" } else { slip(value, asked) };
    (share, format!("{truth_is}. Your {} ± {} {verdict}.{slip}", shown(value), shown(uncertainty)))
}

/// What somebody may have done whose number would else be near.
fn slip(value: f64, asked: Asked) -> &'static str {
    let is_near = |other: f64| (other - asked.truth_arcsec).abs() <= NEAR * asked.uncertainty_arcsec;
    if is_near(-value) {
        " Its sign is wrong."
    } else if is_near(value / ARCSEC_RAD) {
        " It looks like rad, and the sheet asks for ″."
    } else if is_near(value * 3600.0) {
        " It looks like degrees, and the sheet asks for ″."
    } else {
        ""
    }
}

/// Arc seconds with two decimals, or in powers of ten where these say nothing.
fn shown(arcsec: f64) -> String {
    let is_plain = arcsec == 0.0 || (0.01..1e6).contains(&arcsec.abs());
    let text = if is_plain { format!("{:.2}", arcsec + 0.0) } else { format!("{arcsec:.1e}") };
    format!("{}″", text.replace('-', "−"))
}

fn unseen(task: &Task, model: Declared<'_>, reading: Reading) -> (f64, String) {
    let model = match model {
        Ok(model) => model,
        Err(why) => return (0.0, format!("Nothing can be predicted: {why}.")),
    };
    let rms_arcsec = |model: &Model, reading: Reading| {
        let rows: Vec<Row> = task.rows.iter().map(|row| reading.read(*row)).collect();
        Some(unseen_rms_rad(model, &task.instrument, &rows, &task.unseen)? / ARCSEC_RAD)
    };
    let Some(own) = rms_arcsec(model, reading) else {
        return (0.0, "The amended declaration could not be fitted to your data.".to_owned());
    };
    let fitted =
        task.declared.len() + task.effects.iter().map(|effect| effect.coefficients.len()).sum::<usize>();
    // Of the noise in two directions of each row, a fit of so many numbers keeps this share.
    let possible = task.level.difficulty().noise_arcsec * (fitted as f64 / task.rows.len() as f64).sqrt();
    let bare = Model::of(task.instrument.declaration, &task.instrument).ok();
    let bare = bare.and_then(|model| rms_arcsec(&model, task.reading));
    let as_got = bare
        .map_or_else(String::new, |bare| format!("The declaration as you got it errs by {}. ", shown(bare)));
    let (share, verdict) = if own <= PREDICTS_WELL * possible {
        (1.0, "Yours is as good as can be".to_owned())
    } else if bare.is_some_and(|bare| own <= PREDICTS_BETTER * bare) {
        (0.5, format!("{as_got}Yours errs by less than half of that"))
    } else {
        (0.0, format!("{as_got}Less than half of that earns points"))
    };
    let poses = task.unseen.len();
    let why = format!(
        "At {poses} poses that you did not have, your declaration errs by {} (RMS). The noise allows {}. {verdict}.",
        shown(own),
        shown(possible)
    );
    (share, why)
}

fn honesty(task: &Task, sentence: Result<Option<i64>, ItemError>) -> (f64, String) {
    let right = right(task);
    let right_is = format!("Right is sentence {right}: “{}”", SENTENCES[right - 1]);
    let sentence = match sentence {
        Ok(sentence) => sentence,
        Err(error) => return (0.0, format!("{error}. {right_is}")),
    };
    let is_right = sentence.is_some_and(|number| usize::try_from(number) == Ok(right));
    let chosen = sentence.map_or_else(|| "no sentence".to_owned(), |number| format!("sentence {number}"));
    (f64::from(u8::from(is_right)), format!("You chose {chosen}. {right_is}"))
}
