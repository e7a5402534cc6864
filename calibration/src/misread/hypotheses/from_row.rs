//! Some rows are read otherwise than the rest: all from one row on, or all before it. Two files were put together.

use super::{Hypothesis, Reading};
use crate::misread::policy::FROM_ROW_PRICE;
use study::Changed;

/// Rows that each part has at least.
const FEWEST: usize = 4;

/// How far off each row is.
pub(in crate::misread) struct Off<'a> {
    /// As the study reads it.
    pub as_read: &'a [f64],
    /// As the hypothesis reads it.
    pub otherwise: &'a [f64],
}

/// Whether a hypothesis of joints may hold of some rows: a unit, a sign or a zero.
pub(in crate::misread) fn may_change(hypothesis: &Hypothesis) -> bool {
    matches!(
        hypothesis.reading,
        Reading::Unit { .. } | Reading::Reversed { .. } | Reading::FromZenith { .. } | Reading::Turned { .. }
    )
}

/// The hypothesis for those rows that it suits, from one on or before one; and how much likelier the rows are, nats.
pub(in crate::misread) fn of_rows(
    whole: &Hypothesis,
    off: &Off<'_>,
    row_number: impl Fn(usize) -> u64,
) -> Option<(Hypothesis, f64)> {
    let rows = off.as_read.len().min(off.otherwise.len());
    let mut least: Vec<f64> =
        off.as_read.iter().zip(off.otherwise).map(|(one, other)| one.min(*other)).collect();
    least.sort_by(f64::total_cmp);
    let scale = least.get(rows / 2).copied().filter(|scale| *scale > 0.0)?;
    let cost = |size: f64| 2.5 * ((size / scale).powi(2) / 4.0).ln_1p();
    // What the rows up to one gain by being read otherwise.
    let gains = off.as_read.iter().zip(off.otherwise).map(|(one, other)| cost(*one) - cost(*other));
    let up_to: Vec<f64> = gains
        .scan(0.0, |sum, gain| {
            *sum += gain;
            Some(*sum)
        })
        .collect();
    let all = *up_to.last()?;
    let splits = FEWEST..rows.checked_sub(FEWEST)?;
    let parts = splits.flat_map(|at| {
        let before = up_to[at - 1];
        [(0..at, before), (at..rows, all - before)]
    });
    let (part, gain) = parts.max_by(|one, other| one.1.total_cmp(&other.1))?;
    let is_before = part.start == 0;
    let at = if is_before { part.end } else { part.start };
    let price = whole.price + FROM_ROW_PRICE + (2.0 * rows as f64).ln();
    let changes = whole.changes.iter().map(|own| Changed { rows: part.clone(), ..own.clone() }).collect();
    let reading =
        Reading::FromRow { reading: Box::new(whole.reading.clone()), row: row_number(at), before: is_before };
    let hypothesis =
        Hypothesis { reading, changes, lines: Vec::new(), headings: Vec::new(), price, ..whole.clone() };
    Some((hypothesis, gain - price))
}
