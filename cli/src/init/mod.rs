//! A chain and a study to start from, out of what a table of data shows: its header, and the numbers below it.
//!
//! What can be seen is not asked: which column is which joint (`words`), in which unit (`look`), how the truth was
//! observed (`observed`), which way axes turn and from where angles count (`frame`). Each kind of instrument is one of the
//! `templates`; what it makes of a table is a [`Draft`], and `study` writes it down.

mod frame;
mod look;
mod observed;
mod study;
pub mod templates;
mod words;

pub use look::Look;
pub use study::study;

use frame::Frame;
use look::Read;
use observed::Observed;

/// What a template makes of a table.
pub struct Draft {
    /// The declaration.
    pub chain: String,
    /// Its observable.
    pub observable: &'static str,
    /// Joints and inputs with the columns that hold their readings.
    columns: Vec<(String, Read)>,
    /// What was observed.
    observed: Observed,
    /// What is estimated, where that is more than every error.
    estimate: Vec<&'static str>,
    /// Where the fit starts: an error, and its value as the study writes it.
    start: Vec<(&'static str, String)>,
    /// Side quantities that effects may use.
    inputs: Vec<String>,
    /// What the user should know of it.
    pub remarks: Vec<String>,
}

/// The template that a table plainly asks for.
///
/// # Errors
/// None does, or several do; the message lists the templates.
pub fn choose(look: &Look) -> Result<&'static templates::Template, String> {
    let fitting: Vec<_> = templates::TEMPLATES.iter().filter(|template| (template.fits)(look)).collect();
    match fitting.as_slice() {
        [one] => Ok(one),
        several => {
            let found = if several.is_empty() {
                "the header does not say which kind of instrument this is"
            } else {
                "several kinds of instrument have columns of these names"
            };
            let offered =
                if several.is_empty() { templates::TEMPLATES.iter().collect() } else { several.to_vec() };
            let lines: Vec<String> = offered
                .iter()
                .map(|one| format!("\n  --template {:14} {}", one.name, one.looks_for))
                .collect();
            Err(format!(
                "{}: {found}; say which, and name the columns as it looks for them:{}",
                look.file,
                lines.concat()
            ))
        }
    }
}
