//! Why something could not be done: always something that the user can mend.

use model_core::Mistakes;
use model_core::escape::message;

/// Why something could not be done. `Display` is what the user reads.
#[derive(Debug, Clone, thiserror::Error)]
pub enum Refusal {
    /// Mistakes in a text, with their places; rendered with the lines they stand on.
    #[error("{rendered}")]
    Mistakes {
        /// As people read them.
        rendered: String,
        /// As programs do.
        mistakes: Mistakes,
    },
    /// Anything else, in words that say what to write instead.
    #[error("{}", message(.0))]
    Input(String),
}

impl Refusal {
    /// An error in its own words.
    #[must_use]
    pub fn of(error: impl std::error::Error) -> Self {
        Self::Input(error.to_string())
    }
}
