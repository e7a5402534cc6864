//! Harmonics beyond those of the catalogue, which a calibration found in a scan of all orders that the readings resolve.

use crate::candidate::{Effect, Family, Setting};

pub(super) const FAMILY: Family = Family {
    name: "high harmonic",
    what: "A function that repeats many times a turn of a joint, beyond the harmonics that the study asks for. Every number of periods up to 5,000 that the readings can show is looked for.",
    causes: "Teeth of a gear, rollers of a bearing, poles of a motor, divisions of a disc.",
    looks: "A fine wave over its joint, of the same height all around.",
    check: "Count teeth, rollers and poles. Measure at steps of a tenth of the period.",
    effects,
};

/// Those that the calibration took up so far.
fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    setting.own.iter().filter(|effect| effect.family == FAMILY.name).cloned().collect()
}
