//! What a study says of how its files are written, and how much memory their rows may take.

use toml::Spanned;

use super::mistakes::{Gathered, Outcome, mistake};
use super::written::Study;
use tables::formats::Options;

impl Study {
    /// How the data files are read.
    pub(super) fn format(&self) -> Outcome<Options> {
        let character = |written: &Option<Spanned<char>>, what: &str, example: &str, not: &[u8]| {
            let Some(character) = written else { return Ok(None) };
            match u8::try_from(*character.get_ref()) {
                Ok(byte) if byte.is_ascii() && !not.contains(&byte) => Ok(Some(byte)),
                _ => Err(mistake(
                    character.span(),
                    format!("no such {what}"),
                    format!("write one ASCII character, such as \"{example}\""),
                )),
            }
        };
        let mut mistakes = Gathered::default();
        let separator = mistakes.take(character(&self.separator, "separator", ";", b"\"#\r\n"));
        let comment =
            mistakes.take(character(&self.comment, "mark of a comment", "#", b"\" \t\r\n+-.0123456789"));
        let memory_bytes = match &self.memory {
            None => Some(Options::default().memory_bytes),
            Some(written) => mistakes.take(memory(written.get_ref()).ok_or_else(|| {
                mistake(written.span(), "this is no amount of memory", "write memory = \"8 GiB\"")
            })),
        };
        mistakes.none()?;
        let (Some(separator), Some(comment), Some(memory_bytes)) = (separator, comment, memory_bytes) else {
            unreachable!("what is missing comes with a mistake")
        };
        Ok(Options { separator, comment, memory_bytes })
    }
}

/// `8 GiB` or `500 MiB`, in bytes.
fn memory(text: &str) -> Option<u64> {
    let digits = text.trim_end_matches(|letter: char| !letter.is_ascii_digit());
    let shift = match text.get(digits.len()..)?.trim() {
        "GiB" => 30,
        "MiB" => 20,
        _ => return None,
    };
    let number: u64 = digits.parse().ok()?;
    number.checked_mul(1 << shift).filter(|bytes| *bytes > 0)
}
