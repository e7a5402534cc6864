//! A joint counts from elsewhere: a quarter or half a turn away. Where its index is estimated, that is no mistake.

use std::f64::consts::FRAC_PI_2;

use model_core::Quantity;

use super::{Hypothesis, Reading, Tried, beside_unit, line};
use crate::misread::policy::TURNED_PRICE;
use study::{Change, Changed, Read, SampledColumn};

/// Quarter turns that are tried.
pub(in crate::misread) const QUARTERS: [i16; 3] = [1, -1, 2];

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let may_be = |column: &&&SampledColumn| {
        let has_index = matches!(column.read, Read::Reading(id) if tried.indexed.contains(&id));
        column.quantity == Quantity::Angle && !has_index
    };
    let of_column = |column: &&SampledColumn| {
        QUARTERS.map(|quarters| {
            let by_deg = 90 * quarters;
            let how = beside_unit(column, [("offset", format!("\"{by_deg} deg\""))]);
            let changes = vec![Changed::all(column.place, Change::Moved(FRAC_PI_2 * f64::from(quarters)))];
            let lines = vec![line(tried.plan, column, &column.name, how)];
            let reading = Reading::Turned { column: column.name.clone(), by_deg };
            Hypothesis::new(reading, changes, lines, TURNED_PRICE)
        })
    };
    tried.joints.iter().filter(may_be).flat_map(of_column).collect()
}
