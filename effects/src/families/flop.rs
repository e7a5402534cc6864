//! Flop: a body that rests on one side or the other.

use super::driven;
use crate::candidate::Kind;
use crate::candidate::{Effect, Family, Setting};

pub(super) const FAMILY: Family = Family {
    name: "flop",
    what: "A body falls from one rest to the other when the instrument is turned through: a constant that changes sign with \
           the face or the side of the pier.",
    causes: "A mirror loose in its cell, a tube loose in its rings, a bearing without preload, a two-face error of the \
             collimation or the vertical index.",
    looks: "Two levels, one for each face or side of the pier.",
    check: "Point one target in both faces. Push the mirror or the tube against either rest by hand.",
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    driven::each(setting, FAMILY.name, &Kind::Side.inputs(setting), &"two levels".into())
}
