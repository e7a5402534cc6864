//! Linear scales: a joint that shifts is read in units of a wrong length.

use super::encoder;
use crate::candidate::{Effect, Family, Setting};

pub(crate) const FAMILY: Family = Family {
    name: "linear scale",
    what: "A joint that shifts goes further, or less far, than its scale shows, in proportion to the way.",
    causes: "The scale is warmer or colder than where it was divided, or expands unlike what it measures; the lead of the screw, the \
             length of a division or the wavelength in air is not what the counter takes it for; a cosine, where the scale does not lie \
             along the way.",
    looks: "A straight line over the reading, along the joint's own axis and no other: the longer the way, the more.",
    check: "Compare a long way with a known length: a laser interferometer, a step gauge, a length bar. Do it twice, at temperatures of \
            the scale that differ: an error that goes with them is expansion.",
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let shifts = setting.joints().into_iter().filter(|joint| !joint.turns());
    shifts.map(|joint| encoder::scale(FAMILY.name, setting, &joint)).collect()
}
