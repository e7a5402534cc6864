//! Inner products of columns, over some of their rows, and what they take out of columns.

use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, Mat, MatMut, MatRef, Par};

/// Columns that one processor works on at a time.
const COLUMNS_AT_ONCE: usize = 48;

/// A copy of some rows.
pub(super) fn picked(rows: MatRef<'_, f64>, members: &[usize]) -> Mat<f64> {
    let mut part = Mat::zeros(members.len(), rows.ncols());
    for (j, column) in rows.col_iter().enumerate() {
        for (target, &row) in part.col_as_slice_mut(j).iter_mut().zip(members) {
            *target = column[row];
        }
    }
    part
}

/// Adds the inner products of columns to the lower half of a matrix.
pub(crate) fn add_products(gram: MatMut<'_, f64>, rows: MatRef<'_, f64>) {
    let (half, whole) = (BlockStructure::TriangularLower, BlockStructure::Rectangular);
    triangular::matmul(gram, half, Accum::Add, rows.transpose(), whole, rows, whole, 1.0, Par::Seq);
}

/// Fills the upper half with the mirror image of the lower.
pub(super) fn mirrored(mut gram: MatMut<'_, f64>) {
    for j in 0..gram.ncols() {
        for i in 0..j {
            gram[(i, j)] = gram[(j, i)];
        }
    }
}

/// Takes out of columns what an orthonormal basis explains of them: how much of each of its columns that was.
pub(super) fn taken_out(basis: MatRef<'_, f64>, columns: MatMut<'_, f64>) -> Mat<f64> {
    let count = columns.ncols();
    let (mut parts, mut rest) = (Vec::new(), columns);
    while rest.ncols() > 0 {
        let few = rest.ncols().min(COLUMNS_AT_ONCE);
        let (part, others) = rest.split_at_col_mut(few);
        parts.push(part);
        rest = others;
    }
    let of_part = |mut part: MatMut<'_, f64>| {
        let mut absorbed = Mat::zeros(basis.ncols(), part.ncols());
        // Twice: one pass of Gram-Schmidt leaves rounding of the part taken out.
        for _ in 0..2 {
            let mut coefficients = Mat::zeros(basis.ncols(), part.ncols());
            matmul(&mut coefficients, Accum::Replace, basis.transpose(), part.as_ref(), 1.0, Par::Seq);
            matmul(part.as_mut(), Accum::Add, basis, &coefficients, -1.0, Par::Seq);
            absorbed += coefficients;
        }
        absorbed
    };
    let parts = parallel::each_of(parts, of_part);
    let mut absorbed = Mat::zeros(basis.ncols(), count);
    let mut at = 0;
    for part in parts {
        absorbed.subcols_mut(at, part.ncols()).copy_from(&part);
        at += part.ncols();
    }
    absorbed
}
