//! Wandering along the order of the rows: steps that add up to a random walk, at a place or in both tilts of a frame.

use super::{Class, Dictionary, Driver, Family, Law, Setting, Where};
use crate::function::Function;

pub(super) fn offer(setting: &Setting, dictionary: &mut Dictionary) {
    if !setting.rows.in_order || (setting.rows.count as f64) < setting.policy.rows_for_order {
        return;
    }
    let steps = (setting.rows.count / 6).clamp(4, 32);
    let walk = || (1..steps).map(move |step| Function::OrderStep(step as f64 / steps as f64));
    for place in noise_places(setting) {
        let functions = walk().map(|function| (function, 1.0)).collect();
        dictionary.add((Class::Order, Law::Walk), place, Driver::Order, functions, 0.0);
    }
    for (frame, pair) in noise_tilts(setting) {
        let both = pair.into_iter().flat_map(|place| walk().map(move |function| (place, function)));
        let columns: Vec<usize> = both.map(|term| dictionary.column(vec![term])).collect();
        dictionary.push(Family {
            class: Class::Order,
            place: Where::Tilts(frame),
            driver: Driver::Order,
            law: Law::Walk,
            relative: vec![1.0; columns.len()],
            columns,
            extra: 0.0,
            price: 0.0,
        });
    }
}

/// The places at which noise is offered: all of a short chain, the base of a long one.
pub(super) fn noise_places(setting: &Setting) -> Vec<usize> {
    let allowed = |&place: &usize| {
        if setting.few() { setting.turns(place) } else { setting.places.distinct[place].at_base }
    };
    setting.chain_places().filter(allowed).collect()
}

/// The frames whose two tilts together are offered as noise.
pub(super) fn noise_tilts(setting: &Setting) -> Vec<(usize, [usize; 2])> {
    let frames = setting.places.frames.iter().filter(|frame| setting.few() || frame.frame == 0);
    frames.filter_map(|frame| Some((frame.frame, frame.tilts?))).collect()
}
