//! Rows beside unknown objects that follow each other and are off alike: a trajectory that drifts, a tripod that sinks, an
//! encoder that warms.
//!
//! Nobody asks them for a memory from residual to residual: one row sees the road and the next a wall, and what a drift does to
//! the one it does not do to the other. Asked is which way each row would have its station move, and each of its readings. Where
//! rows of a stretch agree in that more than chance explains, with all effects that were found, they do not speak for anything
//! independently: a stretch counts as one group, in the ± and in the flips of the search.

use std::cell::OnceCell;
use std::ops::Range;

use nalgebra::Vector3;

use super::choice::Chosen;
use crate::search::SearchError;
use crate::search::context::{Context, Request};
use crate::search::fitted::Fitted;
use fit::{Block, Model, Outcome, pulled};
use observe::unknowns::OF_OBJECT;
use observe::{Grouping, Observations};

/// The first distance, in rows, at which rows have to agree. Neighbours of a path through the joints agree where a
/// function is missing; that is not asked here.
const NEAREST: usize = 4;

/// Standard deviations of chance by which they have to.
const ALIKE: f64 = 4.0;

/// A stretch is twice as long as the distance at which less than this share is left of what rows have in common there.
const LEFT: f64 = 1.0 / 3.0;

/// Distances looked at from one on to twice as far.
const AT_ONCE: usize = 4;

/// Stretches that there are at least: fewer say nothing of how they scatter.
const FEWEST: usize = 10;

/// By how much a reading is moved to see what it does: rad or m.
const MOVED: f64 = 1e-6;

/// The study with a group for each stretch and its first fit, where rows are off alike beside all that was found and nobody declared
/// groups; `own` is where the observations live then.
pub(super) fn grouped<'a>(
    whole: Context<'a>,
    found: &Chosen<'_>,
    own: &'a OnceCell<Observations>,
) -> Result<Option<(Context<'a>, Fitted)>, SearchError> {
    if !whole.request.plan.fit.noise.stretches {
        return Ok(None);
    }
    let observations = whole.request.observations;
    let Some(rows) = alike(observations, &found.judged.round.fitted)? else { return Ok(None) };
    let stretches = || Observations {
        groups: (0..observations.rows()).map(|row| (row / rows) as u32).collect(),
        grouping: Grouping::Stretches { rows },
        ..observations.clone()
    };
    let whole =
        Context { request: Request { observations: own.get_or_init(stretches), ..whole.request }, ..whole };
    let first = Fitted::first(&whole)?;
    let has_converged = matches!(first.fit.outcome, Outcome::Converged { .. });
    Ok(has_converged.then_some((whole, first)))
}

/// How many rows the stretches have in which rows are off alike at a fit; none where they are not.
fn alike(observations: &Observations, fitted: &Fitted) -> Result<Option<usize>, SearchError> {
    let is_asked = observations.unknowns.is_some()
        && observations.rows_are_alone()
        && observations.together.is_empty()
        && fitted.fit.outcome.is_usable();
    let longest = observations.rows() / FEWEST;
    if !is_asked || longest < 2 * NEAREST {
        return Ok(None);
    }
    let model = Model::without_columns(&fitted.chain, &observations.poses);
    let sigma = fitted.fit.noise.sigma_without_memory();
    let mut pulls = of_station(&model, observations, fitted, &sigma)?.to_vec();
    for number in 0..observations.poses.columns.len() {
        let pulled = pulled(&model, observations, &fitted.fit.values, number, |_| MOVED)?;
        pulls.push(of_reading(fitted, &sigma, &pulled));
    }
    let lengths = pulls.iter().filter_map(|pulls| {
        let near = Agreement::of(pulls, NEAREST);
        if near.by_chance.is_nan() || near.by_chance <= ALIKE {
            return None;
        }
        let mut distance = 2 * NEAREST;
        while distance < longest && Agreement::of(pulls, distance).mean > LEFT * near.mean {
            distance *= 2;
        }
        Some((2 * distance).min(longest))
    });
    Ok(lengths.max())
}

/// How rows agree that are so far apart, up to twice as far.
struct Agreement {
    /// The mean product of two.
    mean: f64,
    /// By how many standard deviations of chance it is off zero.
    by_chance: f64,
}

impl Agreement {
    /// Where rows do not agree, a product of two is as likely positive as negative, and products of different rows hang together in
    /// nothing: their sum is off zero by about the root of the sum of their squares.
    fn of(pulls: &[Vector3<f64>], distance: usize) -> Self {
        let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for apart in (0..AT_ONCE).map(|at| distance + at * distance / AT_ONCE) {
            for (one, other) in pulls.iter().zip(pulls.iter().skip(apart)) {
                let product = one.dot(other);
                count += 1.0;
                sum += product;
                squares += product * product;
            }
        }
        // A reading that nothing hangs on pulls nowhere.
        if squares > 0.0 {
            Self { mean: sum / count, by_chance: sum / squares.sqrt() }
        } else {
            Self { mean: 0.0, by_chance: 0.0 }
        }
    }
}

/// Of each row which way it would have its station shifted, and turned.
fn of_station(
    model: &Model,
    observations: &Observations,
    fitted: &Fitted,
    sigma: &[f64],
) -> Result<[Vec<Vector3<f64>>; 2], SearchError> {
    let Fitted { layout, fit, .. } = fitted;
    let mut pulls = [Vec::new(), Vec::new()];
    let of_block = |_: usize, rows: Range<usize>, block: &Block| {
        let (residual, first) = (block.by_row(&block.residual), layout.first(rows.start));
        let of_row = |row: usize| {
            let own = row * block.components..(row + 1) * block.components;
            let mut pull = [Vector3::zeros(); 2];
            for (at, unknown) in own.clone().zip(&block.unknown[own]) {
                let share = fit.residuals.weight[rows.start + row] * residual[at] / sigma[first + at].powi(2);
                for (part, pull) in pull.iter_mut().enumerate() {
                    *pull += Vector3::from_fn(|axis, _| unknown[OF_OBJECT + 3 * part + axis]) * share;
                }
            }
            pull
        };
        (0..block.rows).map(of_row).collect::<Vec<_>>()
    };
    model.each_block(observations, &fit.values, of_block, |own| {
        for [shift, turn] in own {
            pulls[0].push(shift);
            pulls[1].push(turn);
        }
    })?;
    Ok(pulls)
}

/// Of each row which way it would have a reading moved, along the first axis; `pulled` is what moving it does to the residuals.
fn of_reading(fitted: &Fitted, sigma: &[f64], pulled: &[f64]) -> Vec<Vector3<f64>> {
    let Fitted { layout, fit, .. } = fitted;
    let of_row = |row: usize| {
        let own = layout.of_rows(row..row + 1);
        let pull = own.map(|at| fit.residuals.raw[at] * pulled[at] / MOVED / sigma[at].powi(2));
        Vector3::new(fit.residuals.weight[row] * pull.sum::<f64>(), 0.0, 0.0)
    };
    (0..layout.rows()).map(of_row).collect()
}
