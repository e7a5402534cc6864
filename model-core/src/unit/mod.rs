//! Units as people write them: in declarations, headers of data, study files, errors files and on the command line. There is one
//! table of them, `table`, and one way to read a spelling, [`Unit::read`].

mod table;

use std::f64::consts::PI;

use thiserror::Error;

use crate::algebra::{Poly, Rational};
use crate::names::nearest;
use crate::symbol::{Meaning, Quantity, Symbol, SymbolId};

use table::{TWO_MEANINGS, UNITS};

/// What a unit measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measures {
    /// An angle, SI: rad.
    Angle,
    /// A length, SI: m.
    Length,
    /// A plain number.
    Number,
    /// A temperature, SI: K, or °C, which differs by a constant.
    Temperature,
    /// A time, SI: s.
    Time,
    /// A pressure, SI: Pa.
    Pressure,
}

impl From<Quantity> for Measures {
    fn from(quantity: Quantity) -> Self {
        match quantity {
            Quantity::Angle => Self::Angle,
            Quantity::Length => Self::Length,
            Quantity::Number => Self::Number,
        }
    }
}

impl Measures {
    /// What the numbers of a joint, error, constant or input measure.
    #[must_use]
    pub fn of(symbol: &Symbol) -> Self {
        match symbol.meaning {
            Some(Meaning::Temperature) => Self::Temperature,
            Some(Meaning::Time) => Self::Time,
            Some(Meaning::Pressure) => Self::Pressure,
            _ => symbol.quantity.into(),
        }
    }

    /// What amounts see of it.
    #[must_use]
    pub fn quantity(self) -> Quantity {
        match self {
            Self::Angle => Quantity::Angle,
            Self::Length => Quantity::Length,
            Self::Number | Self::Temperature | Self::Time | Self::Pressure => Quantity::Number,
        }
    }

    /// `an angle`
    #[must_use]
    pub fn noun(self) -> &'static str {
        match self {
            Self::Angle => "an angle",
            Self::Length => "a length",
            Self::Number => "a number",
            Self::Temperature => "a temperature",
            Self::Time => "a time",
            Self::Pressure => "a pressure",
        }
    }

    /// Whether only the meaning of an input says that numbers measure it.
    #[must_use]
    pub fn needs_meaning(self) -> bool {
        matches!(self, Self::Temperature | Self::Time | Self::Pressure)
    }
}

/// A unit.
#[derive(Clone, Copy)]
pub struct Unit {
    name: &'static str,
    measures: Measures,
    /// The same, written out.
    words: &'static [&'static str],
    /// Signs and short forms, which a name of something else may end in.
    signs: &'static [&'static str],
    numerator: i64,
    denominator: i64,
    /// Whether the size is a multiple of π.
    of_pi: bool,
    /// Whether its zero is not that of SI, nor of °C.
    zero_is_shifted: bool,
}

impl std::fmt::Debug for Unit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Unit({})", self.name)
    }
}

impl PartialEq for Unit {
    fn eq(&self, other: &Self) -> bool {
        (self.name, self.measures) == (other.name, other.measures)
    }
}

impl Eq for Unit {}

/// Spellings with two meanings.
struct TwoMeanings {
    spellings: &'static [&'static str],
    meanings: &'static str,
    instead: &'static str,
}

/// Why a text is no unit of what is wanted.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum UnitError {
    /// No unit is written so.
    #[error("`{text}` is no unit: {help}")]
    Unknown {
        /// What was written.
        text: String,
        /// What to write instead.
        help: String,
    },
    /// It could be either of two.
    #[error("`{text}` is {meanings}: {instead}")]
    TwoMeanings {
        /// What was written.
        text: String,
        /// Both meanings.
        meanings: &'static str,
        /// What to write for each.
        instead: &'static str,
    },
    /// The unit measures something else.
    #[error("`{unit}` measures {}, but {} is wanted: write {help}", measures.noun(), wanted.noun())]
    WrongMeasure {
        /// The unit.
        unit: &'static str,
        /// What it measures.
        measures: Measures,
        /// What is wanted.
        wanted: Measures,
        /// Units that would do.
        help: &'static str,
    },
    /// Its zero is another, so that no factor takes it to SI.
    #[error(
        "`{unit}` counts from another zero than °C: write the temperatures in °C, which are (F - 32)*5/9"
    )]
    ShiftedZero {
        /// The unit.
        unit: &'static str,
    },
}

impl Unit {
    /// Every unit that is read.
    pub fn all() -> impl Iterator<Item = Self> {
        UNITS.iter().copied()
    }

    /// The unit that a text is, whatever is measured; none if it is no unit, or could be two.
    #[must_use]
    pub fn find(text: &str) -> Option<Self> {
        Self::read(text, None).ok()
    }

    /// The unit that a text is, where something is measured that the reader may know.
    ///
    /// # Errors
    /// No unit is written so, or two are; the message names both, or what there is.
    pub fn read(text: &str, wanted: Option<Measures>) -> Result<Self, UnitError> {
        let own = wanted.filter(|wanted| wanted.needs_meaning());
        if let Some(unit) = own.and_then(|wanted| spelled(text, |unit| unit.measures == wanted)) {
            return Ok(unit);
        }
        let is_one = |two: &&TwoMeanings| two.spellings.iter().any(|spelling| is_spelled(text, spelling));
        if let Some(&TwoMeanings { meanings, instead, .. }) = TWO_MEANINGS.iter().find(is_one) {
            return Err(UnitError::TwoMeanings { text: text.to_owned(), meanings, instead });
        }
        // An hour of angle is a unit of its own; that of time is one where a time is declared.
        let usual = spelled(text, |unit| !unit.measures.needs_meaning());
        usual
            .or_else(|| spelled(text, |unit| unit.measures.needs_meaning()))
            .ok_or_else(|| UnitError::Unknown { text: text.to_owned(), help: instead_of(text, wanted) })
    }

    /// The unit that a name ends in, behind its last underscore: `az_deg`. One letter is more often part of the name (`pos_m`, the
    /// m-th position) than a unit, and so are signs and short forms (`pos_in`).
    #[must_use]
    pub fn behind_name(name: &str) -> Option<(&str, Self)> {
        let (stem, text) = name.rsplit_once('_')?;
        let unit = Self::find(text).filter(|unit| !unit.measures.needs_meaning())?;
        let is_sign = text.len() == 1 || unit.signs.iter().any(|sign| is_spelled(text, sign));
        (!is_sign || !text.is_ascii()).then_some((stem, unit))
    }

    /// As it is written: `arcsec`.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.name
    }

    /// Every way to write it, its name first.
    pub fn spellings(self) -> impl Iterator<Item = &'static str> {
        [self.name].into_iter().chain(self.words.iter().chain(self.signs).copied())
    }

    /// What it measures.
    #[must_use]
    pub fn measures(self) -> Measures {
        self.measures
    }

    /// Its size in SI: rad, m, 1, K, s or Pa.
    #[must_use]
    pub fn in_si(self) -> f64 {
        // Both are far below 2^53.
        #[allow(clippy::cast_precision_loss)]
        let [numerator, denominator] = [self.numerator as f64, self.denominator as f64];
        (if self.of_pi { numerator * PI } else { numerator }) / denominator
    }

    /// The factor that takes numbers of this unit to SI, where something is measured.
    ///
    /// # Errors
    /// The unit measures something else, or counts from another zero.
    pub fn factor(self, wanted: Measures) -> Result<f64, UnitError> {
        let unit = self.name;
        if self.measures != wanted {
            return Err(UnitError::WrongMeasure {
                unit,
                measures: self.measures,
                wanted,
                help: usual(wanted),
            });
        }
        if self.zero_is_shifted { Err(UnitError::ShiftedZero { unit }) } else { Ok(self.in_si()) }
    }

    /// A number of this unit in SI (rad or m), exactly.
    #[must_use]
    pub fn amount(self, number: &Rational) -> Poly {
        let whole = Poly::constant(number * &Rational::from(self.numerator));
        let Some(size) = Rational::new(1, self.denominator) else {
            unreachable!("the table of units has no denominator that is zero")
        };
        let amount = whole.scale(&size);
        if self.of_pi { &amount * &Poly::symbol(SymbolId::PI) } else { amount }
    }
}

/// Letters from which on upper and lower case are one, and a unit is suggested because it is written alike.
const ALIKE: usize = 3;

/// Whether a text is a spelling. In short ones upper and lower case make another unit: mm and Mm, h and H.
fn is_spelled(text: &str, spelling: &str) -> bool {
    text == spelling || (text.chars().count() >= ALIKE && text.to_lowercase() == spelling.to_lowercase())
}

/// The unit among some that has a spelling.
fn spelled(text: &str, among: impl Fn(&Unit) -> bool) -> Option<Unit> {
    let mut units = Unit::all().filter(among);
    units.find(|unit| unit.spellings().any(|spelling| is_spelled(text, spelling)))
}

/// What to write instead of what is no unit.
fn instead_of(text: &str, wanted: Option<Measures>) -> String {
    let among = || Unit::all().filter(|unit| wanted.is_none_or(|wanted| unit.measures == wanted));
    let near = nearest(text, among().flat_map(Unit::spellings));
    let near =
        near.filter(|near| text.chars().count() >= ALIKE || near.to_lowercase() == text.to_lowercase());
    let near = near.and_then(|near| among().find(|unit| unit.spellings().any(|own| own == near)));
    let names = || among().map(|unit| unit.name).collect::<Vec<_>>().join(", ");
    match (near, wanted) {
        (Some(near), Some(wanted)) => {
            format!("did you mean `{}`? The units of {} are {}", near.name, wanted.noun(), names())
        }
        (Some(near), None) => format!("did you mean `{}`?", near.name),
        (None, Some(wanted)) => format!("the units of {} are {}", wanted.noun(), names()),
        (None, None) => "write rad, deg, arcmin, arcsec, m, mm or um".to_owned(),
    }
}

/// The units of something that are written most often.
fn usual(wanted: Measures) -> &'static str {
    match wanted {
        Measures::Angle => "rad, deg, arcmin or arcsec",
        Measures::Length => "m, mm or um",
        Measures::Number => "a number without a unit, % or ppm",
        Measures::Temperature => "K or °C",
        Measures::Time => "s, min, h or day",
        Measures::Pressure => "Pa, hPa or mbar",
    }
}

#[cfg(test)]
mod tests;
