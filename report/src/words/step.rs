//! A step of what to do next.

/// Something to do.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// What, in a few words.
    pub title: String,
    /// Why and how.
    pub text: String,
    /// A command line that does it.
    pub command: Option<String>,
}
