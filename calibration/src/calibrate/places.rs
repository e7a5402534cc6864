//! Rows that come back to one place: whether they share an error there.
//!
//! A target that stands wrong does so in every round, and a pose that was read five times is not five poses. Where rows of one
//! place agree with each other more than chance explains, a place counts as one group: it is held out as a whole, and what its rows
//! share is part of the noise. What an effect that the chain lacks does at a place its rows share as well; groups take nothing from it
//! but the pretence that rows of one place speak for it independently.

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};

use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use crate::search::SearchError;
use crate::search::context::{Context, Request};
use crate::search::fitted::Fitted;
use observe::{Grouping, Observations, places};

/// The chance at which rows that share nothing are grouped all the same: it costs them nothing but degrees of freedom.
const CHANCE: f64 = 0.05;

/// Values further out than this count as this far, so that outliers do not decide.
const CLIP: f64 = 4.0;

/// The first fit, with places for groups where rows of one place share something that no declared group of them does; `own` is
/// where the observations live then.
pub(super) fn grouped<'a>(
    whole: Context<'a>,
    own: &'a OnceCell<Observations>,
) -> Result<(Context<'a>, Fitted), SearchError> {
    let first = Fitted::first(&whole)?;
    let observations = whole.request.observations;
    let whole_sites = !observations.together.is_empty() || observations.unknowns.is_some();
    if !first.fit.outcome.is_usable() || whole_sites {
        return Ok((whole, first));
    }
    let Some(places) = places(&whole.request.plan.chain, &observations.poses) else {
        return Ok((whole, first));
    };
    let crossed = if observations.rows_are_alone() { Vec::new() } else { observations.groups.clone() };
    let all = match crossed.as_slice() {
        [] => Some(at_places(&first, &places)),
        declared => across_groups(&first, &places, declared),
    };
    let Some(all) = all else { return Ok((whole, first)) };
    // Of places that are read to their end, one after another, what rows share may be a memory.
    if !share(&all, first.fit.rank) || places.is_sorted() && remember(&all) {
        return Ok((whole, first));
    }
    let observations = own.get_or_init(|| Observations {
        groups: places,
        grouping: Grouping::Places,
        crossed,
        ..observations.clone()
    });
    let whole = Context { request: Request { observations, ..whole.request }, ..whole };
    let first = Fitted::first(&whole)?;
    Ok((whole, first))
}

/// Residual components of one kind at one place, in units of their noise.
#[derive(Default)]
struct Sums {
    count: f64,
    sum: f64,
    squares: f64,
}

impl Sums {
    fn add(&mut self, value: f64) {
        self.count += 1.0;
        self.sum += value;
        self.squares += value * value;
    }

    fn mean(&self) -> f64 {
        self.sum / self.count
    }
}

/// The components of each kind at each place, of rows that count.
type AtPlaces = BTreeMap<(u16, u32), Sums>;

fn at_places(fitted: &Fitted, places: &[u32]) -> AtPlaces {
    let mut all = AtPlaces::new();
    for (kind, row, value) in values(fitted) {
        all.entry((kind, places[row])).or_default().add(value);
    }
    all
}

/// The same where groups were declared: means over the rows that a group has at a place, without what the group shares, at the places
/// to which several groups come. `None` where less than half of the rows stand there.
fn across_groups(fitted: &Fitted, places: &[u32], declared: &[u32]) -> Option<AtPlaces> {
    let mut groups: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
    for (&place, &group) in places.iter().zip(declared) {
        groups.entry(place).or_default().insert(group);
    }
    let is_crossed = |row: &usize| groups[&places[*row]].len() > 1;
    if 2 * (0..places.len()).filter(is_crossed).count() < places.len() {
        return None;
    }
    let of_groups = at_places(fitted, declared);
    let mut cells: BTreeMap<(u16, u32, u32), Sums> = BTreeMap::new();
    for (kind, row, value) in values(fitted).filter(|(_, row, _)| is_crossed(row)) {
        let own = value - of_groups[&(kind, declared[row])].mean();
        cells.entry((kind, places[row], declared[row])).or_default().add(own);
    }
    let mut all = AtPlaces::new();
    for ((kind, place, _), cell) in cells {
        all.entry((kind, place)).or_default().add(cell.mean());
    }
    Some(all)
}

/// The kind, the row and the value of each component of rows that count, in units of its noise.
fn values(fitted: &Fitted) -> impl Iterator<Item = (u16, usize, f64)> {
    let Fitted { layout, fit, .. } = fitted;
    let sigma = fit.noise.sigma_without_memory().into_owned();
    let keys = layout.kind_of_each().map(|kind| kind as u16).zip(layout.row_of_each());
    keys.zip(fit.residuals.raw.iter().zip(sigma))
        .filter(|((_, row), _)| fit.residuals.weight[*row] > 0.0)
        .map(|((kind, row), (raw, sigma))| (kind, row, (raw / sigma).clamp(-CLIP, CLIP)))
}

/// Whether means of places scatter more than rows of one place let expect, after a fit of this rank.
///
/// Source: the F test of lack of fit against pure error, N. R. Draper, H. Smith, Applied Regression Analysis, section 2.1.
fn share(all: &AtPlaces, rank: usize) -> bool {
    let (mut between, mut within, mut free) = (0.0, 0.0, 0.0);
    for Sums { count, sum, squares } in all.values() {
        between += sum * sum / count;
        within += (squares - sum * sum / count).max(0.0);
        free += count - 1.0;
    }
    let of_means = all.len() as f64 - rank as f64;
    if free < 1.0 || of_means < 1.0 {
        return false;
    }
    // Rows that were written twice leave nothing within.
    let ratio = between / of_means / (within / free);
    ratio.is_nan() || FisherSnedecor::new(of_means, free).is_ok_and(|f| f.sf(ratio) < CHANCE)
}

/// Whether places that follow each other remember those before.
fn remember(all: &AtPlaces) -> bool {
    let means = || all.iter().map(|(&(kind, _), own)| (kind, own.mean()));
    let neighbours = means().zip(means().skip(1)).filter(|(a, b)| a.0 == b.0);
    let products: Vec<f64> = neighbours.map(|(a, b)| a.1 * b.1).collect();
    let square = products.iter().map(|product| product * product).sum::<f64>();
    products.iter().sum::<f64>() > 3.0 * square.sqrt()
}
