//! Gravity: bodies sag, and joints wind up, by the components of gravity that they see.

use model_core::algebra::{AngleSum, Poly};
use model_core::{Axis, BodyId, Motion, Role, SymbolKind};

use super::{Alias, Effect, Family, Freedom, Function, Place, Setting, whole};

pub(super) const FAMILY: Family = Family {
    name: "gravity",
    what: "A body bends, or its joint winds up, in proportion to a component of gravity as the body sees it.",
    causes: "The tube or the arm bends under its own weight; a counterweight is missing or too heavy; a \
             bearing or drive gives way under the torque.",
    looks: "One period a turn of the joints that tilt the body, fixed in phase to the plumb line, the same \
            whichever way the joint came.",
    check: "Add a known mass at the tip or shift the counterweight: sag grows in proportion. An encoder's \
            eccentricity does not.",
    aliases: &[
        Alias { name: "TPOINT TF", meaning: "sag of the tube, sine of the zenith distance (equatorial)" },
        Alias { name: "TPOINT HECE", meaning: "sag of the tube, cosine of the elevation (alt-azimuth)" },
        Alias { name: "TPOINT HESE", meaning: "sag of the tube, sine of the elevation (alt-azimuth)" },
        Alias { name: "TPOINT DAF", meaning: "sag of the declination axis" },
        Alias { name: "TPOINT FO", meaning: "flexure of the fork" },
    ],
    effects,
};

/// Gravity seen through more joints than this has too many terms to be told by a formula.
const MOST_TERMS: usize = 8;

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    for body in setting.bodies() {
        let moved = setting.chain.body(body).factors.iter().any(|factor| factor.role == Role::Motion);
        let Some(seen) = gravity_seen(setting, body).filter(|_| moved) else { continue };
        let name = setting.body_name(body);
        let changing: Vec<(usize, &Poly)> = seen
            .iter()
            .enumerate()
            .filter(|(_, g)| g.as_constant().is_none() && g.len() <= MOST_TERMS)
            .collect();
        if changing.is_empty() {
            continue;
        }
        for freedom in Freedom::ALL.into_iter().filter(|f| f.motion == Motion::Rotation) {
            let about = freedom.axis_name();
            let sag = |parts: &[(usize, &Poly)], form: &str| Effect {
                family: FAMILY.name,
                name: format!("gravity flexure of {name} {}", freedom.words()),
                place: Place { body, role: Role::MotionError, freedom },
                functions: parts
                    .iter()
                    .map(|&(i, g)| Function {
                        amount: upright(g),
                        stem: format!("sag_{name}_{about}_{}", ["x", "y", "z"][i]),
                    })
                    .collect(),
                driver: "gravity".to_owned(),
                form: form.to_owned(),
            };
            for &(i, g) in &changing {
                let form = format!("gravity along {} of {name}", ["x", "y", "z"][i]);
                effects.push(sag(&[(i, g)], &form));
            }
            if changing.len() > 1 {
                effects.push(sag(&changing, "gravity, every component"));
            }
        }
    }
    effects
}

/// The function or its negative, whichever starts with a positive term.
fn upright(g: &Poly) -> Poly {
    match g.terms().next() {
        Some(first) if first.coefficient.is_negative() => -g,
        _ => g.clone(),
    }
}

/// Gravity in the frame of a body, nominal errors; `None` where a motion is by no whole multiple of a joint.
pub(super) fn gravity_seen(setting: &Setting<'_>, body: BodyId) -> Option<[Poly; 3]> {
    let chain = setting.chain;
    let errors: Vec<bool> = chain.symbols.iter().map(|symbol| symbol.kind == SymbolKind::Error).collect();
    let mut seen = chain.gravity.clone();
    for body in chain.path(body) {
        for factor in &chain.body(body).factors {
            if factor.motion == Motion::Translation {
                continue;
            }
            let nominal = factor.amount.graded_part(|symbol| errors[symbol.index()], 0);
            // Seen from the turned body, the vector turns the other way.
            let angle = AngleSum::from_poly(&(&nominal * &whole(-1))).ok()?;
            let (cosine, sine) = angle.cos_sin();
            let (a, b) = match factor.axis {
                Axis::X => (1, 2),
                Axis::Y => (2, 0),
                Axis::Z => (0, 1),
            };
            let along = &(&cosine * &seen[a]) - &(&sine * &seen[b]);
            let across = &(&sine * &seen[a]) + &(&cosine * &seen[b]);
            seen[a] = along;
            seen[b] = across;
        }
    }
    Some(seen)
}
