//! How surely the numbers of objects and stations are known: by their own rows, and by what stations and errors move them.
//!
//! The triangles say it. A number is what its own rows tell, less what stations and errors behind it take, and those are
//! independent of its own rows once they are rotated.

use faer::{Mat, MatRef, Side};

use super::eliminate::{Eliminated, HOLD, Triangle, divided_out};

/// A number is held by nothing where this share of its variance comes from the rows that hold what nothing else holds.
const BY_HOLD: f64 = 0.01;

/// Of the directions of stations those count that such rows say more than this share of.
const SOME: f64 = 1e-6;

/// How surely some numbers are known.
#[derive(Debug, Clone)]
pub struct Spread {
    /// Where they stand among all.
    pub own: Vec<usize>,
    /// Their covariance, SI.
    pub covariance: Mat<f64>,
    /// Whether rows, or what is stated, hold each.
    pub held: Vec<bool>,
}

impl Eliminated {
    /// First that of all stations' numbers, then that of each object's. `variance` is that of a whitened component; a matrix whose
    /// product with its own transpose is the covariance of the chain's columns is `root`.
    pub fn spread(&self, variance: f64, root: &Mat<f64>) -> Vec<Spread> {
        let by_stations = self.by_stations(root);
        let count = by_stations.nrows();
        let unheld = unheld(by_stations.subcols(0, count), &holds(self.of_stations(), count));
        let of_triangle = |(number, Triangle { own, stations, factor }): (usize, &Triangle)| {
            let (k, factor) = (own.len(), factor.as_ref());
            let behind = k + stations.len();
            let chosen =
                Mat::from_fn(stations.len(), by_stations.ncols(), |i, j| by_stations[(stations[i], j)]);
            let mut moved = factor.subcols(k, stations.len()) * chosen;
            let mut by_errors = moved.subcols_mut(count, root.ncols());
            by_errors += factor.subcols(behind, root.nrows()) * root;
            let follows = solved(factor, -moved);
            let (with_stations, with_errors) =
                (follows.subcols(0, count), follows.subcols(count, root.ncols()));
            let alone = solved(factor, Mat::identity(k, k));
            let of_rows = &alone * alone.transpose() + with_stations * with_stations.transpose();
            // The stations' own triangle is that of no object.
            let through = if number == 0 { alone.as_ref() } else { with_stations };
            let of_stations = through * &unheld;
            let holds = if number == 0 { Vec::new() } else { holds(factor, k) };
            let held = (0..k).map(|at| {
                let own = holds.iter().enumerate().map(|(j, hold)| (hold * of_rows[(at, j)]).powi(2));
                own.sum::<f64>() + of_stations.row(at).squared_norm_l2() < BY_HOLD * of_rows[(at, at)]
            });
            Spread {
                own: own.clone(),
                held: held.collect(),
                covariance: of_rows * faer::Scale(variance) + with_errors * with_errors.transpose(),
            }
        };
        self.triangles.iter().enumerate().map(of_triangle).collect()
    }
}

/// How much the numbers of a triangle are held where nothing else holds them. What no row moves is held as if its column had length
/// one, and has no other length.
fn holds(factor: MatRef<'_, f64>, count: usize) -> Vec<f64> {
    let length = |at: usize| factor.col(at).norm_l2();
    (0..count).map(|at| HOLD * if length(at) > 2.0 * HOLD { length(at) } else { 1.0 }).collect()
}

/// Of the stations' independent parts, of which `root` makes their numbers, those that nothing holds, each by how much.
fn unheld(root: MatRef<'_, f64>, holds: &[f64]) -> Mat<f64> {
    let count = holds.len();
    if count == 0 {
        return Mat::zeros(0, 0);
    }
    let by_holds = Mat::from_fn(count, count, |i, j| holds[i] * root[(i, j)]);
    let Ok(eigen) = (by_holds.transpose() * &by_holds).self_adjoint_eigen(Side::Lower) else {
        return Mat::zeros(count, 0);
    };
    let values = eigen.S().column_vector();
    let some: Vec<usize> = (0..count).filter(|&at| values[at] > SOME).collect();
    Mat::from_fn(count, some.len(), |i, j| eigen.U()[(i, some[j])] * values[some[j]].sqrt())
}

/// The matrix whose product with the first, square, part of a triangle is `right`.
fn solved(factor: MatRef<'_, f64>, mut right: Mat<f64>) -> Mat<f64> {
    for column in 0..right.ncols() {
        let own = right.col_as_slice(column).to_vec();
        right.col_as_slice_mut(column).copy_from_slice(&divided_out(factor, own.len(), |row| own[row]));
    }
    right
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use faer::linalg::solvers::DenseSolveCore;

    use super::*;
    use crate::objects::{Collected, Starts};
    use observe::unknowns::{Freedom, OF_OBJECT, Object, Shape, Station, Unknowns, WIDTH};

    const ROWS: usize = 40;
    const COLUMNS: usize = 2;

    /// Two targets seen from a known and an unknown station: as the inverse of the normal matrix of everything says. What no row
    /// moves is not held.
    #[test]
    fn covariances_are_those_of_all_numbers_at_once() {
        let mut free = Station::ground();
        free.freedom = Freedom::Free;
        let unknowns = Unknowns {
            objects: ["A", "B", "C"].map(|label| Object::unknown(label.to_owned(), Shape::Point)).to_vec(),
            stations: vec![Station::ground(), free],
            object: (0..ROWS as u32).map(|row| Some(row % 2)).collect(),
            station: (0..ROWS as u32).map(|row| row / 2 % 2).collect(),
        };
        let mut collected = Collected::default();
        let mut dense = Mat::<f64>::zeros(2 * ROWS, 12 + COLUMNS);
        for component in 0..2 * ROWS {
            let row = component / 2;
            let mut values: Vec<f64> = (0..=WIDTH + COLUMNS)
                .map(|j| ((component * (2 * j + 3) + 7 * j) as f64 * 0.73).sin())
                .collect();
            values[3..OF_OBJECT].fill(0.0);
            if unknowns.station[row] == 0 {
                values[OF_OBJECT..WIDTH].fill(0.0);
            }
            (0..3).for_each(|j| dense[(component, 6 + 3 * (row % 2) + j)] = values[j]);
            (0..6).for_each(|j| dense[(component, j)] = values[OF_OBJECT + j]);
            (0..COLUMNS).for_each(|j| dense[(component, 12 + j)] = values[WIDTH + j]);
            collected.row.push(row as u32);
            collected.values.extend(values);
        }
        let state = vec![0.0; unknowns.numbers()];
        let eliminated =
            Eliminated::of(&unknowns, &[collected], &state, COLUMNS, 2 * ROWS as u64, Starts::Ignore);
        let factor = eliminated.partial.factor();
        let root = factor.submatrix(0, 0, COLUMNS, COLUMNS).to_owned().partial_piv_lu().inverse();
        let expected = (dense.transpose() * &dense).llt(Side::Lower).unwrap().inverse();
        // The errors may be less sure than rows of such noise make them.
        let variance = 0.25;
        let spread = eliminated.spread(variance, &(&root * faer::Scale(variance.sqrt())));
        let mut compared = 0;
        for own in &spread {
            for (i, &a) in own.own.iter().enumerate().filter(|(_, at)| **at < 12) {
                assert!(own.held[i], "{a}");
                for (j, &b) in own.own.iter().enumerate() {
                    let expected = variance * expected[(a, b)];
                    assert!((own.covariance[(i, j)] - expected).abs() < 1e-9, "{a}, {b}: {expected}");
                    compared += 1;
                }
            }
        }
        assert_eq!(compared, 36 + 2 * 9);
        let nothing: Vec<bool> =
            spread.iter().filter(|own| own.own[0] == 12).flat_map(|own| own.held.clone()).collect();
        assert_eq!(nothing, [false; 3]);
    }
}
