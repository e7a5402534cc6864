//! Thermal: a degree of freedom that follows a temperature.

use super::driven;
use crate::candidate::{Dependence, Kind};
use crate::candidate::{Effect, Family, Setting};

pub(super) const FAMILY: Family = Family {
    name: "thermal",
    what: "A degree of freedom of a body is proportional to a temperature measured beside the joints.",
    causes: "Expansion and bending of a structure that is warmer on one side, a bracket of another material, electronics \
             that warm up.",
    looks: "Residuals that line up when plotted against the temperature, in one degree of freedom of one body.",
    check: "Heat one side, or measure on a cold morning and a warm evening. Put a second sensor where the effect sits.",
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    driven::each(setting, FAMILY.name, &Kind::Temperature.inputs(setting), &Dependence::Linear)
}
