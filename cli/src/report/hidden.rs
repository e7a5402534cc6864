//! What the data hide, in words: effects that they could not have shown, and the declared errors that would pass for them.

use std::collections::BTreeMap;

use calibration::report::{EffectFound, NotShown, Report};

use super::quantities;

/// Errors that are named for one effect.
const NAMED: usize = 3;

/// `smaller than 3.20 arcsec`, or that no size would show.
#[must_use]
pub fn size(effect: &NotShown) -> String {
    effect.smallest.map_or_else(
        || "of any size".to_owned(),
        |smallest| format!("below {}", quantities::told(smallest, effect.unit)),
    )
}

/// What became of an effect that does not show: `97 % of it would pass for elevation_index`.
#[must_use]
pub fn fate(effect: &NotShown) -> String {
    if effect.absorbed == 0.0 {
        return "moves nothing that was observed".to_owned();
    }
    let share = format!("{:.0} % of it would pass for", 100.0 * effect.absorbed);
    match largest(&effect.mistaken_for).as_slice() {
        [] => format!("{share} declared errors"),
        named => {
            let names: Vec<&str> = named.iter().map(|&(name, _)| name).collect();
            format!("{share} {}", names.join(", "))
        }
    }
}

/// How far an accepted effect, left out, would move declared errors; `None` if it moves none.
#[must_use]
pub fn bias(effect: &EffectFound, report: &Report) -> Option<String> {
    let moved: Vec<String> = largest(&effect.bias)
        .into_iter()
        .map(|(name, shift)| {
            let unit = report.errors.iter().find(|error| error.name == *name).map_or("1", |error| error.unit);
            format!("{name} by {}", quantities::told(shift, unit))
        })
        .collect();
    (!moved.is_empty())
        .then(|| format!("one standard uncertainty of it, left out, would move {}", moved.join(", ")))
}

/// The errors that move most, largest first.
fn largest(moved: &BTreeMap<String, f64>) -> Vec<(&str, f64)> {
    let mut moved: Vec<(&str, f64)> = moved.iter().map(|(name, &shift)| (name.as_str(), shift)).collect();
    moved.sort_by(|a, b| b.1.total_cmp(&a.1));
    moved.truncate(NAMED);
    moved
}
