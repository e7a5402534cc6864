//! Columns of a search that span all others: of effects at places that one chain joins, many are combinations of the rest in every
//! row, and need be multiplied only once.
//!
//! What is a combination is found at a sample of the rows, and checked in every row: a function that the sample hardly knew, such as
//! one of a few rows alone, would be lost otherwise.

use faer::linalg::matmul::matmul;
use faer::reborrow::ReborrowMut as _;
use faer::{Accum, Mat, MatMut, MatRef, Par};

use observe::golden;

/// What is left of a column beside others, as a share of its length, below which it is a combination of them.
const NOTHING: f64 = 1e-13;

/// How far a row may be off what the combinations say, as a share of the most that is added up in a row.
const OFF: f64 = 1e-9;

/// Which columns span all, and how the others follow from them.
#[derive(Debug, Clone)]
pub struct Spanning {
    /// Where each column lies: those that span first, in order, then those that follow.
    place: Vec<usize>,
    /// How many span.
    count: usize,
    /// The columns that follow, by those that span.
    by: Mat<f64>,
    /// What each column that follows is multiplied by in a check of all at once.
    multiple: Vec<f64>,
    /// What each column that spans is multiplied by to make the same sum.
    sum: Vec<f64>,
}

impl Spanning {
    /// Every column, of so many.
    #[must_use]
    pub fn all(width: usize) -> Self {
        Self {
            place: (0..width).collect(),
            count: width,
            by: Mat::zeros(width, 0),
            multiple: Vec::new(),
            sum: vec![0.0; width],
        }
    }

    /// Of what columns are at a sample of the rows. Those that are nothing there span; so does the last, the residual.
    #[must_use]
    pub fn of(columns: &[&[f64]]) -> Self {
        let (width, rows) = (columns.len(), columns.first().map_or(0, |column| column.len()));
        let length = |column: &[f64]| column.iter().map(|value| value * value).sum::<f64>().sqrt();
        let lengths: Vec<f64> = columns.iter().map(|column| length(column)).collect();
        if rows < 2 * width || !lengths.iter().all(|length| length.is_finite()) {
            return Self::all(width);
        }
        let (known, mut spanning): (Vec<usize>, Vec<usize>) =
            (0..width).partition(|&at| at + 1 < width && lengths[at] > 0.0);
        let scaled = Mat::from_fn(rows, known.len(), |i, j| columns[known[j]][i] / lengths[known[j]]);
        let factored = scaled.col_piv_qr();
        let (factor, order) = (factored.R(), factored.P().arrays().0);
        let rank = (0..known.len()).take_while(|&at| factor[(at, at)].abs() > NOTHING).count();
        spanning.splice(0..0, order[..rank].iter().map(|&at| known[at]));
        let following: Vec<usize> = order[rank..].iter().map(|&at| known[at]).collect();
        let (count, more) = (spanning.len(), following.len());
        let mut by = Mat::zeros(count, more);
        for j in 0..more {
            for i in (0..rank).rev() {
                let behind: f64 = (i + 1..rank).map(|k| factor[(i, k)] * by[(k, j)]).sum();
                by[(i, j)] = (factor[(i, rank + j)] - behind) / factor[(i, i)];
            }
            by.col_mut(j).iter_mut().filter(|by| by.abs() <= NOTHING).for_each(|by| *by = 0.0);
        }
        // Multiples that no error of several columns together keeps at zero.
        let share = |j: usize| 1.0 + golden::share(j);
        let sum =
            (0..count).map(|i| (0..more).map(|j| share(j) * by[(i, j)]).sum::<f64>()).collect::<Vec<_>>();
        let in_units = |(at, value): (usize, f64)| if lengths[at] > 0.0 { value / lengths[at] } else { 0.0 };
        for (j, &column) in following.iter().enumerate() {
            for (i, &other) in spanning.iter().enumerate().take(rank) {
                by[(i, j)] *= lengths[column] / lengths[other];
            }
        }
        let mut place = vec![0; width];
        spanning.iter().chain(&following).enumerate().for_each(|(at, &column)| place[column] = at);
        Self {
            place,
            count,
            by,
            multiple: following.iter().enumerate().map(|(j, &at)| in_units((at, share(j)))).collect(),
            sum: spanning.iter().copied().zip(sum).map(in_units).collect(),
        }
    }

    /// How many columns span.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Where a column lies, those that span first.
    #[must_use]
    pub fn place(&self, column: usize) -> usize {
        self.place[column]
    }

    /// Whether the others follow in these rows, too; `column` gives a column by its number.
    #[must_use]
    pub fn holds<'c>(&self, column: impl Fn(usize) -> &'c [f64]) -> bool {
        if self.multiple.is_empty() {
            return true;
        }
        let rows = column(0).len();
        let (mut off, mut added) = (vec![0.0; rows], vec![0.0; rows]);
        for (number, &place) in self.place.iter().enumerate() {
            let factor = match place.checked_sub(self.count) {
                None => -self.sum[place],
                Some(following) => self.multiple[following],
            };
            for ((off, added), value) in off.iter_mut().zip(&mut added).zip(column(number)) {
                let value = factor * value;
                *off += value;
                *added += value.abs();
            }
        }
        let most = added.into_iter().fold(0.0, f64::max);
        // A value that is no number fails.
        off.iter().all(|off| off.abs() <= OFF * most)
    }

    /// How some columns follow from those that span.
    #[must_use]
    pub fn unfolding(&self, wanted: &[usize]) -> Unfolding {
        let (mut direct, mut following) = (Vec::new(), Vec::new());
        let mut needed = vec![false; self.count];
        for (to, &column) in wanted.iter().enumerate() {
            match self.place[column].checked_sub(self.count) {
                None => {
                    direct.push((self.place[column], to));
                    needed[self.place[column]] = true;
                }
                Some(own) => {
                    following.push((own, to));
                    needed
                        .iter_mut()
                        .zip(self.by.col(own).iter())
                        .for_each(|(needed, by)| *needed |= *by != 0.0);
                }
            }
        }
        let behind: Vec<usize> = (0..self.count).filter(|&at| needed[at]).collect();
        let mut at = vec![0; self.count];
        behind.iter().enumerate().for_each(|(number, &place)| at[place] = number);
        Unfolding {
            width: wanted.len(),
            direct: direct.into_iter().map(|(place, to)| (at[place], to)).collect(),
            by: Mat::from_fn(behind.len(), following.len(), |i, j| self.by[(behind[i], following[j].0)]),
            following: following.into_iter().map(|(_, to)| to).collect(),
            behind,
        }
    }
}

/// Some columns by those behind them.
#[derive(Debug, Clone)]
pub struct Unfolding {
    /// How many columns.
    width: usize,
    /// The places, in order, of the columns that span these.
    behind: Vec<usize>,
    /// Which of those behind are wanted themselves, and as which column.
    direct: Vec<(usize, usize)>,
    /// Which columns follow, and by what of those behind.
    following: Vec<usize>,
    by: Mat<f64>,
}

impl Unfolding {
    /// How many columns there are.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// The places, in order, of the columns that span these.
    #[must_use]
    pub fn behind(&self) -> &[usize] {
        &self.behind
    }

    /// Makes the columns of some rows, of which `spanning` holds those behind.
    pub fn unfold(&self, spanning: MatRef<'_, f64>, mut to: MatMut<'_, f64>) {
        for &(from, column) in &self.direct {
            to.rb_mut().col_mut(column).copy_from(spanning.col(from));
        }
        let mut made = Mat::zeros(spanning.nrows(), self.following.len());
        matmul(&mut made, Accum::Replace, spanning, &self.by, 1.0, Par::Seq);
        for (&column, own) in self.following.iter().zip(made.col_iter()) {
            to.rb_mut().col_mut(column).copy_from(own);
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Numbers that hang together nowhere.
    fn column(number: usize, rows: usize) -> Vec<f64> {
        (0..rows).map(|row| ((row * (2 * number + 3) + 7 * number) as f64 * 0.731).sin()).collect()
    }

    /// Free columns, combinations of two of them, of very different sizes, one that is nothing but in the last row, and a residual.
    fn columns(free: usize, more: usize, rows: usize) -> Vec<Vec<f64>> {
        let mut columns: Vec<Vec<f64>> = (0..free).map(|number| column(number, rows)).collect();
        for number in 0..more {
            let [a, b] = [number % free, (3 * number + 1) % free];
            let size = 10_f64.powi(number as i32 - 3);
            let sum = |row: usize| size * (0.7 * columns[a][row] - 1.3 * columns[b][row]);
            columns.push((0..rows).map(sum).collect());
        }
        columns.push((0..rows).map(|row| if row + 1 == rows { 1.0 } else { 0.0 }).collect());
        columns.push(column(100, rows));
        columns
    }

    fn of_sample(columns: &[Vec<f64>], rows: usize) -> Spanning {
        Spanning::of(&columns.iter().map(|column| &column[..rows]).collect::<Vec<_>>())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        /// What follows is left out, and comes back as it was; so does any part of the columns.
        #[test]
        fn columns_come_back(free in 2usize..7, more in 0usize..7, skipped in 1usize..4) {
            let columns = columns(free, more, 200);
            let spanning = of_sample(&columns, 90);
            prop_assert_eq!(spanning.count(), free + 2);
            prop_assert!(spanning.holds(|number| columns[number].as_slice()));
            let wanted: Vec<usize> = (0..columns.len()).step_by(skipped).collect();
            let unfolding = spanning.unfolding(&wanted);
            let behind = unfolding.behind();
            let number = |place: usize| (0..columns.len()).find(|&number| spanning.place(number) == place);
            let rows = Mat::from_fn(200, behind.len(), |i, j| number(behind[j]).map_or(0.0, |at| columns[at][i]));
            let mut unfolded = Mat::zeros(200, unfolding.width());
            unfolding.unfold(rows.as_ref(), unfolded.as_mut());
            for (j, &column) in wanted.iter().enumerate() {
                let largest = columns[column].iter().fold(0.0_f64, |most, value| most.max(value.abs()));
                for i in 0..200 {
                    prop_assert!((unfolded[(i, j)] - columns[column][i]).abs() <= 1e-12 * largest);
                }
            }
        }
    }

    /// One row in which a combination is off, however little of it there is, says so; and so does a value that is no number.
    #[test]
    fn a_row_that_the_sample_does_not_stand_for_is_met() {
        let whole = columns(4, 5, 200);
        let spanning = of_sample(&whole, 90);
        for (number, value) in [(4, 1e-6), (8, 1e-3), (5, f64::NAN), (0, 0.1)] {
            let mut columns = whole.clone();
            columns[number][150] += value;
            assert!(!spanning.holds(|number| columns[number].as_slice()), "{number} {value}");
        }
        let mut other = whole.clone();
        other[10][150] = 5.0;
        assert!(spanning.holds(|number| other[number].as_slice()), "the residual follows from nothing");
    }

    /// Too few rows to tell, and numbers that are none: every column spans.
    #[test]
    fn all_span_where_nothing_can_be_told() {
        let mut columns = columns(4, 5, 200);
        assert_eq!(of_sample(&columns, 15).count(), columns.len());
        columns[3][7] = f64::INFINITY;
        let all = of_sample(&columns, 90);
        assert_eq!((all.count(), all.unfolding(&[5, 2]).behind()), (columns.len(), [2, 5].as_slice()));
    }
}
