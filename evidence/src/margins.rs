//! How far each cause is ahead of the best explanation without it, and which other explanations stand beside it.

use crate::bench::{Model, State};
use crate::error::Error;
use crate::greedy::tune;
use crate::likelihood::Active;
use crate::record::Recorder;
use crate::run::Run;
use crate::small::Small;

/// Explanations of one cause that are weighed, at most: more never stood within the width of a set.
const WEIGHED: usize = 12;

/// Points at which a rival is linearised, at most.
const POINTS: usize = 2;

/// One cause of the explanation that is told.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Number of its family.
    pub family: usize,
    /// Lead over the best explanation without it and without what competes with it, nats.
    pub margin: f64,
    /// Families that explain nearly as well in its stead, itself first, each with its score, nats.
    pub set: Vec<(usize, f64)>,
    /// Posterior share of each family of the set, and at last that of having none of them.
    pub shares: Vec<f64>,
    /// Share of the members of the set that act at the same place with the same driver as the first.
    pub site_share: f64,
    /// Whether it is sure enough to be told: its place and driver where their share is large, else the set.
    pub named: bool,
}

/// The findings of an explanation.
pub(crate) fn findings(run: &mut Run, told: &Model) -> Result<Vec<Finding>, Error> {
    let mut rivals = Vec::new();
    let causes = run.bench.causes(&told.active);
    for &cause in &causes {
        let set = competitors(run, told, cause)?;
        without(run, told, cause)?;
        rivals.push((cause, set));
    }
    let mut found = Vec::new();
    for (cause, set) in rivals {
        let allowed = |family: usize| {
            let competes = set.iter().any(|&(other, _)| other == family);
            run.bench.is_noise(family) || (!competes && told.has(family))
        };
        let rival = run
            .reached
            .iter()
            .filter(|model| model.active.iter().all(|&(family, _)| allowed(family)))
            .fold(f64::NEG_INFINITY, |best: f64, model| best.max(model.odds));
        let margin = told.odds - rival;
        let mut scores: Vec<f64> = set.iter().map(|&(_, score)| score).collect();
        scores.push(set[0].1 - margin);
        let best = scores.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let weights: Vec<f64> = scores.iter().map(|score| (score - best).exp()).collect();
        let sum: f64 = weights.iter().sum();
        let site = |family: usize| run.bench.dictionary.families[family].site();
        let here = set.iter().zip(&weights).filter(|((family, _), _)| site(*family) == site(cause));
        let site_share =
            here.map(|(_, weight)| weight).sum::<f64>() / weights[..set.len()].iter().sum::<f64>();
        found.push(Finding {
            family: cause,
            margin,
            set,
            site_share,
            shares: weights.iter().map(|weight| weight / sum).collect(),
            named: margin > run.bench.policy.name_margin,
        });
    }
    Ok(found)
}

/// The families that explain nearly as well in a cause's stead, the cause itself first.
fn competitors(run: &mut Run, told: &Model, cause: usize) -> Result<Vec<(usize, f64)>, Error> {
    let others: Active = told.active.iter().copied().filter(|&(family, _)| family != cause).collect();
    let view = run.bench.view(told.state);
    let others = tune(&view, &others, 3, &mut Recorder::new());
    let gains = view.scan(&others, &|family| !run.bench.is_noise(family));
    let score = |family: usize| gains[family].nats - view.families[family].price;
    let own = score(cause);
    let width = run.bench.policy.set_width;
    // Judged at the point of another hypothesis, or under its noise, a rival looks worse than it is.
    let moved = told.state.point > 0 || !run.bench.noises[told.state.noise].is_even();
    let reach = if moved { f64::INFINITY } else { width };
    let mut near: Vec<(usize, f64)> = (0..gains.len())
        .filter(|&family| family != cause && score(family) > own - reach)
        .map(|family| (family, score(family)))
        .collect();
    near.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    near.truncate(WEIGHED);
    drop(view);
    if moved {
        for (family, score) in &mut near {
            let mut active = others.clone();
            active.push((*family, gains[*family].variance));
            let active = Small::tuned(&run.bench, &active, told.state, &mut Recorder::new());
            let rival = at_its_point(run, Model { active, ..told.clone() })?;
            *score = own + rival.odds - told.odds;
        }
        near.retain(|&(_, score)| score > own - width);
        near.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    }
    near.insert(0, (cause, own));
    Ok(near)
}

/// An explanation judged at its own point.
fn at_its_point(run: &mut Run, model: Model) -> Result<Model, Error> {
    let mut here = model;
    for _ in 0..POINTS {
        match run.bench.settled(&here, run.chain, &mut run.record)? {
            Some(settled) => here = settled,
            _ => break,
        }
    }
    Ok(run.reach(here))
}

/// Explanations without a cause, with noise and memory optimised anew and, where it matters, at their own point.
fn without(run: &mut Run, told: &Model, cause: usize) -> Result<(), Error> {
    let others: Active = told.active.iter().copied().filter(|&(family, _)| family != cause).collect();
    let tuned = tune(&run.bench.view(told.state), &others, 3, &mut run.record);
    let rest = run.bench.model(tuned, told.state);
    let most = rest.active.len() + 2;
    let noisier = run.search_noise_up_to(&rest.active, told.state, most);
    for rival in [rest, noisier] {
        let memory = run.bench.memory_of(&rival.active, told.state.noise, told.state.point);
        if memory != told.state.memory {
            let state = State { memory, ..told.state };
            let tuned = Small::tuned(&run.bench, &rival.active, state, &mut run.record);
            let model = run.bench.model(tuned, state);
            settle(run, model)?;
        }
        settle(run, rival)?;
    }
    Ok(())
}

fn settle(run: &mut Run, model: Model) -> Result<(), Error> {
    match run.bench.settled(&model, run.chain, &mut run.record)? {
        Some(settled) => {
            let again = run.search_noise(&settled.active, settled.state);
            run.reach(settled);
            run.reach(again);
        }
        None => {
            run.reach(model);
        }
    }
    Ok(())
}
