//! Labels of rows with their numbers: groups, and what is held out together.

use std::collections::BTreeMap;

/// Labels with their numbers, from 0 in order of first appearance.
pub(super) type Known = BTreeMap<Vec<String>, u32>;

/// Labels of groups, and of what is held out together.
#[derive(Default)]
pub(super) struct Numbered {
    pub groups: Known,
    pub together: Known,
}

/// The number of each of so many rows by its labels.
pub(super) fn number(known: &mut Known, labels: &[Vec<String>], rows: usize) -> Vec<u32> {
    let of_row = |row: usize| {
        let next = known.len() as u32;
        *known.entry(labels.iter().map(|labels| labels[row].clone()).collect()).or_insert(next)
    };
    (0..rows).map(of_row).collect()
}
