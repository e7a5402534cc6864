//! An accepted effect in words: what it does, where it sits, how sure it is.

use std::collections::BTreeMap;

use super::causes::{body_in_words, form, sentence_case};
use super::numbers;
use calibration::diagnose::{Diagnosis, EffectFound, Side};
use observe::SiUnit;

/// Errors that are named for one effect.
const NAMED: usize = 3;

/// What an effect does: `The body middle is rotated by up to 10.1″ about x, once per turn of beta.`
#[must_use]
pub fn headline(effect: &EffectFound) -> String {
    let amplitude = numbers::short(effect.amplitude, effect.amplitude_unit);
    let body = body_in_words(&effect.body);
    let form = form(&effect.form, &effect.driver);
    if effect.bends.is_some() {
        return format!("The line of sight is bent along the vertical by up to {amplitude}, {form}.");
    }
    let turns = effect.dof.starts_with('R');
    let does = if turns { "is rotated" } else { "is displaced" };
    let axis = axis(&effect.dof);
    if turns == (effect.amplitude_unit == SiUnit::RAD) {
        return format!("{} {does} by up to {amplitude} {axis}, {form}.", sentence_case(&body));
    }
    // A turn that is measured by what it moves, or a shift by what it turns.
    let moves = if turns { "moves" } else { "turns" };
    format!(
        "{} {does} {axis}, {form}. This {moves} the measured {} by up to {amplitude}.",
        sentence_case(&body),
        effect.amplitude_of
    )
}

/// Waves that look the same: `At these readings, waves of 53, 91 and 125 times per turn and 135 more look the same.`
#[must_use]
pub fn look_alike(effect: &EffectFound) -> Option<String> {
    let (told, others) = effect.alias_orders.split_at(effect.alias_orders.len().min(NAMED));
    let told: Vec<String> = told.iter().map(u32::to_string).collect();
    let told = match told.as_slice() {
        [] => return None,
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    };
    let more = if others.is_empty() { String::new() } else { format!(" and {} more", others.len()) };
    Some(format!(
        "At these readings, waves of {told} times per turn{more} look the same. Measure between them to decide."
    ))
}

/// `about x`, `along z`, `about x and y`.
fn axis(dof: &str) -> String {
    let words: Vec<&str> = dof.split(", ").collect();
    let turns = words.iter().all(|word| word.starts_with('R'));
    let axes: Vec<String> = words.iter().map(|word| word[1..].to_owned()).collect();
    format!("{} {}", if turns { "about" } else { "along" }, axes.join(" and "))
}

/// `turns about x`, `shifts along z`.
pub(super) fn moves(dof: &str) -> String {
    format!("{} {}", if dof.starts_with('R') { "turns" } else { "shifts" }, axis(dof))
}

/// Where an effect sits: `a rotation about x in the body middle, after its joint beta`.
#[must_use]
pub fn place(effect: &EffectFound, diagnosis: &Diagnosis) -> String {
    if let Some(sight) = &effect.bends {
        return format!("a bending of the line of sight {sight}, between the instrument and its target");
    }
    let joints: Vec<&str> = diagnosis
        .instrument
        .bodies
        .iter()
        .filter(|body| body.name == effect.body)
        .flat_map(|body| &body.joints)
        .map(|joint| joint.name.as_str())
        .collect();
    let side = match (joints.as_slice(), effect.side) {
        ([], _) => String::new(),
        (joints, Side::Before) => format!(", before its joint {}", joints.join(" and ")),
        (joints, Side::After) => format!(", after its joint {}", joints.join(" and ")),
    };
    format!("a {} in {}{side}", motion(&effect.dof), body_in_words(&effect.body))
}

/// `rotation about x`, `translation along z`.
#[must_use]
pub fn motion(dof: &str) -> String {
    format!("{} {}", if dof.contains('R') { "rotation" } else { "translation" }, axis(dof))
}

/// What happens by chance less often than this hardly does.
pub(super) const CHANCE: f64 = 0.011;

/// How sure it is: `very unlikely to be chance (p ≤ 0.001), found in 10 of 10 repeats`.
#[must_use]
pub fn chance_of(effect: &EffectFound, diagnosis: &Diagnosis) -> String {
    let words = if effect.p_value < 0.0015 {
        "very unlikely to be chance"
    } else if effect.p_value < CHANCE {
        "unlikely to be chance"
    } else {
        "could be chance"
    };
    let sure = format!("{words} ({})", numbers::chance(effect.p_value));
    match diagnosis.search.map(|search| search.folds) {
        Some(folds) if folds > 1 => {
            // A share of a few folds, rounded to the number it came from.
            let times = (effect.selected_in_folds * folds as f64).round();
            let times = match (times > 0.0, 2.0 * times < folds as f64) {
                (false, _) => "none".to_owned(),
                (true, true) => format!("only {times}"),
                (true, false) => times.to_string(),
            };
            format!("{sure}, found in {times} of {folds} repeats")
        }
        _ => sure,
    }
}

/// How sure effects are, of which the first is named first: that one and the least sure of all. None where there is none.
#[must_use]
pub fn chance_of_all(effects: &[&EffectFound], diagnosis: &Diagnosis) -> Option<String> {
    let [first, others @ ..] = effects else { return None };
    let surest = chance_of(first, diagnosis);
    let unsure = |a: &EffectFound, b: &EffectFound| {
        let by_chance = a.p_value.total_cmp(&b.p_value);
        by_chance.then(b.selected_in_folds.total_cmp(&a.selected_in_folds))
    };
    let Some(least) = others.iter().max_by(|a, b| unsure(a, b)) else { return Some(surest) };
    let told = chance_of(least, diagnosis);
    Some(match told == surest {
        true => format!("each {}", predicate(&surest)),
        false => {
            let [surest, told] = [surest, told].map(|chance| predicate(&chance));
            format!("the largest effect {surest}. The least sure, {}, {told}", least.names[0])
        }
    })
}

/// `is unlikely to be chance`, but `could be chance`.
fn predicate(chance: &str) -> String {
    if chance.starts_with("could") { chance.to_owned() } else { format!("is {chance}") }
}

/// The evidence for an effect, and what cannot be separated from it, a line each.
#[must_use]
pub fn evidence(effect: &EffectFound, diagnosis: &Diagnosis) -> Vec<String> {
    let mut lines = Vec::new();
    for (name, &value) in &effect.coefficients {
        let found = diagnosis.errors.iter().find(|error| error.name == *name);
        let told = found.map_or_else(
            || format!("{value:?}"),
            |error| match error.standard_uncertainty {
                Some(sigma) => numbers::estimate(error.value, sigma, error.unit),
                None => format!("{}, determined only together with others", numbers::told(value, error.unit)),
            },
        );
        lines.push(format!("{name} = {told}"));
    }
    lines.push(format!(
        "moves {} by at most {}, {} RMS",
        effect.amplitude_of,
        numbers::told(effect.amplitude, effect.amplitude_unit),
        numbers::told(effect.amplitude_rms, effect.amplitude_unit)
    ));
    lines.push(chance_of(effect, diagnosis));
    lines.extend(bias(effect, diagnosis));
    if !effect.confounded_with.is_empty() {
        lines.push(format!(
            "these data cannot separate this effect from {}",
            effect.confounded_with.join(", or ")
        ));
    }
    if !effect.competing_with.is_empty() {
        let others: Vec<String> = effect.competing_with.iter().map(|names| names.join(" or ")).collect();
        lines.push(format!("fits these data nearly equally: {}", others.join(", or ")));
    }
    lines
}

/// What its uncertainty adds to declared errors; `None` if nothing.
#[must_use]
pub fn bias(effect: &EffectFound, diagnosis: &Diagnosis) -> Option<String> {
    let added: Vec<String> = largest(&effect.bias)
        .into_iter()
        .filter_map(|(name, shift)| {
            let error = diagnosis.errors.iter().find(|error| error.name == name)?;
            Some(format!("{} to {name}", numbers::told(shift, error.unit)))
        })
        .collect();
    (!added.is_empty())
        .then(|| format!("the uncertainty of this effect adds to other errors: {}", added.join(", ")))
}

/// The errors that move most, largest first.
pub(super) fn largest(moved: &BTreeMap<String, f64>) -> Vec<(&str, f64)> {
    let mut moved: Vec<(&str, f64)> = moved.iter().map(|(name, &shift)| (name.as_str(), shift)).collect();
    moved.sort_by(|a, b| b.1.total_cmp(&a.1));
    moved.truncate(NAMED);
    moved
}
