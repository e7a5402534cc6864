//! Quantities averaged over what competes: over causes and their absence, variances, memory and cuttings of the order.

use crate::bench::{Model, State};
use crate::families::Law;
use crate::greedy::tune;
use crate::likelihood::{Active, Posterior};
use crate::margins::Finding;
use crate::record::Recorder;
use crate::run::Run;
use crate::small::Small;

/// Factors of each family's variance that are averaged over.
const VARIANCES: [f64; 4] = [1.0 / 9.0, 1.0 / 3.0, 3.0, 9.0];
/// Shortfall, nats, beyond which a member has no weight in an average.
const NEGLIGIBLE: f64 = 5.0;
/// Members of a set in an average beside the first: the rest share a few percent.
const MEMBERS: usize = 4;
/// Part of the plain variance that an average keeps at least: rounding of differences.
const LEAST: f64 = 0.05;

/// Mean and variance of each component of a quantity.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Moments {
    pub mean: Vec<f64>,
    pub variance: Vec<f64>,
}

/// A quantity as a function of a posterior at a point.
pub(crate) type Quantity<'a> = dyn Fn(&Posterior, usize) -> Moments + 'a;

/// The quantity under the explanation alone.
pub(crate) fn plain(run: &Run, active: &Active, state: State, quantity: &Quantity) -> Option<Moments> {
    run.bench.view(state).posterior(active).map(|posterior| quantity(&posterior, state.point))
}

/// The quantity averaged over everything that competes.
pub(crate) fn averaged(
    run: &Run,
    told: &Model,
    findings: &[Finding],
    quantity: &Quantity,
) -> Option<Moments> {
    let own = plain(run, &told.active, told.state, quantity)?;
    let mut sum = Moments { mean: own.mean.clone(), variance: own.variance.clone() };
    let mut take = |members: Vec<(f64, Moments)>, moves_mean: bool| {
        let mixed = mixture(&members);
        for at in 0..own.mean.len() {
            let shift = mixed.mean[at] - own.mean[at];
            // Where the mean stays, what the members lie off it counts as spread.
            let spread = if moves_mean { mixed.variance[at] } else { mixed.variance[at] + shift * shift };
            if moves_mean {
                sum.mean[at] += shift;
            }
            sum.variance[at] += (spread - own.variance[at]).max(0.0);
        }
    };
    for members in variances(run, told, &own, quantity) {
        take(members, false);
    }
    for found in findings {
        take(alternatives(run, told, found, &own, quantity), true);
    }
    let memories = memories(run, told, quantity);
    if !memories.is_empty() {
        take(memories, true);
    }
    let cuttings = cuttings(run, told, quantity);
    if !cuttings.is_empty() {
        take(cuttings, true);
    }
    for (variance, own) in sum.variance.iter_mut().zip(&own.variance) {
        *variance = variance.max(LEAST * own);
    }
    Some(sum)
}

/// Mean and variance of a mixture with these log weights.
fn mixture(members: &[(f64, Moments)]) -> Moments {
    let best = members.iter().fold(f64::NEG_INFINITY, |best: f64, (weight, _)| best.max(*weight));
    let weights: Vec<f64> = members.iter().map(|(weight, _)| (weight - best).exp()).collect();
    let sum: f64 = weights.iter().sum();
    let size = members[0].1.mean.len();
    let over = |value: &dyn Fn(&Moments, usize) -> f64, at: usize| -> f64 {
        weights.iter().zip(members).map(|(weight, (_, member))| weight / sum * value(member, at)).sum()
    };
    let mean: Vec<f64> = (0..size).map(|at| over(&|member, at| member.mean[at], at)).collect();
    let variance = (0..size)
        .map(|at| over(&|member, at| member.variance[at] + (member.mean[at] - mean[at]).powi(2), at))
        .collect();
    Moments { mean, variance }
}

/// Each family's variance a few times smaller and larger.
fn variances(run: &Run, told: &Model, own: &Moments, quantity: &Quantity) -> Vec<Vec<(f64, Moments)>> {
    let view = run.bench.view(told.state);
    let evidence = view.log_evidence(&told.active);
    let of_family = |at: usize| {
        let mut members = vec![(0.0, own.clone())];
        for factor in VARIANCES {
            let mut active = told.active.clone();
            active[at].1 *= factor;
            let behind = view.log_evidence(&active) - evidence;
            if behind > -NEGLIGIBLE
                && let Some(moments) = plain(run, &active, told.state, quantity)
            {
                members.push((behind, moments));
            }
        }
        members
    };
    (0..told.active.len()).map(of_family).collect()
}

/// A cause, what competes with it, and having none of them.
fn alternatives(
    run: &Run,
    told: &Model,
    found: &Finding,
    own: &Moments,
    quantity: &Quantity,
) -> Vec<(f64, Moments)> {
    let others: Active = told.active.iter().copied().filter(|&(family, _)| family != found.family).collect();
    let view = run.bench.view(told.state);
    let mut members = vec![(found.set[0].1, own.clone())];
    let mut offer = |score: f64, active: Active| {
        if score > found.set[0].1 - NEGLIGIBLE
            && let Some(moments) = plain(run, &active, told.state, quantity)
        {
            members.push((score, moments));
        }
    };
    for &(rival, score) in found.set.iter().skip(1).take(MEMBERS) {
        let mut active = others.clone();
        active.push((rival, view.one(&others, rival).variance.max(f64::MIN_POSITIVE)));
        offer(score, tune(&view, &active, 1, &mut Recorder::new()));
    }
    offer(found.set[0].1 - found.margin, others);
    members
}

/// The memories of the grid that explain the noise nearly as well.
fn memories(run: &Run, told: &Model, quantity: &Quantity) -> Vec<(f64, Moments)> {
    if told.state.memory.is_none() {
        return Vec::new();
    }
    let small = Small::of(&run.bench, &told.active, told.state.point);
    let noise = &run.bench.noises[told.state.noise];
    let grid = small.memories(noise);
    let best = grid.iter().fold(f64::NEG_INFINITY, |best: f64, (evidence, _)| best.max(*evidence));
    let near = grid.into_iter().filter(|(evidence, _)| *evidence > best - NEGLIGIBLE);
    near.filter_map(|(evidence, memory)| {
        let mut posterior = small.view(noise, Some(memory)).posterior(small.active())?;
        posterior.columns = run.bench.active_columns(&told.active)[1..].to_vec();
        Some((evidence, quantity(&posterior, told.state.point)))
    })
    .collect()
}

/// Cuttings of the order drawn with their posterior probability, where found set-ups act.
fn cuttings(run: &Run, told: &Model, quantity: &Quantity) -> Vec<(f64, Moments)> {
    let is_cut =
        |&(family, _): &(usize, f64)| matches!(run.bench.dictionary.families[family].law, Law::Setups(_));
    let (Some(cuts), Some(&(family, variance))) = (&run.cuts, told.active.iter().find(|own| is_cut(own)))
    else {
        return Vec::new();
    };
    let others: Active = told.active.iter().copied().filter(|&(own, _)| own != family).collect();
    let drawn = run.bench.drawn_cuts(cuts, told.state.noise, told.state.point);
    let noise = &run.bench.noises[told.state.noise];
    drawn
        .into_iter()
        .filter_map(|(count, cuts)| {
            let small = Small::with_cuts(&run.bench, &others, told.state.point, family, variance, &cuts);
            let mut posterior = small.view(noise, told.state.memory).posterior(small.active())?;
            let mut numbers = run.bench.active_columns(&others)[1..].to_vec();
            // A set-up of these rows acts on no other row: its columns have no number.
            numbers.resize(posterior.columns.len(), usize::MAX);
            posterior.columns = numbers;
            Some(((count as f64).ln(), quantity(&posterior, told.state.point)))
        })
        .collect()
}
