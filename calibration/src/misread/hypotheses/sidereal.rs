//! A right ascension stands for an hour angle: the sidereal time, in a column that the study does not name, less the right ascension is the
//! hour angle.

use std::f64::consts::PI;

use model_core::Quantity;

use super::{Hypothesis, Reading, Tried, names};
use crate::misread::clock::RAD_AN_HOUR;
use study::{Change, Changed, SampledColumn};

/// Units of sidereal times: hours and degrees, each with a turn.
const UNITS: [(f64, f64); 2] = [(RAD_AN_HOUR, 24.0), (PI / 180.0, 360.0)];

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let angles = |columns: &[&'_ SampledColumn]| -> Vec<usize> {
        (0..columns.len()).filter(|&at| columns[at].quantity == Quantity::Angle).collect()
    };
    let (joints, observed) = (angles(&tried.joints), angles(&tried.observed));
    // An encoder's reading, the observed angle, or both.
    let mut sets: Vec<Vec<&SampledColumn>> = joints.iter().map(|&at| vec![tried.joints[at]]).collect();
    sets.extend(observed.iter().map(|&at| vec![tried.observed[at]]));
    for &joint in &joints {
        sets.extend(observed.iter().map(|&at| vec![tried.joints[joint], tried.observed[at]]));
    }
    sets.iter().filter(|_| !observed.is_empty()).flat_map(|set| of_set(tried, set)).collect()
}

fn of_set(tried: &Tried<'_>, columns: &[&SampledColumn]) -> Vec<Hypothesis> {
    let source = columns.first().map_or(0, |column| column.place.source);
    let mut all = Vec::new();
    for (of, beside) in tried.sample.beside(source).iter().enumerate() {
        for (in_si, turn) in UNITS {
            if beside.numbers.iter().all(|number| (0.0..=turn).contains(number)) {
                let change =
                    |column: &&SampledColumn| Changed::all(column.place, Change::Short { of, in_si });
                let reading =
                    Reading::RightAscension { columns: names(columns), sidereal: beside.name.clone() };
                let changes = columns.iter().map(change).collect();
                all.push(Hypothesis::new(reading, changes, Vec::new(), 0.0));
            }
        }
    }
    all
}
