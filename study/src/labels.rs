//! Labels of rows: which say nothing, and the numbers of those of groups and of what is held out together.

use std::collections::BTreeMap;

/// Whether a label says nothing of its row: a cell left empty, as one file or another has it.
pub(super) fn says_nothing(label: &str) -> bool {
    label.is_empty() || label.eq_ignore_ascii_case("nat") || label.parse().is_ok_and(f64::is_nan)
}

/// Labels with their numbers, from 0 in order of first appearance.
pub(super) type Known = BTreeMap<Vec<String>, u32>;

/// Labels of groups, of what is held out together, and of targets.
#[derive(Default)]
pub(super) struct Numbered {
    pub groups: Known,
    pub together: Known,
    pub targets: Known,
}

/// The number of each of so many rows by its labels.
pub(super) fn number(known: &mut Known, labels: &[Vec<String>], rows: usize) -> Vec<u32> {
    let of_row = |row: usize| {
        let next = known.len() as u32;
        *known.entry(labels.iter().map(|labels| labels[row].clone()).collect()).or_insert(next)
    };
    (0..rows).map(of_row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_says_nothing_is_known() {
        for label in ["", "NaN", "nan", "NaT"] {
            assert!(says_nothing(label), "{label}");
        }
        assert!(!says_nothing("0") && !says_nothing("natural"));
    }
}
