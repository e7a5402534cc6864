//! Gravity: bodies sag by the components of gravity that they see.

use model_core::algebra::Poly;
use model_core::{ObservableId, Role};

use crate::candidate::{Dependence, Effect, Family, Freedom, Function, Place, Setting, seen};

pub(crate) const FAMILY: Family = Family {
    name: "gravity",
    what: "A body bends in proportion to a component of gravity as the body sees it.",
    causes: "The tube, the arm or the fork bends under its own weight, or under what it carries.",
    looks: "One period a turn of the joints that tilt the body, fixed in phase to the plumb line, the same \
            whichever way the joint came.",
    check: "Add a known mass at the tip or shift the counterweight. Sag grows in proportion, the eccentricity of an encoder does not.",
    effects,
};

/// Gravity seen through more joints than this has too many terms to be told by a formula.
pub(super) const MOST_TERMS: usize = 8;

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    for body in setting.bodies().into_iter().filter(|&body| setting.is_moved(body)) {
        let name = setting.body_name(body);
        for freedom in Freedom::rotations() {
            let place = Place { body, role: Role::MotionError, freedom };
            let changing = changing(setting, place);
            let about = freedom.axis_name();
            let sag = |parts: &[(usize, Poly)], form: Dependence| Effect {
                bends: None,
                family: FAMILY.name,
                name: format!("gravity flexure of {name} {}", freedom.words()),
                place,
                functions: parts
                    .iter()
                    .map(|(i, g)| {
                        Function::new(g.clone(), format!("sag_{name}_{about}_{}", ["x", "y", "z"][*i]))
                    })
                    .collect(),
                driver: "gravity".to_owned(),
                form,
            };
            for part in &changing {
                let form = format!("gravity along {} of {name}", ["x", "y", "z"][part.0]);
                effects.push(sag(std::slice::from_ref(part), form.into()));
            }
            // What bends a body about an axis is the gravity across that axis.
            let across: Vec<(usize, Poly)> =
                changing.into_iter().filter(|&(i, _)| i != freedom.axis.index()).collect();
            if across.len() > 1 {
                effects.push(sag(&across, "gravity across the axis".into()));
            }
        }
    }
    effects.extend(setting.observables.iter().filter_map(|&id| droop(setting, id)));
    effects
}

/// A line of sight that falls with gravity by the same amount whichever way the body is rolled: a turn about the
/// horizontal across it.
fn droop(setting: &Setting<'_>, id: ObservableId) -> Option<Effect> {
    let observable = setting.chain.observable(id);
    let body = observable.body;
    let at = |axis| Place { body, role: Role::MotionError, freedom: Freedom::about(axis) };
    let along = Freedom::rotations().find(|freedom| !setting.moves(at(freedom.axis)))?.axis;
    let gravity = seen::from_ground(setting, &setting.chain.gravity, at(along))?;
    let (first, second) = seen::others(along);
    // The cross product of the line of sight and gravity.
    let (about_first, about_second) = (-&gravity[second.index()], gravity[first.index()].clone());
    if about_first.is_zero() || about_second.is_zero() {
        return None;
    }
    let name = setting.body_name(body);
    Some(Effect {
        bends: None,
        family: FAMILY.name,
        name: format!("droop of {name} under gravity"),
        place: at(first),
        functions: vec![Function {
            amount: about_first,
            elsewhere: vec![(at(second), about_second)],
            stem: format!("droop_{name}"),
        }],
        driver: "gravity".to_owned(),
        form: "gravity across the line of sight".into(),
    })
}

/// The components of gravity at a place that change as the joints move, each upright: starting with a positive term.
pub(super) fn changing(setting: &Setting<'_>, place: Place) -> Vec<(usize, Poly)> {
    let Some(seen) = seen::from_ground(setting, &setting.chain.gravity, place) else { return Vec::new() };
    seen.into_iter()
        .enumerate()
        .filter(|(_, g)| g.as_constant().is_none() && g.len() <= MOST_TERMS)
        .map(|(i, g)| {
            let downward = g.terms().next().is_some_and(|first| first.coefficient.is_negative());
            (i, if downward { -&g } else { g })
        })
        .collect()
}
