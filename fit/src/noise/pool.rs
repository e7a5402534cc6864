//! Kinds of component that share one standard deviation, because each alone has too few degrees of freedom.

use std::ops::Range;

use super::{Layout, each};
use observe::{NoiseOf, Observations, SiUnit};

/// A standard deviation of its own needs so many degrees of freedom.
const ENOUGH: f64 = 30.0;

/// Which kinds of component share a standard deviation. Where rows state theirs it is a factor on that.
#[derive(Debug, Clone, PartialEq)]
pub struct Pools {
    /// The pool of each kind, numbered from 0.
    pub of_kind: Vec<usize>,
    /// Pools of rows that are too few to say how large their noise is, and what is taken for it.
    lent: Vec<(usize, Lent)>,
}

/// What is taken for the noise of too few rows.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Lent {
    /// What they state.
    Stated,
    /// The noise of this kind, whose rows state theirs, while these do not.
    Kind(usize),
}

/// A series, or several that are too small each: whether its rows state their noise, its unit, and its kinds.
struct Set {
    is_stated: bool,
    unit: SiUnit,
    kinds: Vec<usize>,
    components: usize,
}

impl Pools {
    /// The pool of each kind of component: its own; that of its series where a kind of it has few degrees of freedom; that of all
    /// series of the same unit where a whole series has few. Where these are few as well, they take what a larger series has for its
    /// noise, or what they state: a single length would else come out exact, and everything be bent to it. `used` independent numbers
    /// were estimated.
    #[must_use]
    pub fn of(observations: &Observations, layout: &Layout, used: f64) -> Self {
        let left = (1.0 - used / (layout.components() as f64).max(1.0)).max(0.0);
        let scarce = |components: usize| (components as f64) * left < ENOUGH;
        let mut of_kind: Vec<usize> = Vec::with_capacity(layout.kinds);
        let (mut small, mut large): (Vec<(usize, Set)>, Vec<Set>) = (Vec::new(), Vec::new());
        let mut next = 0;
        for series in &observations.poses.series {
            let (rows, count, start) = (series.rows.len(), series.measure.components(), of_kind.len());
            let (is_stated, unit) = (observations.states_sigma(series), series.measure.unit());
            let (kinds, components): (Range<usize>, usize) = (start..start + count, rows * count);
            if !scarce(components) {
                let own = if scarce(rows) { 1 } else { count };
                of_kind.extend((0..count).map(|at| next + at % own));
                next += own;
                large.push(Set { is_stated, unit, kinds: kinds.collect(), components });
                continue;
            }
            let known = small.iter_mut().find(|(_, set)| (set.is_stated, set.unit) == (is_stated, unit));
            let pool = if let Some((pool, set)) = known {
                set.kinds.extend(kinds);
                set.components += components;
                *pool
            } else {
                small.push((next, Set { is_stated, unit, kinds: kinds.collect(), components }));
                next += 1;
                next - 1
            };
            of_kind.extend(std::iter::repeat_n(pool, count));
        }
        let noise_of = observations.noise_of_kinds();
        let mut lent = Vec::new();
        for (pool, few) in small.into_iter().filter(|(_, set)| scarce(set.components)) {
            let in_unit = |large: &&Set| large.unit == few.unit;
            let alike = |large: &&Set| large.is_stated == few.is_stated;
            let same = kind_like(&few, large.iter().filter(alike).filter(in_unit), &noise_of);
            // A factor on what is stated has no unit.
            let factor = || kind_like(&few, large.iter().filter(alike).filter(|_| few.is_stated), &noise_of);
            if let Some(kind) = same.or_else(factor) {
                let other = of_kind[kind];
                few.kinds.iter().for_each(|&kind| of_kind[kind] = other);
            } else if few.is_stated && !large.is_empty() {
                lent.push((pool, Lent::Stated));
            } else if let Some(kind) = kind_like(&few, large.iter().filter(in_unit), &noise_of) {
                lent.push((pool, Lent::Kind(kind)));
            }
        }
        Self { of_kind, lent }
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.of_kind.iter().max().map_or(0, |last| last + 1)
    }

    /// The standard deviation of each kind, given that of each pool as its own residuals have it; `stated` is what each component states.
    #[must_use]
    pub fn by_kind(&self, layout: &Layout, mut of_pools: Vec<f64>, stated: &[f64]) -> Vec<f64> {
        for (pool, lent) in &self.lent {
            of_pools[*pool] = match *lent {
                Lent::Stated => 1.0,
                Lent::Kind(kind) => {
                    let own = layout.kind_of_each().zip(each(stated)).filter(|(own, _)| *own == kind);
                    let [count, squares] = own.fold([0.0; 2], |[count, squares], (_, stated)| {
                        [count + 1.0, squares + stated * stated]
                    });
                    of_pools[self.of_kind[kind]] * (squares / count).sqrt()
                }
            };
        }
        self.of_kind.iter().map(|&pool| of_pools[pool]).collect()
    }
}

/// A kind of larger series whose noise is most like that of some kinds: of the same sort, or else any.
fn kind_like<'s>(
    few: &Set,
    large: impl Iterator<Item = &'s Set> + Clone,
    noise_of: &[NoiseOf],
) -> Option<usize> {
    let is_alike = |kind: &&usize| few.kinds.iter().any(|own| noise_of[*own] == noise_of[**kind]);
    let mut kinds = large.flat_map(|large| &large.kinds);
    kinds.clone().find(is_alike).or_else(|| kinds.next()).copied()
}
