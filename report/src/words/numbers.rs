//! SI numbers as people read them: arcseconds, degrees, micrometres, with as many digits as mean something.

use std::f64::consts::PI;

use model_core::unit::Unit;
use observe::SiUnit;

/// A unit for reading, with its size in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// As it is printed; empty for a plain number.
    pub name: String,
    /// Its size in SI.
    pub in_si: f64,
}

/// The unit in which a number of this size is told.
#[must_use]
pub fn reading(unit: SiUnit, largest: f64) -> Reading {
    let (base, per) = unit.split();
    let largest = largest.abs();
    let name = match base {
        SiUnit::RAD if largest < PI / 180.0 => "″",
        SiUnit::RAD => "°",
        SiUnit::METRE if largest < 1e-4 => "µm",
        SiUnit::METRE if largest < 1.0 => "mm",
        SiUnit::METRE => "m",
        SiUnit::PIXEL => "px",
        _ if per == SiUnit::ONE && largest < 1e-3 && largest > 0.0 => "ppm",
        _ => "",
    };
    let in_si = Unit::find(name).map_or(1.0, Unit::in_si);
    let per = match per {
        SiUnit::ONE => String::new(),
        per if name.is_empty() => per.to_string(),
        per => per.to_string().trim_start_matches('1').to_owned(),
    };
    Reading { name: format!("{name}{per}"), in_si }
}

/// A number with its unit, to three significant digits or more where they stand before the point.
#[must_use]
pub fn told(value: f64, unit: SiUnit) -> String {
    let reading = reading(unit, value);
    with_unit(&digits(value / reading.in_si, 2), &reading)
}

/// A number with its unit, as short as a headline needs it: two digits, three after a leading one.
#[must_use]
pub fn short(value: f64, unit: SiUnit) -> String {
    let reading = reading(unit, value);
    let value = value / reading.in_si;
    with_unit(&digits(value, leading(value)), &reading)
}

/// How many digits a headline has beside the first.
fn leading(value: f64) -> i32 {
    let first = if value == 0.0 { 0.0 } else { value.abs() / 10_f64.powf(value.abs().log10().floor()) };
    if first < 2.0 { 2 } else { 1 }
}

/// An estimate and its standard uncertainty, to two significant digits of the latter.
#[must_use]
pub fn estimate(value: f64, uncertainty: f64, unit: SiUnit) -> String {
    estimate_in(value, uncertainty, &reading(unit, value.abs().max(uncertainty)))
}

/// The same in a unit that is given: one table, one unit.
#[must_use]
pub fn estimate_in(value: f64, uncertainty: f64, reading: &Reading) -> String {
    let (value, uncertainty) = (value / reading.in_si, uncertainty / reading.in_si);
    let places = if uncertainty > 0.0 { decimals(uncertainty, 1) } else { decimals(value, 3) };
    with_unit(&format!("{value:.places$} ± {uncertainty:.places$}"), reading)
}

/// An estimate that depends on which cause is the true one: how far it would move, down and up, as the range of its values.
#[must_use]
pub fn by_cause(value: f64, uncertainty: f64, moves: [f64; 2], unit: SiUnit) -> String {
    let [low, high] = moves.map(|own| value + own);
    let largest = [value, uncertainty, low, high].map(f64::abs).into_iter().fold(0.0, f64::max);
    by_cause_in(value, uncertainty, moves, &reading(unit, largest))
}

/// The same in a unit that is given.
#[must_use]
pub fn by_cause_in(value: f64, uncertainty: f64, moves: [f64; 2], reading: &Reading) -> String {
    let places = decimals(uncertainty / reading.in_si, 1);
    let [low, high] = moves.map(|own| format!("{:.places$}", (value + own) / reading.in_si));
    let range = with_unit(&format!("{low} to {high}"), reading);
    format!("{} ({range} by cause)", estimate_in(value, uncertainty, reading))
}

/// A number with the unit that is given, to three significant digits.
#[must_use]
pub fn told_in(value: f64, reading: &Reading) -> String {
    with_unit(&digits(value / reading.in_si, 2), reading)
}

/// A reading's name with its unit, as it is printed beside an axis or above a column.
#[must_use]
pub fn name_with_unit(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.to_owned() } else { format!("{name}, {unit}") }
}

/// A chance: `p ≤ 0.001`, `p = 0.042`.
#[must_use]
pub fn chance(p: f64) -> String {
    if p < 0.0015 { "p ≤ 0.001".to_owned() } else { format!("p = {p:.3}") }
}

/// How many times: `2.6 times`, `about ten times`.
#[must_use]
pub fn times(ratio: f64) -> String {
    match ratio {
        ratio if (9.5..10.5).contains(&ratio) => "about ten times".to_owned(),
        ratio if ratio < 9.5 => format!("{ratio:.1} times"),
        ratio => format!("{ratio:.0} times"),
    }
}

fn with_unit(number: &str, reading: &Reading) -> String {
    let number = number.replace('-', "−");
    match reading.name.chars().next() {
        None => number,
        Some('″' | '°') => format!("{number}{}", reading.name),
        Some(_) => format!("{number} {}", reading.name),
    }
}

/// A number to `more` digits beside its first.
fn digits(value: f64, more: i32) -> String {
    if value != 0.0 && !(1e-6..1e9).contains(&value.abs()) {
        return format!("{value:.2e}");
    }
    let places = decimals(value, more);
    format!("{value:.places$}")
}

/// Decimal places that show `more` digits beside the first.
fn decimals(value: f64, more: i32) -> usize {
    if value == 0.0 || !value.is_finite() {
        return 1;
    }
    let first = value.abs().log10().floor();
    // Between −300 and 300: no digit is lost.
    #[allow(clippy::cast_possible_truncation)]
    let places = more - first as i32;
    usize::try_from(places).unwrap_or(0).min(12)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_told_in_the_unit_of_their_size() {
        let arcsec = PI / 648_000.0;
        assert_eq!(told(2.8284 * arcsec, SiUnit::RAD), "2.83″");
        assert_eq!(told(-0.5, SiUnit::RAD), "−28.6°");
        assert_eq!(told(3.14159e-4, SiUnit::METRE), "0.314 mm");
        assert_eq!(told(2e-5, SiUnit::METRE), "20.0 µm");
        assert_eq!(told(0.0, SiUnit::RAD), "0.0″");
        assert_eq!(told(1.5, SiUnit::ONE), "1.50");
        assert_eq!(told(1.5e-5, SiUnit::ONE), "15.0 ppm");
        assert_eq!(told(3.0 * arcsec, SiUnit::RAD.per(SiUnit::KELVIN)), "3.00″/K");
        assert_eq!(told(2e-3, SiUnit::METRE.per(SiUnit::RAD)), "2.00 mm/rad");
        assert_eq!(told(0.25, SiUnit::METRE.power(-1)), "0.250 1/m");
        assert_eq!(estimate(21.043 * arcsec, 0.1431 * arcsec, SiUnit::RAD), "21.04 ± 0.14″");
        assert_eq!(estimate(-3e-4, 4.2e-5, SiUnit::METRE), "−0.300 ± 0.042 mm");
        assert_eq!(short(10.13 * arcsec, SiUnit::RAD), "10.1″");
        assert_eq!(short(7.73 * arcsec, SiUnit::RAD), "7.7″");
        assert_eq!(chance(2e-4), "p ≤ 0.001");
    }
}
