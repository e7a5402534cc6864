//! Rows that repeat others number by number: a file pasted twice, a line that a logger wrote again.
//!
//! They are no observations of their own; counted as such they would make the ± of what they say too small, and show a structure
//! that no instrument has. Where readings have few digits, rows repeat each other by chance; then as many differ in one number
//! alone, and follow each other in no order.

use std::hash::{DefaultHasher, Hash, Hasher};

use rayon::prelude::*;

use network::Remark;
use observe::Observations;

/// So many rows that follow each other and repeat others that do are no chance.
const IN_ORDER: usize = 8;

/// Rows at least that one processor looks through.
const AT_ONCE: usize = 4096;

/// The observations without rows that repeat earlier ones, and what is to be said of these.
pub(super) fn without_repeats(observations: Observations) -> (Observations, Option<Remark>) {
    let numbers = Numbers::of(&observations);
    let repeats = numbers.repeats();
    let Some(&[of, first]) = repeats.first() else { return (observations, None) };
    if longest_in_order(&repeats) < IN_ORDER && numbers.differ_in_one() >= repeats.len() {
        return (observations, None);
    }
    let mut is_repeat = vec![false; observations.rows()];
    repeats.iter().for_each(|[_, row]| is_repeat[*row] = true);
    let kept: Vec<usize> = (0..observations.rows()).filter(|&row| !is_repeat[row]).collect();
    let [of, first] = [of, first].map(|row| observations.row_number(row));
    let remark = Remark::Repeated { rows: repeats.len(), first, of };
    (observations.select(&kept), Some(remark))
}

/// How many rows that are held out are rows of those that are fitted, number by number.
pub(super) fn fitted_as_well(held_out: &Observations, fitted: &Observations) -> usize {
    let [held_out, fitted] =
        [held_out, fitted].map(|own| Numbers { has_groups: false, ..Numbers::of(own) }.sorted_of_all());
    held_out.iter().filter(|(hash, _)| fitted.binary_search_by_key(hash, |own| own.0).is_ok()).count()
}

/// How many repeats follow each other as what they repeat does.
fn longest_in_order(repeats: &[[usize; 2]]) -> usize {
    let follows = |a: &[usize; 2], b: &[usize; 2]| a[0] + 1 == b[0] && a[1] + 1 == b[1];
    repeats.chunk_by(follows).map(<[_]>::len).max().unwrap_or(0)
}

/// What makes rows the same.
struct Numbers<'a> {
    observations: &'a Observations,
    /// The number of each row's series.
    series: Vec<u32>,
    /// Whether a group was declared: rows of different groups are different rows.
    has_groups: bool,
}

impl<'a> Numbers<'a> {
    fn of(observations: &'a Observations) -> Self {
        let all = observations.poses.series.iter().zip(0..);
        let series =
            all.flat_map(|(series, number)| std::iter::repeat_n(number, series.rows.len())).collect();
        Self { observations, series, has_groups: !observations.rows_are_alone() }
    }

    /// How many numbers a row has; what was measured counts as one.
    fn count(&self) -> usize {
        self.observations.poses.columns.len() + 1
    }

    /// All that a row is, but for one of its numbers if that is to be left out.
    fn key(&self, row: usize, without: Option<usize>) -> Vec<u64> {
        let own = self.observations;
        let mut key = vec![u64::from(self.series[row])];
        if let Some(unknowns) = &own.unknowns {
            key.extend([unknowns.object[row].map_or(u64::MAX, u64::from), u64::from(unknowns.station[row])]);
        }
        if self.has_groups {
            key.push(u64::from(own.groups[row]));
        }
        let readings = own.poses.columns.iter().enumerate();
        let readings = readings.filter(|&(at, _)| without != Some(at));
        key.extend(readings.map(|(_, (_, values))| values[row].to_bits()));
        if without != Some(own.poses.columns.len()) {
            key.extend(own.measured[row].numbers().iter().map(|value| value.to_bits()));
        }
        key
    }

    /// Rows brought together by what they are, each lot in order.
    fn sorted(&self, rows: impl ParallelIterator<Item = usize>, without: Option<usize>) -> Vec<(u64, u32)> {
        let hash = |row: usize| {
            let mut hasher = DefaultHasher::new();
            self.key(row, without).hash(&mut hasher);
            (hasher.finish(), row as u32)
        };
        let mut sorted: Vec<(u64, u32)> = rows.map(hash).collect();
        sorted.par_sort_unstable();
        sorted
    }

    /// All rows, brought together by all that they are.
    fn sorted_of_all(&self) -> Vec<(u64, u32)> {
        self.sorted((0..self.observations.rows()).into_par_iter().with_min_len(AT_ONCE), None)
    }

    /// Rows that are the same as an earlier one, with the first of these, in order.
    fn repeats(&self) -> Vec<[usize; 2]> {
        let all = self.sorted_of_all();
        let mut repeats = Vec::new();
        for lot in all.chunk_by(|a, b| a.0 == b.0).filter(|lot| lot.len() > 1) {
            let first = lot[0].1 as usize;
            let key = self.key(first, None);
            let others = lot[1..].iter().map(|&(_, row)| row as usize);
            repeats.extend(others.filter(|&row| self.key(row, None) == key).map(|row| [first, row]));
        }
        repeats.sort_unstable_by_key(|[_, row]| *row);
        repeats
    }

    /// How many rows differ from another one in one number alone.
    fn differ_in_one(&self) -> usize {
        let rows = || (0..self.observations.rows()).into_par_iter().with_min_len(AT_ONCE);
        let mut whole = vec![0; self.observations.rows()];
        self.sorted(rows(), None).into_iter().for_each(|(hash, row)| whole[row as usize] = hash);
        let differ =
            |lot: &&[(u64, u32)]| lot.iter().any(|own| whole[own.1 as usize] != whole[lot[0].1 as usize]);
        let alike = |number: usize| {
            let sorted = self.sorted(rows(), Some(number));
            sorted.chunk_by(|a, b| a.0 == b.0).filter(differ).map(<[_]>::len).sum::<usize>()
        };
        (0..self.count()).map(alike).sum()
    }
}
