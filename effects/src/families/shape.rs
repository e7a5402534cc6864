//! Shapes: functions of one reading that a calibration took up because no other family explains the data as well.

use crate::candidate::{Effect, Family, Setting};

pub(super) const FAMILY: Family = Family {
    name: "shape",
    what: "A step, a ramp, a bump, a wave with corners, or a function without a name, of one joint or input at one place: what \
           these data show and no other family spells out.",
    causes: "A joint of a track or a segment of a rail (step, bump), a stop, a spring or a counterweight that comes into play \
             beyond some angle (ramp), a chain or belt drive (sawtooth), a table in the controller.",
    looks: "The shape itself, drawn over its joint or input.",
    check: "Measure at close steps around the thresholds.",
    effects,
};

/// Those that the calibration took up so far.
fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    setting.own.iter().filter(|effect| effect.family == FAMILY.name).cloned().collect()
}
