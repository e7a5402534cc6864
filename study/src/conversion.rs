//! How the numbers of a column become readings: packed notation, sign, offset and a shift by rows.

use std::f64::consts::{PI, TAU};

use model_core::unit::Measures;
use toml::Spanned;

use super::amount::si;
use super::mistakes::{Outcome, mistake};
use super::written::Column;

/// The largest shift by rows that a study may ask for.
const MOST_SHIFT: i64 = 1000;

/// Decimal digits that binary holds.
const DIGITS: i32 = 15;

/// A number rounded to some significant decimal digits.
pub(super) fn to_digits(number: f64, digits: i32) -> f64 {
    if number == 0.0 || !number.is_finite() {
        return number;
    }
    let scale = 10_f64.powi(digits - number.abs().log10().ceil() as i32);
    let rounded = (number * scale).round() / scale;
    if rounded.is_finite() { rounded } else { number }
}

/// How digits stand for an angle where that is no unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Notation {
    /// Degrees before the point, then two digits of minutes, then seconds: 12.3456 is 12° 34′ 56″.
    Degrees,
    /// Hours, minutes and seconds as one number: 123456.7 is 12 h 34 min 56.7 s.
    Hours,
    /// Counts of an encoder, with the number of counts a turn.
    Counts(f64),
}

impl Notation {
    /// As a study writes it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Degrees => "ddd.mmss",
            Self::Hours => "hhmmss",
            Self::Counts(_) => "counts",
        }
    }

    /// The angle in rad, and whether its minutes and seconds are below 60.
    #[must_use]
    pub fn unpack(self, number: f64) -> (f64, bool) {
        // Sexagesimal digits are decimal ones: what binary cannot hold is rounded away before they are cut apart.
        let decimal = to_digits(number.abs(), DIGITS);
        let (whole, unit) = match self {
            Self::Degrees => (decimal * 1e4, PI / 180.0),
            Self::Hours => (decimal, PI / 12.0),
            Self::Counts(per_turn) => return (number / per_turn * TAU, true),
        };
        let large = (whole / 1e4 + 1e-12).floor();
        let rest = whole - large * 1e4;
        let minutes = (rest / 100.0 + 1e-10).floor();
        let seconds = (rest - minutes * 100.0).max(0.0);
        let angle_rad = (large + minutes / 60.0 + seconds / 3600.0) * unit;
        (angle_rad.copysign(number), minutes < 60.0 && seconds < 60.0)
    }

    /// The number that says an angle, rad, to the hundred-millionth of a second that [`Self::unpack`] reads.
    #[must_use]
    pub fn pack(self, angle_rad: f64) -> f64 {
        let (unit, step) = match self {
            Self::Degrees => (PI / 180.0, 1e-4),
            Self::Hours => (PI / 12.0, 1.0),
            Self::Counts(per_turn) => return angle_rad / TAU * per_turn,
        };
        let seconds = (angle_rad.abs() / unit * 3600.0 * 1e8).round() / 1e8;
        let (large, rest) = ((seconds / 3600.0).floor(), seconds.rem_euclid(3600.0));
        let minutes = (rest / 60.0).floor();
        let packed = large * 1e4 + minutes * 100.0 + (rest - minutes * 60.0);
        // To the digits that are known, so that no binary fraction is written out.
        let digits = 1e8 / step;
        ((packed * step * digits).round() / digits).copysign(angle_rad)
    }
}

/// What is done to the numbers of a column: unpacked, turned round, moved, and taken from other rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conversion {
    /// Digits that are degrees or hours, minutes and seconds.
    pub notation: Option<Notation>,
    /// Whether the sign is turned round.
    pub negated: bool,
    /// What is added after that, rad, m or 1.
    pub offset_si: f64,
    /// A row takes the reading of the row that stands so many before it.
    pub shift: i64,
}

impl Conversion {
    /// Readings are the numbers as they stand.
    pub const NONE: Self = Self { notation: None, negated: false, offset_si: 0.0, shift: 0 };

    /// What a study writes of a column.
    pub(super) fn of(column: &Column, measures: Measures) -> Outcome<Self> {
        let negated = match column.sign.as_ref().map(|sign| (*sign.get_ref(), sign.span())) {
            None | Some((1, _)) => false,
            Some((-1, _)) => true,
            Some((other, span)) => {
                return Err(mistake(span, format!("`sign` is {other}"), "write 1 or -1"));
            }
        };
        let offset_si = match &column.offset {
            None => 0.0,
            Some(offset) => si(offset.get_ref(), measures, &offset.span())?,
        };
        let notation = column.notation.as_ref().map(|word| notation(word, column, measures)).transpose()?;
        let counts = column.counts_per_turn.as_ref().map(|per_turn| counts(per_turn, column, measures));
        let notation = notation.or(counts.transpose()?);
        let shift = match &column.shift {
            None => 0,
            Some(shift) if shift.get_ref().abs() <= MOST_SHIFT => *shift.get_ref(),
            Some(shift) => {
                let help = format!("write a number of rows from -{MOST_SHIFT} to {MOST_SHIFT}");
                return Err(mistake(shift.span(), format!("`shift` is {}", shift.get_ref()), help));
            }
        };
        Ok(Self { notation, negated, offset_si, shift })
    }

    /// A reading of a number times its unit, rad, m or 1; the number of a packed notation comes without a unit.
    #[must_use]
    pub fn value(&self, number: f64) -> f64 {
        let plain = self.notation.map_or(number, |notation| notation.unpack(number).0);
        (if self.negated { -plain } else { plain }) + self.offset_si
    }

    /// What stands in the file for a reading, rad, m or 1, before its notation: the inverse of [`Self::value`] up to
    /// [`Self::packed`].
    #[must_use]
    pub fn plain(&self, reading: f64) -> f64 {
        let plain = reading - self.offset_si;
        if self.negated { -plain } else { plain }
    }

    /// The same in the notation of the column; `in_si` is the size of its unit where it has one.
    #[must_use]
    pub fn packed(&self, plain: f64, in_si: f64) -> f64 {
        self.notation.map_or(plain / in_si, |notation| notation.pack(plain))
    }
}

fn notation(word: &Spanned<String>, column: &Column, measures: Measures) -> Outcome<Notation> {
    let known = [Notation::Degrees, Notation::Hours];
    let Some(notation) = known.into_iter().find(|own| own.name() == word.get_ref().to_lowercase()) else {
        let why = format!("`{}` is an unknown notation", word.get_ref());
        return Err(mistake(word.span(), why, "write \"ddd.mmss\" or \"hhmmss\""));
    };
    if measures != Measures::Angle {
        return Err(mistake(word.span(), "only an angle has minutes and seconds", "leave `notation` out"));
    }
    if column.unit.is_some() {
        let why = format!("`notation = \"{}\"` is a unit already", notation.name());
        return Err(mistake(word.span(), why, "leave `unit` out"));
    }
    Ok(notation)
}

fn counts(per_turn: &Spanned<f64>, column: &Column, measures: Measures) -> Outcome<Notation> {
    let wrong = |why: &str, help: &str| Err(mistake(per_turn.span(), why, help));
    if measures != Measures::Angle {
        return wrong("only an angle has turns", "leave `counts_per_turn` out");
    }
    if column.unit.is_some() || column.notation.is_some() {
        return wrong("`counts_per_turn` is a unit already", "leave `unit` and `notation` out");
    }
    if !(per_turn.get_ref().is_finite() && *per_turn.get_ref() >= 1.0) {
        return wrong("an encoder has at least one count a turn", "write a number such as 65536");
    }
    Ok(Notation::Counts(*per_turn.get_ref()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_digits_are_cut_apart_where_they_are_decimal() {
        // 53° 07′ 25.28847717436″, with the digits of a file.
        let (angle_rad, is_sexagesimal) = Notation::Degrees.unpack(53.072528847717436);
        approx::assert_abs_diff_eq!(
            angle_rad.to_degrees(),
            53.0 + 7.0 / 60.0 + 25.28847717436 / 3600.0,
            epsilon = 1e-12
        );
        assert!(is_sexagesimal);
        // What binary holds as 12.3399999… has 34 minutes.
        let (angle_rad, _) = Notation::Degrees.unpack(-12.34);
        approx::assert_abs_diff_eq!(angle_rad.to_degrees(), -(12.0 + 34.0 / 60.0), epsilon = 1e-12);
        let (angle_rad, _) = Notation::Hours.unpack(123_456.7);
        let hours = 12.0 + 34.0 / 60.0 + 56.7 / 3600.0;
        approx::assert_abs_diff_eq!(angle_rad.to_degrees(), 15.0 * hours, epsilon = 1e-10);
        assert!(!Notation::Degrees.unpack(10.755).1);
        assert!(!Notation::Degrees.unpack(10.1575).1);
    }

    #[test]
    fn what_is_packed_is_unpacked() {
        for notation in [Notation::Degrees, Notation::Hours] {
            for angle_deg in [0.0, 12.582_5, -53.1, 359.999_999_999_9, 29.999_999_999_99, 1e-7] {
                let angle_rad = f64::to_radians(angle_deg);
                let (back, is_sexagesimal) = notation.unpack(notation.pack(angle_rad));
                // Half of a hundred-millionth of a second of time.
                approx::assert_abs_diff_eq!(back, angle_rad, epsilon = 4e-13);
                assert!(is_sexagesimal, "{angle_deg}");
            }
        }
        assert_eq!(Notation::Degrees.pack((12.0 + 34.0 / 60.0 + 56.0 / 3600.0) * PI / 180.0), 12.3456);
    }
}
