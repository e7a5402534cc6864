//! The specification of the study, and whether held-out rows meet it.

use serde::Serialize;

use super::rms::BeforeAfter;
use observe::SiUnit;

/// The goal.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Goal {
    /// The largest RMS that is good enough, SI.
    pub rms: f64,
    /// Its unit.
    pub unit: SiUnit,
    /// The RMS of the model that is written, on held-out rows within reach, SI; absent where nothing was held out.
    pub reached: Option<f64>,
    /// Whether that is good enough.
    pub met: bool,
}

impl Goal {
    pub(super) fn of(
        asked: Option<f64>,
        rms: &[BeforeAfter],
        with_effects: bool,
        largest: impl Fn(SiUnit) -> f64,
    ) -> Option<Self> {
        let (rms, own) = (asked?, rms.first()?);
        let written = if with_effects { own.after } else { own.before };
        let reached = written.within(largest(own.unit)).held_out_rms_kept;
        Some(Self { rms, unit: own.unit, reached, met: reached.is_some_and(|reached| reached <= rms) })
    }
}
