//! The standard uncertainties that the files of a study state: of what was measured, and of readings.

use model_core::SymbolId;
use nalgebra::DMatrix;

use super::columns::Columns;
use super::correlated::is_correlation;
use super::plan::SourcePlan;
use super::rows::Rows;
use super::uncertain::Uncertain;
use tables::formats::DataError;

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
    let is_one = |sigma: f64| sigma >= 0.0 && sigma.is_finite();
    let why = "a reading's standard uncertainty cannot be negative: write zero or more";
    each_row(&source.uncertain.sigma, &columns.uncertain, rows, file, is_one, why)
}

/// What is stated in columns, as far as it can be, and what is stated of every row; one value a row.
fn each_row<K: Copy>(
    stated: &[(K, Uncertain)],
    placed: &[(K, usize)],
    rows: &Rows,
    file: &str,
    is_one: impl Fn(f64) -> bool,
    why: &str,
) -> Result<Vec<(K, Vec<f64>)>, DataError> {
    let of_column = |(of, at): &(K, usize)| {
        let values = &rows.numbers[*at];
        match values.iter().position(|&value| !is_one(value)) {
            Some(row) => Err(impossible(rows, row, file, why)),
            None => Ok((*of, values.clone())),
        }
    };
    let evenly = stated.iter().filter_map(|(of, own)| match own {
        Uncertain::Evenly(value) => Some(Ok((*of, vec![*value; rows.row_numbers.len()]))),
        Uncertain::Column(_) => None,
    });
    placed.iter().map(of_column).chain(evenly).collect()
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
    let why = "a correlation lies between -1 and 1: divide a covariance by both standard deviations";
    let pairs = each_row(&source.uncertain.correlated, &columns.correlated, rows, file, is_correlation, why)?;
    match (0..rows.row_numbers.len()).find(|&row| !hang_together(&pairs, row)) {
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
