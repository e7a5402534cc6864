//! The report in words: the one place where a [`Diagnosis`](calibration::diagnose::Diagnosis) becomes English.
//!
//! First the five [`Answers`] that a person acts on, then cautions, evidence, values, noise, what remains and what
//! could not have shown. How words are set in type is for whoever prints them.

mod answers;
mod better;
mod causes;
mod cautions;
mod columns;
mod components;
pub mod contest;
mod effects;
mod errors;
pub mod frozen;
mod hidden;
mod ladder;
mod left;
mod measure;
mod next;
mod noise;
pub mod numbers;
mod places;
mod rivals;
mod rows;
mod step;
mod steps;

pub use answers::{Answers, Tone, answers};
pub use better::hides;
pub use causes::{cause, form, sentence_case};
pub use cautions::caution;
pub use columns::asked;
pub use components::{component_in_words, side};
pub use effects::{bias, chance_of, evidence, headline, look_alike, motion, place};
pub use errors::{EstimateLine, Estimates, estimates, not_shown as errors_not_shown, wanted_not_shown};
pub use hidden::{fate, size};
pub use ladder::{ModelLine, SIMPLEST, Stage, missing_models, models, stages};
pub use left::{function_form, remaining};
pub use measure::pose_tables;
pub use next::PoseTable;
pub use noise::noise;
pub use places::remedy_would_show;
pub use rows::row;
pub use step::Step;
