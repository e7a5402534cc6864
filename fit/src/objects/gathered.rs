//! Rows on their way into a triangular factor: held back until they are many, because a reflection of few rows costs more
//! by the row.

use crate::{Partial, Rows};

/// Rows that go into the factor at a time, at least.
const ENOUGH: usize = 192;

/// A factor, and the rows that are not in it yet.
#[derive(Debug, Clone)]
pub(super) struct Gathered {
    whole: Partial,
    waiting: Vec<Rows>,
    count: usize,
}

impl Gathered {
    /// No rows yet.
    pub fn new(parameters: usize) -> Self {
        Self { whole: Partial::new(parameters), waiting: Vec::new(), count: 0 }
    }

    /// Takes in rows of as many columns as there are parameters, and the residual.
    pub fn add(&mut self, rows: Rows) {
        self.count += rows.count();
        self.waiting.push(rows);
        if self.count >= ENOUGH {
            self.reflect();
        }
    }

    /// The factor of all rows.
    pub fn into_whole(mut self) -> Partial {
        self.reflect();
        self.whole
    }

    fn reflect(&mut self) {
        let waiting = std::mem::take(&mut self.waiting);
        self.whole.add(Rows::stacked(waiting, self.whole.parameters + 1));
        self.count = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether they waited or not, rows have the same inner products.
    #[test]
    fn rows_that_wait_count_as_much() {
        let value = |row: usize, column: usize| ((row * 7 + column * 5) as f64 * 0.9).sin();
        let rows = |from: usize, count: usize| {
            let mut rows = Rows::zeros(count, 4);
            for (j, column) in rows.columns_mut().enumerate() {
                column.iter_mut().enumerate().for_each(|(i, to)| *to = value(from + i, j));
            }
            rows
        };
        let (mut gathered, mut count) = (Gathered::new(3), 0);
        for size in [3, 0, 11, 100, 79, 200, 5] {
            gathered.add(rows(count, size));
            count += size;
        }
        let factor = gathered.into_whole().factor();
        let products = factor.transpose() * &factor;
        for i in 0..4 {
            for j in 0..4 {
                let direct: f64 = (0..count).map(|row| value(row, i) * value(row, j)).sum();
                assert!((products[(i, j)] - direct).abs() < 1e-11, "{i} {j}");
            }
        }
    }
}
