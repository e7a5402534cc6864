//! Drift: a degree of freedom that moves in proportion to time.

use super::driven;
use crate::candidate::{Dependence, Kind};
use crate::candidate::{Effect, Family, Setting};

pub(super) const FAMILY: Family = Family {
    name: "drift",
    what: "A degree of freedom of a body moves in proportion to time.",
    causes: "A foundation or tripod that sinks or twists, creep of a joint or a glue line, electronics that settle.",
    looks: "A slope in the residuals in order of acquisition, in one degree of freedom of one body.",
    check: "Measure the first pose again at the end. Watch a level on the base.",
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    driven::each(setting, FAMILY.name, &Kind::Time.inputs(setting), &Dependence::Linear)
}
