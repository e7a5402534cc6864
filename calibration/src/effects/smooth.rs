//! Smooth fall-backs: Fourier series of one joint at one place, for what no formula of the catalogue explains.

use model_core::{Motion, Role};

use super::{Effect, Freedom, Place, Setting, harmonic};

/// The order of the series.
const ORDER: u32 = 8;

/// Every smooth candidate of a chain: each joint drives each rotation of its own body.
#[must_use]
pub fn smooth(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    for joint in setting.joints().into_iter().filter(super::JointAxis::turns) {
        let name = setting.name(joint.symbol);
        for freedom in Freedom::ALL.into_iter().filter(|f| f.motion == Motion::Rotation) {
            effects.push(Effect {
                family: "smooth",
                name: format!("a smooth function of {name} about {}", freedom.axis_name()),
                place: Place { body: joint.body, role: Role::MotionError, freedom },
                functions: (1..=ORDER)
                    .flat_map(|order| harmonic(joint.symbol, name, order, "smooth"))
                    .collect(),
                driver: name.to_owned(),
                form: format!("Fourier series of order {ORDER}"),
            });
        }
    }
    effects
}
