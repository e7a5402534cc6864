//! Which readings of a row are off together, as those of a trajectory are: the one says it of the other, by its name.

use model_core::{Chain, SymbolId};
use toml::Spanned;

use super::column_plan::ColumnPlan;
use super::mistakes::{Outcome, every, mistake, unknown};
use super::uncertain::Uncertain;
use super::written::{Column, Correlation, Table};

/// Two readings, the first by its number first, and their correlation.
pub(super) type Correlated = ([SymbolId; 2], Uncertain);

/// The correlations that a table of columns states, each pair once.
pub fn correlated(chain: &Chain, columns: &Table<Column>) -> Outcome<Vec<Correlated>> {
    let uncertain: Vec<&str> = columns
        .iter()
        .filter(|(_, column)| column.get_ref().sigma.is_some())
        .map(|(name, _)| name.get_ref().as_str())
        .collect();
    let mut known: Vec<[SymbolId; 2]> = Vec::new();
    let stated = columns.iter().flat_map(|(name, column)| {
        let others = column.get_ref().correlation.iter();
        others.map(move |(other, correlation)| (name, other, correlation))
    });
    every(stated.map(|(name, other, correlation)| {
        let of = |name: &Spanned<String>| {
            let is_uncertain = uncertain.contains(&name.get_ref().as_str());
            chain.find_symbol(name.get_ref()).filter(|_| is_uncertain).ok_or_else(|| {
                unknown(name.span(), "reading with a `sigma`", name.get_ref(), uncertain.iter().copied())
            })
        };
        let mut pair = [of(name)?, of(other)?];
        pair.sort_unstable();
        if pair[0] == pair[1] {
            return Err(mistake(
                other.span(),
                "a reading has no correlation with itself",
                "name another one",
            ));
        }
        if known.contains(&pair) {
            let message =
                format!("the correlation of `{}` and `{}` is stated twice", name.get_ref(), other.get_ref());
            return Err(mistake(other.span(), message, "state it in one place"));
        }
        known.push(pair);
        match correlation.get_ref() {
            Correlation::Evenly(number) if is_correlation(*number) => Ok((pair, Uncertain::Evenly(*number))),
            Correlation::Evenly(_) => Err(mistake(
                correlation.span(),
                "a correlation lies between -1 and 1",
                "divide a covariance by both standard deviations",
            )),
            Correlation::Column(name) => Ok((pair, Uncertain::Column(ColumnPlan::of_numbers(name)))),
        }
    }))
}

/// Whether a number can be a correlation.
pub(super) fn is_correlation(number: f64) -> bool {
    (-1.0..=1.0).contains(&number)
}
