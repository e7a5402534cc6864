//! Quantities with a unit, as study files, errors files, headers of data and the command line write them:
//! `2 arcsec`, `0.1 mm`, `30 deg`, `1e-6 rad`.
//!
//! Inside, angles are radians and lengths metres; this is the edge where they become so.

mod plausible;

use std::f64::consts::PI;

use model_core::Quantity;
use serde::{Deserialize, Serialize};
use thiserror::Error;

pub use plausible::{BareColumn, Doubt, Plausible};

/// A unit of angle, of length or of nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// As it is written: `arcsec`.
    pub name: &'static str,
    /// What it measures.
    pub quantity: Quantity,
    /// Its size in rad, m or 1.
    pub in_si: f64,
}

/// Every unit that is read.
const UNITS: &[Unit] = &[
    angle("rad", 1.0),
    angle("mrad", 1e-3),
    angle("urad", 1e-6),
    angle("µrad", 1e-6),
    angle("nrad", 1e-9),
    angle("deg", PI / 180.0),
    angle("°", PI / 180.0),
    angle("arcmin", PI / 10_800.0),
    angle("′", PI / 10_800.0),
    angle("arcsec", PI / 648_000.0),
    angle("″", PI / 648_000.0),
    angle("mas", PI / 648_000_000.0),
    angle("gon", PI / 200.0),
    angle("mgon", PI / 200_000.0),
    angle("hour", PI / 12.0),
    angle("turn", 2.0 * PI),
    length("m", 1.0),
    length("km", 1e3),
    length("dm", 0.1),
    length("cm", 1e-2),
    length("mm", 1e-3),
    length("um", 1e-6),
    length("µm", 1e-6),
    length("nm", 1e-9),
    length("inch", 0.0254),
    length("ft", 0.3048),
    number("1", 1.0),
    number("%", 1e-2),
    number("ppm", 1e-6),
    number("ppb", 1e-9),
];

/// What some write for a unit, and what to write instead: the nearest of so few letters may be another unit.
const MEANT: &[(&[&str], &str)] = &[
    (&["\"", "''", "as", "asec", "sec", "arcseconds"], "did you mean `arcsec`?"),
    (&["'", "am", "amin", "min", "arcminutes"], "did you mean `arcmin`?"),
    (&["s"], "write arcsec for a second of arc; a second of time is 15 arcsec"),
    (&["h", "hr", "hrs", "hours"], "did you mean `hour`, of which a turn has 24?"),
    (&["d", "degree", "degrees"], "did you mean `deg`?"),
    (&["g", "grad", "grads"], "did you mean `gon`?"),
    (&["r", "radian", "radians"], "did you mean `rad`?"),
    (&["metre", "metres", "meter", "meters"], "did you mean `m`?"),
    (&["in"], "did you mean `inch`?"),
];

/// Letters from which on a unit is suggested because it is written alike.
const ALIKE: usize = 3;

const fn angle(name: &'static str, in_si: f64) -> Unit {
    Unit { name, quantity: Quantity::Angle, in_si }
}

const fn length(name: &'static str, in_si: f64) -> Unit {
    Unit { name, quantity: Quantity::Length, in_si }
}

const fn number(name: &'static str, in_si: f64) -> Unit {
    Unit { name, quantity: Quantity::Number, in_si }
}

impl Unit {
    /// Every unit that is read.
    pub fn all() -> impl Iterator<Item = Self> {
        UNITS.iter().copied()
    }

    /// The unit of this name.
    #[must_use]
    pub fn find(name: &str) -> Option<Self> {
        UNITS.iter().find(|unit| unit.name == name).copied()
    }

    /// The unit of this name.
    ///
    /// # Errors
    /// No unit has this name; the message suggests the nearest, and what there is.
    pub fn parse(name: &str) -> Result<Self, UnitError> {
        Self::find(name).ok_or_else(|| UnitError::Unknown { name: name.to_string(), help: instead_of(name) })
    }
}

/// What to write instead of what is no unit.
fn instead_of(name: &str) -> String {
    let written = name.to_lowercase();
    if let Some((_, instead)) = MEANT.iter().find(|(names, _)| names.contains(&written.as_str())) {
        return (*instead).to_string();
    }
    let alike = || model_core::names::nearest(name, UNITS.iter().map(|unit| unit.name));
    // Upper and lower case alone tell MM from mm.
    let is_long = name.chars().count() >= ALIKE || alike().is_some_and(|near| near.to_lowercase() == written);
    match alike().filter(|_| is_long) {
        Some(near) => format!("did you mean `{near}`?"),
        None => "write rad, deg, arcmin, arcsec, m, mm or um".to_string(),
    }
}

/// A number with the unit that was written with it, if one was.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amount {
    /// The number as written.
    pub number: f64,
    /// The unit as written; none means SI.
    pub unit: Option<Unit>,
}

/// Why a quantity could not be read.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum UnitError {
    /// No number at the start.
    #[error("`{text}` does not start with a number: write a number and a unit, as in \"2 arcsec\"")]
    NoNumber {
        /// What was written.
        text: String,
    },
    /// The number is infinite or not a number.
    #[error("`{text}` is not finite")]
    NotFinite {
        /// What was written.
        text: String,
    },
    /// The unit is none.
    #[error("`{name}` is no unit: {help}")]
    Unknown {
        /// What was written.
        name: String,
        /// What to write instead.
        help: String,
    },
    /// The unit measures something else.
    #[error("`{unit}` measures {measures}, but {wanted} is wanted: write {help}")]
    WrongQuantity {
        /// The unit.
        unit: &'static str,
        /// What it measures.
        measures: &'static str,
        /// What is wanted.
        wanted: &'static str,
        /// Units that would do.
        help: &'static str,
    },
}

impl Amount {
    /// Reads `2 arcsec`, `0.1mm`, or a bare number (SI).
    ///
    /// # Errors
    /// No number, a number that is not finite, or an unknown unit.
    pub fn parse(text: &str) -> Result<Self, UnitError> {
        let trimmed = text.trim();
        let end = number_length(trimmed);
        let number: f64 = trimmed
            .get(..end)
            .and_then(|digits| digits.parse().ok())
            .ok_or_else(|| UnitError::NoNumber { text: trimmed.to_string() })?;
        if !number.is_finite() {
            return Err(UnitError::NotFinite { text: trimmed.to_string() });
        }
        let unit = match trimmed.get(end..).map_or("", str::trim) {
            "" => None,
            name => Some(Unit::parse(name)?),
        };
        Ok(Self { number, unit })
    }

    /// The amount in rad, m or 1.
    ///
    /// # Errors
    /// The unit measures something else.
    pub fn to_si(self, quantity: Quantity) -> Result<f64, UnitError> {
        match self.unit {
            None => Ok(self.number),
            Some(unit) if unit.quantity == quantity => Ok(self.number * unit.in_si),
            Some(unit) => Err(UnitError::WrongQuantity {
                unit: unit.name,
                measures: noun(unit.quantity),
                wanted: noun(quantity),
                help: match quantity {
                    Quantity::Angle => "rad, deg, arcmin or arcsec",
                    Quantity::Length => "m, mm or um",
                    Quantity::Number => "a number without a unit, % or ppm",
                },
            }),
        }
    }
}

/// Reads a quantity into rad, m or 1: `2 arcsec`, or a bare number in SI.
///
/// # Errors
/// No number, an unknown unit, or a unit of something else.
pub fn parse(text: &str, quantity: Quantity) -> Result<f64, UnitError> {
    Amount::parse(text)?.to_si(quantity)
}

/// How such a quantity is written, for messages.
#[must_use]
pub fn example(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Angle => "\"2 arcsec\"",
        Quantity::Length => "\"0.1 mm\"",
        Quantity::Number => "\"3 ppm\" or 0.5",
    }
}

/// Length of the number at the start of a text, its exponent included.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |mut at: usize| {
        while bytes.get(at).is_some_and(|byte| byte.is_ascii_digit() || *byte == b'.') {
            at += 1;
        }
        at
    };
    let sign = |at: usize| at + usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let mantissa = digits(sign(0));
    if matches!(bytes.get(mantissa), Some(b'e' | b'E')) {
        let start = sign(mantissa + 1);
        let end = digits(start);
        if end > start {
            return end;
        }
    }
    mantissa
}

fn noun(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Angle => "an angle",
        Quantity::Length => "a length",
        Quantity::Number => "a number",
    }
}

impl<'de> Deserialize<'de> for Amount {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl serde::de::Visitor<'_> for Visitor {
            type Value = Amount;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("a number (SI) or a quantity with its unit, as in \"2 arcsec\"")
            }

            fn visit_f64<E: serde::de::Error>(self, number: f64) -> Result<Amount, E> {
                if number.is_finite() {
                    Ok(Amount { number, unit: None })
                } else {
                    Err(E::custom(UnitError::NotFinite { text: number.to_string() }))
                }
            }

            fn visit_i64<E: serde::de::Error>(self, number: i64) -> Result<Amount, E> {
                // Whole numbers that a person writes in a file are far below 2^53.
                #[allow(clippy::cast_precision_loss)]
                self.visit_f64(number as f64)
            }

            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Amount, E> {
                Amount::parse(text).map_err(E::custom)
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

impl Serialize for Amount {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.unit {
            None => serializer.serialize_f64(self.number),
            Some(unit) => serializer.collect_str(&format_args!("{} {}", self.number, unit.name)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn quantities_become_si() -> Result<(), UnitError> {
        for (text, quantity, expected) in [
            ("2 arcsec", Quantity::Angle, 9.696_273_622_190_721e-6),
            ("30 deg", Quantity::Angle, 0.523_598_775_598_298_8),
            ("-30°", Quantity::Angle, -0.523_598_775_598_298_8),
            ("1e-6 rad", Quantity::Angle, 1e-6),
            ("30.66″", Quantity::Angle, 30.66 * PI / 648_000.0),
            ("2 ′", Quantity::Angle, 2.0 * PI / 10_800.0),
            ("0.1 mm", Quantity::Length, 1e-4),
            ("0.1mm", Quantity::Length, 1e-4),
            (" +5e2um ", Quantity::Length, 5e-4),
            ("3 ppm", Quantity::Number, 3e-6),
            (".25", Quantity::Length, 0.25),
        ] {
            assert_relative_eq!(parse(text, quantity)?, expected, max_relative = 1e-15);
        }
        Ok(())
    }

    /// A suggestion that is taken changes no number by a factor that nobody notices.
    #[test]
    fn no_other_unit_is_suggested_for_few_letters() {
        for (written, instead) in [
            ("\"", "did you mean `arcsec`?"),
            ("as", "did you mean `arcsec`?"),
            ("h", "did you mean `hour`, of which a turn has 24?"),
            ("s", "write arcsec for a second of arc; a second of time is 15 arcsec"),
            ("x", "write rad, deg, arcmin, arcsec, m, mm or um"),
            ("ym", "write rad, deg, arcmin, arcsec, m, mm or um"),
            ("MM", "did you mean `mm`?"),
            ("Degrees", "did you mean `deg`?"),
            ("arcsecs", "did you mean `arcsec`?"),
        ] {
            assert_eq!(instead_of(written), instead, "{written}");
        }
    }

    #[test]
    fn what_is_no_quantity_is_refused_with_what_to_write() {
        let message = |text, quantity| parse(text, quantity).map_err(|error| error.to_string());
        insta::assert_debug_snapshot!([
            message("arcsec", Quantity::Angle),
            message("2 arcsecs", Quantity::Angle),
            message("2 furlong", Quantity::Length),
            message("2 mm", Quantity::Angle),
            message("2 deg", Quantity::Number),
            message("1e999 m", Quantity::Length),
            message("", Quantity::Length),
        ]);
    }
}
