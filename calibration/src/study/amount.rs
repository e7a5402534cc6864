//! An amount that a study writes, in SI.

use std::ops::Range;

use model_core::Quantity;

use super::mistakes::{Outcome, plain};
use crate::data::units::Amount;

/// In rad, m, or as it is.
pub(super) fn si(amount: &Amount, quantity: Quantity, place: &Range<usize>) -> Outcome<f64> {
    amount.to_si(quantity).map_err(|error| plain(place.clone(), error.to_string()))
}
