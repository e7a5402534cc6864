//! Verdicts as people and programs read them.

mod json;
mod table;
mod text;

pub use json::{as_json, unread_as_json};
pub use table::{Format, Line, Piece, as_table, lines, of_claim};
pub use text::{Paint, as_text};
