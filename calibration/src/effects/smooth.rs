//! Smooth fall-backs: Fourier series of one joint at one place, for what no formula of the catalogue explains.

use super::{Effect, Freedom, Setting, harmonic};

/// The order of the series.
const ORDER: u32 = 8;

/// Every smooth candidate of a chain: each joint drives each rotation of its own body.
#[must_use]
pub fn smooth(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    for joint in setting.turning() {
        let name = setting.name(joint.symbol);
        for freedom in Freedom::rotations() {
            effects.push(Effect {
                family: "smooth",
                name: format!("a smooth function of {name} about {}", freedom.axis_name()),
                place: joint.place().with(freedom),
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
