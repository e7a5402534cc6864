//! The combinations of parameters that data determine: those whose columns, with every error at zero, are independent.
//!
//! What only products of errors would show is not determined, however large the errors come out: the same declaration and
//! the same poses always determine the same combinations. An angle that came out near a quarter turn is no small error: a joint whose
//! zero is elsewhere. It stands at its whole quarter turns instead, where the instrument is another one.

use faer::{Mat, MatRef};

use super::partial::Partial;

/// Below this share of the largest singular value (columns scaled to length one) a combination counts as not seen: its
/// uncertainty would be ten thousand times that of what is seen best, and beyond what is linear.
const UNSEEN: f64 = 1e-4;

/// A column this much shorter than the longest is zero but for rounding: a quarter turn's cosine, say.
const ROUNDING: f64 = 1e-14;

/// Below this share of its largest part, a part of an undetermined combination is rounding.
const NO_PART: f64 = 1e-6;

/// A part of what sizes alone hold that is this share of the parameter's own standard uncertainty, or less, moves nothing that anybody
/// would notice: it adds half a percent to that.
const UNNOTICED: f64 = 0.1;

/// The first parameter of a combination has the factor 1 where its part in what the data see is at least this share of the largest.
const LEADS: f64 = 1e-3;

/// Of the parts of an undetermined combination the last one of at least this share of the largest stands for it.
const STANDS: f64 = 0.5;

/// The combinations that the data determine.
#[derive(Debug, Clone)]
pub struct Subspace {
    /// What the rows tell.
    partial: Partial,
    /// Whether it is asked what they tell more of than sizes do.
    is_beyond: bool,
    /// Length of each column of the whitened Jacobian; 1 for columns of zeros.
    scale: Vec<f64>,
    /// What is not determined, in parameters times their scale and in reduced echelon form, p × (p − rank).
    unseen: Mat<f64>,
    /// The parameter that stands for each column of `unseen`: its part is 1 there and 0 in the others.
    pivots: Vec<usize>,
    /// The change of each parameter that counts as one, SI.
    size: Vec<f64>,
    /// The whole quarter turns about which each parameter was asked for, rad; zero for others than angles.
    homes: Vec<f64>,
    /// Orthonormal combinations of parameters in units of their size: p − rank undetermined ones, then the determined. p × p.
    axes: Mat<f64>,
}

impl Subspace {
    /// What is seen where the partial was accumulated, with every error at zero. `size` holds the change of each parameter
    /// that counts as one, SI, length p.
    #[must_use]
    pub fn determined(partial: &Partial, size: Vec<f64>) -> Self {
        let p = partial.parameters;
        let factor = partial.factor();
        let lengths: Vec<f64> = (0..p).map(|column| partial.length(column)).collect();
        let longest = lengths.iter().copied().filter(|length| length.is_finite()).fold(0.0, f64::max);
        let visible = |length: f64| length > ROUNDING * longest && length.is_finite();
        let scale = lengths.iter().map(|&length| if visible(length) { length } else { 1.0 }).collect();
        let scaled = Mat::from_fn(p, p, |row, column| {
            if visible(lengths[column]) { factor[(row, column)] / lengths[column] } else { 0.0 }
        });
        let unseen = match scaled.svd() {
            Ok(svd) => {
                let values = svd.S().column_vector();
                let largest = if p > 0 { values[0] } else { 0.0 };
                let seen = |at: &usize| values[*at] > UNSEEN * largest && values[*at] > 0.0;
                let rank = (0..p).filter(seen).count();
                svd.V().subcols(rank, p - rank).to_owned()
            }
            // Only numbers that are none do not factor: nothing is seen then.
            Err(_) => Mat::identity(p, p),
        };
        Self::without(unseen, &[], scale, partial, false).resized(size)
    }

    /// The same, asked with each parameter at so many quarter turns, rad, length p.
    #[must_use]
    pub fn at(self, homes: Vec<f64>) -> Self {
        Self { homes, ..self }
    }

    /// The whole quarter turns about which each parameter was asked for, rad.
    #[must_use]
    pub fn homes(&self) -> &[f64] {
        &self.homes
    }

    /// What the rows tell more of than the sizes do: combinations whose standard uncertainty from the whitened rows is below
    /// that of a prior of these sizes, SI, length p.
    #[must_use]
    pub fn beyond(partial: &Partial, size: Vec<f64>) -> Self {
        let p = partial.parameters;
        let factor = partial.factor();
        let scaled = Mat::from_fn(p, p, |row, column| factor[(row, column)] * size[column]);
        let (unseen, unnoticed) = match scaled.svd() {
            Ok(svd) => {
                let values = svd.S().column_vector();
                let rank = (0..p).filter(|&at| values[at] > 1.0).count();
                let variance =
                    |row| (0..rank).map(|at| (svd.V()[(row, at)] / values[at]).powi(2)).sum::<f64>();
                let unnoticed = (0..p).map(|row| UNNOTICED * variance(row).sqrt()).collect();
                (svd.V().subcols(rank, p - rank).to_owned(), unnoticed)
            }
            // Only numbers that are none do not factor: nothing is seen then.
            Err(_) => (Mat::identity(p, p), Vec::new()),
        };
        let scale = size.iter().map(|size| 1.0 / size).collect();
        Self::without(unseen, &unnoticed, scale, partial, true).resized(size)
    }

    /// What is left without combinations that are not seen, of parameters times their scale, and without the parts of these that nobody
    /// would notice; the sizes are still to be told.
    fn without(
        unseen: Mat<f64>,
        unnoticed: &[f64],
        scale: Vec<f64>,
        partial: &Partial,
        is_beyond: bool,
    ) -> Self {
        let (mut unseen, pivots) = echelon(unseen);
        for column in unseen.col_iter_mut() {
            let parts = column.iter_mut().zip(unnoticed);
            parts.filter(|(part, unnoticed)| part.abs() <= **unnoticed).for_each(|(part, _)| *part = 0.0);
        }
        let axes = Mat::zeros(scale.len(), scale.len());
        let homes = vec![0.0; scale.len()];
        Self { partial: partial.clone(), is_beyond, scale, unseen, pivots, size: Vec::new(), homes, axes }
    }

    /// What the rows tell of the first so many parameters, as if there were no others.
    #[must_use]
    pub fn of_first(&self, count: usize) -> Self {
        let partial = self.partial.spread(&(0..count).map(Some).collect::<Vec<_>>());
        let first = match self.is_beyond {
            true => Self::beyond(&partial, self.scale[..count].iter().map(|scale| 1.0 / scale).collect()),
            false => Self::determined(&partial, self.size[..count].to_vec()),
        };
        first.at(self.homes[..count].to_vec())
    }

    /// The same combinations with other sizes.
    #[must_use]
    pub fn resized(mut self, size: Vec<f64>) -> Self {
        let mut rest = Mat::from_fn(self.unseen.nrows(), self.unseen.ncols(), |row, column| {
            self.unseen[(row, column)] / self.scale[row] / size[row]
        });
        normalise(&mut rest);
        let p = self.scale.len();
        self.axes = if rest.ncols() > 0 { rest.qr().compute_Q() } else { Mat::identity(p, p) };
        self.size = size;
        self
    }

    /// The number of combinations that are determined.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.scale.len() - self.unseen.ncols()
    }

    /// The number of parameters.
    pub(super) fn parameters(&self) -> usize {
        self.scale.len()
    }

    /// The change of each parameter that counts as one, SI.
    pub fn size(&self) -> &[f64] {
        &self.size
    }

    /// Orthonormal undetermined combinations of parameters in units of their size, p × (p − rank).
    pub(super) fn rest(&self) -> MatRef<'_, f64> {
        self.axes.as_ref().subcols(0, self.unseen.ncols())
    }

    /// Orthonormal combinations without undetermined part, of parameters in units of their size, p × rank.
    pub(super) fn basis(&self) -> MatRef<'_, f64> {
        self.axes.as_ref().subcols(self.unseen.ncols(), self.rank())
    }

    /// How far parameters that deviate so much, SI, lie along each undetermined combination, in units of the sizes.
    #[must_use]
    pub fn strain(&self, deviation: &[f64]) -> Vec<f64> {
        let along = |axis: usize| {
            let parts = deviation.iter().zip(&self.size).enumerate();
            parts.map(|(row, (value, size))| self.axes[(row, axis)] * value / size).sum()
        };
        (0..self.unseen.ncols()).map(along).collect()
    }

    /// A deviation without its undetermined part, SI: the smallest, in units of the sizes, that the data cannot tell from it.
    #[must_use]
    pub fn smallest(&self, deviation: &[f64]) -> Vec<f64> {
        let strain = self.strain(deviation);
        let part =
            |row: usize| strain.iter().enumerate().map(|(at, s)| s * self.axes[(row, at)]).sum::<f64>();
        deviation.iter().enumerate().map(|(row, value)| value - part(row) * self.size[row]).collect()
    }

    /// The combinations that are not determined, in SI parameters, columns of length one, each with as few parts as the
    /// others leave it. p × (p − rank).
    #[must_use]
    pub fn null_space(&self) -> Mat<f64> {
        let mut null = Mat::from_fn(self.scale.len(), self.unseen.ncols(), |row, column| {
            self.unseen[(row, column)] / self.scale[row]
        });
        normalise(&mut null);
        null
    }

    /// Per parameter, whether it has no part in what is not determined.
    #[must_use]
    pub fn separable(&self) -> Vec<bool> {
        self.unseen.row_iter().map(|row| row.iter().all(|&part| part == 0.0)).collect()
    }

    /// Per parameter, whether some determined combination holds it.
    #[must_use]
    pub fn shown(&self) -> Vec<bool> {
        let combinations = self.combinations();
        let holds = |parameter| combinations.iter().flatten().any(|&(own, _)| own == parameter);
        (0..self.scale.len()).map(holds).collect()
    }

    /// Independent combinations that the data determine, as many as the rank: parameters in their order with their factors
    /// (SI), the first 1. The parameter that a combination is of comes first where sizes hold the rest, or where the first in order hardly has a
    /// part in it; behind it stands what it hangs on.
    #[must_use]
    pub fn combinations(&self) -> Vec<Vec<(usize, f64)>> {
        let free = (0..self.scale.len()).filter(|row| !self.pivots.contains(row));
        free.map(|row| {
            // Together with those that stand for what is not determined, a parameter without the undetermined part.
            let others = self.pivots.iter().enumerate().map(|(column, &pivot)| {
                (pivot, -self.unseen[(row, column)] * self.scale[pivot] / self.scale[row])
            });
            let mut parts: Vec<(usize, f64)> = others.filter(|(_, part)| *part != 0.0).collect();
            parts.push((row, 1.0));
            parts.sort_by_key(|(parameter, _)| *parameter);
            // Of one that hardly has a part in it the others would be ten thousands.
            let share = |&(own, part): &(usize, f64)| (part * self.scale[row] / self.scale[own]).abs();
            let largest = parts.iter().map(share).fold(0.0, f64::max);
            let leads = !self.is_beyond && share(&parts[0]) >= LEADS * largest;
            parts.sort_by_key(|(parameter, _)| (!leads && *parameter != row, *parameter));
            let first = parts[0].1;
            parts.iter_mut().for_each(|(_, part)| *part = plain(*part / first));
            parts
        })
        .collect()
    }

    /// The parameters that undetermined combinations link, set by set in their order, each with the number of combinations
    /// of the set that are not determined. A parameter that moves nothing is a set of its own.
    #[must_use]
    pub fn linked(&self) -> Vec<(Vec<usize>, usize)> {
        let mut sets: Vec<(Vec<usize>, usize)> = Vec::new();
        for column in self.unseen.col_iter() {
            let parts: Vec<usize> = (0..column.nrows()).filter(|&row| column[row] != 0.0).collect();
            let apart = |set: &(Vec<usize>, usize)| set.0.iter().all(|member| !parts.contains(member));
            let (mut rest, joined): (Vec<_>, Vec<_>) = sets.into_iter().partition(apart);
            let count = 1 + joined.iter().map(|(_, count)| count).sum::<usize>();
            let mut members: Vec<usize> = joined.into_iter().flat_map(|set| set.0).chain(parts).collect();
            members.sort_unstable();
            members.dedup();
            rest.push((members, count));
            sets = rest;
        }
        sets.sort();
        sets
    }
}

/// A factor without the rounding of the elimination, where it is a small fraction.
fn plain(factor: f64) -> f64 {
    let sixths = (factor * 12.0).round() / 12.0;
    if sixths != 0.0 && (factor - sixths).abs() < NO_PART { sixths } else { factor }
}

/// Columns of length one.
fn normalise(columns: &mut Mat<f64>) {
    for column in columns.col_iter_mut() {
        let length = column.norm_l2();
        if length > 0.0 {
            column.iter_mut().for_each(|part| *part /= length);
        }
    }
}

/// The same column space in reduced echelon form: each column has a row in which the others are zero, and which stands for
/// it. What is left in other rows are the parts that it cannot do without, so that parameters which nothing links share no
/// column, and one that moves nothing has a column to itself.
fn echelon(mut columns: Mat<f64>) -> (Mat<f64>, Vec<usize>) {
    let (rows, count) = columns.shape();
    let mut pivots: Vec<usize> = Vec::new();
    for done in 0..count {
        let free: Vec<(usize, usize)> = (0..rows)
            .filter(|row| !pivots.contains(row))
            .flat_map(|row| (done..count).map(move |at| (row, at)))
            .collect();
        let size = |&(row, at): &(usize, usize)| columns[(row, at)].abs();
        let largest = free.iter().map(size).fold(0.0, f64::max);
        // Not the largest itself: which of two that are alike is larger would be for rounding to say.
        let stands = free.iter().rev().find(|at| size(at) >= STANDS * largest && largest > 0.0);
        let Some(&(pivot, at)) = stands else { break };
        pivots.push(pivot);
        for row in 0..rows {
            let own = columns[(row, at)];
            columns[(row, at)] = columns[(row, done)];
            columns[(row, done)] = own;
        }
        let head = columns[(pivot, done)];
        for row in 0..rows {
            columns[(row, done)] /= head;
        }
        for other in (0..count).filter(|&other| other != done) {
            let share = columns[(pivot, other)];
            for row in 0..rows {
                columns[(row, other)] -= share * columns[(row, done)];
            }
            columns[(pivot, other)] = 0.0;
        }
    }
    for column in columns.col_iter_mut() {
        let largest = column.norm_max();
        column.iter_mut().filter(|part| part.abs() < NO_PART * largest).for_each(|part| *part = 0.0);
    }
    (columns, pivots)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The factor of a Jacobian.
    fn partial(rows: &[[f64; 4]]) -> Partial {
        let matrix = Mat::from_fn(rows.len(), 5, |row, column| rows[row].get(column).copied().unwrap_or(0.0));
        Partial::new(4).with_rows(matrix.as_ref())
    }

    #[test]
    fn sums_are_determined_where_their_parts_are_not() {
        // The first two move everything alike, the second by half; the last moves nothing.
        let rows = [[2.0, 1.0, 0.0, 0.0], [4.0, 2.0, 1.0, 0.0], [-2.0, -1.0, 3.0, 0.0]];
        for size in [vec![1.0; 4], vec![1e-4, 1e-3, 2.0, 1.0]] {
            let subspace = Subspace::determined(&partial(&rows), size.clone());
            assert_eq!(subspace.rank(), 2);
            assert_eq!(subspace.combinations(), [vec![(0, 1.0), (1, 0.5)], vec![(2, 1.0)]]);
            assert_eq!(subspace.separable(), [false, false, true, false]);
            // The smallest in units of the sizes: each gets its share of what they do together.
            let smallest = subspace.smallest(&[1.0, 0.0, 0.5, 7.0]);
            let reach = [size[0].powi(2), size[1].powi(2) / 2.0];
            let whole = reach[0] + reach[1] / 2.0;
            for (value, expected) in smallest.iter().zip([reach[0] / whole, reach[1] / whole, 0.5, 0.0]) {
                approx::assert_relative_eq!(*value, expected, epsilon = 1e-12);
            }
        }
    }

    /// The first is what the second is, and hardly anything of the third.
    #[test]
    fn a_combination_is_of_what_the_data_see_of_it() {
        let (some, little) = (-0.2, -4e-6);
        let rows =
            [[some, 1.0, 0.0, 0.0], [little, 0.0, 1.0, 0.0], [some, 1.0, 0.0, 1.0], [little, 0.0, 1.0, 2.0]];
        let combinations = Subspace::determined(&partial(&rows), vec![1.0; 4]).combinations();
        let names: Vec<Vec<usize>> =
            combinations.iter().map(|own| own.iter().map(|(parameter, _)| *parameter).collect()).collect();
        assert_eq!(names, [vec![0, 1], vec![2, 1], vec![3]], "{combinations:?}");
        assert!(combinations.iter().flatten().all(|(_, factor)| factor.abs() < 10.0), "{combinations:?}");
    }

    /// What a fourth parameter leaves open together with the first, the first determines by itself.
    #[test]
    fn the_first_parameters_by_themselves_determine_what_another_shares_with_them() {
        let rows =
            [[2.0, 0.5, 0.0, -2.0], [1.0, 0.0, 1.0, -1.0], [0.0, 3.0, 1.0, 0.0], [1.0, 1.0, 5.0, -1.0]];
        for subspace in [
            Subspace::determined(&partial(&rows), vec![1.0; 4]),
            Subspace::beyond(&partial(&rows), vec![100.0, 200.0, 300.0, 400.0]),
        ] {
            assert_eq!((subspace.rank(), subspace.separable()), (3, vec![false, true, true, false]));
            let first = subspace.of_first(3);
            assert_eq!((first.rank(), first.null_space().ncols()), (3, 0));
        }
        // Sizes say what counts: by these the rows tell no more of the second than is known.
        let size = [100.0, 0.01, 300.0, 400.0];
        let first = Subspace::beyond(&partial(&rows), size.to_vec()).of_first(3);
        let null = first.null_space();
        let parts = [0, 1, 2].map(|at| (null[(at, 0)] / size[at]).abs());
        assert!(first.rank() == 2 && parts[1] > 1e4 * parts[0].max(parts[2]), "{parts:?}");
    }
}
