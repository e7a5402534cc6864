//! A class: data sets with a secret, one for each student, and points for what is handed in.
//!
//! [`hand_out`] draws a data set for each name and seals the key; [`grade()`] draws it again from the key and compares. All texts come
//! and go as strings, and chance is an argument.

mod answer;
mod cause;
mod design;
mod folder;
mod grade;
mod instrument;
mod instruments;
mod key;
mod level;
mod misread;
mod model;
mod policy;
mod readings;
mod refit;
mod report;
mod rubric;
mod seed;
mod sentence;
mod task;
#[cfg(test)]
mod tests;

pub use folder::{AMENDED, ANSWER};
pub use grade::{Grade, Handed, Marked, grade};
pub use key::{Folder, Key, KeyError, NewError, Student, hand_out};
pub use level::{Level, NoLevel};
pub use report::{csv, feedback, table};
pub use rubric::{Item, RUBRIC, full};
