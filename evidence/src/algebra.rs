//! Small dense algebra: Cholesky factors, and the spectrum of a symmetric matrix with one vector in its axes.

use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, Mat, MatMut, MatRef, Par, Side};

/// The lower Cholesky factor. Where rounding makes the matrix indefinite, the diagonal grows by as little as helps.
pub(crate) fn cholesky(matrix: &Mat<f64>) -> Option<Mat<f64>> {
    if let Ok(factor) = matrix.llt(Side::Lower) {
        return Some(factor.L().to_owned());
    }
    [1e-13, 3e-12, 9e-11, 2.7e-9, 8.1e-8].iter().find_map(|nudge| {
        let mut nudged = matrix.clone();
        for index in 0..matrix.nrows() {
            nudged[(index, index)] *= 1.0 + nudge;
        }
        nudged.llt(Side::Lower).ok().map(|factor| factor.L().to_owned())
    })
}

/// Adds the inner products of columns to the lower triangle of a matrix.
pub(crate) fn add_products(lower: MatMut<'_, f64>, columns: MatRef<'_, f64>) {
    let (structure, whole) = (BlockStructure::TriangularLower, BlockStructure::Rectangular);
    triangular::matmul(
        lower,
        structure,
        Accum::Add,
        columns.transpose(),
        whole,
        columns,
        whole,
        1.0,
        Par::Seq,
    );
}

/// The inner products of columns.
pub(crate) fn products(columns: &Mat<f64>) -> Mat<f64> {
    let width = columns.ncols();
    let mut products = Mat::zeros(width, width);
    add_products(products.as_mut(), columns.as_ref());
    mirror(&mut products);
    products
}

/// Writes the lower triangle of a matrix over the upper one, tile by tile: column by column would leave the processor's cache.
pub(crate) fn mirror(matrix: &mut Mat<f64>) {
    const TILE: usize = 16;
    let size = matrix.ncols();
    let mut tile = [0.0; TILE * TILE];
    for left in (0..size).step_by(TILE) {
        let columns = left..(left + TILE).min(size);
        for top in (left..size).step_by(TILE) {
            let rows = top..(top + TILE).min(size);
            for (own, at) in tile.chunks_exact_mut(TILE).zip(columns.clone()) {
                own[..rows.len()].copy_from_slice(&column(matrix, at)[rows.clone()]);
            }
            for (down, row) in rows.enumerate() {
                let into = &mut column_mut(matrix, row)[left..columns.end.min(row)];
                for (value, own) in into.iter_mut().zip(tile.chunks_exact(TILE)) {
                    *value = own[down];
                }
            }
        }
    }
}

/// One column of a matrix stored by columns.
pub(crate) fn column(matrix: &Mat<f64>, at: usize) -> &[f64] {
    matrix.col(at).try_as_col_major().map_or(&[], |column| column.as_slice())
}

/// The same to be written.
pub(crate) fn column_mut(matrix: &mut Mat<f64>, at: usize) -> &mut [f64] {
    matrix.col_mut(at).try_as_col_major_mut().map_or(&mut [], |column| column.as_slice_mut())
}

/// L⁻¹ times each column.
pub(crate) fn solve_lower(factor: MatRef<'_, f64>, right: MatMut<'_, f64>) {
    solve_lower_triangular_in_place(factor, right, Par::Seq);
}

/// L⁻ᵀ times a vector.
pub(crate) fn solve_upper(factor: &Mat<f64>, right: &mut [f64]) {
    for row in (0..right.len()).rev() {
        let own = column(factor, row);
        right[row] = (right[row] - dot(&own[row + 1..], &right[row + 1..])) / own[row];
    }
}

/// Half of the logarithm of the determinant of a matrix, from its factor.
pub(crate) fn half_log_det(factor: &Mat<f64>) -> f64 {
    (0..factor.nrows()).map(|index| column(factor, index)[index].ln()).sum()
}

/// Inner product with four sums side by side.
#[inline(always)]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a_lanes, a_rest) = a.as_chunks::<4>();
    let (b_lanes, b_rest) = b.as_chunks::<4>();
    for (a, b) in a_lanes.iter().zip(b_lanes) {
        for lane in 0..4 {
            sums[lane] += a[lane] * b[lane];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums[0] + sums[1] + (sums[2] + sums[3]) + rest
}

/// Eigenvalues of a symmetric matrix (full, column by column), and a vector in the axes of its eigenvectors.
///
/// The eigenvectors themselves are never formed: reflections and rotations act on the vector.
/// Source: Golub and Welsch (1969), Calculation of Gauss quadrature rules, for the idea; Bowdler et al. (1968) for QL.
pub(crate) fn spectrum(matrix: &mut [f64], vector: &mut [f64]) -> Vec<f64> {
    // Nearly all of a contest's time beside products of matrices is spent here.
    let (mut diagonal, mut beside) = pulp::Arch::new().dispatch(|| tridiagonal(matrix, vector));
    let size = diagonal.len();
    for low in 0..size {
        // Rounding ends the loop after two or three rounds; the bound is only for values that are no numbers.
        for _ in 0..60 {
            let small = |at: usize, diagonal: &[f64], beside: &[f64]| {
                beside[at].abs() <= f64::EPSILON * (diagonal[at].abs() + diagonal[at + 1].abs())
            };
            let end = (low..size - 1).find(|&at| small(at, &diagonal, &beside)).unwrap_or(size - 1);
            if end == low {
                break;
            }
            rotate(&mut diagonal, &mut beside, vector, low, end);
        }
    }
    diagonal
}

/// Householder's reduction to a tridiagonal matrix.
#[inline(always)]
fn tridiagonal(a: &mut [f64], vector: &mut [f64]) -> (Vec<f64>, Vec<f64>) {
    let n = vector.len();
    let (mut beside, mut v, mut p) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    for k in 0..n.saturating_sub(2) {
        let column = &a[k * n..(k + 1) * n];
        let length = dot(&column[k + 1..], &column[k + 1..]).sqrt();
        beside[k] = column[k + 1];
        if length == 0.0 || dot(&column[k + 2..], &column[k + 2..]) == 0.0 {
            continue;
        }
        let reflected = if column[k + 1] > 0.0 { -length } else { length };
        v[k + 1..].copy_from_slice(&column[k + 1..]);
        v[k + 1] -= reflected;
        beside[k] = reflected;
        let beta = 2.0 / dot(&v[k + 1..], &v[k + 1..]);
        for j in k + 1..n {
            p[j] = beta * dot(&a[j * n + k + 1..(j + 1) * n], &v[k + 1..]);
        }
        let half = beta / 2.0 * dot(&p[k + 1..], &v[k + 1..]);
        for j in k + 1..n {
            p[j] -= half * v[j];
        }
        for j in k + 1..n {
            let (vj, pj) = (v[j], p[j]);
            for ((a, v), p) in a[j * n + k + 1..(j + 1) * n].iter_mut().zip(&v[k + 1..]).zip(&p[k + 1..]) {
                *a -= vj * p + pj * v;
            }
        }
        let along = beta * dot(&v[k + 1..], &vector[k + 1..]);
        for (value, v) in vector[k + 1..].iter_mut().zip(&v[k + 1..]) {
            *value -= along * v;
        }
    }
    if n > 1 {
        beside[n - 2] = a[(n - 2) * n + n - 1];
    }
    ((0..n).map(|k| a[k * n + k]).collect(), beside)
}

/// One implicit QL step between two small off-diagonals.
fn rotate(diagonal: &mut [f64], beside: &mut [f64], vector: &mut [f64], low: usize, end: usize) {
    let g = (diagonal[low + 1] - diagonal[low]) / (2.0 * beside[low]);
    let r = (g * g + 1.0).sqrt();
    let mut g = diagonal[end] - diagonal[low] + beside[low] / (g + r.copysign(g));
    let (mut sine, mut cosine, mut shift) = (1.0, 1.0, 0.0);
    for at in (low..end).rev() {
        let (f, b) = (sine * beside[at], cosine * beside[at]);
        let r = (f * f + g * g).sqrt();
        beside[at + 1] = r;
        if r == 0.0 {
            diagonal[at + 1] -= shift;
            beside[end] = 0.0;
            return;
        }
        (sine, cosine) = (f / r, g / r);
        let g_next = diagonal[at + 1] - shift;
        let r = (diagonal[at] - g_next) * sine + 2.0 * cosine * b;
        shift = sine * r;
        diagonal[at + 1] = g_next + shift;
        g = cosine * r - b;
        let above = vector[at + 1];
        vector[at + 1] = sine * vector[at] + cosine * above;
        vector[at] = cosine * vector[at] - sine * above;
    }
    diagonal[low] -= shift;
    beside[low] = g;
    beside[end] = 0.0;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spectrum_gives_traces_and_quadratic_forms_back() {
        for n in [1, 2, 3, 7, 29] {
            let value =
                |i: usize, j: usize| ((i * 7 + j * 7 + i * j) as f64).sin() + if i == j { 3.0 } else { 0.0 };
            let matrix: Vec<f64> = (0..n * n).map(|at| value(at / n, at % n)).collect();
            let vector: Vec<f64> = (0..n).map(|at| (at as f64 + 0.5).cos()).collect();
            let (mut a, mut g) = (matrix.clone(), vector.clone());
            let values = spectrum(&mut a, &mut g);
            let trace: f64 = (0..n).map(|at| matrix[at * n + at]).sum();
            assert!((values.iter().sum::<f64>() - trace).abs() < 1e-12 * n as f64);
            let times = |vector: &[f64]| -> Vec<f64> {
                (0..n).map(|row| (0..n).map(|at| matrix[row * n + at] * vector[at]).sum()).collect()
            };
            let (once, twice) = (times(&vector), times(&times(&vector)));
            let form =
                |power: i32| g.iter().zip(&values).map(|(g, value)| g * g * value.powi(power)).sum::<f64>();
            assert!((form(1) - dot(&vector, &once)).abs() < 1e-11 * n as f64);
            assert!((form(2) - dot(&vector, &twice)).abs() < 1e-10 * n as f64);
        }
    }
}
