//! Two mistakes at once: asked where the data are far off and no single mistake explains them.

use super::written::Written;
use super::{Hypothesis, Reading};

/// Every stage.
pub(in crate::misread) const STAGES: [u8; 4] = [0, 1, 2, 3];

/// Where a mistake stands on the way from a file's cell to a number: which column it is, its unit, its row, its sense and zero.
pub(in crate::misread) fn stage(reading: &Reading) -> Option<u8> {
    match reading {
        Reading::Exchanged { .. } | Reading::Order { .. } | Reading::PlacesExchanged { .. } => Some(0),
        Reading::Unit { .. }
        | Reading::Counts { .. }
        | Reading::Packed { .. }
        | Reading::Doubled { .. }
        | Reading::PlacesUnit { .. } => Some(1),
        Reading::Shifted { .. } => Some(2),
        Reading::Reversed { .. }
        | Reading::FromZenith { .. }
        | Reading::Turned { .. }
        | Reading::RightAscension { .. }
        | Reading::Inverse { .. }
        | Reading::HeadingsReversed
        | Reading::HeadingsFromY { .. } => Some(3),
        Reading::FromRow { .. }
        | Reading::OfStation { .. }
        | Reading::Both { .. }
        | Reading::TwoStates { .. }
        | Reading::Frame { .. } => None,
    }
}

/// Both mistakes as one hypothesis; `None` where they are of one stage and one column.
pub(in crate::misread) fn of(one: &Hypothesis, other: &Hypothesis) -> Option<Hypothesis> {
    let (own, others) = (stage(&one.reading)?, stage(&other.reading)?);
    let [first, second] = if own <= others { [one, other] } else { [other, one] };
    let meet = first.changes.iter().any(|own| second.changes.iter().any(|other| own.place == other.place));
    if own == others && meet {
        return None;
    }
    Some(Hypothesis {
        reading: Reading::Both { readings: [first, second].map(|own| Box::new(own.reading.clone())) },
        changes: first.changes.iter().chain(&second.changes).cloned().collect(),
        lines: Written::merged(&first.lines, &second.lines),
        places: first.places.iter().chain(&second.places).copied().collect(),
        headings: first.headings.iter().chain(&second.headings).cloned().collect(),
        price: one.price + other.price,
        digits: one.digits + other.digits,
    })
}
