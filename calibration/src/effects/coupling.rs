//! Coupling: a degree of freedom of one body driven by another joint.

use model_core::algebra::{AngleSum, Poly};
use model_core::{Motion, Role};

use super::{Alias, Effect, Family, Freedom, Function, Place, Setting, harmonic};

pub(super) const FAMILY: Family = Family {
    name: "coupling",
    what: "One joint moves a body that another joint carries, or two joints act together.",
    causes: "A shifting load loads a lower bearing; cables pull as an upper axis turns; a gear train couples \
             two axes.",
    looks: "Harmonics of one joint in a degree of freedom of another body; products of functions of two joints.",
    check: "Turn one joint with the other clamped and watch the clamped one.",
    aliases: &[Alias { name: "TPOINT HXSA…, P…", meaning: "harmonics of one coordinate in the other" }],
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let joints: Vec<_> = setting.joints().into_iter().filter(super::JointAxis::turns).collect();
    let mut effects = Vec::new();
    for (at, own) in joints.iter().enumerate() {
        let neighbours = joints.iter().enumerate().filter(|&(i, _)| i.abs_diff(at) == 1);
        for (_, other) in neighbours {
            let (name, driver) = (setting.body_name(own.body), setting.name(other.symbol));
            for freedom in Freedom::ALL.into_iter().filter(|f| f.motion == Motion::Rotation) {
                for order in 1..=2 {
                    let stem = format!("cross_{}{}", freedom.word().to_lowercase(), name);
                    effects.push(Effect {
                        family: FAMILY.name,
                        name: format!(
                            "coupling of {driver} into {name} {}, harmonic {order}",
                            freedom.words()
                        ),
                        place: Place { body: own.body, role: Role::MotionError, freedom },
                        functions: harmonic(other.symbol, driver, order, &stem),
                        driver: driver.to_owned(),
                        form: format!("harmonic {order}"),
                    });
                }
            }
        }
    }
    effects.extend(products(setting, &joints));
    effects
}

/// Products of the first harmonics of two joints, about each joint's own axis.
fn products(setting: &Setting<'_>, joints: &[super::JointAxis]) -> Vec<Effect> {
    let mut effects = Vec::new();
    for (at, first) in joints.iter().enumerate() {
        for second in joints.iter().skip(at + 1).take(1) {
            let (a, b) = (setting.name(first.symbol), setting.name(second.symbol));
            let waves = |symbol| {
                let angle = AngleSum::symbol(symbol);
                [("cos", Poly::cos(&angle)), ("sin", Poly::sin(&angle))]
            };
            for own in [first, second] {
                let name = setting.body_name(own.body);
                let mut functions = Vec::new();
                for (word_a, wave_a) in waves(first.symbol) {
                    for (word_b, wave_b) in waves(second.symbol) {
                        functions.push(Function {
                            amount: &wave_a * &wave_b,
                            stem: format!("pair_{name}_{word_a}_{a}_{word_b}_{b}"),
                        });
                    }
                }
                effects.push(Effect {
                    family: FAMILY.name,
                    name: format!("{a} and {b} together in {name} {}", own.freedom.words()),
                    place: Place { body: own.body, role: Role::MotionError, freedom: own.freedom },
                    functions,
                    driver: format!("{a}, {b}"),
                    form: "product of first harmonics".to_owned(),
                });
            }
        }
    }
    effects
}
