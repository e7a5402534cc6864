//! Packed digits: 12.3456 for 12° 34′ 56″. A column of decimal numbers has digit pairs of 60 and more; one that is packed has none.

use model_core::Quantity;

use super::{Hypothesis, Reading, Tried, line, names, quoted, sets};
use crate::misread::policy::PACKED_PRICE;
use study::{Change, Changed, Notation, SampledColumn};

/// Digit pairs behind the point of a packed number: minutes and seconds.
const PAIRS: f64 = 2.0;

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let notation = Notation::Degrees;
    let how = || vec![("notation", quoted(notation.name()))];
    let hypothesis = |set: Vec<&SampledColumn>| {
        let changes =
            set.iter().map(|column| Changed::all(column.place, Change::Notation(notation))).collect();
        let lines = set.iter().map(|column| line(tried.plan, column, &column.name, how())).collect();
        let reading = Reading::Packed { columns: names(&set), notation: notation.name() };
        // Of a hundred pairs of digits sixty are below 60.
        let digits = set.iter().map(|column| -0.6_f64.ln() * PAIRS * column.written.len() as f64).sum();
        Hypothesis { digits, ..Hypothesis::new(reading, changes, lines, PACKED_PRICE) }
    };
    sets(tried, is_packed).into_iter().map(hypothesis).collect()
}

/// Whether a column of angles is read as degrees, and every number of it could be degrees, minutes and seconds.
fn is_packed(column: &SampledColumn) -> bool {
    column.quantity == Quantity::Angle
        && column.factor == 1.0_f64.to_radians()
        && column.written.iter().any(|number| number.fract() != 0.0)
        && column.written.iter().all(|number| Notation::Degrees.unpack(*number).1)
}
