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

/// An answer: the mark, and items of which each is read by itself. What it leaves out counts as not answered.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Answer {
    /// The mark of the sheet.
    pub mark: String,
    #[serde(flatten)]
    items: toml::Table,
}

/// The items of an answer.
const ITEMS: [&str; 6] = ["causes", "reading", "sentence", "size", "error", "prediction"];

/// Why an answer cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum AnswerError {
    /// Longer than any answer.
    #[error("`answer.toml` has more than {LONGEST} bytes")]
    TooLong,
    /// A mistake of TOML, or no mark.
    #[error("`answer.toml` cannot be read: {0}")]
    Mistake(String),
}

/// Why an item of an answer cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ItemError {
    /// No list of words.
    #[error("`causes` is no list of words: write it as `causes = [\"wobble\", \"first_oval\"]`")]
    Causes,
    /// A reading that the sheet does not list.
    #[error("`{0}` is no reading of the sheet")]
    Reading(String),
    /// No number of a sentence.
    #[error("`sentence` is no whole number: write it as `sentence = 2`")]
    Sentence,
    /// No number with its uncertainty.
    #[error("`{0}` is no number with its ±: write it as `{0} = {{ value = 12.3, uncertainty = 0.4 }}`")]
    Number(&'static str),
}

impl Answer {
    /// Reads an answer.
    ///
    /// # Errors
    /// It is too long, is no TOML, or has no mark.
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

    /// Keys that no answer has.
    #[must_use]
    pub fn unknown(&self) -> Vec<String> {
        self.items.keys().filter(|key| !ITEMS.contains(&key.as_str())).map(|key| clipped(key)).collect()
    }

    /// The causes, each with those that the student does not choose between; none for a word that the sheet does not list.
    ///
    /// # Errors
    /// The value is not a list of words.
    pub fn causes(&self) -> Result<Vec<Vec<Option<Cause>>>, ItemError> {
        let words = self.cause_words()?;
        let set = |entry: &&str| {
            let mut set: Vec<Option<Cause>> = entry.split(" or ").map(cause).collect();
            set.sort_unstable();
            set.dedup();
            set
        };
        Ok(words.iter().map(set).collect())
    }

    /// The words that the sheet does not list.
    #[must_use]
    pub fn no_causes(&self) -> Vec<String> {
        let words = self.cause_words().unwrap_or_default();
        let words = words.iter().flat_map(|entry| entry.split(" or "));
        words.filter(|word| cause(word).is_none()).map(|word| clipped(word.trim())).collect()
    }

    fn cause_words(&self) -> Result<Vec<&str>, ItemError> {
        let Some(causes) = self.items.get("causes") else { return Ok(Vec::new()) };
        let words = causes.as_array().and_then(|list| list.iter().map(toml::Value::as_str).collect());
        words.ok_or(ItemError::Causes)
    }

    /// How the student read the columns.
    ///
    /// # Errors
    /// A word that the sheet does not list.
    pub fn reading(&self) -> Result<Reading, ItemError> {
        let Some(reading) = self.items.get("reading") else { return Ok(Reading::AsLabelled) };
        let word = reading.as_str().map_or_else(|| reading.to_string(), str::to_owned);
        Reading::of_word(&plain(&word)).ok_or_else(|| ItemError::Reading(clipped(&word)))
    }

    /// The number of a sentence.
    ///
    /// # Errors
    /// It is no whole number.
    pub fn sentence(&self) -> Result<Option<i64>, ItemError> {
        let read = |value: &toml::Value| value.as_integer().ok_or(ItemError::Sentence);
        self.items.get("sentence").map(read).transpose()
    }

    /// A number: `size`, `error` or `prediction`.
    ///
    /// # Errors
    /// It is no number with an uncertainty.
    pub fn number(&self, name: &'static str) -> Result<Option<Number>, ItemError> {
        let read = |value: &toml::Value| value.clone().try_into().map_err(|_| ItemError::Number(name));
        self.items.get(name).map(read).transpose()
    }
}

/// The cause that a student means.
fn cause(word: &str) -> Option<Cause> {
    Cause::of_word(&plain(word))
}

/// A word as a sheet has it, however its letters and gaps are written.
fn plain(word: &str) -> String {
    word.trim().to_lowercase().replace([' ', '-'], "_")
}
