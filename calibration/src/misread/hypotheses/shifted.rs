//! Readings of joints stand one row off what was observed at them.

use super::{Hypothesis, Reading, Tried, beside_unit, line, names};
use crate::misread::policy::SHIFTED_PRICE;
use study::{Change, Changed, SampledColumn};

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let mut sets: Vec<Vec<&SampledColumn>> = vec![tried.joints.clone()];
    if tried.joints.len() > 1 {
        sets.extend(tried.joints.iter().map(|column| vec![*column]));
    }
    let mut all = Vec::new();
    for set in sets.iter().filter(|set| !set.is_empty()) {
        for by in [1, -1] {
            let how = |column: &SampledColumn| beside_unit(column, [("shift", by.to_string())]);
            let changes = set.iter().map(|column| Changed::all(column.place, Change::Shift(by))).collect();
            let lines =
                set.iter().map(|column| line(tried.plan, column, &column.name, how(column))).collect();
            let reading = Reading::Shifted { columns: names(set), by };
            all.push(Hypothesis::new(reading, changes, lines, SHIFTED_PRICE));
        }
    }
    all
}
