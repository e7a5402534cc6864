//! The sense of a column: it counts the other way, or from the zenith instead of the horizon.

use std::f64::consts::FRAC_PI_2;

use model_core::Quantity;

use super::{Hypothesis, Reading, Tried, beside_unit, line};
use crate::misread::policy::ZENITH_PRICE;
use study::{Change, Changed, SampledColumn};

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let of_column = |column: &&SampledColumn| {
        let own = |reading: Reading, change: Change, offset: Option<&str>, price: f64| {
            let offset = offset.map(|offset| ("offset", offset.to_owned()));
            let how = beside_unit(column, [("sign", "-1".to_owned())].into_iter().chain(offset));
            let lines = vec![line(tried.plan, column, &column.name, how)];
            Hypothesis::new(reading, vec![Changed::all(column.place, change)], lines, price)
        };
        let name = || column.name.clone();
        let reversed = own(Reading::Reversed { column: name() }, Change::Reversed(0.0), None, 0.0);
        let zenith = (column.quantity == Quantity::Angle).then(|| {
            own(
                Reading::FromZenith { column: name() },
                Change::Reversed(FRAC_PI_2),
                Some("\"90 deg\""),
                ZENITH_PRICE,
            )
        });
        [Some(reversed), zenith].into_iter().flatten().collect::<Vec<_>>()
    };
    tried.joints.iter().chain(&tried.observed).flat_map(of_column).collect()
}
