//! Coupling: a degree of freedom of one body driven by another joint.

use crate::candidate::{Dependence, Effect, Family, Freedom, Setting, harmonic};

/// Harmonics of the other joint.
const HARMONICS: std::ops::RangeInclusive<u32> = 1..=2;

pub(super) const FAMILY: Family = Family {
    name: "coupling",
    what: "One joint moves a body that another joint carries.",
    causes: "A shifting load loads a lower bearing; cables pull as an upper axis turns; a gear train couples \
             two axes.",
    looks: "Harmonics of one joint in a degree of freedom of another body.",
    check: "Turn one joint with the other clamped and watch the clamped one.",
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let joints = setting.turning();
    let mut effects = Vec::new();
    for own in &joints {
        for other in joints.iter().filter(|other| other.symbol != own.symbol) {
            let (name, driver) = (setting.body_name(own.body), setting.name(other.symbol));
            for freedom in Freedom::rotations() {
                for order in HARMONICS {
                    let stem = format!("cross_{}{}", freedom.word().to_lowercase(), name);
                    effects.push(Effect {
                        bends: None,
                        family: FAMILY.name,
                        name: format!(
                            "coupling of {driver} into {name} {}, harmonic {order}",
                            freedom.words()
                        ),
                        place: own.place().with(freedom),
                        functions: harmonic(other.symbol, driver, order, &stem),
                        driver: driver.to_owned(),
                        form: Dependence::Harmonic { order },
                    });
                }
            }
        }
    }
    effects
}
