//! Groups of rows, dealt to folds: rows of one group are not independent, and are held out together.

use std::collections::BTreeMap;

use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Which group each row belongs to, and which fold each group.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Folds {
    /// Group of each row, numbered from 0 in order of first appearance.
    pub(super) group_of_row: Vec<u32>,
    pub(super) fold_of_group: Vec<u32>,
    /// Rows of each fold. Where rows were merged, as many as there were before.
    pub(super) rows_of_fold: Vec<usize>,
    /// Rows behind the others that state something by themselves.
    pub(super) stated: usize,
}

impl Folds {
    /// Deals groups to `folds` folds at random (`seed`), evenly by rows; fewer folds where there are fewer groups.
    #[must_use]
    pub fn deal(groups: &[u32], folds: usize, seed: u64) -> Self {
        let (group_of_row, count) = number(groups);
        let folds = folds.clamp(1, count.max(1));
        let mut size = vec![0_u32; count];
        group_of_row.iter().for_each(|&group| size[group as usize] += 1);
        let mut order: Vec<u32> = (0..count as u32).collect();
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        for i in (1..order.len()).rev() {
            let j = (random.next_u64() % (i as u64 + 1)) as usize;
            order.swap(i, j);
        }
        // Large groups first, so that they cannot unbalance the end of the deal; equal ones stay shuffled.
        order.sort_by_key(|&group| std::cmp::Reverse(size[group as usize]));
        let mut rows_of_fold = vec![0_usize; folds];
        let mut fold_of_group = vec![0; count];
        for group in order {
            let fold = (0..folds).min_by_key(|&fold| rows_of_fold[fold]).unwrap_or(0);
            fold_of_group[group as usize] = fold as u32;
            rows_of_fold[fold] += size[group as usize] as usize;
        }
        Self { group_of_row, fold_of_group, rows_of_fold, stated: 0 }
    }

    /// The same, where units of several groups are held out together: of each row its group and its unit.
    #[must_use]
    pub fn deal_together(groups: &[u32], units: &[u32], folds: usize, seed: u64) -> Self {
        let dealt = Self::deal(units, folds, seed);
        let (group_of_row, count) = number(groups);
        let mut fold_of_group = vec![0; count];
        for (row, &group) in group_of_row.iter().enumerate() {
            fold_of_group[group as usize] = dealt.of_row(row) as u32;
        }
        Self { group_of_row, fold_of_group, rows_of_fold: dealt.rows_of_fold, stated: 0 }
    }

    /// Counts a row less in its fold: one that says nothing.
    pub fn without_component(&mut self, row: usize) {
        let fold = self.of_row(row);
        self.rows_of_fold[fold] = self.rows_of_fold[fold].saturating_sub(1);
    }

    /// Two folds: the rows to learn from (0) and those held out (1). A group with rows in both is two groups.
    #[must_use]
    pub fn held_out(groups: &[u32], held: &[bool]) -> Self {
        let most = groups.iter().copied().max().unwrap_or(0) + 1;
        let of_row: Vec<u32> =
            groups.iter().zip(held).map(|(&group, &held)| group + if held { most } else { 0 }).collect();
        let (group_of_row, count) = number(&of_row);
        let mut fold_of_group = vec![0; count];
        let mut rows_of_fold = vec![0; 2];
        for (&group, &held) in group_of_row.iter().zip(held) {
            fold_of_group[group as usize] = u32::from(held);
            rows_of_fold[usize::from(held)] += 1;
        }
        Self { group_of_row, fold_of_group, rows_of_fold, stated: 0 }
    }

    /// The same with rows behind them that state something by themselves, each a group of its own: those of one unit are held out together, and
    /// those without one never are.
    #[must_use]
    pub fn with_stated(mut self, units: &[Option<u32>]) -> Self {
        let (first, folds) = (self.fold_of_group.len() as u32, self.count());
        self.group_of_row.extend((first..).take(units.len()));
        for unit in units {
            let fold = unit.map_or(folds, |unit| unit as usize % folds);
            self.fold_of_group.push(fold as u32);
            self.rows_of_fold.get_mut(fold).into_iter().for_each(|rows| *rows += 1);
        }
        self.stated += units.len();
        self
    }

    /// How many folds there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.rows_of_fold.len()
    }

    /// How many groups there are of rows that state nothing by themselves.
    #[must_use]
    pub fn groups(&self) -> usize {
        self.fold_of_group.len() - self.stated
    }

    /// How many rows there are.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.group_of_row.len()
    }

    /// The group of a row.
    #[must_use]
    pub fn group(&self, row: usize) -> u32 {
        self.group_of_row[row]
    }

    /// The groups of some rows.
    #[must_use]
    pub fn groups_of(&self, rows: &[usize]) -> Vec<u32> {
        rows.iter().map(|&row| self.group(row)).collect()
    }

    /// The fold that a row lies in; the number of folds where it lies in none.
    #[must_use]
    pub fn of_row(&self, row: usize) -> usize {
        self.fold_of_group[self.group(row) as usize] as usize
    }
}

/// Numbers groups from 0 in order of first appearance.
pub(super) fn number(groups: &[u32]) -> (Vec<u32>, usize) {
    // Groups that are numbered already, with gaps perhaps, need no map.
    let most = groups.iter().copied().max().unwrap_or(0) as usize;
    if most <= 2 * groups.len() {
        let mut numbers = vec![u32::MAX; most + 1];
        let mut next = 0;
        let mut of = |group: u32| {
            let number = &mut numbers[group as usize];
            if *number == u32::MAX {
                *number = next;
                next += 1;
            }
            *number
        };
        let of_row = groups.iter().map(|&group| of(group)).collect();
        return (of_row, next as usize);
    }
    let mut numbers = BTreeMap::new();
    let of_row = groups
        .iter()
        .map(|&group| {
            let next = numbers.len() as u32;
            *numbers.entry(group).or_insert(next)
        })
        .collect();
    (of_row, numbers.len())
}
