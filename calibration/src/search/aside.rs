//! Rows set aside: whether they share a stretch of a joint or an input, by permutations.
//!
//! Gross outliers lie anywhere. Rows that a robust fit sets aside on one side of a pier, or at one end of a joint, are what
//! the declaration lacks.

use model_core::SymbolId;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rayon::prelude::*;

use observe::Poses;

/// Rows set aside below which they cannot share anything.
const FEWEST: usize = 4;

/// Stretches start and end at so many even shares of the rows.
const CUTS: usize = 24;

/// Permutations, and the chance of as much in any reading from which on it is told.
const PERMUTATIONS: usize = 999;
const CHANCE: f64 = 0.01;

/// What rows set aside share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shared {
    pub reading: SymbolId,
    /// Between these readings, SI.
    pub from: f64,
    pub to: f64,
    /// Rows set aside there, and all rows there.
    pub rows: [usize; 2],
}

/// Where stretches of one reading may start and end, the rows in its order.
struct Sorted {
    reading: SymbolId,
    /// Positions in the order, equal readings never apart.
    cuts: Vec<usize>,
    /// The reading behind each cut but the last, and that before each but the first.
    ends: Vec<[f64; 2]>,
    /// Between which cuts each row lies.
    between: Vec<u8>,
}

impl Sorted {
    fn by(reading: SymbolId, values: &[f64]) -> Self {
        let rows = values.len();
        let mut sorted = values.to_vec();
        sorted.par_sort_unstable_by(f64::total_cmp);
        let cut = |cut: usize| match sorted.get(cut) {
            Some(value) => sorted.partition_point(|other| other < value),
            None => rows,
        };
        let mut cuts: Vec<usize> = (0..=CUTS).map(|i| cut(i * rows / CUTS)).collect();
        cuts.dedup();
        let ends: Vec<[f64; 2]> =
            cuts.windows(2).map(|ends| [sorted[ends[0]], sorted[ends[1] - 1]]).collect();
        let number = |value: &f64| ends[1..].partition_point(|[from, _]| from <= value) as u8;
        let between = values.par_iter().map(number).collect();
        Self { reading, cuts, ends, between }
    }
}

/// The stretch of a reading in which far more rows were set aside than elsewhere, if chance does not explain it.
pub(crate) fn shared(poses: &Poses, aside: &[usize], seed: u64) -> Option<Shared> {
    let rows = poses.rows();
    if aside.len() < FEWEST || 2 * aside.len() > rows {
        return None;
    }
    let sorted: Vec<Sorted> =
        poses.columns.iter().map(|(reading, values)| Sorted::by(*reading, values)).collect();
    let best = |aside: &[usize]| -> Option<(f64, usize, usize, usize)> {
        let each = sorted.iter().enumerate().filter_map(|(number, sorted)| {
            most_crowded(sorted, aside).map(|(score, from, to)| (score, number, from, to))
        });
        each.max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let (score, number, from, to) = best(aside)?;
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut as_crowded = 0_usize;
    // Only as many rows are shuffled as are asked for.
    let mut shuffled: Vec<usize> = (0..rows).collect();
    for _ in 0..PERMUTATIONS {
        for i in 0..aside.len() {
            shuffled.swap(i, random.random_range(i..rows));
        }
        as_crowded += usize::from(best(&shuffled[..aside.len()]).is_some_and(|(other, ..)| other >= score));
    }
    drop(shuffled);
    if (1 + as_crowded) as f64 / (1 + PERMUTATIONS) as f64 > CHANCE {
        return None;
    }
    let Sorted { reading, cuts, ends, between } = &sorted[number];
    let is_there = |&&row: &&usize| (from..to).contains(&usize::from(between[row]));
    let there = aside.iter().filter(is_there).count();
    Some(Shared {
        reading: *reading,
        from: ends[from][0],
        to: ends[to - 1][1],
        rows: [there, cuts[to] - cuts[from]],
    })
}

/// The stretch with the largest excess of rows set aside, in standard deviations of the hypergeometric distribution, and between
/// which cuts it lies.
fn most_crowded(sorted: &Sorted, aside: &[usize]) -> Option<(f64, usize, usize)> {
    let rows = sorted.between.len() as f64;
    let mut before = vec![0_usize; sorted.cuts.len()];
    // Behind the cut that a row lies before.
    aside.iter().for_each(|&row| before[usize::from(sorted.between[row]) + 1] += 1);
    (1..before.len()).for_each(|cut| before[cut] += before[cut - 1]);
    let share = aside.len() as f64 / rows;
    let mut best: Option<(f64, usize, usize)> = None;
    for i in 0..sorted.cuts.len() {
        for j in i + 1..sorted.cuts.len() {
            let size = (sorted.cuts[j] - sorted.cuts[i]) as f64;
            let variance = size * share * (1.0 - share) * (rows - size) / (rows - 1.0);
            if variance <= 0.0 {
                continue;
            }
            let score = ((before[j] - before[i]) as f64 - size * share) / variance.sqrt();
            if best.is_none_or(|(most, ..)| score > most) {
                best = Some((score, i, j));
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn readings(columns: Vec<Vec<f64>>) -> Poses {
        let columns = (0..).map(SymbolId).zip(columns).collect();
        Poses { columns, ..Poses::default() }
    }

    #[test]
    fn rows_on_one_side_share_it_and_scattered_ones_share_nothing() {
        let joint: Vec<f64> = (0..600).map(|row| f64::from(row) * 0.618 % 1.0).collect();
        let side: Vec<f64> = (0..600).map(|row| if row % 5 == 0 { -1.0 } else { 1.0 }).collect();
        let poses = readings(vec![joint.clone(), side.clone()]);
        let on_one_side: Vec<usize> = (0..600).filter(|row| row % 25 == 0).collect();
        let found = shared(&poses, &on_one_side, 1);
        assert!(found.is_some_and(|found| found.reading == SymbolId(1) && found.to == -1.0), "{found:?}");
        let at_one_end: Vec<usize> = (0..600).filter(|&row| joint[row] > 0.93).step_by(2).collect();
        let found = shared(&poses, &at_one_end, 1);
        assert!(found.is_some_and(|found| found.reading == SymbolId(0) && found.from > 0.8), "{found:?}");
        let mut false_alarms = 0;
        for seed in 0..40 {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let anywhere: Vec<usize> = (0..20).map(|i| 30 * i + random.random_range(0..30)).collect();
            false_alarms += usize::from(shared(&poses, &anywhere, seed).is_some());
        }
        assert!(false_alarms <= 3, "{false_alarms}");
    }
}
