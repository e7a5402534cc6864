//! Which rows of files to draw, where some stand for all.

use std::ops::Range;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Rows beside each other that are drawn together: neighbours tell whether the noise remembers.
const STRETCH: u64 = 1000;

/// Which rows of files with so many rows to draw, evenly from all: of as many parts of the rows, a stretch somewhere in each. Every row
/// where no more are there than are wanted.
#[must_use]
pub fn stretches(rows: &[u64], wanted: u64, seed: u64) -> Vec<Vec<Range<u64>>> {
    let all: u64 = rows.iter().sum();
    if all <= wanted {
        return rows.iter().map(|&rows| std::iter::once(0..rows).collect()).collect();
    }
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (parts, length) = ((wanted / STRETCH).max(1), STRETCH.min(wanted));
    let bound = |part: u64| (u128::from(part) * u128::from(all) / u128::from(parts)) as u64;
    let drawn: Vec<Range<u64>> = (0..parts)
        .map(|part| {
            let last = bound(part + 1).saturating_sub(length).max(bound(part));
            let start = random.random_range(bound(part)..=last);
            start..start + length
        })
        .collect();
    let mut first = 0;
    let own = |&rows: &u64| {
        let cut = |stretch: &Range<u64>| {
            let end = stretch.end.min(first + rows).saturating_sub(first);
            stretch.start.saturating_sub(first)..end
        };
        let stretches = drawn.iter().map(cut).filter(|stretch| stretch.start < stretch.end).collect();
        first += rows;
        stretches
    };
    rows.iter().map(own).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_drawn_once_and_evenly() {
        let tables = [
            (vec![5, 1, 7000, 3, 2500], 3000),
            (vec![10; 700], 2000),
            (vec![2500], 2499),
            (vec![1, 1, 1], 1),
        ];
        for (rows, wanted) in tables {
            let drawn = stretches(&rows, wanted, 3);
            assert_eq!(drawn.len(), rows.len());
            for (own, &rows) in drawn.iter().zip(&rows) {
                assert!(
                    own.iter().all(|stretch| stretch.start < stretch.end && stretch.end <= rows),
                    "{own:?}"
                );
                assert!(own.windows(2).all(|pair| pair[0].end <= pair[1].start), "{own:?}");
            }
            let count: u64 = drawn.iter().flatten().map(|stretch| stretch.end - stretch.start).sum();
            assert!(count <= wanted && count * 2 > wanted, "{rows:?}: {count} of {wanted}");
        }
        assert_eq!(stretches(&[5, 6], 11, 1).concat(), [0..5, 0..6]);
        // Of a thousand parts of a hundred million rows, none is far from where it should be.
        let drawn = stretches(&[60_000_000, 40_000_000], 1_000_000, 1);
        assert_eq!([drawn[0].len(), drawn[1].len()], [600, 400]);
        assert!(
            drawn[0]
                .iter()
                .zip(0..)
                .all(|(own, part)| (part * 100_000..(part + 1) * 100_000).contains(&own.start))
        );
    }
}
