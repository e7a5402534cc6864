//! Readings of joints stand one row off what was observed at them.

use super::{Hypothesis, Reading, Tried, line, unit_of};
use study::{Change, SampledColumn};

/// Rows slip rarely.
const PRICE: f64 = 1.5;

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let mut sets: Vec<Vec<&SampledColumn>> = vec![tried.joints.clone()];
    if tried.joints.len() > 1 {
        sets.extend(tried.joints.iter().map(|column| vec![*column]));
    }
    let mut all = Vec::new();
    for set in sets.iter().filter(|set| !set.is_empty()) {
        for by in [1, -1] {
            let how = |column: &SampledColumn| format!("{}, shift = {by}", unit_of(column));
            all.push(Hypothesis {
                reading: Reading::Shifted {
                    columns: set.iter().map(|column| column.name.clone()).collect(),
                    by,
                },
                changes: set.iter().map(|column| (column.place, Change::Shift(by))).collect(),
                lines: set
                    .iter()
                    .map(|column| line(tried.plan, column, &column.name, &how(column)))
                    .collect(),
                price: PRICE,
                digits: 0.0,
            });
        }
    }
    all
}
