//! An answer of a command as a value.

use model_core::escape::Screen;
use serde_json::Value;

/// An answer for reading, and the same for programs.
#[derive(Debug, Clone, PartialEq)]
pub struct Told {
    /// For reading.
    pub text: String,
    /// For programs.
    pub json: Value,
}

/// A text without the colours of a terminal.
pub fn plain(text: &Screen) -> String {
    anstream::adapter::strip_str(text.as_str()).to_string()
}
