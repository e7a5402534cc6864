//! Claims about absolute sizes: of the error over a set of poses, and of what the first order drops.

use super::{CheckError, Checker};
use model_core::budget::{self, Budget, Poses};
use model_core::chain::ObservableId;
use model_core::remainder::{self, Domain};

/// That errors of given sizes do so much to an observable.
#[derive(Debug, Clone)]
pub struct Size {
    /// To which observable.
    pub observable: ObservableId,
    /// How large each error is, in SI, by [`SymbolId`](model_core::SymbolId).
    pub sizes: Vec<f64>,
    /// How the influences of several errors at one pose are added.
    pub combined: Combined,
    /// What is taken of the values over the poses.
    pub measure: SizeMeasure,
    /// The claimed limits, in rad or m.
    pub limits: Limits,
    /// Over which poses.
    pub poses: Poses,
}

/// How influences at one pose are added.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Combined {
    /// As they are: the worst that can happen, to first order.
    Sum,
    /// The root of the sum of squares: what to expect of independent errors.
    RootSumSquare,
}

/// What is taken of the values over the poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SizeMeasure {
    /// The largest.
    Sup,
    /// The root mean square.
    Rms,
    /// What so many per cent of the poses stay below.
    Percentile(f64),
}

/// What a size is said to be.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// At most this.
    pub at_most: Option<f64>,
    /// At least this.
    pub at_least: Option<f64>,
}

/// That exact form and first order differ by no more than a limit, all errors within their sizes.
#[derive(Debug, Clone)]
pub struct Bound {
    /// Of which observable.
    pub observable: ObservableId,
    /// Where errors, joints and inputs lie.
    pub domain: Domain,
    /// The claimed limit: no unit for a direction, metres for a point.
    pub at_most: f64,
}

/// What becomes of a claim that is not decided by algebra.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// It holds.
    Holds,
    /// It does not.
    Differs,
    /// What was found allows both.
    Undecided,
}

/// A size as it was found.
#[derive(Debug, Clone, PartialEq)]
pub struct SizeVerdict {
    /// The value, rad or m.
    pub found: f64,
    /// Where it lies for certain enough: the same twice, except for percentiles.
    pub between: [f64; 2],
    /// At how many poses it was sampled, if it was.
    pub poses: Option<usize>,
    /// What becomes of the claim.
    pub outcome: Outcome,
}

/// A bound as it was proven.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundVerdict {
    /// Never exceeded.
    pub proven: f64,
    /// The largest difference that a search found; `None` where the proof was enough.
    pub found: Option<f64>,
    /// What becomes of the claim.
    pub outcome: Outcome,
}

/// Poses of a percentile: its rank is then right to about one and a half per cent of the poses.
const SAMPLED: usize = 2048;

/// Starts and seed of the search for a large remainder.
const SEARCH: (u32, u64) = (16, 1);

impl Checker<'_> {
    /// The verdict on a size.
    ///
    /// # Errors
    /// The poses do not give the observable a value.
    pub fn size(&self, claim: &Size) -> Result<SizeVerdict, CheckError> {
        let (found, between, poses) = match claim.measure {
            SizeMeasure::Sup | SizeMeasure::Rms => {
                let budget = Budget::measure(self.chain, claim.observable, &claim.sizes, &claim.poses)?;
                let summary = match (budget.influences.as_slice(), claim.combined) {
                    ([only], _) => &only.summary,
                    (_, Combined::Sum) => &budget.worst_case,
                    (_, Combined::RootSumSquare) => &budget.root_sum_square,
                };
                let value = if claim.measure == SizeMeasure::Sup { summary.sup } else { summary.rms };
                (value, [value, value], None)
            }
            SizeMeasure::Percentile(percent) => {
                let (value, between) = self.percentile(claim, percent)?;
                (value, between, Some(SAMPLED))
            }
        };
        let [low, high] = between;
        let Limits { at_most, at_least } = claim.limits;
        let certain = at_most.is_none_or(|limit| high <= limit) && at_least.is_none_or(|limit| low >= limit);
        let wrong = at_most.is_some_and(|limit| low > limit) || at_least.is_some_and(|limit| high < limit);
        let outcome = match (certain, wrong) {
            (true, _) => Outcome::Holds,
            (_, true) => Outcome::Differs,
            _ => Outcome::Undecided,
        };
        Ok(SizeVerdict { found, between, poses, outcome })
    }

    /// The percentile over evenly spread poses, and the values three standard deviations of its rank away.
    fn percentile(&self, claim: &Size, percent: f64) -> Result<(f64, [f64; 2]), CheckError> {
        let influences =
            budget::influences_at(self.chain, claim.observable, &claim.sizes, &claim.poses, SAMPLED)?;
        let mut values: Vec<f64> = influences
            .iter()
            .map(|influences| match claim.combined {
                Combined::Sum => influences.iter().sum(),
                Combined::RootSumSquare => influences.iter().map(|value| value * value).sum::<f64>().sqrt(),
            })
            .collect();
        values.sort_by(f64::total_cmp);
        let (count, share) = (values.len() as f64, percent / 100.0);
        let spread = 3.0 * (count * share * (1.0 - share)).sqrt();
        let at = |rank: f64| values[rank.clamp(0.0, count - 1.0) as usize];
        let rank = count * share;
        Ok((at(rank.ceil() - 1.0), [at((rank - spread).floor()), at((rank + spread).ceil())]))
    }

    /// The verdict on a bound: proven where the bound of the remainder is small enough, refuted where a search finds more.
    ///
    /// # Errors
    /// The domain has no bound.
    pub fn bound(&self, claim: &Bound) -> Result<BoundVerdict, CheckError> {
        let proven = remainder::bound(self.chain, claim.observable, &claim.domain)?.value;
        if proven <= claim.at_most {
            return Ok(BoundVerdict { proven, found: None, outcome: Outcome::Holds });
        }
        let (starts, seed) = SEARCH;
        let found = remainder::search(self.chain, claim.observable, &claim.domain, starts, seed)?.value;
        let outcome = if found > claim.at_most { Outcome::Differs } else { Outcome::Undecided };
        Ok(BoundVerdict { proven, found: Some(found), outcome })
    }
}
