//! How uncertain readings are: a joint or an input says it where it says in which column they stand.

use model_core::unit::Measures;
use model_core::{Chain, SymbolId};
use toml::Spanned;

use super::amount::si;
use super::column_plan::{ColumnPlan, column_plan};
use super::mistakes::{Outcome, every, mistake};
use super::written::{Column, Sigma, Table};

/// How uncertain a reading is.
#[derive(Debug, Clone)]
pub(super) enum Uncertain {
    /// So much in every row, SI.
    Evenly(f64),
    /// As much as a column says.
    Column(ColumnPlan),
}

/// Of each joint and input that says it, how uncertain its readings are.
pub(super) fn sigma(chain: &Chain, columns: &Table<Column>) -> Outcome<Vec<(SymbolId, Uncertain)>> {
    let stated = columns.iter().filter_map(|(name, column)| {
        // A name that is none has been told.
        let id = chain.find_symbol(name.get_ref())?;
        Some((id, column.get_ref().sigma.as_ref()?))
    });
    let planned = |id: SymbolId, sigma: &Spanned<Sigma>| {
        let (measures, place) = (Measures::of(chain.symbol(id)), sigma.span());
        match sigma.get_ref() {
            Sigma::Amount(amount) => match si(amount, measures, &place)? {
                sigma if sigma > 0.0 && sigma.is_finite() => Ok(Uncertain::Evenly(sigma)),
                _ => Err(mistake(
                    place,
                    "a standard deviation is positive",
                    "leave `sigma` out of what is exact",
                )),
            },
            Sigma::Columns(columns) => match columns.as_slice() {
                [column] => column_plan(column, measures, &place, false).map(Uncertain::Column),
                _ => Err(mistake(place, "a reading has one standard deviation", "name one column")),
            },
        }
    };
    every(stated.map(|(id, sigma)| Ok((id, planned(id, sigma)?))))
}
