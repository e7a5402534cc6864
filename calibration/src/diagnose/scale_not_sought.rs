//! Scales of ranges that only stations with a standard uncertainty would show: the search takes those for unknown.

use super::caution::Caution;
use crate::candidate::{Dependence, EffectId};
use crate::effects::RANGE;
use crate::search::context::Context;
use crate::search::round::Round;

/// Stations that show a scale together.
const SHOW: usize = 2;

/// What is told of each range whose scale nobody declared, where the search cannot see it though stations are stated.
pub(super) fn scale_not_sought(whole: &Context<'_>, last: &Round<'_>) -> Vec<Caution> {
    let Some(unknowns) = &whole.request.observations.unknowns else { return Vec::new() };
    let stations = unknowns.stations.iter().filter(|own| own.freedom.is_within()).count();
    if stations < SHOW {
        return Vec::new();
    }
    let chain = &last.fitted.chain;
    let ranges = whole.setting.ranges().into_iter().filter_map(|(body, axis, input)| {
        let name = whole.setting.name(input);
        let mut factors = chain.bodies.iter().flat_map(|body| &body.factors);
        if factors.any(|factor| chain.symbols_in(&factor.amount).contains(&input)) {
            return None;
        }
        let is_scale = |effect: EffectId| {
            let effect = &whole.catalogue[effect];
            (effect.family, effect.driver.as_str(), &effect.form) == (RANGE, name, &Dependence::Linear)
        };
        let scale = last.search.problem.candidates().find(|&effect| is_scale(effect))?;
        let (range, body) = (name.to_owned(), whole.setting.body_name(body).to_owned());
        let is_seen = !last.search.problem.columns(scale).is_empty();
        (!is_seen).then(|| Caution::ScaleNotSought { range, body, axis: axis.to_string() })
    });
    ranges.collect()
}
