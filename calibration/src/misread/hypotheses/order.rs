//! A quaternion whose scalar stands last and was taken for the first, or the other way round; a rotation that is the inverse.

use super::{Hypothesis, Reading, Tried, beside_unit, line, names};
use crate::misread::policy::ORDER_PRICE;
use study::{Change, Changed, SampledColumn};

/// What the columns that a study reads as w, x, y, z hold in truth; and of each of the four the place that it stands at.
const ORDERS: [(&str, [usize; 4]); 2] = [("x, y, z, w", [3, 0, 1, 2]), ("z, w, x, y", [1, 2, 3, 0])];

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let mut sources: Vec<usize> = tried.observed.iter().map(|column| column.place.source).collect();
    sources.dedup();
    sources.into_iter().flat_map(|source| of_source(tried, source)).collect()
}

fn of_source(tried: &Tried<'_>, source: usize) -> Vec<Hypothesis> {
    let own: Vec<&SampledColumn> =
        tried.observed.iter().copied().filter(|column| column.place.source == source).collect();
    let keys: Vec<&str> = (0..own.len()).map(|at| tried.plan.observed_key(source, at)).collect();
    match keys[..] {
        ["w", "x", "y", "z"] => {
            let mut all: Vec<Hypothesis> =
                ORDERS.iter().map(|(order, from)| ordered(tried, &own, order, *from)).collect();
            all.push(inverse(tried, &own[1..]));
            all
        }
        ["rx", "ry", "rz"] => vec![inverse(tried, &own)],
        _ => Vec::new(),
    }
}

fn ordered(tried: &Tried<'_>, own: &[&SampledColumn], order: &'static str, from: [usize; 4]) -> Hypothesis {
    let pairs = || own.iter().zip(from).map(|(column, from)| (*column, own[from]));
    let exchanged = pairs().map(|(column, from)| Changed::all(column.place, Change::Exchanged(from.place)));
    let lines = pairs().map(|(column, from)| line(tried.plan, column, &from.name, Vec::new())).collect();
    Hypothesis::new(Reading::Order { columns: names(own), order }, exchanged.collect(), lines, ORDER_PRICE)
}

/// The rotation that turns the other way about the same axis.
fn inverse(tried: &Tried<'_>, parts: &[&SampledColumn]) -> Hypothesis {
    let reversed = |column: &&SampledColumn| {
        let how = beside_unit(column, [("sign", "-1".to_owned())]);
        line(tried.plan, column, &column.name, how)
    };
    let changes = parts.iter().map(|own| Changed::all(own.place, Change::Reversed(0.0))).collect();
    let lines = parts.iter().map(reversed).collect();
    Hypothesis::new(Reading::Inverse { columns: names(parts) }, changes, lines, ORDER_PRICE)
}
