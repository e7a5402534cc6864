//! The report of a calibration, as programs read it: the keys of `report.json` are a promise.

pub(crate) mod words;

use serde::Serialize;

use crate::design::Proposal;
use crate::diagnose::Precision;

/// Everything that a calibration found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// The conclusion.
    pub verdict: Verdict,
    /// What was used.
    pub observations: Used,
    /// The declared and the new errors.
    pub errors: Vec<ErrorFound>,
    /// Errors that these data cannot tell apart: only combinations of those in one list are determined.
    pub not_separable: Vec<Vec<String>>,
    /// What the data can say: outcome of the fit, precision, noise, hints.
    pub precision: Precision,
    /// Where to measure next, if the study asks: D-optimal, then A-optimal.
    pub next_poses: Vec<Proposal>,
    /// Where to measure next to tell accepted effects from others that explain these data as well.
    pub separating: Vec<Separation>,
    /// The effects that were accepted, in the order they came in.
    pub effects: Vec<EffectFound>,
    /// What is left after them.
    pub remaining: Remaining,
    /// What these data could not have shown.
    pub not_shown: Vec<NotShown>,
    /// Residuals of the declaration as it was.
    pub before: Rms,
    /// Residuals of the amended one.
    pub after: Rms,
    /// Unit of the residuals: `rad` or `m`.
    pub unit: &'static str,
}

/// The conclusion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Verdict {
    /// Every accepted effect is the only one of its class, without rivals, and nothing is left.
    #[serde(rename = "explained")]
    Explained,
    /// Nothing is left, but some effects have others that explain these data as well.
    #[serde(rename = "explained up to a class")]
    UpToAClass,
    /// The residual still has structure.
    #[serde(rename = "structure remains")]
    StructureRemains,
    /// No effect stands out from the noise.
    #[serde(rename = "nothing detectable")]
    NothingDetectable,
    /// An effect hangs on fewer than five observations.
    #[serde(rename = "few observations")]
    FewObservations,
}

impl Verdict {
    /// As the report writes it.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Explained => "explained",
            Self::UpToAClass => "explained up to a class",
            Self::StructureRemains => "structure remains",
            Self::NothingDetectable => "nothing detectable",
            Self::FewObservations => "few observations",
        }
    }
}

/// How many observations were used, and which were not.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Used {
    /// Observations read.
    pub rows: usize,
    /// Observations with weight.
    pub used: usize,
    /// The others.
    pub set_aside: Vec<SetAsideRow>,
}

/// An observation that has no weight.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SetAsideRow {
    /// Its number in its file, from 1.
    pub row: u64,
    /// Why.
    pub why: String,
}

/// An error and its estimate.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ErrorFound {
    /// The declared name.
    pub name: String,
    /// The estimate, SI.
    pub value: f64,
    /// Its standard uncertainty, SI.
    pub standard_uncertainty: f64,
    /// `rad`, `m` or `1`.
    pub unit: &'static str,
    /// Whether these data determine it by itself.
    pub separable: bool,
}

/// An accepted effect.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EffectFound {
    /// As the amended declaration writes it.
    pub text: String,
    /// The body it sits in.
    pub body: String,
    /// `Rx` to `Tz`.
    pub dof: String,
    /// The joint or input behind it.
    pub driver: String,
    /// The kind of function.
    pub form: String,
    /// What it may be called.
    pub names: Vec<String>,
    /// Effects that no data at these poses could tell from it.
    pub class: Vec<String>,
    /// Effects that explain these data about as well.
    pub rivals: Vec<String>,
    /// The new errors and their estimates, SI.
    pub coefficients: std::collections::BTreeMap<String, f64>,
    /// Familywise p when it was accepted.
    pub p_value: f64,
    /// The share of the searches without one fold each that chose it too.
    pub selected_in_folds: f64,
    /// How far one standard uncertainty of it, left out, would move each declared error, SI.
    pub bias: std::collections::BTreeMap<String, f64>,
}

/// Poses that would tell an accepted effect from its class and its rivals.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Separation {
    /// The name of the effect.
    pub effect: String,
    /// The joints, in the order of the poses' values.
    pub joints: Vec<String>,
    /// One list of joint values a pose, rad or m, the most telling first.
    pub poses: Vec<Vec<f64>>,
    /// The others that they tell it from.
    pub apart: Vec<Told>,
    /// The others that no pose within the ranges tells from it.
    pub never: Vec<String>,
}

/// How well an effect can be told from another.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Told {
    /// The name of the other.
    pub name: String,
    /// Sum of squares, in units of the noise, that the other leaves of the effect in the data so far, all else refitted.
    pub now: f64,
    /// The same once the poses are measured too; twice the log-likelihood to expect between the two.
    pub then: f64,
}

/// What is left of structure in the residual.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Remaining {
    /// Chance of at least as much structure in noise, all that was looked at taken together.
    pub p_value: f64,
    /// The rows that were looked at: all, or a sample from all over the data where they are many.
    pub rows: usize,
    /// What was looked at.
    pub looked: Vec<Looked>,
    /// Where it sits, if one smooth function at one place explains the data better than the catalogue does.
    #[serde(rename = "where")]
    pub place: Option<Where>,
    /// The smooth function there: driver (rad or the input's unit), value (rad or m), two standard uncertainties.
    pub shape: Vec<Vec<f64>>,
    /// Lines for the study that make the function there an effect of its own; absent for a bump, which no amount of a
    /// declaration can follow.
    pub offer: Option<String>,
}

/// One statistic of what is left.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Looked {
    /// What it looks at: `neighbours along beta`.
    pub at: String,
    /// Chance of as much in noise, of this statistic alone.
    pub p_value: f64,
}

/// A place in the chain.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Where {
    /// The body.
    pub body: String,
    /// `Rx` to `Tz`.
    pub dof: String,
    /// The joint or input.
    pub driver: String,
    /// The kind of function: `Fourier series of order 8`.
    pub form: String,
}

/// An effect that these data would not show below some size.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NotShown {
    /// Its name.
    pub name: String,
    /// The smallest amplitude that would be found four times out of five, SI; absent if no size would show.
    pub smallest: Option<f64>,
    /// `rad` or `m`.
    pub unit: &'static str,
    /// The share of it that the declared errors absorb, 0 to 1.
    pub absorbed: f64,
    /// The bias that it would put into the declared errors: how far an effect of amplitude 1 SI would move each at most, SI.
    pub mistaken_for: std::collections::BTreeMap<String, f64>,
}

/// Root mean square over observations of the length of the residual.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rms {
    /// On the data that were fitted.
    pub rms: f64,
    /// On data that no stage saw, gross outliers aside; absent where nothing could be held out.
    pub held_out_rms: Option<f64>,
    /// Over how many observations that is.
    pub held_out_rows: usize,
    /// The same over every observation held out.
    pub held_out_rms_of_all: Option<f64>,
}
