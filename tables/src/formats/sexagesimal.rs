//! Angles as sky and survey tables write them: `12 34 56.7`, `-00:30:00`, `12h34m56.7s`, `41° 16′ 9″`.
//!
//! Only a column whose unit is a degree or an hour of angle is read so: elsewhere the same letters are a time of day.

use std::f64::consts::PI;

/// The sizes in rad of the units that have minutes and seconds: a degree, and an hour of angle.
const UNITS: [f64; 2] = [PI / 180.0, PI / 12.0];

/// The number of a text in its unit, of whose size in SI it depends whether it has minutes and seconds; none where it is no such angle.
#[must_use]
pub fn sexagesimal(text: &str, in_si: f64) -> Option<f64> {
    // Sizes of units are products of others: to their last digit.
    if !UNITS.iter().any(|unit| (in_si / unit - 1.0).abs() < 1e-12) {
        return None;
    }
    let text = text.trim();
    let (is_negative, digits) = match text.chars().next()? {
        '-' | '\u{2212}' => (true, text.trim_start_matches(['-', '\u{2212}'])),
        '+' => (false, text.strip_prefix('+')?),
        _ => (false, text),
    };
    let is_between = |letter: char| {
        letter.is_whitespace()
            || matches!(letter, ':' | 'd' | 'h' | 'm' | 's' | '°' | '′' | '″' | '\'' | '"' | 'º' | '’' | '”')
    };
    // Minutes and seconds alone are no angle with all of its parts.
    let first = digits.trim_start_matches(|letter: char| letter.is_ascii_digit()).chars().next()?;
    if !is_between(first) || matches!(first, 'm' | 's' | '′' | '″' | '\'' | '"' | '’' | '”') {
        return None;
    }
    let parts: Vec<&str> = digits.split(is_between).filter(|part| !part.is_empty()).collect();
    let (last, whole) = match parts.as_slice() {
        [whole @ .., last] if (1..=2).contains(&whole.len()) => (*last, whole),
        _ => return None,
    };
    let is_number = |part: &str| part.bytes().all(|letter| letter.is_ascii_digit());
    let decimals = last.split('.').count();
    if !whole.iter().all(|part| is_number(part))
        || decimals > 2
        || !last.split('.').all(is_number)
        || last == "."
    {
        return None;
    }
    let mut sum = 0.0;
    for (at, part) in whole.iter().chain([&last]).enumerate() {
        let number: f64 = part.parse().ok()?;
        if at > 0 && number >= 60.0 {
            return None;
        }
        sum += number / 60_f64.powi(at as i32);
    }
    Some(if is_negative { -sum } else { sum })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_with_minutes_and_seconds_are_read() {
        let degree = UNITS[0];
        for (text, expected) in [
            ("12 34 56.7", 12.0 + 34.0 / 60.0 + 56.7 / 3600.0),
            ("-00:30:00", -0.5),
            ("+12h30m", 12.5),
            ("12h34m56.7s", 12.0 + 34.0 / 60.0 + 56.7 / 3600.0),
            ("41° 16′ 9″", 41.0 + 16.0 / 60.0 + 9.0 / 3600.0),
            ("−5 15.5", -5.0 - 15.5 / 60.0),
        ] {
            let read = sexagesimal(text, degree);
            assert!(read.is_some_and(|read| (read - expected).abs() < 1e-12), "{text}: {read:?}");
        }
    }

    #[test]
    fn what_is_none_is_not_guessed() {
        for text in [
            "",
            "-",
            "12",
            "12 60 00",
            "12 30 60.0",
            "1 2 3 4",
            "12.5 30",
            "12 ab 3",
            "1:2:.",
            "nan 1",
            "--",
            "30m15s",
            "30\u{2032} 15\u{2033}",
        ] {
            assert_eq!(sexagesimal(text, UNITS[0]), None, "{text}");
        }
        // A time of day.
        assert_eq!(sexagesimal("12:34:56", 1.0), None);
        assert!(sexagesimal("12:34:56", UNITS[1]).is_some());
    }
}
