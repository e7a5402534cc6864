//! A ladder of models, from the instrument as delivered to the declaration with effects, each judged on held-out rows.

use serde::Serialize;

use crate::limits::WORTH_WRITING;
use observe::SiUnit;

/// What a model fits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub enum RungName {
    /// Nothing: all declared errors are zero.
    #[serde(rename = "as delivered")]
    AsDelivered,
    /// The errors that place base and target.
    #[serde(rename = "placed")]
    Placed,
    /// Those and the zeros of joints.
    #[serde(rename = "zeros")]
    Zeros,
    /// All declared errors that the study estimates.
    #[serde(rename = "geometry")]
    Geometry,
    /// Those and the effects that were found.
    #[serde(rename = "effects")]
    Effects,
}

/// A model of the ladder.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rung {
    /// Which.
    pub name: RungName,
    /// What it fits beyond the model before: errors, or effects.
    pub adds: Vec<String>,
    /// How many errors it fits in all.
    pub errors: usize,
    /// RMS on held-out rows, every row, SI; absent where the figure is larger than the region that was measured.
    pub held_out_rms: Option<f64>,
    /// The same over rows that are within reach.
    pub held_out_rms_kept: Option<f64>,
    /// Standard error of the latter, SI.
    pub standard_error: Option<f64>,
    /// RMS in regions of the joints that no stage saw, every row, SI; absent where it was not measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elsewhere_rms: Option<f64>,
}

/// Why a model is not on the ladder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum WhyNot {
    /// It fits what the model before fits.
    #[serde(rename = "adds nothing")]
    AddsNothing,
    /// Its fit did not converge.
    #[serde(rename = "not converged")]
    NotConverged,
}

/// A model that is not on the ladder.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LeftOut {
    /// Which.
    pub name: RungName,
    /// Why.
    pub why: WhyNot,
}

/// The ladder.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ladder {
    /// Unit of the figures.
    pub unit: SiUnit,
    /// The models, each with all that the one before has.
    pub rungs: Vec<Rung>,
    /// The others.
    pub left_out: Vec<LeftOut>,
    /// The simplest that none predicts better than by more than the standard error of the difference.
    pub simplest: RungName,
    /// The model of declared errors that is written: all of them, or fewer where these predict better.
    pub written: RungName,
}

impl Ladder {
    /// A model of it.
    #[must_use]
    pub fn rung(&self, name: RungName) -> Option<&Rung> {
        self.rungs.iter().find(|rung| rung.name == name)
    }

    /// Where a simpler model predicts held-out rows clearly better than all declared errors: that one, and the declaration.
    #[must_use]
    pub fn simpler(&self) -> Option<[&Rung; 2]> {
        let both = [self.rung(self.simplest)?, self.rung(RungName::Geometry)?];
        let [simple, declared] = both.map(|rung| rung.held_out_rms_kept);
        let is_better = simple? <= WORTH_WRITING * declared.unwrap_or(f64::INFINITY);
        (self.simplest < RungName::Geometry && is_better).then_some(both)
    }

    /// The errors that the declaration fits and a model does not.
    #[must_use]
    pub fn above(&self, model: RungName) -> Vec<&str> {
        let above = self.rungs.iter().filter(|rung| rung.name > model && rung.name <= RungName::Geometry);
        above.flat_map(|rung| rung.adds.iter().map(String::as_str)).collect()
    }
}
