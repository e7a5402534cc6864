//! Encoders: errors of a joint about its own axis that repeat with the joint.

use model_core::algebra::Poly;

use crate::candidate::{Dependence, Effect, Family, Function, JointAxis, Setting, harmonic};

pub(crate) const FAMILY: Family = Family {
    name: "encoder",
    what: "The joint differs from its encoder's reading, by a function of that reading.",
    causes: "The graduated disc sits off centre (once per turn), or is oval or tilted (twice). Four readout cells differ (four times). \
             Teeth of a gear or poles of a motor (many times). A wrong number of counts per turn (scale).",
    looks: "A sine of the reading, once or several times per turn, or a straight line (scale). Only about the joint's own axis, and \
            independent of the other joints and of gravity.",
    check: "Add a second reading head opposite the first. If the disc is off centre, the two heads err in opposite directions.",
    effects,
};

/// The name of a harmonic of an encoder.
pub(super) fn harmonic_name(order: u32, joint: &str) -> String {
    match order {
        1 => format!("encoder eccentricity of {joint}"),
        2 => format!("encoder ellipticity of {joint}"),
        _ => format!("encoder error of {joint}, {order} per turn"),
    }
}

/// The harmonic of an encoder, in the catalogue or from a scan.
pub(crate) fn encoder_harmonic(setting: &Setting<'_>, joint: &JointAxis, order: u32) -> Effect {
    let name = setting.name(joint.symbol);
    let stem = match order {
        1 => "ecc",
        2 => "ellip",
        _ => "enc",
    };
    Effect {
        bends: None,
        family: FAMILY.name,
        name: harmonic_name(order, name),
        place: joint.place(),
        functions: harmonic(joint.symbol, name, order, stem),
        driver: name.to_owned(),
        form: Dependence::Harmonic { order },
    }
}

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    for joint in setting.joints() {
        if joint.turns() {
            effects.extend((1..=setting.harmonics).map(|order| encoder_harmonic(setting, &joint, order)));
            effects.push(scale(FAMILY.name, setting, &joint));
        }
    }
    effects
}

/// The scale of what reads a joint.
pub(super) fn scale(family: &'static str, setting: &Setting<'_>, joint: &JointAxis) -> Effect {
    let name = setting.name(joint.symbol);
    Effect {
        bends: None,
        family,
        name: format!("encoder scale of {name}"),
        place: joint.place(),
        functions: vec![Function::new(Poly::symbol(joint.symbol), format!("scale_{name}"))],
        driver: name.to_owned(),
        form: Dependence::Linear,
    }
}
