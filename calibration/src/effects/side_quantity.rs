//! Side quantities: a degree of freedom that follows a temperature, the time, the side of the pier.

use model_core::algebra::Poly;
use model_core::{Role, SymbolKind};

use super::{Alias, Effect, Family, Freedom, Function, Place, Setting};

pub(super) const FAMILY: Family = Family {
    name: "side quantity",
    what: "A degree of freedom of a body is proportional to something measured beside the joints.",
    causes: "Thermal expansion and bending (temperature), drift of a foundation or of electronics (time), \
             parts that fall from one rest to the other (pier side, face), a rotator off its axis.",
    looks: "Residuals that line up when plotted against the side quantity, in one degree of freedom.",
    check: "Change that quantity alone: heat one side, wait, turn the instrument through the pole.",
    aliases: &[
        Alias { name: "TPOINT temperature terms", meaning: "side quantity temperature" },
        Alias { name: "two-face error", meaning: "side quantity face" },
        Alias { name: "TPOINT PSC…, flop", meaning: "side quantity pier side" },
    ],
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    for &input in setting.inputs {
        if setting.chain.symbol(input).kind != SymbolKind::Input {
            continue;
        }
        let driver = setting.name(input);
        for body in setting.bodies() {
            let name = setting.body_name(body);
            let moved = setting.chain.body(body).factors.iter().any(|f| f.role == Role::Motion);
            for freedom in Freedom::ALL {
                for role in [Role::MotionError, Role::PositionError] {
                    if role == Role::PositionError && !moved {
                        continue;
                    }
                    let (tag, frame) = match role {
                        Role::MotionError => ("", ""),
                        _ => ("axis_", " axis"),
                    };
                    let stem = format!("{driver}_{tag}{name}_{}", freedom.word().to_lowercase());
                    effects.push(Effect {
                        family: FAMILY.name,
                        name: format!("{driver} in {name}{frame} {}", freedom.words()),
                        place: Place { body, role, freedom },
                        functions: vec![Function { amount: Poly::symbol(input), stem }],
                        driver: driver.to_owned(),
                        form: "linear".to_owned(),
                    });
                }
            }
        }
    }
    effects
}
