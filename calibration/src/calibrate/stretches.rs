//! Rows beside unknown objects that follow each other and are off alike: a trajectory that drifts, a tripod that sinks, an
//! encoder that warms.
//!
//! Nobody asks them for a memory from residual to residual: one row sees the road and the next a wall, and what a drift does to
//! the one it does not do to the other. Asked is which way each row would have its station move, and each of its readings. Where
//! rows of a stretch agree in that more than chance explains, with all effects that were found, they do not speak for anything
//! independently: a stretch counts as one group, in the ± and in the flips of the search.

use std::ops::Range;

use nalgebra::Vector3;

use crate::data::unknowns::OF_OBJECT;
use crate::data::{Grouping, Observations};
use crate::fit::{Block, Model};
use crate::search::SearchError;
use crate::search::context::Context;
use crate::search::fitted::Fitted;

/// The first distance, in rows, at which rows have to agree. Neighbours of a path through the joints agree where a
/// function is missing; that is not asked here.
const NEAREST: usize = 4;

/// Standard deviations of chance by which they have to.
const ALIKE: f64 = 4.0;

/// The same for a stretch to go on.
const STILL_ALIKE: f64 = 2.0;

/// Distances looked at from one on to twice as far.
const AT_ONCE: usize = 4;

/// Stretches that there are at least: fewer say nothing of how they scatter.
const FEWEST: usize = 10;

/// By how much a reading is moved to see what it does: rad or m.
const MOVED: f64 = 1e-6;

/// How rows go together.
pub(super) struct Stretches {
    /// Rows of one.
    rows: usize,
}

impl Stretches {
    /// The observations with a group for each stretch.
    pub fn of(&self, observations: &Observations) -> Observations {
        let groups = (0..observations.rows()).map(|row| (row / self.rows) as u32).collect();
        Observations { groups, grouping: Grouping::Stretches { rows: self.rows }, ..observations.clone() }
    }
}

/// How long the stretches are in which rows are off alike at a fit; none where they are not, or somebody declared groups.
pub(super) fn alike(whole: &Context<'_>, fitted: &Fitted) -> Result<Option<Stretches>, SearchError> {
    let observations = whole.request.observations;
    let is_asked = observations.unknowns.is_some()
        && observations.rows_are_alone()
        && observations.together.is_empty()
        && fitted.fit.outcome.is_usable();
    let longest = observations.rows() / FEWEST;
    if !is_asked || longest < 2 * NEAREST {
        return Ok(None);
    }
    let mut pulls = of_station(observations, fitted)?.to_vec();
    for number in 0..observations.poses.columns.len() {
        pulls.push(of_reading(observations, fitted, number)?);
    }
    let agree = |distance: usize| {
        pulls.iter().map(|pulls| agreement(pulls, distance)).fold(f64::NEG_INFINITY, f64::max)
    };
    if agree(NEAREST) < ALIKE {
        return Ok(None);
    }
    let mut distance = 2 * NEAREST;
    while distance < longest && agree(distance) > STILL_ALIKE {
        distance *= 2;
    }
    Ok(Some(Stretches { rows: (2 * distance).min(longest) }))
}

/// By how many standard deviations of chance rows agree that are so far apart, up to twice as far.
///
/// Where they do not, a product of two is as likely positive as negative, and products of different rows hang together in nothing:
/// their sum is off zero by about the root of the sum of their squares.
fn agreement(pulls: &[Vector3<f64>], distance: usize) -> f64 {
    let (mut sum, mut squares) = (0.0, 0.0);
    for apart in (0..AT_ONCE).map(|at| distance + at * distance / AT_ONCE) {
        for (one, other) in pulls.iter().zip(pulls.iter().skip(apart)) {
            let product = one.dot(other);
            sum += product;
            squares += product * product;
        }
    }
    if squares > 0.0 { sum / squares.sqrt() } else { 0.0 }
}

/// Of each row which way it would have its station shifted, and turned.
fn of_station(observations: &Observations, fitted: &Fitted) -> Result<[Vec<Vector3<f64>>; 2], SearchError> {
    let model = Model::without_columns(&fitted.chain, &observations.poses);
    let Fitted { layout, fit, .. } = fitted;
    let sigma = fit.noise.sigma_without_memory();
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

/// Of each row which way it would have one of its readings moved, along the first axis.
fn of_reading(
    observations: &Observations,
    fitted: &Fitted,
    number: usize,
) -> Result<Vec<Vector3<f64>>, SearchError> {
    let Fitted { layout, fit, .. } = fitted;
    let mut moved = observations.clone();
    moved.poses.columns[number].1.iter_mut().for_each(|reading| *reading += MOVED);
    let model = Model::without_columns(&fitted.chain, &moved.poses);
    let mut there = Vec::with_capacity(layout.components());
    let own = |_: usize, _: Range<usize>, block: &Block| block.by_row(&block.residual);
    model.each_block(&moved, &fit.values, own, |own| there.extend(own))?;
    let sigma = fit.noise.sigma_without_memory();
    let of_row = |row: usize| {
        let own = layout.of_rows(row..row + 1);
        let pull = own.map(|at| {
            let here = fit.residuals.raw[at];
            here * (there[at] - here) / MOVED / sigma[at].powi(2)
        });
        Vector3::new(fit.residuals.weight[row] * pull.sum::<f64>(), 0.0, 0.0)
    };
    Ok((0..observations.rows()).map(of_row).collect())
}
