//! Packed digits: 12.3456 for 12° 34′ 56″. A column of decimal numbers has digit pairs of 60 and more; one that is packed has none.

use model_core::Quantity;

use super::{Hypothesis, Reading, Tried, line};
use study::{Change, Notation, SampledColumn};

/// What a pair of digits below 60 says for packed digits, nats: of a hundred pairs sixty are.
const PAIR: f64 = 0.510_825_623_765_990_7;

/// Digit pairs behind the point of a packed number: minutes and seconds.
const PAIRS: f64 = 2.0;

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let packed = |columns: &[&'_ SampledColumn]| -> Vec<usize> {
        (0..columns.len()).filter(|&at| is_packed(columns[at])).collect()
    };
    let joints: Vec<&SampledColumn> = packed(&tried.joints).into_iter().map(|at| tried.joints[at]).collect();
    let observed: Vec<&SampledColumn> =
        packed(&tried.observed).into_iter().map(|at| tried.observed[at]).collect();
    let all: Vec<&SampledColumn> = joints.iter().chain(&observed).copied().collect();
    let mut sets: Vec<Vec<&SampledColumn>> = Vec::new();
    for set in [all.clone(), joints, observed].into_iter().chain(all.iter().map(|column| vec![*column])) {
        if !set.is_empty() && !sets.contains(&set) {
            sets.push(set);
        }
    }
    let notation = Notation::Degrees;
    let hypothesis = |set: Vec<&SampledColumn>| Hypothesis {
        reading: Reading::Packed {
            columns: set.iter().map(|column| column.name.clone()).collect(),
            notation: notation.name(),
        },
        changes: set.iter().map(|column| (column.place, Change::Notation(notation))).collect(),
        lines: set
            .iter()
            .map(|column| {
                line(tried.plan, column, &column.name, &format!(", notation = \"{}\"", notation.name()))
            })
            .collect(),
        price: 1.0,
        digits: set.iter().map(|column| PAIR * PAIRS * column.written.len() as f64).sum(),
    };
    sets.into_iter().map(hypothesis).collect()
}

/// Whether a column of angles is read as degrees, and every number of it could be degrees, minutes and seconds.
fn is_packed(column: &SampledColumn) -> bool {
    column.quantity == Quantity::Angle
        && column.factor == 1.0_f64.to_radians()
        && column.written.iter().any(|number| number.fract() != 0.0)
        && column.written.iter().all(|number| Notation::Degrees.unpack(*number).1)
}
