//! A frozen model as it is told: what each of its terms was read as, what leaving one out does, and what else would gain.

use serde::Serialize;

use observe::SiUnit;

/// A model whose terms the study gives.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrozenModel {
    /// The terms, in the study's order.
    pub terms: Vec<TermFitted>,
    /// Declared errors that are no term.
    pub held_at_zero: Vec<String>,
    /// RMS of held-out rows with all terms; absent where rows observe unknown objects.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub held_out_rms: Option<f64>,
    /// Its unit, and that of the others: `rad` or `m`.
    pub unit: SiUnit,
    /// Rows that these figures are over: those without weight are outliers.
    pub rows: usize,
    /// What gains most beside the terms, the best first.
    pub others: Vec<OtherTerm>,
}

/// A term of a frozen model.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TermFitted {
    /// As the study writes it.
    pub term: String,
    /// The declared error, or the effect of the catalogue.
    pub read_as: String,
    /// Whether it is declared.
    pub declared: bool,
    /// The new errors of an effect.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub errors: Vec<String>,
    /// RMS of held-out rows without it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub held_out_rms_without: Option<f64>,
}

/// An effect that is no term.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OtherTerm {
    /// Its name in the catalogue.
    pub effect: String,
    /// What other fields call it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub published: Vec<String>,
    /// How many effects these data cannot separate from it.
    pub alike: usize,
    /// Whether a search that starts from the terms would take it up.
    pub accepted: bool,
    /// RMS of held-out rows with it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub held_out_rms_with: Option<f64>,
}
