//! What a print says of an instrument, and whether its declaration implies it.
//!
//! The pipeline reads: claims file → [`mod@file`] → printed text → [`latex`] → a claim → [`checker`] → a verdict → [`show`], in the
//! symbols of the print.
//! Nothing here reads a file, prints, or knows a clock.

pub mod checker;
pub mod file;
pub mod latex;
pub mod paper;
pub mod show;
