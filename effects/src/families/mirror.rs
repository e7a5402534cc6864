//! Mirrors: a beam that comes along a joint's axis and is turned aside by a mirror on the joint.

use model_core::algebra::{AngleSum, Poly};
use model_core::{Axis, TransformKind};

use crate::candidate::{Dependence, Effect, Family, Freedom, Function, JointAxis, Setting, seen, whole};

pub(super) const FAMILY: Family = Family {
    name: "mirror tilt",
    what: "The beam comes along a joint's axis and a mirror at half a right angle, turning with the joint, throws it \
           aside; beam and axis are not quite parallel.",
    causes: "The source, the camera or the tube is not on the axis of the mirror: a scanner, a siderostat, a telescope \
             with its instrument at a Nasmyth or coudé focus.",
    looks: "A sine of the joint about its own axis, and its cosine at right angles to the axis, of the same size: the mirror turns the \
            beam's tilt into the two in quadrature.",
    check: "Put a target on the axis and turn the mirror out of the way: the beam should meet it.",
    effects,
};

/// For joints across whose axis, along a coordinate axis of their body, something is observed.
///
/// In the mirror's frame the beam's tilt ω turns backwards with the joint. A mirror with normal n reflects a small
/// rotation ω of the beam into −(ω − 2(n·ω)n) of the line of sight: with n between axis and line of sight, the part
/// of ω along the line of sight goes about the axis and the part across both stays across, both with the sign changed.
fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    setting.turning().into_iter().filter_map(|joint| tilted(setting, &joint)).collect()
}

fn tilted(setting: &Setting<'_>, joint: &JointAxis) -> Option<Effect> {
    let sight = line_of_sight(setting, joint)?;
    let (first, second) = seen::others(joint.freedom.axis);
    // The third axis, and the sense in which (axis, sight, third) follow each other.
    let (third, right_handed) = if sight == first { (second, true) } else { (first, false) };
    let name = setting.name(joint.symbol);
    let angle = AngleSum::symbol(joint.symbol);
    let cosine = Poly::cos(&angle);
    let sense = if right_handed == joint.reversed { 1 } else { -1 };
    let sine = &Poly::sin(&angle) * &whole(sense);
    // The tilt (a, b) along sight and third axis at reading zero, seen from the turned mirror:
    // along sight a cos q − s b sin q, along the third s a sin q + b cos q, with s = −1 for a forward turn.
    let across = joint.place().with(Freedom::about(third));
    let functions = vec![
        Function {
            amount: cosine.clone(),
            elsewhere: vec![(across, sine.clone())],
            stem: format!("beam_cos_{name}"),
        },
        Function { amount: -&sine, elsewhere: vec![(across, cosine)], stem: format!("beam_sin_{name}") },
    ];
    Some(Effect {
        bends: None,
        family: FAMILY.name,
        name: format!("beam not along the {name} axis before its mirror"),
        place: joint.place(),
        functions,
        driver: name.to_owned(),
        form: Dependence::Harmonic { order: 1 },
    })
}

/// The axis of its body, across the joint's own, along which everything is observed.
fn line_of_sight(setting: &Setting<'_>, joint: &JointAxis) -> Option<Axis> {
    debug_assert!(joint.freedom.kind == TransformKind::Rotation);
    let sees = |axis: Axis| {
        setting.observables.iter().all(|&id| {
            let seen = seen::observed(setting, id, joint.place());
            seen.is_some_and(|seen| seen.iter().enumerate().all(|(i, s)| (i == axis.index()) != s.is_zero()))
        })
    };
    let (first, second) = seen::others(joint.freedom.axis);
    [first, second].into_iter().find(|&axis| sees(axis))
}
