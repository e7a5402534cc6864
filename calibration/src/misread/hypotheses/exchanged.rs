//! Two columns of the same quantity stand for each other.

use super::{Hypothesis, Reading, Tried, beside_unit, line};
use crate::misread::policy::EXCHANGED_PRICE;
use study::{Change, Changed, SampledColumn};

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let mut all = Vec::new();
    for columns in [&tried.joints, &tried.observed] {
        for (at, one) in columns.iter().enumerate() {
            for other in &columns[at + 1..] {
                if one.quantity == other.quantity && one.place.source == other.place.source {
                    all.push(hypothesis(tried, one, other));
                }
            }
        }
    }
    all
}

fn hypothesis(tried: &Tried<'_>, one: &SampledColumn, other: &SampledColumn) -> Hypothesis {
    let reads = |column: &SampledColumn, from: &SampledColumn| {
        line(tried.plan, column, &from.name, beside_unit(from, []))
    };
    let reading = Reading::Exchanged { columns: [one.name.clone(), other.name.clone()] };
    let changes = vec![
        Changed::all(one.place, Change::Exchanged(other.place)),
        Changed::all(other.place, Change::Exchanged(one.place)),
    ];
    Hypothesis::new(reading, changes, vec![reads(one, other), reads(other, one)], EXCHANGED_PRICE)
}
