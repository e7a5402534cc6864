//! Error motion of a joint's axis: tilts and shifts that repeat as the joint turns.

use model_core::{Motion, Role};

use super::{Alias, Effect, Family, Freedom, Place, Setting, harmonic};

/// Harmonics of the turn that are in the catalogue.
const HARMONICS: std::ops::RangeInclusive<u32> = 1..=4;

pub(super) const FAMILY: Family = Family {
    name: "joint motion",
    what: "The axis of a joint tilts or shifts as the joint turns, in step with the turn.",
    causes: "Bearing races and balls that are not round, a track that is not flat, a shaft bent or clamped \
             askew.",
    looks: "Harmonics of the joint in a direction across its own axis (tilt, radial) or along it (axial). \
            Seen from the ground a tilt of order n in the turning frame is of order n − 1 and n + 1; the part of \
            order zero is perpendicularity, which is declared.",
    check: "Watch an inclinometer on the turning frame, or a sphere and dial gauges on the axis, through one \
            turn.",
    aliases: &[
        Alias { name: "TPOINT HZSA3, HZCA3", meaning: "tilt of the azimuth axis, harmonic 3" },
        Alias { name: "TPOINT HPSA, HPCA", meaning: "non-perpendicularity that varies with azimuth" },
        Alias {
            name: "ISO 230-7 tilt, radial and axial error motion",
            meaning: "the same, by degree of freedom",
        },
    ],
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    for joint in setting.joints().into_iter().filter(super::JointAxis::turns) {
        let name = setting.name(joint.symbol);
        for freedom in Freedom::ALL.into_iter().filter(|&freedom| freedom != joint.freedom) {
            let (kind, stem) = match (freedom.motion, freedom.axis == joint.freedom.axis) {
                (Motion::Rotation, _) => (format!("tilt about {}", freedom.axis_name()), "tilt"),
                (Motion::Translation, true) => ("axial motion".to_owned(), "axial"),
                (Motion::Translation, false) => {
                    (format!("radial motion along {}", freedom.axis_name()), "radial")
                }
            };
            let turns = freedom.motion == Motion::Rotation;
            for order in HARMONICS.filter(|&order| turns || order <= 2) {
                let per_turn = match order {
                    1 => "once a turn".to_owned(),
                    _ => format!("{order} per turn"),
                };
                let stem = format!("{stem}_{}", freedom.axis_name());
                let roles: &[Role] =
                    if turns { &[Role::MotionError, Role::PositionError] } else { &[Role::MotionError] };
                for &role in roles {
                    let frame = match role {
                        Role::MotionError => "",
                        _ => " in the fixed frame",
                    };
                    effects.push(Effect {
                        family: FAMILY.name,
                        name: format!("{kind} of the {name} axis, {per_turn}{frame}"),
                        place: Place { body: joint.body, role, freedom },
                        functions: harmonic(joint.symbol, name, order, &stem),
                        driver: name.to_owned(),
                        form: format!("harmonic {order}"),
                    });
                }
            }
        }
    }
    effects
}
