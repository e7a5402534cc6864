//! The contest as data: each step of the search, and what became of each hypothesis.

/// The part of a contest in which a step was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// With robust weights, every family at once.
    Robust,
    /// Without robust weights.
    Plain,
    /// After the chain was linearised anew.
    Relinearised,
    /// Families of the noise before causes.
    NoiseFirst,
    /// With memory of the noise.
    Memory,
    /// Open functions against sums of named ones.
    Unpack,
    /// Shapes against open functions.
    Shapes,
    /// Rivals without one cause.
    Margins,
}

/// Why a family came or left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reason {
    /// It had the best gain less price.
    Best,
    /// It no longer gained beside the others.
    NoGain,
    /// Another family, of this number, explains the same better.
    Swapped(usize),
    /// One family, of this number, explains what it and another explained.
    OneForTwo(usize),
    /// It belongs to a function that named laws explain better.
    Unpacked,
    /// It belongs to a function that a shape explains better.
    Shaped(usize),
}

/// One step of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Counted from zero over the whole contest.
    pub number: usize,
    /// The part of the contest.
    pub stage: Stage,
    /// The family.
    pub family: usize,
    /// Whether it came, else it left.
    pub came: bool,
    /// Why.
    pub reason: Reason,
    /// Its gain less its price at this step, nats, where it was weighed.
    pub score: f64,
}

/// Gathers steps.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Recorder {
    pub stage: Stage,
    pub steps: Vec<Step>,
}

impl Recorder {
    pub fn new() -> Self {
        Self { stage: Stage::Robust, steps: Vec::new() }
    }

    pub fn note(&mut self, family: usize, came: bool, reason: Reason, score: f64) {
        self.steps.push(Step { number: self.steps.len(), stage: self.stage, family, came, reason, score });
    }
}
