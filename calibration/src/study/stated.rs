//! The standard uncertainties that the files of a study state: of what was measured, and of readings.

use model_core::SymbolId;

use super::columns::Columns;
use super::plan::SourcePlan;
use super::rows::Rows;
use super::uncertain::Uncertain;
use crate::formats::DataError;

/// Those of the components of each row.
pub(super) fn of_components(columns: &Columns, rows: &Rows, file: &str) -> Result<Vec<[f64; 3]>, DataError> {
    let stated: Vec<&Vec<f64>> = columns.sigma.clone().filter_map(|at| rows.numbers.get(at)).collect();
    (0..rows.row_numbers.len())
        .map(|row| {
            let of = |component: usize| stated[component.min(stated.len() - 1)][row];
            let sigma = [of(0), of(1), of(2)];
            match sigma.iter().all(|&sigma| sigma > 0.0) {
                true => Ok(sigma),
                false => Err(impossible(rows, row, file, "a standard uncertainty must be positive")),
            }
        })
        .collect()
}

/// Those of readings that are not exact, one value a row; zero in a row whose reading is.
pub(super) fn of_readings(
    source: &SourcePlan,
    columns: &Columns,
    rows: &Rows,
    file: &str,
) -> Result<Vec<(SymbolId, Vec<f64>)>, DataError> {
    let count = rows.row_numbers.len();
    let of_column = |(id, at): &(SymbolId, usize)| {
        let stated = &rows.numbers[*at];
        match stated.iter().position(|sigma| !(*sigma >= 0.0 && sigma.is_finite())) {
            Some(row) => Err(impossible(rows, row, file, "a reading's standard uncertainty is zero or more")),
            None => Ok((*id, stated.clone())),
        }
    };
    let evenly = source.uncertain.iter().filter_map(|(id, own)| match own {
        Uncertain::Evenly(sigma) => Some(Ok((*id, vec![*sigma; count]))),
        Uncertain::Column(_) => None,
    });
    columns.uncertain.iter().map(of_column).chain(evenly).collect()
}

fn impossible(rows: &Rows, row: usize, file: &str, why: &str) -> DataError {
    let (line, row) = (rows.places.line(row), rows.number(row));
    DataError::Impossible { file: file.to_owned(), line, row, why: why.to_owned() }
}
