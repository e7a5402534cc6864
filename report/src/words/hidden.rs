//! What the data hide, in words: effects that they could not have shown, and the declared errors that imitate them.

use super::effects::largest;
use super::numbers;
use calibration::diagnose::NotShown;

/// `below 3.20″`, or that no size would show.
#[must_use]
pub fn size(effect: &NotShown) -> String {
    effect.smallest.map_or_else(
        || "of any size".to_owned(),
        |smallest| format!("below {}", numbers::told(smallest, effect.unit)),
    )
}

/// What becomes of an effect that does not show: `invisible, since elevation_index imitates it completely`.
#[must_use]
pub fn fate(effect: &NotShown) -> String {
    if effect.absorbed == 0.0 {
        return "moves nothing that was measured".to_owned();
    }
    let names: Vec<&str> = largest(&effect.mistaken_for).into_iter().map(|(name, _)| name).collect();
    let places = effect.by_places.then_some("the places of objects and stations");
    let taken = names.into_iter().chain(places).collect::<Vec<_>>().join(", ");
    let taken = if taken.is_empty() { "declared errors" } else { &taken };
    match effect.smallest {
        None => format!("invisible, since other values of {taken} look the same"),
        Some(_) => format!("other values of {taken} look {:.0} % the same", 100.0 * effect.absorbed),
    }
}
