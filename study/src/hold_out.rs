//! `[hold_out]`: how to judge on data that no stage saw.

use super::mistakes::{Outcome, within};
use super::written::Study;

/// How to judge on data that no stage saw.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HoldOut {
    /// Into how many parts the observations are divided.
    pub folds: usize,
    /// A second file instead, relative to the study.
    pub file: Option<String>,
    /// Columns whose rows with the same labels are held out together, and are one unit to the ±.
    pub together: Vec<String>,
    /// Seed of the division.
    pub seed: u64,
}

impl Study {
    /// What the study says of it.
    pub(super) fn held_out(&self) -> Outcome<HoldOut> {
        let folds = &self.hold_out.folds;
        within(folds.span(), "folds", *folds.get_ref(), 2..=1000)?;
        let folds = usize::try_from(*folds.get_ref()).unwrap_or(usize::MAX);
        let (file, together) = (self.hold_out.file.clone(), self.hold_out.together.0.clone());
        Ok(HoldOut { folds, file, together, seed: self.hold_out.seed })
    }
}
