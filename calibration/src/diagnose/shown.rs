//! Which of many rows are shown, and how many others each of them stands for.

use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use fit::FitResult;
use fit::noise::Layout;
use observe::Observations;

/// Rows that pictures draw at most.
pub(crate) const DRAWN: usize = 2000;

/// One in so many of the rows shown is there because it was set aside, or because its residual is among the largest.
const ONE_FIRST_IN: usize = 4;

/// Rows that are shown, in order.
#[derive(Debug, Clone, PartialEq)]
pub struct Shown {
    /// Which.
    pub rows: Vec<usize>,
    /// How many rows each stands for, itself included: sums over what is shown, each row as often as this, estimate sums over all.
    pub stands_for: Vec<f64>,
}

impl Shown {
    /// Every row, or so many of them: those set aside and those with the largest residuals, and a sample of the others with a fixed
    /// seed.
    #[must_use]
    pub fn of(observations: &Observations, fit: &FitResult, most: usize) -> Self {
        let rows = observations.rows();
        if rows <= most {
            return Self { rows: (0..rows).collect(), stands_for: vec![1.0; rows] };
        }
        let layout = Layout::of(observations);
        let square = |own: &[f64]| own.iter().fold(0.0, |sum, residual| sum + residual * residual);
        let length: Vec<f64> = layout.by_row(&fit.residuals.raw).map(square).collect();
        Self::part(|row| fit.residuals.weight[row] > 0.0, &length, most)
    }

    /// So many of more rows, by whether each was kept and by the length of its residual.
    fn part(is_kept: impl Fn(usize) -> bool, length: &[f64], most: usize) -> Self {
        let rows = length.len();
        let mut order: Vec<usize> = (0..rows).collect();
        let count = most / ONE_FIRST_IN;
        if count > 0 {
            order.select_nth_unstable_by(count - 1, |&a, &b| {
                is_kept(a).cmp(&is_kept(b)).then(length[b].total_cmp(&length[a])).then(a.cmp(&b))
            });
        }
        let mut is_first = vec![false; rows];
        order[..count].iter().for_each(|&row| is_first[row] = true);
        let mut others: Vec<usize> = (0..rows).filter(|&row| !is_first[row]).collect();
        let (sample, _) = others.partial_shuffle(&mut ChaCha8Rng::seed_from_u64(1), most - count);
        let share = (rows - count) as f64 / sample.len() as f64;
        order.truncate(count);
        order.extend(&*sample);
        order.sort_unstable();
        let stands_for = order.iter().map(|&row| if is_first[row] { 1.0 } else { share }).collect();
        Self { rows: order, stands_for }
    }

    /// Whether these are not all of so many rows.
    #[must_use]
    pub fn is_part_of(&self, rows: usize) -> bool {
        self.rows.len() < rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_holds_what_was_set_aside_and_the_largest_and_stands_for_all() {
        // Residuals grow with the row; every hundredth row was set aside.
        let length: Vec<f64> = (0..1000).map(f64::from).collect();
        let shown = Shown::part(|row| row % 100 != 5, &length, 80);
        assert_eq!(shown.rows.len(), 80);
        assert!(shown.rows.is_sorted_by(|a, b| a < b));
        let first = (0..10).map(|at| 100 * at + 5).chain((990..1000).filter(|row| row % 100 != 5));
        for row in first {
            let at = shown.rows.binary_search(&row);
            assert_eq!(at.map(|at| shown.stands_for[at]), Ok(1.0), "{row}");
        }
        assert!((shown.stands_for.iter().sum::<f64>() - 1000.0).abs() < 1e-9);
        // The others from everywhere.
        assert!((0..5).all(|fifth| shown.rows.iter().filter(|&&row| row / 200 == fifth).count() > 5));
        assert!(shown.is_part_of(1000) && !shown.is_part_of(80));
        assert_eq!(shown, Shown::part(|row| row % 100 != 5, &length, 80));
    }

    #[test]
    fn three_of_four_rows_are_a_part() {
        let shown = Shown::part(|_| true, &[1.0, f64::NAN, 2.0, 0.0], 3);
        assert_eq!((shown.rows.len(), shown.stands_for.iter().sum::<f64>()), (3, 4.0));
    }
}
