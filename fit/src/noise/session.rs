//! What the rows of a group share beside their own noise: a random offset of each group and kind of component, by restricted
//! maximum likelihood.
//!
//! Source: D. A. Harville, Maximum likelihood approaches to variance component estimation, Journal of the American Statistical
//! Association 72 (1977) 320-338.

use faer::{Mat, Side};

use super::Layout;
use observe::Observations;

/// Variances of the offset that are tried, in units of the noise of a row.
const RATIOS: [f64; 14] = [0.0, 0.01, 0.03, 0.06, 0.1, 0.2, 0.4, 0.8, 1.5, 3.0, 6.0, 12.0, 30.0, 100.0];

/// Components above which groups are many enough to do without what the fit took out.
const MANY: usize = 50_000;

/// Offsets that the rows of a group share.
#[derive(Debug, Clone, PartialEq)]
pub struct Offsets {
    /// The set of each component: those of one kind in one group share an offset. Length n.
    pub set: Vec<u32>,
    /// The kind of each component, length n.
    kind: Vec<u16>,
    /// Per kind the variance of the offsets over that of a row's own noise.
    pub ratio: Vec<f64>,
    /// Whether whitening takes them out: where places that cross these groups are what counts as independent.
    pub crossed: bool,
}

impl Offsets {
    /// No offsets in the groups of these rows; those that do not count have one of their own.
    fn none(layout: &Layout, observations: &Observations, weight: &[f64]) -> Self {
        let groups = observations.sharing();
        let group = |row: usize| if weight[row] > 0.0 { groups[row] } else { u32::MAX };
        let kinds = || layout.kind_of_each().map(|kind| kind as u16);
        let mut keys: Vec<(u16, u32)> =
            kinds().zip(layout.row_of_each()).map(|(kind, row)| (kind, group(row))).collect();
        let of_component = keys.clone();
        keys.sort_unstable();
        keys.dedup();
        // Every component's key is among all keys.
        let place = |key: &(u16, u32)| keys.partition_point(|known| known < key) as u32;
        Self {
            set: of_component.iter().map(place).collect(),
            kind: kinds().collect(),
            ratio: vec![0.0; layout.kinds],
            crossed: !observations.crossed.is_empty(),
        }
    }

    /// Those of some ranges of components, one after another.
    #[must_use]
    pub fn of_parts<'a>(&self, parts: impl Iterator<Item = std::ops::Range<usize>> + Clone + 'a) -> Self {
        Self {
            set: parts.clone().flat_map(|part| self.set[part].iter().copied()).collect(),
            kind: parts.flat_map(|part| self.kind[part].iter().copied()).collect(),
            ratio: self.ratio.clone(),
            crossed: self.crossed,
        }
    }

    /// Takes out of a column, in units of the rows' own noise, so much of each set's mean that what is left has variance one
    /// and does not hang together.
    pub fn whiten(&self, column: &mut [f64]) {
        let sets = self.set.iter().max().map_or(0, |last| *last as usize + 1);
        let mut means = vec![[0.0; 2]; sets];
        for (value, &set) in column.iter().zip(&self.set) {
            let [count, sum] = &mut means[set as usize];
            *count += 1.0;
            *sum += value;
        }
        for ((value, &set), &kind) in column.iter_mut().zip(&self.set).zip(&self.kind) {
            let [count, sum] = means[set as usize];
            *value -= sum / count * (1.0 - 1.0 / (1.0 + count * self.ratio[usize::from(kind)]).sqrt());
        }
    }

    /// What they make of the covariance of Qᵀe, in units of the variance of the rows' own noise; and the degrees of freedom of their
    /// size.
    #[must_use]
    pub fn covariance(&self, q: &Mat<f64>) -> (Mat<f64>, f64) {
        let sets = self.set.iter().max().map_or(0, |last| *last as usize + 1);
        let mut sums = Mat::<f64>::zeros(q.ncols(), sets);
        for (at, (&set, &kind)) in self.set.iter().zip(&self.kind).enumerate() {
            let size = self.ratio[usize::from(kind)].sqrt();
            for (sum, value) in sums.col_as_slice_mut(set as usize).iter_mut().zip(q.row(at).iter()) {
                *sum += size * value;
            }
        }
        let free = sets.saturating_sub(self.ratio.len()).max(1);
        (&sums * sums.transpose(), free as f64)
    }

    /// Standard deviation of a component in units of its own noise.
    #[must_use]
    pub fn gain(&self, component: usize) -> f64 {
        (1.0 + self.ratio[usize::from(self.kind[component])]).sqrt()
    }

    /// ln |V| of the values in units of the rows' own noise.
    fn ln_determinant(&self) -> f64 {
        let sets = self.set.iter().max().map_or(0, |last| *last as usize + 1);
        let mut counts = vec![(0.0, 0_u16); sets];
        for (&set, &kind) in self.set.iter().zip(&self.kind) {
            counts[set as usize].0 += 1.0;
            counts[set as usize].1 = kind;
        }
        counts.iter().map(|&(count, kind)| (1.0 + count * self.ratio[usize::from(kind)]).ln()).sum()
    }
}

/// The offsets of groups in values of variance about one, and the standard deviation of the rows' own noise in their unit;
/// `weight` is that of each row, and `q` holds the orthonormal columns that were fitted to them (n × k). `None` where the groups
/// share nothing.
#[must_use]
pub fn fit(
    layout: &Layout,
    observations: &Observations,
    weight: &[f64],
    values: &[f64],
    q: &Mat<f64>,
) -> Option<(Offsets, f64)> {
    let k = if values.len() > MANY { 0 } else { q.ncols() };
    if values.len() <= k + 1 {
        return None;
    }
    let columns = Mat::from_fn(
        values.len(),
        k + 1,
        |row, column| if column == k { values[row] } else { q[(row, column)] },
    );
    let deviance = |offsets: &Offsets| {
        let mut white = columns.clone();
        (0..=k).for_each(|j| offsets.whiten(white.col_as_slice_mut(j)));
        let factor = (white.transpose() * &white).llt(Side::Lower).ok()?;
        let l = factor.L();
        let left = (values.len() - k) as f64;
        let own = l[(k, k)] / left.sqrt();
        let ln_columns: f64 = (0..k).map(|at| 2.0 * l[(at, at)].ln()).sum();
        let value = 2.0 * left * own.ln() + offsets.ln_determinant() + ln_columns;
        value.is_finite().then_some((value, own))
    };
    let mut best = Offsets::none(layout, observations, weight);
    let mut least = deviance(&best)?;
    // Kind by kind, twice round: they hang together through the columns alone.
    for kind in (0..layout.kinds).chain(0..layout.kinds) {
        for ratio in RATIOS {
            let mut other = best.clone();
            other.ratio[kind] = ratio;
            if let Some(found) = deviance(&other).filter(|found| found.0 < least.0) {
                (least, best) = (found, other);
            }
        }
    }
    best.ratio.iter().any(|ratio| *ratio > 0.0).then_some((best, least.1))
}
