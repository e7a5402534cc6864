//! Rotator: a turning part of the optics that the chain does not have.

use model_core::{Quantity, Role, SymbolId};

use super::joint_motion::{Turn, whirl};
use crate::candidate::{Dependence, Kind};
use crate::candidate::{Effect, Family, Freedom, Place, Setting, per_turn, seen};

pub(super) const FAMILY: Family = Family {
    name: "rotator",
    what: "The line of sight moves on a circle as an instrument rotator or derotator turns.",
    causes: "The rotator's axis is not the optical axis, or the camera's centre is not on the rotator's axis.",
    looks: "A circle in the frame of the observing body, one turn for one turn of the rotator (two for an image rotator of \
            mirrors).",
    check: "Stop the mount and turn the rotator. A star draws the circle.",
    effects,
};

/// Inputs named `rotator` that are angles.
fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    let angles: Vec<SymbolId> = Kind::Rotator
        .inputs(setting)
        .into_iter()
        .filter(|&input| setting.chain.symbol(input).quantity == Quantity::Angle)
        .collect();
    for input in angles {
        let name = setting.name(input);
        for &id in setting.observables {
            let body = setting.chain.observable(id).body;
            for freedom in Freedom::rotations() {
                let (first, _) = seen::others(freedom.axis);
                let place = Place { body, role: Role::MotionError, freedom: Freedom::about(first) };
                // The circle lies across the line of sight: about the axis that moves nothing.
                if setting.moves(place.with(freedom)) {
                    continue;
                }
                for (order, forward) in [(1, true), (1, false), (2, true), (2, false)] {
                    let turn = Turn { angle: input, name, order, forward };
                    let (sense, short) = if forward { ("forward", "fwd") } else { ("backward", "bwd") };
                    effects.push(Effect {
                        bends: None,
                        family: FAMILY.name,
                        name: format!("circle with {name}, {} {sense}", per_turn(order)),
                        place,
                        functions: whirl(place, &turn, &format!("circle_{short}")),
                        driver: name.to_owned(),
                        form: Dependence::Harmonic { order },
                    });
                }
            }
        }
    }
    effects
}
