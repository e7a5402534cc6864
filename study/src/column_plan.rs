//! A column that a study takes from its files.

use std::ops::Range;

use model_core::Quantity;

use super::conversion::Conversion;
use super::mistakes::{Outcome, mistake, plain};
use super::written::Column;
use tables::units::Unit;

/// A column that is to be found in a file.
#[derive(Debug, Clone)]
pub(super) struct ColumnPlan {
    pub name: String,
    pub unit: Option<Unit>,
    pub quantity: Quantity,
    /// A column with a declared name needs no unit: it is in SI.
    pub declared: bool,
    /// The study names it.
    pub named: bool,
    /// How its numbers become readings.
    pub conversion: Conversion,
}

impl ColumnPlan {
    /// A column of a declared name, which a study need not name: its numbers are in SI.
    pub fn declared(name: String, quantity: Quantity) -> Self {
        Self { name, unit: None, quantity, declared: true, named: false, conversion: Conversion::NONE }
    }

    /// A column that a study names, of numbers without a unit.
    pub fn of_numbers(name: &str) -> Self {
        Self { named: true, ..Self::declared(name.to_owned(), Quantity::Number) }
    }
}

/// The column that a study names, with its unit; only inputs have a meaning.
pub(super) fn column_plan(
    column: &Column,
    quantity: Quantity,
    place: &Range<usize>,
    of_input: bool,
) -> Outcome<ColumnPlan> {
    let unit = column.unit.as_deref().map(Unit::parse).transpose();
    let unit = unit.map_err(|error| plain(place.clone(), error.to_string()))?;
    let unit = unit.or(counts(column, quantity)?);
    if let (Some(meaning), false) = (&column.meaning, of_input) {
        return Err(mistake(
            meaning.span(),
            "what is measured has no meaning of its own",
            "leave `meaning` out",
        ));
    }
    if let (Some(sigma), false) = (&column.sigma, of_input) {
        return Err(mistake(
            sigma.span(),
            "only a joint or an input states here how uncertain it is",
            "state the noise of what is measured under `[noise]`, as `sigma`",
        ));
    }
    if let (Some((other, _)), false) = (column.correlation.first_key_value(), of_input) {
        return Err(mistake(
            other.span(),
            "only readings of joints and inputs have correlations",
            "leave `correlation` out",
        ));
    }
    let conversion = Conversion::of(column, quantity)?;
    match &column.column {
        Some(name) => {
            Ok(ColumnPlan { name: name.clone(), unit, quantity, declared: false, named: true, conversion })
        }
        None => Err(mistake(place.clone(), "this column is measured, not derived", "write `column = \"…\"`")),
    }
}

/// The unit of a column of an encoder's counts.
fn counts(column: &Column, quantity: Quantity) -> Outcome<Option<Unit>> {
    let Some(counts) = &column.counts_per_turn else { return Ok(None) };
    let wrong = |why: &str, help: &str| Err(mistake(counts.span(), why.to_owned(), help.to_owned()));
    if quantity != Quantity::Angle {
        return wrong("only an angle has turns", "leave `counts_per_turn` out");
    }
    if column.unit.is_some() || column.notation.is_some() {
        return wrong("`counts_per_turn` is a unit already", "leave `unit` and `notation` out");
    }
    let per_turn = *counts.get_ref();
    if !(per_turn.is_finite() && per_turn >= 1.0) {
        return wrong("an encoder has at least one count a turn", "write a number such as 65536");
    }
    Ok(Some(Unit { name: "count", quantity, in_si: std::f64::consts::TAU / per_turn }))
}
