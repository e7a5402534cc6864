//! Standard uncertainties of what is shown: the Jacobian at the errors given, times a factor of the covariance of estimates.

use model_core::SymbolId;

use crate::builder::{Builder, Value};

/// How sure some errors and constants are, together.
#[derive(Debug, Clone, Copy)]
pub struct Covariance<'a> {
    /// The errors and constants, in the order of the rows.
    pub of: &'a [SymbolId],
    /// SI, row by row; symmetric, and no combination has a variance below zero.
    pub rows: &'a [Vec<f64>],
}

/// Derivatives that some estimates have in common, and the places of these with their signs.
type Distinct = (Vec<Value>, Vec<(usize, f64)>);

/// The standard uncertainty of each number shown, from its derivatives by the estimates, row by row.
pub(super) fn standard(b: &mut Builder, derivatives: &[Value], covariance: &Covariance<'_>) -> Vec<Value> {
    let count = covariance.of.len();
    let shown = derivatives.len().checked_div(count).unwrap_or_default();
    let column = |at: usize| -> Vec<Value> { (0..shown).map(|row| derivatives[row * count + at]).collect() };
    // Estimates that move what is shown in the same way count as one, their sum: fewer operations, and what only their
    // sum is sure of is not taken apart.
    let mut distinct: Vec<Distinct> = Vec::new();
    for at in 0..count {
        let own = column(at);
        if own.iter().all(|value| *value == Builder::ZERO) {
            continue;
        }
        let turned: Vec<Value> = own.iter().map(|value| -*value).collect();
        match distinct.iter_mut().find(|(known, _)| *known == own || *known == turned) {
            Some((known, members)) => members.push((at, if *known == own { 1.0 } else { -1.0 })),
            None => distinct.push((own, vec![(at, 1.0)])),
        }
    }
    let between = |one: &[(usize, f64)], other: &[(usize, f64)]| -> f64 {
        let pairs = one.iter().flat_map(|a| other.iter().map(move |b| (a, b)));
        pairs.map(|((a, sign_a), (b, sign_b))| sign_a * sign_b * covariance.rows[*a][*b]).sum()
    };
    let rows: Vec<Vec<f64>> = distinct
        .iter()
        .map(|(_, one)| distinct.iter().map(|(_, other)| between(one, other)).collect())
        .collect();
    let factor = factor(&rows);
    (0..shown)
        .map(|row| {
            let mut variance = Builder::ZERO;
            for column in &factor {
                let pairs: Vec<(Value, Value)> = distinct
                    .iter()
                    .zip(column)
                    .map(|((own, _), &part)| (own[row], b.constant(part)))
                    .collect();
                let moved = b.dot(pairs);
                let square = b.mul(moved, moved);
                variance = b.add(variance, square);
            }
            b.root(variance)
        })
        .collect()
}

/// Columns whose products with themselves add up to a covariance: Cholesky's method on the correlations, the largest that is
/// left first, until what is left is rounding.
fn factor(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let count = rows.len();
    let scale: Vec<f64> = (0..count).map(|at| rows[at][at].max(0.0).sqrt()).collect();
    let correlation = |a: usize, b: usize| {
        if scale[a] > 0.0 && scale[b] > 0.0 { rows[a][b] / (scale[a] * scale[b]) } else { 0.0 }
    };
    let mut left: Vec<Vec<f64>> =
        (0..count).map(|a| (0..count).map(|b| correlation(a, b)).collect()).collect();
    let mut columns = Vec::new();
    for _ in 0..count {
        let Some(pivot) = (0..count).max_by(|a, b| left[*a][*a].total_cmp(&left[*b][*b])) else { break };
        let largest = left[pivot][pivot];
        if largest.is_nan() || largest <= count as f64 * f64::EPSILON {
            break;
        }
        let column: Vec<f64> = (0..count).map(|at| left[at][pivot] / largest.sqrt()).collect();
        for (a, row) in left.iter_mut().enumerate() {
            for (b, entry) in row.iter_mut().enumerate() {
                let is_done = a == pivot || b == pivot;
                *entry = if is_done { 0.0 } else { *entry - column[a] * column[b] };
            }
        }
        columns.push(column.iter().zip(&scale).map(|(part, scale)| part * scale).collect());
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::factor;

    /// The products of the columns, added up.
    fn product(columns: &[Vec<f64>], a: usize, b: usize) -> f64 {
        columns.iter().map(|column| column[a] * column[b]).sum()
    }

    #[test]
    fn factors_multiply_to_the_covariance() {
        let whole = vec![vec![4e-8, 1e-5, -3e-9], vec![1e-5, 9e-3, 2e-7], vec![-3e-9, 2e-7, 1e-9]];
        // The third is the sum of the others: two columns tell all.
        let singular = vec![vec![2.0, -1.0, 1.0], vec![-1.0, 3.0, 2.0], vec![1.0, 2.0, 3.0]];
        // The first is known for sure.
        let sure = vec![vec![0.0, 0.0], vec![0.0, 2.5e-13]];
        for (rows, count) in [(whole, 3), (singular, 2), (sure, 1)] {
            let columns = factor(&rows);
            assert_eq!(columns.len(), count);
            for (a, row) in rows.iter().enumerate() {
                for (b, entry) in row.iter().enumerate() {
                    let scale = (rows[a][a] * rows[b][b]).sqrt();
                    let wrong = (product(&columns, a, b) - entry).abs();
                    assert!(wrong <= 4.0 * f64::EPSILON * scale, "{a} {b}: {wrong} of {scale}");
                }
            }
        }
    }
}
