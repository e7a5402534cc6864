//! Stations that come out elsewhere than they are stated, all of which a scale of the ranges that nobody declared would bring home: two
//! places tell one distance, and no row says whether a place is wrong or every distance too long.

use super::caution::Caution;
use super::misplaced::{Misplaced, by_what_is_stated};
use crate::search::context::{Context, Found};
use crate::search::fitted::Fitted;
use crate::search::round::Round;
use effects::candidate::{Dependence, EffectId};
use effects::families::RANGE;

/// A scale is no chance from so many of its standard uncertainties on.
const SURE: f64 = 4.0;

/// What is told of each range whose scale nobody declared and no search accepted.
pub(super) fn scale_or_places(
    whole: &Context<'_>,
    last: &Round<'_>,
    misplaced: &[Misplaced],
) -> Vec<Caution> {
    if !misplaced.iter().any(Misplaced::is_stated_station) {
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
        if last.fitted.found.iter().any(|found| found.effect == scale) {
            return None;
        }
        let [scale, uncertainty] = fitted(whole, last, scale)?;
        let (range, body) = (name.to_owned(), whole.setting.body_name(body).to_owned());
        let of_size = Caution::ScaleOrPlaces { range, body, axis: axis.to_string(), scale, uncertainty };
        (scale.abs() > SURE * uncertainty).then_some(of_size)
    });
    ranges.collect()
}

/// A scale beside everything that was found, and its standard uncertainty; `None` where the data and the stated places do not show it, or
/// where places are as far off with it: one of them is wrong then.
fn fitted(whole: &Context<'_>, last: &Round<'_>, scale: EffectId) -> Option<[f64; 2]> {
    let mut found = last.fitted.found.clone();
    found.push(Found { effect: scale, p_value: 1.0, alike: vec![scale], shares: Vec::new() });
    let Fitted { fit, errors, .. } = Fitted::with(whole, found, &last.fitted).ok()?;
    let &[scale] = errors.last()?.as_slice() else { return None };
    let at = fit.parameters.iter().position(|&id| id == scale)?;
    let unknowns = whole.request.observations.unknowns.as_ref()?;
    if !fit.outcome.is_usable() || !fit.separable[at] || !by_what_is_stated(unknowns, &fit).is_empty() {
        return None;
    }
    Some([fit.values[scale.index()], fit.standard_uncertainty(scale)?])
}
