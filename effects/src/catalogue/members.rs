//! The members of every family for one chain.

use model_core::SymbolId;
use model_core::algebra::Poly;

use crate::candidate::{Dependence, Effect, Function, Kind, Place, Setting};
use crate::families::{FAMILIES, encoder, gravity, joint_motion};

/// The whole catalogue for one chain, family after family, without repetitions and without what can move nothing that
/// is observed.
#[must_use]
pub fn catalogue(setting: &Setting<'_>) -> Vec<Effect> {
    let mut all: Vec<Effect> = Vec::new();
    let mut moved: Vec<(Place, bool)> = Vec::new();
    for effect in FAMILIES.iter().flat_map(|family| (family.effects)(setting)) {
        let repeated = all.iter().any(|other| {
            (other.place, other.family) == (effect.place, effect.family)
                && other.functions.len() == effect.functions.len()
                && other
                    .functions
                    .iter()
                    .zip(&effect.functions)
                    .all(|(a, b)| (&a.amount, &a.elsewhere) == (&b.amount, &b.elsewhere))
        });
        let moves = effect.places().into_iter().any(|place| {
            if let Some(&(_, known)) = moved.iter().find(|(known, _)| *known == place) {
                return known;
            }
            let moves = setting.moves(place);
            moved.push((place, moves));
            moves
        });
        if !repeated && moves && !effect.functions.is_empty() {
            all.push(effect);
        }
    }
    let reversed: Vec<Effect> = setting
        .inputs
        .iter()
        .filter(|&&input| setting.reverses(input))
        .flat_map(|&input| all.iter().filter_map(move |effect| reversed(effect, input, setting)))
        .collect();
    all.extend(reversed);
    all
}

/// The same effect times an input, for families of the instrument's own geometry and low orders: on the far side of the
/// pier, what is fixed to the instrument acts the other way round. Of a direction of motion, for the encoder of its joint
/// alone: backlash that changes as the joint turns.
fn reversed(effect: &Effect, input: SymbolId, setting: &Setting<'_>) -> Option<Effect> {
    let geometric = [gravity::FAMILY.name, encoder::FAMILY.name, joint_motion::FAMILY.name];
    let low = matches!(effect.form, Dependence::Harmonic { order: 1 | 2 });
    if !geometric.contains(&effect.family) || !(low || effect.family == gravity::FAMILY.name) {
        return None;
    }
    if let Kind::Direction(joint) = Kind::of(setting, input)
        && (effect.family != encoder::FAMILY.name || effect.driver != setting.name(joint))
    {
        return None;
    }
    let name = setting.name(input);
    let times = |function: &Function| {
        function.map(format!("{}_{name}", function.stem), |amount| &Poly::symbol(input) * amount)
    };
    Some(Effect {
        name: format!("{}, times {name}", effect.name),
        functions: effect.functions.iter().map(times).collect(),
        driver: format!("{}, {name}", effect.driver),
        ..effect.clone()
    })
}
