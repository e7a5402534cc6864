//! What a word of a GSI line says: its index, and its data in the unit that it states.
//!
//! Source: Leica Geosystems, GSI Online for TPS and DNA; Total Open Station, `leica_gsi`: positions 1 to 3 are the index, position 6 the
//! unit, position 7 the sign, and 8 or 16 letters of data follow.

/// The foot, m.
///
/// Source: international yard and pound agreement (1959).
const FOOT_M: f64 = 0.3048;

/// A word.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Word<'t> {
    /// What it is of.
    pub index: &'t str,
    unit: u8,
    is_negative: bool,
    /// Its data without the sign.
    pub data: &'t str,
}

impl<'t> Word<'t> {
    /// Reads a word.
    ///
    /// # Errors
    /// What it lacks.
    pub fn of(text: &'t str) -> Result<Self, String> {
        let bad = |why: &str| Err(format!("`{}` {why}", super::clipped(text)));
        if !text.is_ascii() || !matches!(text.len(), 15 | 23) {
            return bad(
                "is no word of GSI: an index, a unit and a sign in 7 letters, then 8 or 16 letters of data; was the line cut off?",
            );
        }
        let (head, data) = text.split_at(7);
        let index = head.get(..2).unwrap_or_default();
        let &[.., unit, sign] = head.as_bytes() else { return bad("has no sign before its data") };
        let is_index = index.bytes().all(|letter| letter.is_ascii_digit());
        if !is_index || !matches!(sign, b'+' | b'-') {
            return bad(
                "is no word of GSI: it begins with an index of two digits, and its seventh letter is a sign",
            );
        }
        // Those of three digits are of levels and of the atmosphere.
        let three = head.get(..3).unwrap_or_default();
        let has_three = matches!(index, "33" | "37" | "39" | "53" | "56" | "57" | "59" | "91");
        let index =
            if has_three && three.bytes().all(|letter| letter.is_ascii_digit()) { three } else { index };
        Ok(Self { index, unit, is_negative: sign == b'-', data })
    }

    /// Its data as text, without the zeros in front.
    pub fn label(&self) -> &'t str {
        match self.data.trim_start_matches('0') {
            "" => "0",
            label => label,
        }
    }

    /// Digits as a number times a step.
    fn number(&self, step: f64) -> Result<f64, String> {
        let digits = self.data.bytes().all(|letter| letter.is_ascii_digit());
        let number: Option<f64> = self.data.parse().ok().filter(|_| digits);
        let number = number.ok_or_else(|| format!("`{}` holds no digits for a number", self.data))?;
        Ok(if self.is_negative { -number * step } else { number * step })
    }

    /// An angle, degrees.
    ///
    /// # Errors
    /// Minutes or seconds that are none, or a unit of something else.
    pub fn angle_deg(&self) -> Result<f64, String> {
        match self.unit {
            b'2' => self.number(1e-5 * 0.9),
            b'3' => self.number(1e-5),
            b'4' => self.sexagesimal_deg(),
            b'5' => self.number(1e-4 * 360.0 / 6400.0),
            other => Err(format!(
                "unit {} of an angle is none: 2 is gon, 3 degrees, 4 degrees with minutes and seconds, 5 mil",
                char::from(other)
            )),
        }
    }

    /// Degrees, minutes and tenths of seconds: 123 45 67.8 are 12345678.
    fn sexagesimal_deg(&self) -> Result<f64, String> {
        let tenths = self.number(1.0)?.abs();
        let (degrees, rest) = ((tenths / 1e5).trunc(), tenths % 1e5);
        let (minutes, seconds) = ((rest / 1e3).trunc(), rest % 1e3 / 10.0);
        // 60.0 seconds are what rounding makes of 59.96.
        if minutes >= 60.0 || seconds > 60.0 {
            return Err(format!(
                "`{}` has {minutes} minutes and {seconds} seconds: write numbers below 60",
                self.data
            ));
        }
        let size = degrees + minutes / 60.0 + seconds / 3600.0;
        Ok(if self.is_negative { -size } else { size })
    }

    /// A length, m.
    ///
    /// # Errors
    /// No digits, or a unit of something else.
    pub fn length_m(&self) -> Result<f64, String> {
        match self.unit {
            b'0' => self.number(1e-3),
            b'1' => self.number(1e-3 * FOOT_M),
            b'6' => self.number(1e-4),
            b'7' => self.number(1e-4 * FOOT_M),
            b'8' => self.number(1e-5),
            other => Err(format!(
                "unit {} of a length is none: 0, 6 and 8 are metres, 1 and 7 feet",
                char::from(other)
            )),
        }
    }

    /// Whether it is in feet.
    pub fn is_in_feet(&self) -> bool {
        matches!(self.unit, b'1' | b'7')
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_the_manual_are_read() {
        let word = |text: &'static str| Word::of(text);
        let near = |found: Result<f64, String>, expected: f64| {
            assert!(
                found.as_ref().is_ok_and(|found| (found - expected).abs() < 1e-9),
                "{found:?} {expected}"
            );
        };
        near(word("21.102+17920860").and_then(|word| word.angle_deg()), 179.2086 * 0.9);
        near(word("22.103+07567500").and_then(|word| word.angle_deg()), 75.675);
        near(word("21.104+12345308").and_then(|word| word.angle_deg()), 123.0 + 45.0 / 60.0 + 30.8 / 3600.0);
        near(word("21.105+16000000").and_then(|word| word.angle_deg()), 90.0);
        near(word("31..00+00003387").and_then(|word| word.length_m()), 3.387);
        near(word("31..06+0000000000033871").and_then(|word| word.length_m()), 3.3871);
        near(word("31..01+00001000").and_then(|word| word.length_m()), 0.3048);
        near(word("82..00-00213159").and_then(|word| word.length_m()), -213.159);
        assert_eq!(word("110001+0000H66X").map(|word| (word.index, word.label())), Ok(("11", "H66X")));
        assert_eq!(word("331.08+00012345").map(|word| word.index), Ok("331"));
    }

    #[test]
    fn what_is_no_word_says_why() {
        for (text, why) in [
            ("21.102+1792086", "was the line cut off?"),
            ("21.102 179208600", "was the line cut off?"),
            ("2x.102+17920860", "an index of two digits"),
            ("21.102017920860", "its seventh letter is a sign"),
            ("21.102+1792°860", "is no word of GSI"),
        ] {
            assert!(Word::of(text).is_err_and(|said| said.contains(why)), "{text}");
        }
        for (text, why) in [
            ("21.104+12360000", "60 minutes"),
            ("21.104+12359601", "60.1 seconds"),
            ("21.102+1792A860", "holds no digits"),
            ("21.100+17920860", "unit 0 of an angle"),
        ] {
            let said = Word::of(text).and_then(|word| word.angle_deg());
            assert!(said.as_ref().is_err_and(|said| said.contains(why)), "{text} {said:?}");
        }
    }
}
