//! The study file: which chain, which data, what was observed, what to estimate and what to look for.
//!
//! [`Study`] is the file as written (`written`); with a chain it becomes a [`Plan`] in which every name is
//! resolved (`plan`); with the data files the plan becomes [`Observations`](crate::data::Observations)
//! (`load`).

mod columns;
mod effects;
mod format;
mod inputs;
mod load;
mod plan;
mod sigma;
mod written;

use std::ops::Range;

use model_core::names;
use thiserror::Error;

pub use load::{Loaded, Open};
pub use plan::{NextPoses, Plan, Search, SourcePlan};
pub use written::{HoldOut, Study};

/// A mistake in a study file.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}{}{help}", if help.is_empty() { "" } else { "; " })]
pub struct StudyError {
    /// Where it stands, in bytes.
    pub place: Range<usize>,
    /// What is wrong.
    pub message: String,
    /// What to write instead; may be empty.
    pub help: String,
}

impl StudyError {
    fn new(place: Range<usize>, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { place, message: message.into(), help: help.into() }
    }

    /// A name that is none of those there are.
    fn unknown<'a>(
        place: Range<usize>,
        what: &str,
        name: &str,
        candidates: impl Iterator<Item = &'a str> + Clone,
    ) -> Self {
        let help = names::nearest(name, candidates.clone()).map_or_else(
            || {
                format!(
                    "there are {}",
                    candidates.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
                )
            },
            |near| format!("did you mean `{near}`?"),
        );
        Self::new(place, format!("no {what} is called `{name}`"), help)
    }

    /// What the reader of TOML says, with the nearest key where one is misspelt.
    fn from_toml(error: &toml::de::Error) -> Self {
        let place = error.span().unwrap_or(0..0);
        let message = error.message().to_string();
        let unknown = ["unknown field", "unknown variant"].iter().any(|start| message.starts_with(start));
        let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
        match quoted.split_first() {
            Some((found, expected)) if unknown => {
                let key = if message.starts_with("unknown field") { "key" } else { "value" };
                let help = names::nearest(found, expected.iter().copied()).map_or_else(
                    || format!("write one of {}", expected.join(", ")),
                    |near| format!("did you mean `{near}`?"),
                );
                Self::new(place, format!("`{found}` is no {key} here"), help)
            }
            _ => Self::new(place, message.trim_end(), ""),
        }
    }
}
