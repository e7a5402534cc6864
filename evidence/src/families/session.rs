//! Set-ups: an offset a session with a label, or a stretch of rows between two found changes.

use super::order::{noise_places, noise_tilts};
use super::{Class, Dictionary, Driver, Family, Law, Setting, Where};
use crate::function::Function;

pub(super) fn offer(setting: &Setting, dictionary: &mut Dictionary) {
    let Some(labels) = &setting.rows.labels else { return };
    let mut levels = labels.clone();
    levels.sort_unstable();
    levels.dedup();
    // Labels that hardly repeat name rows, not set-ups: nothing would be left to judge an offset of each by.
    if levels.len() as f64 * setting.policy.rows_of_setup > setting.rows.count as f64 {
        return;
    }
    let functions: Vec<Function> = levels.into_iter().map(Function::Label).collect();
    let places: Vec<(Where, Vec<usize>)> = noise_places(setting)
        .into_iter()
        .map(|place| (Where::Place(place), vec![place]))
        .chain(noise_tilts(setting).into_iter().map(|(frame, pair)| (Where::Tilts(frame), pair.to_vec())))
        .collect();
    for (place, members) in places {
        add(dictionary, place, &members, &functions, Law::Sessions, 0.0);
    }
}

/// Adds one family with a column for each function at each of the members.
pub(crate) fn add(
    dictionary: &mut Dictionary,
    place: Where,
    members: &[usize],
    functions: &[Function],
    law: Law,
    price: f64,
) -> usize {
    let terms =
        members.iter().flat_map(|&place| functions.iter().map(move |function| (place, function.clone())));
    let columns: Vec<usize> = terms.map(|term| dictionary.column(vec![term])).collect();
    dictionary.push(Family {
        class: Class::Setup,
        place,
        driver: Driver::Order,
        law,
        relative: vec![1.0; columns.len()],
        columns,
        extra: 0.0,
        price,
    })
}
