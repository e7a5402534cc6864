//! Sessions: what was set up anew from one session to the next.

use super::driven;
use crate::candidate::Kind;
use crate::candidate::{Effect, Family, Setting};

pub(super) const FAMILY: Family = Family {
    name: "session",
    what: "A degree of freedom of a body has another constant in each session.",
    causes: "The instrument was set up, levelled or homed anew; something was taken off and put back.",
    looks: "Levels that change from session to session and stay within one.",
    check: "Measure the same target at the end of one session and the start of the next.",
    effects,
};

/// All sessions together are one effect at a place; the first, which has no input, is what they are counted from.
fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let inputs = Kind::Session.inputs(setting);
    if inputs.is_empty() {
        return Vec::new();
    }
    driven::driven(setting, FAMILY.name, ("session", "offset of a session"), &inputs, &"levels".into())
}
