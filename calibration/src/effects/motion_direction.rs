//! Direction and rate of motion: backlash, play, latency.

use model_core::algebra::Poly;
use model_core::{Role, SymbolKind};

use super::{Alias, Effect, Family, Function, Place, Setting};

pub(super) const FAMILY: Family = Family {
    name: "direction and rate",
    what: "A joint is off by a fixed amount that depends on which way it came, or in proportion to how fast.",
    causes: "Play in gears and couplings, friction that winds up a shaft (direction); an encoder read later \
             than the observation (rate).",
    looks: "Two branches, one for each direction of motion; or a residual in proportion to the rate.",
    check: "Approach one pose from both sides; read it at rest and in motion.",
    aliases: &[Alias { name: "TPOINT backlash, hysteresis", meaning: "direction of motion of a joint" }],
    effects,
};

/// Inputs named `beta_direction` or `beta_rate` belong to the joint `beta`.
fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    for joint in setting.joints() {
        let name = setting.name(joint.symbol);
        for (suffix, kind, form) in [("direction", "backlash", "sign"), ("rate", "latency", "linear")] {
            let Some(input) = setting.chain.find_symbol(&format!("{name}_{suffix}")) else { continue };
            if setting.chain.symbol(input).kind == SymbolKind::Input && setting.inputs.contains(&input) {
                effects.push(Effect {
                    family: FAMILY.name,
                    name: format!("{kind} of {name}"),
                    place: Place { body: joint.body, role: Role::MotionError, freedom: joint.freedom },
                    functions: vec![Function { amount: Poly::symbol(input), stem: format!("{kind}_{name}") }],
                    driver: format!("{name}_{suffix}"),
                    form: form.to_owned(),
                });
            }
        }
    }
    effects
}
