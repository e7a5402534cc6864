//! Numbers of rows that mostly follow each other: they are held stretch by stretch, so that very many rows take no memory.

/// One whole number a row.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Numbers {
    stretches: Vec<Stretch>,
    rows: usize,
}

/// Rows from one on, up to the next stretch: numbers that are all the same, or each one more than that before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Stretch {
    row: u32,
    step: u32,
    number: u64,
}

impl Stretch {
    fn at(&self, row: usize) -> u64 {
        self.number + u64::from(self.step) * (row - self.row as usize) as u64
    }
}

impl Numbers {
    /// How many rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows == 0
    }

    /// The number of a row, if there is such a row.
    #[must_use]
    pub fn get(&self, row: usize) -> Option<u64> {
        let after = self.stretches.partition_point(|stretch| stretch.row as usize <= row);
        let stretch = self.stretches.get(after.checked_sub(1)?)?;
        (row < self.rows).then(|| stretch.at(row))
    }

    /// The number of the last row.
    #[must_use]
    pub fn last(&self) -> Option<u64> {
        self.get(self.rows.checked_sub(1)?)
    }

    /// Every number in order.
    pub fn iter(&self) -> impl Iterator<Item = u64> {
        let ends = self.stretches.iter().skip(1).map(|stretch| stretch.row as usize).chain([self.rows]);
        self.stretches
            .iter()
            .zip(ends)
            .flat_map(|(stretch, end)| (stretch.row as usize..end).map(|row| stretch.at(row)))
    }

    /// Those of some rows, in the order given.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        rows.iter().filter_map(|&row| self.get(row)).collect()
    }
}

impl Extend<u64> for Numbers {
    fn extend<T: IntoIterator<Item = u64>>(&mut self, numbers: T) {
        for number in numbers {
            let row = self.rows;
            self.rows += 1;
            if let Some(last) = self.stretches.last_mut() {
                if row - last.row as usize == 1 && number.wrapping_sub(last.number) <= 1 {
                    last.step = (number - last.number) as u32;
                }
                if last.at(row) == number {
                    continue;
                }
            }
            // Rows are counted with 32 bits wherever they are held.
            self.stretches.push(Stretch { row: row as u32, step: 0, number });
        }
    }
}

impl FromIterator<u64> for Numbers {
    fn from_iter<T: IntoIterator<Item = u64>>(numbers: T) -> Self {
        let mut all = Self::default();
        all.extend(numbers);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn numbers_are_those_that_went_in(steps in prop::collection::vec((0u64..4, 1usize..4), 0..20), pick in prop::collection::vec(0usize..60, 0..9)) {
            let mut last = 7;
            let of = |(step, times): (u64, usize)| (0..times).map(move |_| step).collect::<Vec<_>>();
            let all: Vec<u64> = steps.into_iter().flat_map(of).map(|step| {
                last = if step == 3 { last - 5_u64.min(last) } else { last + step };
                last
            }).collect();
            let held: Numbers = all.iter().copied().collect();
            prop_assert_eq!((held.len(), held.last()), (all.len(), all.last().copied()));
            prop_assert_eq!(held.iter().collect::<Vec<_>>(), all.clone());
            prop_assert!((0..=all.len()).all(|row| held.get(row) == all.get(row).copied()));
            let some: Vec<u64> = pick.iter().filter_map(|&row| all.get(row).copied()).collect();
            prop_assert_eq!(held.select(&pick).iter().collect::<Vec<_>>(), some);
        }
    }

    #[test]
    fn rows_that_follow_each_other_take_no_memory() {
        let held: Numbers = (1..=1000).chain([5; 1000]).collect();
        assert_eq!(held.stretches.len(), 2);
    }
}
