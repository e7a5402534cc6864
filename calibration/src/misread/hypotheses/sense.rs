//! The sense of a column: it counts the other way, or from the zenith instead of the horizon.

use std::f64::consts::FRAC_PI_2;

use model_core::Quantity;

use super::{Hypothesis, Reading, Tried, line, unit_of};
use crate::misread::policy::ZENITH_PRICE;
use study::{Change, Changed, SampledColumn};

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let of_column = |column: &&SampledColumn| {
        let own = |reading: Reading, change: Change, how: String, price: f64| Hypothesis {
            reading,
            changes: vec![Changed::all(column.place, change)],
            lines: vec![line(tried.plan, column, &column.name, &format!("{}{how}", unit_of(column)))],
            price,
            digits: 0.0,
        };
        let name = || column.name.clone();
        let reversed =
            own(Reading::Reversed { column: name() }, Change::Reversed(0.0), ", sign = -1".to_owned(), 0.0);
        let zenith = (column.quantity == Quantity::Angle).then(|| {
            own(
                Reading::FromZenith { column: name() },
                Change::Reversed(FRAC_PI_2),
                ", sign = -1, offset = \"90 deg\"".to_owned(),
                ZENITH_PRICE,
            )
        });
        [Some(reversed), zenith].into_iter().flatten().collect::<Vec<_>>()
    };
    tried.joints.iter().chain(&tried.observed).flat_map(of_column).collect()
}
