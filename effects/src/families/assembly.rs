//! Assembly: a constant rotation or shift that the declaration does not have.

use model_core::algebra::Poly;
use model_core::{Role, TransformKind};

use crate::candidate::{Dependence, Effect, Family, Freedom, Function, Place, Setting};

pub(super) const FAMILY: Family = Family {
    name: "assembly",
    what: "A body sits rotated or shifted on its lower body, or its axis does, by a constant amount: index, \
           collimation, perpendicularity, intersection of axes, tilt of the whole instrument.",
    causes: "Axes that are not perpendicular or do not meet, an encoder's zero, a device or a line of sight mounted \
             askew, an instrument that is not level.",
    looks: "A constant in the frame of the body, turning with everything below it.",
    check: "Measure in two faces: most of them change sign. Level the instrument and measure again: its tilt goes away, \
            the others stay.",
    effects,
};

/// The name of a constant at a place.
#[must_use]
pub fn assembly_name(body: &str, role: Role, freedom: Freedom) -> String {
    let what = if freedom.kind == TransformKind::Rotation { "rotation" } else { "shift" };
    let axis = if role == Role::MotionError { "" } else { " axis" };
    format!("constant {what} of {body}{axis} {}", freedom.words())
}

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    for body in setting.bodies() {
        let name = setting.body_name(body);
        for role in [Role::PositionError, Role::MotionError] {
            for freedom in Freedom::ALL {
                let tag = if role == Role::MotionError { "" } else { "axis_" };
                let stem = format!("offset_{tag}{name}_{}", freedom.word().to_lowercase());
                effects.push(Effect {
                    bends: None,
                    family: FAMILY.name,
                    name: assembly_name(name, role, freedom),
                    place: Place { body, role, freedom },
                    functions: vec![Function::new(Poly::one(), stem)],
                    driver: "none".to_owned(),
                    form: Dependence::Constant,
                });
            }
        }
    }
    effects
}
