//! Things that are joined two by two, until chains of them are one.

/// Things in chains, each chain by its first.
#[derive(Debug, Clone)]
pub(super) struct Joined {
    /// Of each thing one further up its chain, or itself.
    above: Vec<usize>,
}

impl Joined {
    /// So many things, each alone.
    pub fn alone(count: usize) -> Self {
        Self { above: (0..count).collect() }
    }

    /// The first of a thing's chain.
    pub fn first(&mut self, mut at: usize) -> usize {
        while self.above[at] != at {
            self.above[at] = self.above[self.above[at]];
            at = self.above[at];
        }
        at
    }

    /// Makes one of the chains of two things; whether they were two.
    pub fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.first(a), self.first(b));
        self.above[a.max(b)] = a.min(b);
        a != b
    }
}
