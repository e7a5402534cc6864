//! Verdicts as people and programs read them.

mod json;
mod text;

pub use json::as_json;
pub use text::{Paint, as_text};
