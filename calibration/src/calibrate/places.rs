//! Rows that come back to one place: whether they share an error there.
//!
//! A target that stands wrong does so in every round, and a pose that was read five times is not five poses. Where rows of one
//! place agree with each other more than chance explains, a place counts as one group: it is held out as a whole, and what its rows
//! share is part of the noise. What an effect that the chain lacks does at a place its rows share as well; groups take nothing from it
//! but the pretence that rows of one place speak for it independently.

use std::cell::OnceCell;
use std::collections::BTreeMap;

use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use crate::data::{Observations, places};
use crate::fit::FitResult;
use crate::fit::noise::Layout;
use crate::search::SearchError;
use crate::search::context::{Context, Request};
use crate::search::fitted::Fitted;

/// The chance at which rows that share nothing are grouped all the same: it costs them nothing but degrees of freedom.
const CHANCE: f64 = 0.05;

/// Values further out than this count as this far, so that outliers do not decide.
const CLIP: f64 = 4.0;

/// The first fit, with places for groups where nobody declared groups and rows of one place share something; `own` is where the
/// observations live then.
pub(super) fn grouped<'a>(
    whole: Context<'a>,
    own: &'a OnceCell<Observations>,
) -> Result<(Context<'a>, Fitted), SearchError> {
    let first = Fitted::first(&whole)?;
    let observations = whole.request.observations;
    let are_alone = observations.groups.is_sorted_by(|before, after| before < after);
    if !first.fit.outcome.is_usable() || !are_alone || observations.unknowns.is_some() {
        return Ok((whole, first));
    }
    let Some(places) = places(&whole.request.plan.chain, &observations.poses) else {
        return Ok((whole, first));
    };
    if !share(observations, &first.fit, &places) || remember(observations, &first.fit, &places) {
        return Ok((whole, first));
    }
    let observations =
        own.get_or_init(|| Observations { groups: places, by_place: true, ..observations.clone() });
    let whole = Context { request: Request { observations, ..whole.request }, ..whole };
    let first = Fitted::first(&whole)?;
    Ok((whole, first))
}

/// The residual components in units of their noise, those of rows that count.
fn values<'a>(layout: &'a Layout, fit: &'a FitResult) -> impl Iterator<Item = (u16, u32, f64)> + 'a {
    let sigma = fit.noise.sigma_without_memory().into_owned();
    let keys = layout.kind.iter().zip(&layout.row);
    keys.zip(fit.residuals.raw.iter().zip(sigma))
        .filter(|((_, row), _)| fit.residuals.weight[**row as usize] > 0.0)
        .map(|((&kind, &row), (raw, sigma))| (kind, row, (raw / sigma).clamp(-CLIP, CLIP)))
}

/// Whether means of places scatter more than rows of one place let expect.
///
/// Source: the F test of lack of fit against pure error, N. R. Draper, H. Smith, Applied Regression Analysis, section 2.1.
fn share(observations: &Observations, fit: &FitResult, places: &[u32]) -> bool {
    let layout = Layout::of(observations);
    let mut sums: BTreeMap<(u16, u32), [f64; 3]> = BTreeMap::new();
    for (kind, row, value) in values(&layout, fit) {
        let [count, sum, squares] = sums.entry((kind, places[row as usize])).or_default();
        *count += 1.0;
        *sum += value;
        *squares += value * value;
    }
    let (mut between, mut within, mut free) = (0.0, 0.0, 0.0);
    for [count, sum, squares] in sums.values() {
        between += sum * sum / count;
        within += (squares - sum * sum / count).max(0.0);
        free += count - 1.0;
    }
    let of_means = sums.len() as f64 - fit.rank as f64;
    if free < 1.0 || of_means < 1.0 {
        return false;
    }
    // Rows that were written twice leave nothing within.
    let ratio = between / of_means / (within / free);
    ratio.is_nan() || FisherSnedecor::new(of_means, free).is_ok_and(|f| f.sf(ratio) < CHANCE)
}

/// Whether the places themselves follow each other, each read to its end, and remember those before: then what their rows share is
/// a memory.
fn remember(observations: &Observations, fit: &FitResult, places: &[u32]) -> bool {
    if !places.is_sorted() {
        return false;
    }
    let layout = Layout::of(observations);
    let mut means: BTreeMap<(u16, u32), [f64; 2]> = BTreeMap::new();
    for (kind, row, value) in values(&layout, fit) {
        let [count, sum] = means.entry((kind, places[row as usize])).or_default();
        *count += 1.0;
        *sum += value;
    }
    let means: Vec<(u16, f64)> =
        means.into_iter().map(|((kind, _), [count, sum])| (kind, sum / count)).collect();
    let neighbours = means.iter().zip(means.iter().skip(1)).filter(|(a, b)| a.0 == b.0);
    let products: Vec<f64> = neighbours.map(|(a, b)| a.1 * b.1).collect();
    let square = products.iter().map(|product| product * product).sum::<f64>();
    products.iter().sum::<f64>() > 3.0 * square.sqrt()
}
