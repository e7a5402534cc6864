//! What a registration takes out: a turn and a shift of everything that is seen, which errors cannot be told from.

use model_core::ObservableKind;
use model_core::budget::Sensitivity;
use nalgebra::DMatrix;

/// The sensitivity with every column cleared of what a common turn, and for points a common shift, explains.
#[must_use]
pub fn registered(sensitivity: &Sensitivity) -> Sensitivity {
    let poses = sensitivity.poses();
    let rows = 3 * poses;
    let count = poses.max(1) as f64;
    let middle = match sensitivity.kind {
        ObservableKind::Direction => [0.0; 3],
        // A turn about the middle is the farthest from a shift.
        ObservableKind::Point => [0, 1, 2]
            .map(|axis: usize| sensitivity.places.iter().map(|place| place[axis]).sum::<f64>() / count),
    };
    let moves = match sensitivity.kind {
        ObservableKind::Direction => 3,
        ObservableKind::Point => 6,
    };
    let rigid = DMatrix::from_fn(rows, moves, |row, column| {
        let (pose, axis) = (row / 3, row % 3);
        if column >= 3 {
            return f64::from(u8::from(axis == column - 3));
        }
        // eₐ × place
        let place = [0, 1, 2].map(|axis: usize| sensitivity.places[pose][axis] - middle[axis]);
        match (axis + 3 - column) % 3 {
            1 => -place[(column + 2) % 3],
            2 => place[(column + 1) % 3],
            _ => 0.0,
        }
    });
    let basis = orthonormal(rigid);
    let errors = sensitivity.errors.len();
    let columns =
        DMatrix::from_fn(rows, errors, |row, error| sensitivity.columns[row / 3 * errors + error][row % 3]);
    let seen = &columns - &basis * (basis.transpose() * &columns);
    let column = |at: usize| [0, 1, 2].map(|axis| seen[(at / errors * 3 + axis, at % errors)]);
    Sensitivity { columns: (0..poses * errors).map(column).collect(), ..sensitivity.clone() }
}

/// An orthonormal basis of the columns; what of one is rounding beside the others has no part in it.
fn orthonormal(mut columns: DMatrix<f64>) -> DMatrix<f64> {
    /// Of a column's length.
    const ROUNDING: f64 = 1e-10;
    for at in 0..columns.ncols() {
        let length = columns.column(at).norm();
        // Twice is enough. Source: B. N. Parlett, The Symmetric Eigenvalue Problem (1980), section 6.9.
        for _ in 0..2 {
            for earlier in 0..at {
                let along = columns.column(earlier).dot(&columns.column(at));
                let part = columns.column(earlier) * along;
                columns.set_column(at, &(columns.column(at) - part));
            }
        }
        let left = columns.column(at).norm();
        let factor = if left > ROUNDING * length { 1.0 / left } else { 0.0 };
        columns.column_mut(at).scale_mut(factor);
    }
    columns
}
