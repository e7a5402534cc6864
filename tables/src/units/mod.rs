//! Quantities with a unit, as study files, errors files, headers of data and the command line write them:
//! `2 arcsec`, `0.1 mm`, `30 deg`, `1e-6 rad`.
//!
//! Inside, angles are radians and lengths metres; this is the edge where they become so.

mod plausible;

use model_core::Quantity;
use model_core::unit::{Measures, Unit, UnitError};
use serde::{Deserialize, Serialize};
use thiserror::Error;

pub use plausible::{BareColumn, Doubt, Plausible};

/// A number with the unit that was written with it, if one was.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amount {
    /// The number as written.
    pub number: f64,
    /// The unit as written; none means SI.
    pub unit: Option<Unit>,
}

/// Why a quantity could not be read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum AmountError {
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
    /// The unit is none, or of something else.
    #[error(transparent)]
    Unit(#[from] UnitError),
}

impl Amount {
    /// Reads `2 arcsec`, `0.1mm`, or a bare number (SI).
    ///
    /// # Errors
    /// No number, a number that is not finite, or an unknown unit.
    pub fn parse(text: &str) -> Result<Self, AmountError> {
        Self::read(text, None)
    }

    /// The same of what is known to be measured: `s` is a second of time, or of arc.
    fn read(text: &str, measures: Option<Measures>) -> Result<Self, AmountError> {
        let trimmed = text.trim();
        let end = number_length(trimmed);
        let number: f64 = trimmed
            .get(..end)
            .and_then(|digits| digits.parse().ok())
            .ok_or_else(|| AmountError::NoNumber { text: trimmed.to_string() })?;
        if !number.is_finite() {
            return Err(AmountError::NotFinite { text: trimmed.to_string() });
        }
        let unit = match trimmed.get(end..).map_or("", str::trim) {
            "" => None,
            name => Some(Unit::read(name, measures)?),
        };
        Ok(Self { number, unit })
    }

    /// The amount in SI: rad, m or 1 of a quantity.
    ///
    /// # Errors
    /// The unit measures something else.
    pub fn to_si(self, wanted: impl Into<Measures>) -> Result<f64, UnitError> {
        self.unit.map_or(Ok(self.number), |unit| Ok(self.number * unit.factor(wanted.into())?))
    }
}

/// Reads a quantity into rad, m or 1: `2 arcsec`, or a bare number in SI.
///
/// # Errors
/// No number, an unknown unit, or a unit of something else.
pub fn parse(text: &str, quantity: Quantity) -> Result<f64, AmountError> {
    Ok(Amount::parse(text)?.to_si(quantity)?)
}

/// Reads a time into seconds: `0.1 s`, `2 min`, or a bare number.
///
/// # Errors
/// As [`parse`].
pub fn parse_time(text: &str) -> Result<f64, AmountError> {
    Ok(Amount::read(text, Some(Measures::Time))?.to_si(Measures::Time)?)
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
                    Err(E::custom(AmountError::NotFinite { text: number.to_string() }))
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
            Some(unit) => serializer.collect_str(&format_args!("{} {}", self.number, unit.name())),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn quantities_become_si() -> Result<(), AmountError> {
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

    #[test]
    fn what_is_no_quantity_is_refused_with_what_to_write() {
        let message = |text, quantity| parse(text, quantity).map_err(|error| error.to_string());
        insta::assert_debug_snapshot!([
            message("arcsec", Quantity::Angle),
            message("2 arcsecz", Quantity::Angle),
            message("2 h", Quantity::Angle),
            message("2 mil", Quantity::Length),
            message("20 °C", Quantity::Angle),
            message("2 furlong", Quantity::Length),
            message("2 mm", Quantity::Angle),
            message("2 deg", Quantity::Number),
            message("1e999 m", Quantity::Length),
            message("", Quantity::Length),
        ]);
    }
}
