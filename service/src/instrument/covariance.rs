//! How sure the estimates of an instrument are, together.

use model_core::mistake::Mistake;
use model_core::{Chain, SymbolId, SymbolKind, names};
use nalgebra::{DMatrix, SymmetricEigen};
use toml::Spanned;

use super::file;
use crate::refusal::Refusal;
use crate::source::Source;

/// Entries across the diagonal are the same to this part of the two standard uncertainties: what was written and read again is.
const SAME: f64 = 1e-9;

/// No correlation matrix has an eigenvalue below zero by more than this times its size: rounding of what was written.
const ROUNDING: f64 = 1e-9;

/// The covariance of estimates, SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Covariance {
    /// The estimates, in the order of the rows.
    pub of: Vec<SymbolId>,
    /// Those of them that the data do not determine by themselves: their variance is what was known before.
    pub undetermined: Vec<SymbolId>,
    /// Row by row; symmetric.
    pub rows: Vec<Vec<f64>>,
}

impl Covariance {
    /// Reads it.
    pub(super) fn of(source: &Source, chain: &Chain, written: &file::Covariance) -> Result<Self, Refusal> {
        let wrong = |place, message: String, help: &str| {
            Err(source.mistake(Mistake::new(place, message).with_help(help)))
        };
        let of = written.of.get_ref();
        let mut symbols: Vec<SymbolId> = Vec::new();
        for name in of {
            let id = estimate(source, chain, name)?;
            if symbols.contains(&id) {
                return wrong(
                    name.span(),
                    format!("`{}` stands here twice", name.get_ref()),
                    "leave one out",
                );
            }
            symbols.push(id);
        }
        let undetermined = written.undetermined.iter().map(|name| estimate(source, chain, name));
        let undetermined = undetermined.collect::<Result<Vec<_>, _>>()?;
        let rows = written.rows.get_ref();
        if rows.len() != symbols.len() {
            let message = format!("the covariance of {} estimates has {} rows", symbols.len(), rows.len());
            return wrong(written.rows.span(), message, "write a row for each estimate");
        }
        for row in rows {
            if row.get_ref().len() != symbols.len() {
                let message =
                    format!("this row has {} numbers for {} estimates", row.get_ref().len(), symbols.len());
                return wrong(row.span(), message, "write a number for each estimate");
            }
        }
        let at = |row: usize, column: usize| *rows[row].get_ref()[column].get_ref();
        for (row, numbers) in rows.iter().enumerate() {
            for (column, number) in numbers.get_ref().iter().enumerate() {
                let value = *number.get_ref();
                if !value.is_finite() {
                    return wrong(
                        number.span(),
                        "this is no finite number".to_owned(),
                        "write a number in SI",
                    );
                }
                if row == column && value < 0.0 {
                    let message = "a variance is not negative".to_owned();
                    return wrong(number.span(), message, "write the square of a standard uncertainty");
                }
            }
            for (column, number) in numbers.get_ref().iter().enumerate().take(row) {
                let scale = (at(row, row) * at(column, column)).sqrt();
                if (at(row, column) - at(column, row)).abs() > SAME * scale {
                    let message = format!(
                        "the covariance of `{}` and `{}` is another one across the diagonal",
                        of[row].get_ref(),
                        of[column].get_ref()
                    );
                    return wrong(number.span(), message, "write the same number in both places");
                }
            }
        }
        let scale = |at_row: usize| at(at_row, at_row).sqrt().max(f64::MIN_POSITIVE);
        let count = symbols.len();
        let correlation = DMatrix::from_fn(count, count, |a, b| at(a, b) / scale(a) / scale(b));
        let smallest = SymmetricEigen::new(correlation).eigenvalues.iter().copied().fold(0.0, f64::min);
        if smallest.is_nan() || smallest < -ROUNDING * count as f64 {
            let message = "this is no covariance: a sum of these estimates would have a variance below zero";
            return wrong(written.rows.span(), message.to_owned(), "write the covariance of one fit");
        }
        let rows = rows.iter().map(|row| row.get_ref().iter().map(|number| *number.get_ref()).collect());
        Ok(Self { of: symbols, undetermined, rows: rows.collect() })
    }

    /// The covariance of two estimates, SI; zero of what was not estimated.
    #[must_use]
    pub fn between(&self, one: SymbolId, other: SymbolId) -> f64 {
        let at = |symbol| self.of.iter().position(|own| *own == symbol);
        at(one).zip(at(other)).map_or(0.0, |(row, column)| self.rows[row][column])
    }

    /// The standard uncertainty of an estimate, SI; `None` where the data do not determine it by itself.
    #[must_use]
    pub fn standard_uncertainty(&self, symbol: SymbolId) -> Option<f64> {
        let at = self.of.iter().position(|own| *own == symbol)?;
        (!self.undetermined.contains(&symbol)).then(|| self.rows[at][at].sqrt())
    }
}

/// What a study may estimate of a chain.
pub(crate) fn errors_and_constants(chain: &Chain) -> impl Iterator<Item = SymbolId> {
    chain.symbols_of(SymbolKind::Error).chain(chain.symbols_of(SymbolKind::Constant))
}

/// The error or constant of a name.
fn estimate(source: &Source, chain: &Chain, name: &Spanned<String>) -> Result<SymbolId, Refusal> {
    let of_kind = || errors_and_constants(chain);
    let found = of_kind().find(|id| chain.symbol(*id).name == *name.get_ref());
    found.ok_or_else(|| {
        let message = format!("chain {} has no error `{}`", chain.name, name.get_ref());
        let near = names::nearest(name.get_ref(), of_kind().map(|id| chain.symbol(id).name.as_str()));
        let help = near.map_or_else(
            || "name errors and constants of the declaration".to_owned(),
            |near| format!("did you mean `{near}`?"),
        );
        source.mistake(Mistake::new(name.span(), message).with_help(help))
    })
}
