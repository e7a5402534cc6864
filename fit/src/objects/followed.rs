//! How much of a residual of its own each component leaves to what is estimated: an object seen closely takes its place from
//! the sights across it, which leave little of their own.
//!
//! The factor of a fit gives it row by row. What stations and errors take is what a row's derivatives are once the triangle is
//! divided out, less what the row's object follows of that.

use faer::{Mat, MatRef};

use super::eliminate::{Collected, Eliminated, OF_STATION, divided_out};
use super::reduce::{reflected, units};
use observe::unknowns::{Freedom, OF_OBJECT, Object, Unknowns, WIDTH};

/// What is followed of a component's own residual, as shares of it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FollowedShare {
    /// By its object and by stations.
    pub by_unknowns: f64,
    /// By the errors.
    pub by_errors: f64,
}

/// A component with its row's number and derivatives, whitened and weighted.
type Seen<'a> = (usize, u32, &'a [f64]);

impl Eliminated {
    /// Of each of so many components what is followed, for rows like those that were eliminated; a matrix whose product with its own
    /// transpose is the covariance of the chain's columns is `root`, and `first` tells the first component of a row.
    pub fn followed(
        &self,
        unknowns: &Unknowns,
        parts: &[Collected],
        root: &Mat<f64>,
        first: impl Fn(usize) -> usize,
        components: usize,
    ) -> Vec<FollowedShare> {
        let width = WIDTH + root.nrows() + 1;
        let mut of_object: Vec<Vec<Seen<'_>>> = vec![Vec::new(); unknowns.objects.len() + 1];
        for part in parts {
            let mut last = (u32::MAX, 0);
            for (&row, values) in part.row.iter().zip(part.values.chunks_exact(width)) {
                last = if last.0 == row { (row, last.1 + 1) } else { (row, first(row as usize)) };
                let object = unknowns.object[row as usize].map_or(unknowns.objects.len(), |at| at as usize);
                of_object[object].push((last.1, row, values));
            }
        }
        let by_stations = self.by_stations(root);
        let own = parallel::each_of(of_object.iter_mut().enumerate(), |(object, rows)| {
            rows.sort_by_key(|&(_, row, _)| unknowns.station[row as usize]);
            of_rows(unknowns, rows, unknowns.objects.get(object), by_stations.as_ref(), root)
        });
        let mut followed = vec![FollowedShare::default(); components];
        for (rows, shares) in of_object.iter().zip(own) {
            rows.iter().zip(shares).for_each(|((at, ..), share)| followed[*at] = share);
        }
        followed
    }

    /// By what the derivatives by stations are multiplied: columns for the stations, and for the errors that stations follow.
    pub(super) fn by_stations(&self, root: &Mat<f64>) -> Mat<f64> {
        let factor = self.of_stations();
        let (count, k) = (factor.nrows(), root.ncols());
        let by_errors = factor.subcols(count, root.nrows()) * root;
        let mut by = Mat::<f64>::zeros(count, count + k);
        for column in 0..count + k {
            let right = |row: usize| match column.checked_sub(count) {
                None => f64::from(u8::from(row == column)),
                Some(error) => -by_errors[(row, error)],
            };
            by.col_as_slice_mut(column).copy_from_slice(&divided_out(factor, count, right));
        }
        by
    }
}

/// The same of the rows of one object.
fn of_rows(
    unknowns: &Unknowns,
    rows: &[Seen<'_>],
    object: Option<&Object>,
    by_stations: MatRef<'_, f64>,
    root: &Mat<f64>,
) -> Vec<FollowedShare> {
    let (stations, columns) = (by_stations.nrows(), root.nrows());
    let of_chain = Mat::from_fn(rows.len(), columns, |i, j| rows[i].2[WIDTH + j]);
    let mut left = Mat::<f64>::zeros(rows.len(), by_stations.ncols());
    left.subcols_mut(stations, root.ncols()).copy_from(&of_chain * root);
    let first_of_station = unknowns.first_of_stations();
    let mut start = 0;
    for seen in rows.chunk_by(|a, b| unknowns.station[a.1 as usize] == unknowns.station[b.1 as usize]) {
        let station = unknowns.station[seen[0].1 as usize] as usize;
        if unknowns.stations[station].numbers() > 0 {
            let own = Mat::from_fn(seen.len(), OF_STATION, |i, j| seen[i].2[OF_OBJECT + j]);
            let part = own * by_stations.subrows(first_of_station[station], OF_STATION);
            let mut left = left.subrows_mut(start, seen.len());
            left += part;
        }
        start += seen.len();
    }
    let numbers = object.map_or(0, Object::numbers);
    // What is stated of the object holds it beside its rows.
    let stated = match object.map(|object| object.freedom) {
        Some(Freedom::Within { shift_m, .. }) => (numbers, 1.0 / shift_m),
        _ => (0, 0.0),
    };
    let count = rows.len() + stated.0;
    let mut of_object = Mat::from_fn(count, numbers.min(count), |i, j| match i.checked_sub(rows.len()) {
        None => rows[i].2[j],
        Some(number) => {
            if number == j {
                stated.1
            } else {
                0.0
            }
        }
    });
    let (reflections, moves) = reflected(&mut of_object);
    let units = units(&reflections, &moves);
    let basis = Mat::from_fn(rows.len(), units.len(), |i, j| units[j][i]);
    let share = basis.transpose() * &left;
    left -= &basis * share;
    let mut followed = vec![FollowedShare::default(); rows.len()];
    let mut add = |columns: MatRef<'_, f64>, to: fn(&mut FollowedShare) -> &mut f64| {
        for column in columns.col_iter() {
            followed.iter_mut().zip(column.iter()).for_each(|(own, value)| *to(own) += value * value);
        }
    };
    add(basis.as_ref(), |own| &mut own.by_unknowns);
    add(left.subcols(0, stations), |own| &mut own.by_unknowns);
    add(left.subcols(stations, root.ncols()), |own| &mut own.by_errors);
    followed
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use faer::Side;
    use faer::linalg::solvers::DenseSolveCore;

    use super::*;
    use crate::objects::Starts;
    use observe::unknowns::{Freedom, Object, Shape, Station};

    const ROWS: usize = 30;
    const COLUMNS: usize = 2;

    /// The diagonal of the projection onto the columns of a matrix.
    fn hat(matrix: &Mat<f64>) -> Vec<f64> {
        let inverse = (matrix.transpose() * matrix).llt(Side::Lower).unwrap().inverse();
        let hat = matrix * inverse * matrix.transpose();
        (0..matrix.nrows()).map(|at| hat[(at, at)]).collect()
    }

    /// Two targets seen from two stations, of which one is unknown, and rows that see none: as in one matrix of everything.
    #[test]
    fn shares_are_those_of_all_numbers_at_once() {
        let mut free = Station::ground();
        free.freedom = Freedom::Free;
        let mut given = Station::ground();
        given.freedom = Freedom::Given;
        let unknowns = Unknowns {
            objects: ["A", "B"].map(|label| Object::unknown(label.to_owned(), Shape::Point)).to_vec(),
            stations: vec![given, free],
            object: (0..ROWS as u32).map(|row| [None, Some(0), Some(1)][row as usize % 3]).collect(),
            station: (0..ROWS as u32).map(|row| row / 2 % 2).collect(),
        };
        let width = WIDTH + COLUMNS + 1;
        let mut collected = Collected::default();
        let mut dense = Mat::<f64>::zeros(2 * ROWS, 12 + COLUMNS);
        for component in 0..2 * ROWS {
            let row = component / 2;
            let mut values: Vec<f64> =
                (0..width).map(|j| ((component * (2 * j + 3) + 7 * j) as f64 * 0.73).sin()).collect();
            let object = unknowns.object[row];
            let own = if object.is_some() { 3 } else { 0 };
            values[own..OF_OBJECT].fill(0.0);
            if unknowns.station[row] == 0 || object.is_none() {
                values[OF_OBJECT..WIDTH].fill(0.0);
            }
            (0..own).for_each(|j| dense[(component, 3 * object.unwrap() as usize + j)] = values[j]);
            (0..OF_STATION + COLUMNS).for_each(|j| dense[(component, 6 + j)] = values[OF_OBJECT + j]);
            collected.row.push(row as u32);
            collected.values.extend(values);
        }
        let state = vec![0.0; unknowns.numbers()];
        let parts = [collected];
        let eliminated = Eliminated::of(&unknowns, &parts, &state, COLUMNS, 2 * ROWS as u64, Starts::Ignore);
        let factor = eliminated.partial.factor();
        let triangle = factor.submatrix(0, 0, COLUMNS, COLUMNS).to_owned();
        let root = triangle.partial_piv_lu().inverse();
        let followed = eliminated.followed(&unknowns, &parts, &root, |row| 2 * row, 2 * ROWS);
        let (all, of_unknowns) = (hat(&dense), hat(&dense.subcols(0, 12).to_owned()));
        for (at, own) in followed.iter().enumerate() {
            assert!((own.by_unknowns - of_unknowns[at]).abs() < 1e-9, "{at}: {own:?} {}", of_unknowns[at]);
            assert!((own.by_unknowns + own.by_errors - all[at]).abs() < 1e-9, "{at}: {own:?} {}", all[at]);
        }
        let sum: f64 = followed.iter().map(|own| own.by_unknowns + own.by_errors).sum();
        assert!((sum - 14.0).abs() < 1e-9, "{sum}");
    }
}
