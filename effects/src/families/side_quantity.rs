//! Side quantities: a degree of freedom that follows anything else measured beside the joints.

use super::driven;
use crate::candidate::{Dependence, Kind};
use crate::candidate::{Effect, Family, Setting};

pub(super) const FAMILY: Family = Family {
    name: "side quantity",
    what: "A degree of freedom of a body is proportional to something measured beside the joints: a load, a pressure, the \
           wind, a voltage.",
    causes: "Whatever the quantity does to the structure or to the electronics.",
    looks: "Residuals that line up when plotted against the side quantity, in one degree of freedom.",
    check: "Change that quantity alone.",
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    driven::each(setting, FAMILY.name, &Kind::Other.inputs(setting), &Dependence::Linear)
}
