//! A column of texts, one behind the other in memory: a million short cells are two allocations.

/// Texts in order.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Texts {
    /// All of them, one behind the other.
    all: String,
    /// Where each ends.
    ends: Vec<usize>,
}

impl Texts {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Adds a text behind the others.
    pub fn push(&mut self, text: &str) {
        self.all.push_str(text);
        self.ends.push(self.all.len());
    }

    /// Adds others behind these.
    pub fn append(&mut self, more: &Self) {
        let before = self.all.len();
        self.all.push_str(&more.all);
        self.ends.extend(more.ends.iter().map(|end| before + end));
    }

    /// A text by its number; `None` beyond the last.
    #[must_use]
    pub fn get(&self, at: usize) -> Option<&str> {
        let end = *self.ends.get(at)?;
        let start = at.checked_sub(1).map_or(0, |before| self.ends[before]);
        self.all.get(start..end)
    }

    /// Every text in order.
    pub fn iter(&self) -> impl Iterator<Item = &str> {
        (0..self.len()).filter_map(|at| self.get(at))
    }

    /// Whether any of them holds a letter.
    #[must_use]
    pub fn contain(&self, letter: char) -> bool {
        self.all.contains(letter)
    }

    /// The memory that they take, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.all.len() + self.ends.len() * size_of::<usize>()
    }
}

impl<S: AsRef<str>> FromIterator<S> for Texts {
    fn from_iter<I: IntoIterator<Item = S>>(texts: I) -> Self {
        let mut all = Self::default();
        texts.into_iter().for_each(|text| all.push(text.as_ref()));
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    proptest::proptest! {
        #[test]
        fn texts_come_out_as_they_went_in(some in proptest::collection::vec(".{0,3}", 0..8), more in proptest::collection::vec(".{0,3}", 0..8)) {
            let mut texts: Texts = some.iter().collect();
            texts.append(&more.iter().collect());
            let expected: Vec<&str> = some.iter().chain(&more).map(String::as_str).collect();
            assert_eq!(texts.iter().collect::<Vec<_>>(), expected);
            assert_eq!(texts.len(), expected.len());
            assert_eq!(texts.get(expected.len()), None);
        }
    }
}
