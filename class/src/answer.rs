//! What a student hands in, as read.

use model_core::escape::clipped;
use serde::Deserialize;

use crate::cause::Cause;
use crate::misread::Reading;

/// The longest answer that is read, bytes.
const LONGEST: usize = 1 << 16;

/// A number with its standard uncertainty, arc seconds.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Number {
    /// The value.
    pub value: f64,
    /// One standard uncertainty.
    pub uncertainty: f64,
}

/// An answer. What it leaves out counts as not answered.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answer {
    /// The mark of the sheet.
    pub mark: String,
    #[serde(default)]
    causes: Vec<String>,
    reading: Option<String>,
    /// The number of a sentence.
    pub sentence: Option<i64>,
    /// The size of the largest effect.
    pub size: Option<Number>,
    /// A declared error.
    pub error: Option<Number>,
    /// z of the error of the pointing at the asked pose.
    pub prediction: Option<Number>,
}

/// Why an answer cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum AnswerError {
    /// Longer than any answer.
    #[error("`answer.toml` has more than {LONGEST} bytes")]
    TooLong,
    /// A mistake of TOML, or a key that there is not.
    #[error("`answer.toml` cannot be read: {0}")]
    Mistake(String),
    /// A cause that the sheet does not list.
    #[error("`{0}` is no cause of the sheet")]
    NoCause(String),
    /// A reading that the sheet does not list.
    #[error("`{0}` is no reading of the sheet")]
    NoReading(String),
}

impl Answer {
    /// Reads an answer.
    ///
    /// # Errors
    /// It is too long, is no TOML, or has a key that there is not.
    pub fn of(text: &str) -> Result<Self, AnswerError> {
        if text.len() > LONGEST {
            return Err(AnswerError::TooLong);
        }
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        toml::from_str(text).map_err(|error| {
            let line = error.span().map(|span| text[..span.start].matches('\n').count() + 1);
            let place = line.map_or_else(String::new, |line| format!("line {line}: "));
            AnswerError::Mistake(format!("{place}{}", error.message().replace('\n', " ")))
        })
    }

    /// The causes, each with those that the student does not choose between.
    ///
    /// # Errors
    /// A word that the sheet does not list.
    pub fn causes(&self) -> Result<Vec<Vec<Cause>>, AnswerError> {
        let cause = |word: &str| {
            let word = word.trim();
            Cause::of_word(word).ok_or_else(|| AnswerError::NoCause(clipped(word)))
        };
        let set = |entry: &String| {
            let mut set: Vec<Cause> = entry.split(" or ").map(cause).collect::<Result<_, _>>()?;
            set.sort_unstable();
            set.dedup();
            Ok(set)
        };
        self.causes.iter().map(set).collect()
    }

    /// How the student read the columns.
    ///
    /// # Errors
    /// A word that the sheet does not list.
    pub fn reading(&self) -> Result<Reading, AnswerError> {
        let word = self.reading.as_deref().unwrap_or(Reading::AsLabelled.word()).trim();
        Reading::of_word(word).ok_or_else(|| AnswerError::NoReading(clipped(word)))
    }
}
