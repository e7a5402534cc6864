//! The standard uncertainties that the files of a study state: of what was measured, and of readings.

use model_core::SymbolId;
use nalgebra::DMatrix;

use super::columns::Columns;
use super::correlated::is_correlation;
use super::plan::SourcePlan;
use super::rows::Rows;
use super::uncertain::Uncertain;
use crate::formats::DataError;

/// Correlations that a file gives with few digits may be of no readings by as much.
const ROUNDED: f64 = 1e-2;

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
    let evenly = source.uncertain.sigma.iter().filter_map(|(id, own)| match own {
        Uncertain::Evenly(sigma) => Some(Ok((*id, vec![*sigma; count]))),
        Uncertain::Column(_) => None,
    });
    columns.uncertain.iter().map(of_column).chain(evenly).collect()
}

/// Two readings and their correlation, one value a row.
type OfPair = ([SymbolId; 2], Vec<f64>);

/// The correlations of pairs of readings.
pub(super) fn of_pairs(
    source: &SourcePlan,
    columns: &Columns,
    rows: &Rows,
    file: &str,
) -> Result<Vec<OfPair>, DataError> {
    let count = rows.row_numbers.len();
    let of_column = |(pair, at): &([SymbolId; 2], usize)| {
        let stated = &rows.numbers[*at];
        match stated.iter().position(|&correlation| !is_correlation(correlation)) {
            Some(row) => Err(impossible(
                rows,
                row,
                file,
                "a correlation lies between -1 and 1: divide a covariance by both standard deviations",
            )),
            None => Ok((*pair, stated.clone())),
        }
    };
    let evenly = source.uncertain.correlated.iter().filter_map(|(pair, own)| match own {
        Uncertain::Evenly(correlation) => Some(Ok((*pair, vec![*correlation; count]))),
        Uncertain::Column(_) => None,
    });
    let pairs: Vec<_> = columns.correlated.iter().map(of_column).chain(evenly).collect::<Result<_, _>>()?;
    match (0..count).find(|&row| !hang_together(&pairs, row)) {
        Some(row) => Err(impossible(
            rows,
            row,
            file,
            "its correlations contradict each other, no covariance matrix has them: state that of every pair",
        )),
        None => Ok(pairs),
    }
}

/// Whether the correlations of a row are those of anything: no combination of its readings has a negative variance, beyond rounding.
fn hang_together(pairs: &[OfPair], row: usize) -> bool {
    // Of one pair every correlation is.
    if pairs.len() < 2 {
        return true;
    }
    let mut readings: Vec<SymbolId> = pairs.iter().flat_map(|(pair, _)| *pair).collect();
    readings.sort_unstable();
    readings.dedup();
    let mut matrix = DMatrix::identity(readings.len(), readings.len());
    for (pair, values) in pairs {
        let [i, j] = pair.map(|id| readings.partition_point(|own| *own < id));
        (matrix[(i, j)], matrix[(j, i)]) = (values[row], values[row]);
    }
    matrix.symmetric_eigenvalues().iter().all(|&variance| variance >= -ROUNDED)
}

fn impossible(rows: &Rows, row: usize, file: &str, why: &str) -> DataError {
    let (line, row) = (rows.places.line(row), rows.number(row));
    DataError::Impossible { file: file.to_owned(), line, row, why: why.to_owned() }
}
