//! What is held out as a whole: groups, and sites that hold several of them.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::Observations;

impl Observations {
    /// What is held out together, and what the ± count as one: of each row the number of its group, or of the site that holds its
    /// group.
    #[must_use]
    pub fn units(&self) -> Cow<'_, [u32]> {
        let (groups, together) = (&self.groups, &self.together);
        if together.is_empty() {
            return Cow::Borrowed(groups);
        }
        // Each label leads to the least one that a group shares with it, round after round until none leads further.
        let most = together.iter().max().map_or(0, |last| *last as usize + 1);
        let mut least: Vec<u32> = (0..).take(most).collect();
        loop {
            let mut of_group: BTreeMap<u32, u32> = BTreeMap::new();
            for (&group, &label) in groups.iter().zip(together) {
                let own = of_group.entry(group).or_insert(u32::MAX);
                *own = (*own).min(least[label as usize]);
            }
            let mut changed = false;
            for (group, &label) in groups.iter().zip(together) {
                let own = of_group[group];
                changed |= own < least[label as usize];
                least[label as usize] = least[label as usize].min(own);
            }
            if !changed {
                return Cow::Owned(together.iter().map(|&label| least[label as usize]).collect());
            }
        }
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
