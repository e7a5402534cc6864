//! Scales of ranges that only stations with a standard uncertainty would show: the search takes those for unknown. A fit beside the
//! stated places says how large they are.

use super::caution::Caution;
use super::misplaced::by_what_is_stated;
use crate::candidate::{Dependence, EffectId};
use crate::effects::RANGE;
use crate::search::context::{Context, Found};
use crate::search::fitted::Fitted;
use crate::search::round::Round;

/// Stations that show a scale together.
const SHOW: usize = 2;

/// A scale is no chance from so many of its standard uncertainties on.
const SURE: f64 = 4.0;

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
        (!is_seen).then(|| Caution::ScaleNotSought {
            range,
            body,
            axis: axis.to_string(),
            fitted: fitted(whole, last, scale),
        })
    });
    ranges.collect()
}

/// A scale beside everything that was found, and its standard uncertainty; `None` where the data and the stated places do not show it, or
/// where places are as far off with it: one of them is wrong then.
fn fitted(whole: &Context<'_>, last: &Round<'_>, scale: EffectId) -> Option<[f64; 2]> {
    let mut found = last.fitted.found.clone();
    found.push(Found { effect: scale, p_value: 1.0, alike: vec![scale] });
    let Fitted { fit, errors, .. } = Fitted::with(whole, found, &last.fitted).ok()?;
    let &[scale] = errors.last()?.as_slice() else { return None };
    let at = fit.parameters.iter().position(|&id| id == scale)?;
    let unknowns = whole.request.observations.unknowns.as_ref()?;
    if !fit.outcome.is_usable() || !fit.separable[at] || !by_what_is_stated(unknowns, &fit).is_empty() {
        return None;
    }
    Some([fit.values[scale.index()], fit.standard_uncertainty(scale)?])
}

impl Caution {
    /// The range whose scale is missing for sure, and how large it is; `None` where it may be chance.
    pub(crate) fn missing_scale(&self) -> Option<(&str, f64)> {
        match self {
            Self::ScaleNotSought { range, fitted: Some([value, uncertainty]), .. }
                if value.abs() > SURE * uncertainty =>
            {
                Some((range, *value))
            }
            _ => None,
        }
    }
}
