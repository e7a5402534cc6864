//! SI numbers as people tell them: arcseconds, degrees, micrometres, with as many digits as mean something.

use std::f64::consts::PI;

/// A unit for reading, with its size in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// As it is printed; empty for a plain number.
    pub name: &'static str,
    /// Its size in rad, m or 1.
    pub in_si: f64,
}

/// The unit in which a number of this size is told; `unit` is `rad`, `m` or `1`.
#[must_use]
pub fn reading(unit: &str, largest: f64) -> Reading {
    match unit {
        "rad" if largest < PI / 180.0 => Reading { name: "arcsec", in_si: PI / 648_000.0 },
        "rad" => Reading { name: "deg", in_si: PI / 180.0 },
        "m" if largest < 1e-4 => Reading { name: "µm", in_si: 1e-6 },
        "m" if largest < 1.0 => Reading { name: "mm", in_si: 1e-3 },
        "m" => Reading { name: "m", in_si: 1.0 },
        _ => Reading { name: "", in_si: 1.0 },
    }
}

/// A number with its unit, to three significant digits or more where they stand before the point.
#[must_use]
pub fn told(value: f64, unit: &str) -> String {
    let reading = reading(unit, value.abs());
    with_unit(&digits(value / reading.in_si, 2), reading)
}

/// An estimate and its standard uncertainty, to two significant digits of the latter.
#[must_use]
pub fn estimate(value: f64, uncertainty: f64, unit: &str) -> String {
    let reading = reading(unit, value.abs().max(uncertainty));
    let (value, uncertainty) = (value / reading.in_si, uncertainty / reading.in_si);
    let places = if uncertainty > 0.0 { decimals(uncertainty, 1) } else { decimals(value, 3) };
    with_unit(&format!("{value:.places$} ± {uncertainty:.places$}"), reading)
}

/// A reading's name with its unit, as it stands beside an axis or above a column.
#[must_use]
pub fn name_with_unit(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.to_owned() } else { format!("{name}, {unit}") }
}

/// A chance, told as none below what can be told.
#[must_use]
pub fn chance(p: f64) -> String {
    if p <= 0.001 { "at most 0.001".to_owned() } else { format!("{p:.3}") }
}

/// Where structure was looked for, if not in every row: ` in a sample of 6336 of 100000 rows`.
pub fn sampled(rows: usize, of: usize) -> String {
    if rows < of { format!(" in a sample of {rows} of {of} rows") } else { String::new() }
}

fn with_unit(number: &str, reading: Reading) -> String {
    format!("{number} {}", reading.name).trim_end().to_owned()
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
        assert_eq!(told(2.8284 * arcsec, "rad"), "2.83 arcsec");
        assert_eq!(told(-0.5, "rad"), "-28.6 deg");
        assert_eq!(told(3.14159e-4, "m"), "0.314 mm");
        assert_eq!(told(2e-5, "m"), "20.0 µm");
        assert_eq!(told(0.0, "rad"), "0.0 arcsec");
        assert_eq!(told(1.5, "1"), "1.50");
        assert_eq!(estimate(21.043 * arcsec, 0.1431 * arcsec, "rad"), "21.04 ± 0.14 arcsec");
        assert_eq!(estimate(-3e-4, 4.2e-5, "m"), "-0.300 ± 0.042 mm");
        assert_eq!(chance(2e-4), "at most 0.001");
    }
}
