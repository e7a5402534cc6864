//! Inner products of columns, over some of their rows.

use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::{Accum, Mat, MatMut, MatRef, Par};

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
    matmul(gram, half, Accum::Add, rows.transpose(), whole, rows, whole, 1.0, Par::Seq);
}

/// Fills the upper half with the mirror image of the lower.
pub(super) fn mirrored(mut gram: MatMut<'_, f64>) {
    for j in 0..gram.ncols() {
        for i in 0..j {
            gram[(i, j)] = gram[(j, i)];
        }
    }
}
