//! Assembly: a constant rotation or shift that the declaration does not have.

use model_core::algebra::Poly;
use model_core::{Motion, Role};

use super::{Alias, Effect, Family, Freedom, Function, Place, Setting};

pub(super) const FAMILY: Family = Family {
    name: "assembly",
    what: "A body sits rotated or shifted on its lower body, or its axis does, by a constant amount.",
    causes: "Axes that are not perpendicular or do not meet, an encoder's zero, a device mounted askew.",
    looks: "A constant in the frame of the body, turning with everything below it.",
    check: "Measure in two faces: most of them change sign.",
    aliases: &[
        Alias {
            name: "TPOINT IA, IE, IH, ID",
            meaning: "index of an encoder: assembly about the joint's own axis",
        },
        Alias {
            name: "TPOINT CA, CH",
            meaning: "collimation: assembly of the tube across the line of sight",
        },
        Alias { name: "TPOINT NPAE, NP", meaning: "non-perpendicularity: assembly of the upper axis" },
        Alias {
            name: "TPOINT AN, AW, ME, MA",
            meaning: "tilt of the lower axis: assembly of the first body",
        },
        Alias { name: "laser tracker x1 to x7", meaning: "offsets and tilts of beam and axes" },
    ],
    effects,
};

/// The name of a constant at a place.
#[must_use]
pub fn assembly_name(body: &str, role: Role, freedom: Freedom) -> String {
    let what = if freedom.motion == Motion::Rotation { "rotation" } else { "shift" };
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
                    family: FAMILY.name,
                    name: assembly_name(name, role, freedom),
                    place: Place { body, role, freedom },
                    functions: vec![Function { amount: Poly::one(), stem }],
                    driver: "none".to_owned(),
                    form: "constant".to_owned(),
                });
            }
        }
    }
    effects
}
