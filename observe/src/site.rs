//! What is held out as a whole: groups, and sites that hold several of them.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::Observations;
use super::joined::Joined;

impl Observations {
    /// Whether each row is a group of its own.
    #[must_use]
    pub fn rows_are_alone(&self) -> bool {
        self.groups.is_sorted_by(|before, after| before < after)
    }

    /// The groups whose rows share an offset of the noise: as they were declared, where places count as groups instead.
    #[must_use]
    pub fn sharing(&self) -> &[u32] {
        if self.crossed.is_empty() { &self.groups } else { &self.crossed }
    }

    /// What is held out together, and what the ± count as one: of each row the number of its group, or of the site that holds its
    /// group.
    #[must_use]
    pub fn units(&self) -> Cow<'_, [u32]> {
        let (groups, together) = (&self.groups, &self.together);
        if together.is_empty() {
            return Cow::Borrowed(groups);
        }
        let mut joined = Joined::alone(together.iter().max().map_or(0, |last| *last as usize + 1));
        let mut of_group: BTreeMap<u32, u32> = BTreeMap::new();
        for (&group, &label) in groups.iter().zip(together) {
            joined.join(*of_group.entry(group).or_insert(label) as usize, label as usize);
        }
        Cow::Owned(together.iter().map(|&label| joined.first(label as usize) as u32).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_and_what_is_held_out_together_are_one_unit() {
        let of = |groups: &[u32], together: &[u32]| {
            let observations = Observations {
                groups: groups.to_vec(),
                together: together.to_vec(),
                ..Observations::default()
            };
            observations.units().into_owned()
        };
        assert_eq!(of(&[0, 1, 2, 3], &[]), [0, 1, 2, 3]);
        assert_eq!(of(&[0, 1, 2, 3], &[0, 0, 1, 1]), [0, 0, 1, 1]);
        // Groups chain labels: 3 with 2, 2 with 1, and 0 stays alone.
        assert_eq!(of(&[5, 6, 6, 7, 7, 8], &[0, 3, 2, 2, 1, 1]), [0, 1, 1, 1, 1, 1]);
    }
}
