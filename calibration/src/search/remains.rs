//! Structure remains: statistics of what the last model leaves, all under the same sign flips, combined by the
//! smallest p.
//!
//! Source: P. A. P. Moran, "Notes on continuous stochastic phenomena", Biometrika 37 (1950), for the product of
//! neighbours; P. H. Westfall and S. S. Young, "Resampling-Based Multiple Testing" (1993) for the combination.

use rayon::prelude::*;

use super::scan::{Left, Scan};
use super::signs::Signs;

/// Nearest neighbours of each observation in the space of all joints.
const NEAREST: usize = 4;

/// Neighbours of each observation along one reading, ahead of it.
const AHEAD: usize = 2;

/// Observations that are passed over at most on the way to a neighbour of another group.
const PASSED: usize = 64;

/// Observations that are compared with each other at most: beyond that, evenly chosen ones are.
const COMPARED: usize = 4000;

/// A statistic of the residual, the larger the more conspicuous, and what chance makes of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Statistic {
    /// What it looks at: `neighbours in beta`.
    pub what: String,
    /// Of the residual as it is.
    pub observed: f64,
    /// Under each flip.
    pub chance: Vec<f64>,
}

impl Statistic {
    /// The most conspicuous block of a scan.
    #[must_use]
    pub fn of_scan(what: &str, scan: &Scan) -> Self {
        let chance = scan.chance.iter().map(|ln_p| -ln_p).collect();
        Self { what: what.to_owned(), observed: -scan.best, chance }
    }

    /// The sum over pairs of observations of the products of their residuals, in size: Moran's I where the pairs are
    /// neighbours, an autocorrelation where they are so many rows apart. `first` says where the components of each
    /// observation start.
    #[must_use]
    pub fn of_pairs(
        what: String,
        pairs: &[(usize, usize)],
        first: &[usize],
        left: &Left<'_>,
        signs: &Signs,
    ) -> Self {
        let variance = left.residual.iter().map(|r| r * r).sum::<f64>()
            / (left.residual.len() as f64 - left.basis.ncols() as f64).max(1.0);
        let components = |row: usize| first[row]..first[row + 1];
        let products: Vec<(usize, usize, f64, f64)> = pairs
            .par_iter()
            .map(|&(a, b)| {
                let both = || components(a).zip(components(b));
                let product = both().map(|(i, j)| left.residual[i] * left.residual[j]).sum();
                // What the regression alone makes of independent noise.
                let expected = left.basis.col_iter().map(|u| both().map(|(i, j)| u[i] * u[j]).sum::<f64>());
                let expected = -variance * expected.sum::<f64>();
                let bucket = |row: usize| signs.bucket_of_row()[first[row]];
                (bucket(a), bucket(b), product, expected)
            })
            .collect();
        let observed: f64 = products.iter().map(|(_, _, product, expected)| product - expected).sum();
        let chance = parallel::each(signs.flips(), |flip| {
            let sign = signs.of_flip(flip);
            products.iter().map(|&(a, b, product, _)| sign[a] * sign[b] * product).sum::<f64>().abs()
        });
        Self { what, observed: observed.abs(), chance }
    }
}

/// Familywise p of the statistics together, and the p of each alone.
#[must_use]
pub fn combined(statistics: &[Statistic]) -> (f64, Vec<f64>) {
    let flips = statistics.first().map_or(0, |statistic| statistic.chance.len());
    let count = flips as f64 + 1.0;
    let mut smallest = vec![1.0_f64; flips];
    let mut alone = Vec::new();
    for statistic in statistics {
        let mut sorted = statistic.chance.clone();
        sorted.push(statistic.observed);
        sorted.sort_by(f64::total_cmp);
        // As conspicuous or more, itself counted.
        let p = |value: f64| (sorted.len() - sorted.partition_point(|&other| other < value)) as f64 / count;
        smallest.iter_mut().zip(&statistic.chance).for_each(|(s, &value)| *s = s.min(p(value)));
        alone.push(p(statistic.observed));
    }
    let best = alone.iter().copied().fold(1.0, f64::min);
    let as_good = smallest.iter().filter(|&&p| p <= best).count();
    ((1 + as_good) as f64 / count, alone)
}

/// Each observation with its nearest ones in the space of some coordinates (one list an observation), those of its own group aside:
/// what a group shares is no structure.
#[must_use]
pub fn nearest(points: &[Vec<f64>], groups: &[u32]) -> Vec<(usize, usize)> {
    let step = points.len().div_ceil(COMPARED).max(1);
    let chosen: Vec<usize> = (0..points.len()).step_by(step).collect();
    chosen
        .par_iter()
        .flat_map_iter(|&a| {
            let mut near: Vec<(f64, usize)> = Vec::with_capacity(NEAREST + 1);
            for &b in chosen.iter().filter(|&&b| b != a && groups[b] != groups[a]) {
                let distance: f64 = points[a].iter().zip(&points[b]).map(|(x, y)| (x - y) * (x - y)).sum();
                if near.len() == NEAREST && near.last().is_some_and(|&(most, _)| distance >= most) {
                    continue;
                }
                let at = near.partition_point(|&(other, _)| other <= distance);
                near.insert(at, (distance, b));
                near.truncate(NEAREST);
            }
            near.into_iter().map(move |(_, b)| (a, b))
        })
        .collect()
}

/// Observations that follow each other in one reading: each with the next two of other groups.
#[must_use]
pub fn along(reading: &[f64], groups: &[u32]) -> Vec<(usize, usize)> {
    let mut order: Vec<usize> = (0..reading.len()).collect();
    order.sort_by(|&a, &b| reading[a].total_cmp(&reading[b]).then(a.cmp(&b)));
    let next = |(at, &a): (usize, &usize)| {
        let others = order[at + 1..].iter().take(PASSED).filter(move |&&b| groups[b] != groups[a]);
        others.take(AHEAD).map(move |&b| (a, b))
    };
    order.iter().enumerate().flat_map(next).collect()
}

/// Observations so many rows apart within each run of rows.
#[must_use]
pub fn lagged(runs: &[std::ops::Range<usize>], lag: usize) -> Vec<(usize, usize)> {
    runs.iter().flat_map(|run| (run.start + lag..run.end).map(move |row| (row - lag, row))).collect()
}
