//! Declared errors in words: one table, one unit for each kind of quantity, those that the study wants first, then by size.

use super::numbers::{self, Reading};
use calibration::diagnose::{AtZero, BesideFunction, Diagnosis, ErrorFound, Estimable};
use observe::SiUnit;

/// A line of the table of estimates.
#[derive(Debug, Clone, PartialEq)]
pub struct EstimateLine {
    /// The error, or a combination of errors: `da1 + dtheta_x3`.
    pub what: String,
    /// `27.30 ± 0.10″`
    pub estimate: String,
    /// Whether an accepted effect brought it.
    pub found: bool,
    /// Whether it is a combination.
    pub combined: bool,
    /// Whether the study wants it first.
    pub wanted: bool,
}

/// The table of estimates, and what these data do not determine.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimates {
    /// Every error and combination that these data determine.
    pub lines: Vec<EstimateLine>,
    /// What they do not, a sentence each.
    pub notes: Vec<String>,
}

/// Every estimable error and combination with its value.
#[must_use]
pub fn estimates(diagnosis: &Diagnosis) -> Estimates {
    let units = Units::of(diagnosis);
    let effects: Vec<&String> =
        diagnosis.effects.iter().flat_map(|effect| effect.coefficients.keys()).collect();
    let single = diagnosis.errors.iter().filter(|error| error.separable).map(|error| {
        let line = EstimateLine {
            what: error.name.clone(),
            estimate: match error.standard_uncertainty {
                Some(sigma) => {
                    with_causes(error.value, sigma, error.moves_by_cause, &units.reading(error.unit))
                }
                None => numbers::told_in(error.value, &units.reading(error.unit)),
            },
            found: effects.contains(&&error.name),
            combined: false,
            wanted: diagnosis.wanted.contains(&error.name),
        };
        (place(diagnosis, [error.name.as_str()].into_iter()), error.over_noise, line)
    });
    let combined = diagnosis.estimable.iter().map(|estimable| {
        let names = || estimable.combination.iter().map(|part| part.error.as_str());
        let line = EstimateLine {
            what: combination(estimable),
            estimate: with_causes(
                estimable.value,
                estimable.standard_uncertainty,
                estimable.moves_by_cause,
                &units.reading(estimable.unit),
            ),
            found: false,
            combined: true,
            wanted: names().any(|name| diagnosis.wanted.iter().any(|own| own == name)),
        };
        (place(diagnosis, names()), estimable.over_noise, line)
    });
    let mut lines: Vec<(usize, f64, EstimateLine)> = single.chain(combined).collect();
    lines.sort_by(|one, other| one.0.cmp(&other.0).then(other.1.total_cmp(&one.1)));
    let lines = lines.into_iter().map(|(_, _, line)| line).collect();
    Estimates { lines, notes: notes(diagnosis) }
}

/// Where the first of some errors that the study wants stands among those; behind all of them where it wants none.
fn place<'a>(diagnosis: &Diagnosis, names: impl Iterator<Item = &'a str>) -> usize {
    let own = names.filter_map(|name| diagnosis.wanted.iter().position(|own| own == name));
    own.min().unwrap_or(diagnosis.wanted.len())
}

fn with_causes(value: f64, uncertainty: f64, moves: Option<[f64; 2]>, reading: &Reading) -> String {
    match moves {
        Some(moves) => numbers::by_cause_in(value, uncertainty, moves, reading),
        None => numbers::estimate_in(value, uncertainty, reading),
    }
}

/// What these data do not determine.
fn notes(diagnosis: &Diagnosis) -> Vec<String> {
    let mut notes = still(diagnosis);
    notes.extend(held(diagnosis));
    let errors = diagnosis.errors.iter().filter_map(|error| error.moves_by_cause);
    let combinations = diagnosis.estimable.iter().filter_map(|estimable| estimable.moves_by_cause);
    if errors.chain(combinations).next().is_some() {
        notes.push(
            "by cause: range over the candidate causes. The ± assumes the cause written to the amended declaration"
                .to_owned(),
        );
    }
    notes.extend(diagnosis.at_zero.iter().map(at_zero));
    notes.extend(diagnosis.beside_functions.iter().map(beside_function));
    for set in &diagnosis.not_separable {
        let told = diagnosis
            .estimable
            .iter()
            .any(|estimable| estimable.combination.iter().all(|part| set.contains(&part.error)));
        if !told {
            notes.push(format!("these data cannot separate {}", sorted(set).join(", ")));
        }
    }
    notes.extend(not_shown(diagnosis));
    notes
}

/// The errors that the written model does without.
fn held(diagnosis: &Diagnosis) -> Option<String> {
    let ladder = diagnosis.ladder.as_ref()?;
    let held: Vec<String> = ladder.above(ladder.written).into_iter().map(str::to_owned).collect();
    (!held.is_empty()).then(|| {
        format!("not estimated, since a simpler model predicts better: {}", sorted(&held).join(", "))
    })
}

/// Columns whose readings do not change: what they would show these data cannot.
fn still(diagnosis: &Diagnosis) -> Vec<String> {
    let rows = diagnosis.observations.rows;
    let is_still = |range: [f64; 2]| rows > 1 && range[0] == range[1];
    let readings = diagnosis.instrument.readings.iter().filter(|reading| is_still(reading.range));
    readings.map(|reading| format!("`{}` is the same in all rows", reading.name)).collect()
}

/// `index is the value at air = 0. These data have 18.2 to 24.1`
fn at_zero(AtZero { errors, input, from, to, unit }: &AtZero) -> String {
    // A temperature may be in degrees Celsius, which only differences are in kelvin of.
    let unit = if *unit == SiUnit::KELVIN { SiUnit::ONE } else { *unit };
    let own = numbers::reading(unit, from.abs().max(to.abs()));
    let are = if errors.len() == 1 { "is the value" } else { "are the values" };
    format!(
        "{} {are} at {input} = 0. These data have {} to {}",
        sorted(errors).join(", "),
        numbers::told_in(*from, &own),
        numbers::told_in(*to, &own)
    )
}

/// `range_zero is the value where the function found (powers, of range in beam along y) is zero. …`
fn beside_function(BesideFunction { errors, function }: &BesideFunction) -> String {
    let are = if errors.len() == 1 { "is the value" } else { "are the values" };
    format!(
        "{} {are} where the function found ({function}) is zero. A function with another zero gives another value",
        sorted(errors).join(", ")
    )
}

/// The declared errors that these data do not show, in a sentence; `None` if they show all.
#[must_use]
pub fn not_shown(diagnosis: &Diagnosis) -> Option<String> {
    let hidden: Vec<String> =
        diagnosis.errors.iter().filter(|error| !error.shown).map(|error| error.name.clone()).collect();
    (!hidden.is_empty()).then(|| format!("not shown by these data: {}", sorted(&hidden).join(", ")))
}

/// The errors that the study wants and these data do not show, in a sentence; `None` if they show all.
#[must_use]
pub fn wanted_not_shown(diagnosis: &Diagnosis) -> Option<String> {
    let hidden = |name: &&String| diagnosis.errors.iter().any(|error| error.name == **name && !error.shown);
    let hidden: Vec<String> = diagnosis.wanted.iter().filter(hidden).cloned().collect();
    (!hidden.is_empty()).then(|| format!("Not shown by these data: {}.", hidden.join(", ")))
}

/// `da1 + dtheta_x3`, `a − 1/2·b`
pub(super) fn combination(estimable: &Estimable) -> String {
    let mut text = String::new();
    for part in &estimable.combination {
        let (sign, size) = match part.ratio.strip_prefix('-') {
            Some(size) => ("−", size),
            None => ("+", part.ratio.as_str()),
        };
        if text.is_empty() {
            text.push_str(if sign == "−" { "−" } else { "" });
        } else {
            text.push_str(&format!(" {sign} "));
        }
        if size != "1" {
            text.push_str(&format!("{size}·"));
        }
        text.push_str(&part.error);
    }
    text
}

/// The unit of each kind of quantity in one table: that in which half of its values are told.
struct Units(Vec<(SiUnit, Reading)>);

impl Units {
    fn of(diagnosis: &Diagnosis) -> Self {
        let mut kinds: Vec<(SiUnit, Vec<f64>)> = Vec::new();
        let single =
            diagnosis.errors.iter().filter(|error| error.separable).map(|e: &ErrorFound| (e.unit, e.value));
        let combined = diagnosis.estimable.iter().map(|e| (e.unit, e.value));
        for (unit, value) in single.chain(combined) {
            match kinds.iter_mut().find(|(known, _)| *known == unit) {
                Some((_, values)) => values.push(value.abs()),
                None => kinds.push((unit, vec![value.abs()])),
            }
        }
        let typical = |(unit, mut values): (SiUnit, Vec<f64>)| {
            values.sort_by(f64::total_cmp);
            (unit, numbers::reading(unit, values[values.len() / 2]))
        };
        Self(kinds.into_iter().map(typical).collect())
    }

    fn reading(&self, unit: SiUnit) -> Reading {
        let known = self.0.iter().find(|(known, _)| *known == unit);
        known.map_or_else(|| numbers::reading(unit, 1.0), |(_, reading)| reading.clone())
    }
}

fn sorted(names: &[String]) -> Vec<String> {
    let mut names = names.to_vec();
    names.sort_by_key(|name| natural(name));
    names
}

/// A key by which `a2` comes before `a10`.
fn natural(name: &str) -> Vec<(String, u64)> {
    let mut parts: Vec<(String, u64)> = vec![(String::new(), 0)];
    let mut in_number = false;
    for letter in name.chars() {
        let digit = letter.to_digit(10).map(u64::from);
        if in_number && digit.is_none() {
            parts.push((String::new(), 0));
        }
        in_number = digit.is_some();
        if let Some((text, number)) = parts.last_mut() {
            match digit {
                Some(digit) => *number = number.saturating_mul(10).saturating_add(digit),
                None => text.push(letter),
            }
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use calibration::diagnose::Part;

    #[test]
    fn two_comes_before_ten() {
        let names = ["a10", "a2", "a", "b1", "a2_x"].map(str::to_owned);
        assert_eq!(sorted(&names), ["a", "a2", "a2_x", "a10", "b1"]);
    }

    #[test]
    fn a_combination_reads_as_one_would_write_it() {
        let part = |error: &str, ratio: &str| Part { error: error.into(), ratio: ratio.into() };
        let sum = |combination| Estimable {
            combination,
            value: 0.0,
            standard_uncertainty: 0.0,
            moves_by_cause: None,
            over_noise: 0.0,
            unit: SiUnit::RAD,
            degrees_of_freedom: 1.0,
        };
        assert_eq!(combination(&sum(vec![part("da1", "1"), part("dtheta_x3", "1")])), "da1 + dtheta_x3");
        assert_eq!(combination(&sum(vec![part("a", "-1"), part("b", "-1/2")])), "−a − 1/2·b");
    }
}
