//! An amount that a study writes, in SI.

use std::ops::Range;

use model_core::Quantity;
use model_core::unit::Measures;

use super::mistakes::{Outcome, mistake, plain};
use tables::units::Amount;

/// In SI.
pub(super) fn si(amount: &Amount, measures: impl Into<Measures>, place: &Range<usize>) -> Outcome<f64> {
    amount.to_si(measures).map_err(|error| plain(place.clone(), error.to_string()))
}

/// The same of an amount that says its unit: of where things stand no number tells metres from millimetres, or radians from gon.
/// Zero is zero in all of them.
pub(super) fn si_with_unit(
    name: &str,
    amount: &Amount,
    quantity: Quantity,
    place: &Range<usize>,
) -> Outcome<f64> {
    let number = amount.number;
    if amount.unit.is_some() || number == 0.0 {
        return si(amount, quantity, place);
    }
    let help = match quantity {
        Quantity::Angle => format!("write {name} = \"{number} deg\", \"{number} gon\" or \"{number} rad\""),
        _ => format!("write {name} = \"{number} m\" or \"{number} mm\""),
    };
    Err(mistake(place.clone(), format!("`{name}` is {number} without a unit"), help))
}
