//! One pass over the rows at given values of the parameters: residuals and derivatives, summed up so that parts merge.
//!
//! Nothing of a row is kept but its residual, and that only for those who ask: derivatives go straight into the factor.

use std::ops::Range;

use super::block::Block;
use super::model::Model;
use super::objects::{Collected, Eliminated, Starts};
use super::partial::{Partial, PartialError, Rows};
use super::{FitError, robust};
use crate::noise::Layout;
use observe::{Observations, Poses};

/// How much a row counts, by the norm of its whitened components.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weighting {
    /// All alike.
    Full,
    /// Huber's: one over the distance from the median on, so that every loss has one bottom where the model is linear.
    Huber,
    /// Tukey's biweight.
    Biweight,
}

impl Weighting {
    /// The weight of a row whose residual has this norm, in units of its noise, over so many components.
    pub fn weight(self, norm: f64, components: usize) -> f64 {
        match self {
            Self::Full => 1.0,
            Self::Huber => (robust::median_norm(components) / norm.max(f64::MIN_POSITIVE)).min(1.0),
            Self::Biweight => robust::weight(norm, components),
        }
    }

    /// The weight's derivative by the norm.
    fn slope(self, norm: f64, components: usize) -> f64 {
        if self == Self::Biweight { robust::slope(norm, components) } else { 0.0 }
    }

    /// What the row adds to the sum that a fit with these weights makes small.
    fn loss(self, norm: f64, components: usize) -> f64 {
        let bend = robust::median_norm(components);
        match self {
            Self::Huber if norm > bend => bend * (2.0 * norm - bend),
            Self::Full | Self::Huber => norm * norm,
            Self::Biweight => robust::loss(norm, components),
        }
    }
}

/// What some rows say of the next step; that of parts merges.
#[derive(Debug, Clone, PartialEq)]
pub struct Tally {
    /// The pass that it belongs to; 0 where all rows are in memory.
    pub(super) pass: u64,
    /// Rows that went in.
    pub rows: u64,
    /// Rows with weight.
    pub(super) kept: u64,
    /// The factor of the rows, whitened and weighted, by the model's columns.
    pub partial: Partial,
    /// Per kind of component: weights, and weights times squares of the whitened residual.
    pub(super) kinds: Vec<[f64; 2]>,
    /// What the weights make small.
    pub(super) objective: f64,
    /// Squares of weight times whitened residual.
    pub(super) weighted_squares: f64,
    /// Components times their weight.
    pub(super) weights: f64,
    /// Components times the derivative of weight times norm.
    pub(super) slopes: f64,
    /// Squares of the residual of rows with weight, rad or m.
    pub(super) squares: f64,
}

impl Tally {
    /// No rows yet.
    pub(super) fn new(columns: usize, kinds: usize) -> Self {
        Self {
            pass: 0,
            rows: 0,
            kept: 0,
            partial: Partial::new(columns),
            kinds: vec![[0.0; 2]; kinds],
            objective: 0.0,
            weighted_squares: 0.0,
            weights: 0.0,
            slopes: 0.0,
            squares: 0.0,
        }
    }

    /// The tally of both parts. Parts may be merged in any order and any grouping: the results differ by rounding.
    ///
    /// # Errors
    /// Tallies of different passes or models.
    pub fn merge(mut self, other: &Self) -> Result<Self, PartialError> {
        if self.kinds.len() != other.kinds.len() {
            return Err(PartialError::Kinds { one: self.kinds.len(), other: other.kinds.len() });
        }
        let partial = self.partial.merge(&other.partial)?;
        if self.pass != other.pass {
            return Err(PartialError::Passes);
        }
        for (kind, other) in self.kinds.iter_mut().flatten().zip(other.kinds.iter().flatten()) {
            *kind += other;
        }
        Ok(Self {
            pass: self.pass,
            rows: self.rows + other.rows,
            kept: self.kept + other.kept,
            partial,
            kinds: self.kinds,
            objective: self.objective + other.objective,
            weighted_squares: self.weighted_squares + other.weighted_squares,
            weights: self.weights + other.weights,
            slopes: self.slopes + other.slopes,
            squares: self.squares + other.squares,
        })
    }

    /// By how much a step with weights held fixed falls short of the minimum, because the weights move along.
    ///
    /// Source: Huber and Ronchetti, Robust Statistics, 2nd ed., section 7.8.
    pub(super) fn stride(&self) -> f64 {
        if self.slopes > 0.0 { (self.weights / self.slopes).clamp(1.0, 1.5) } else { 1.0 }
    }

    /// By what (JᵀJ)⁻¹ of whitened rows of so many components, each with its full weight, must be multiplied to be the covariance of
    /// estimates made with these weights; `used` of them the estimates follow.
    ///
    /// Source: Huber and Ronchetti, Robust Statistics, 2nd ed., equation (7.83), for norms of several components.
    pub fn variance_factor(&self, n: f64, used: f64) -> f64 {
        if n <= used {
            return f64::INFINITY;
        }
        // Below a twentieth hardly any row has weight left, and the ratio would say nothing.
        let slope = (self.slopes / n).max(0.05);
        self.weighted_squares / (n - used) / (slope * slope)
    }

    /// RMS of the residuals' lengths over rows with weight, rad or m.
    pub(super) fn rms(&self) -> f64 {
        if self.kept > 0 { (self.squares / self.kept as f64).sqrt() } else { 0.0 }
    }

    /// Takes in a block whose components have these standard deviations, row by row, without the rows that are aside: all
    /// but its factor. Returns what whitening and weight multiply each component by.
    fn weighed(
        &mut self,
        block: &Block,
        first_kind: usize,
        sigma: &[f64],
        weighting: Weighting,
        aside: &[bool],
    ) -> Vec<f64> {
        let (rows, m) = (block.rows, block.components);
        let mut root = vec![0.0; rows * m];
        for row in 0..rows {
            self.rows += 1;
            if !block.defined[row] || aside.get(row) == Some(&true) {
                continue;
            }
            let (mut square, mut length) = (0.0, 0.0);
            for component in 0..m {
                let residual = block.residual[component * rows + row];
                length += residual * residual;
                square += (residual / sigma[row * m + component]).powi(2);
            }
            let norm = square.sqrt();
            let weight = weighting.weight(norm, m);
            self.objective += weighting.loss(norm, m);
            self.weighted_squares += weight * weight * square;
            self.weights += m as f64 * weight;
            self.slopes += m as f64 * weight + weighting.slope(norm, m) * norm;
            if weight > 0.0 {
                self.kept += 1;
                self.squares += length;
            }
            for component in 0..m {
                let (at, sigma) = (component * rows + row, sigma[row * m + component]);
                let [weights, squares] = &mut self.kinds[first_kind + component];
                *weights += weight;
                *squares += weight * (block.residual[at] / sigma).powi(2);
                root[at] = weight.sqrt() / sigma;
            }
        }
        root
    }
}

/// The rows of a block that count, each component times its factor, with what is unknown of them; `start` is the first row.
pub(super) fn collected(block: &Block, root: &[f64], start: usize) -> Collected {
    let mut collected = Collected::default();
    let count = block.rows;
    for (row, component) in (0..count).flat_map(|row| (0..block.components).map(move |c| (row, c))) {
        let at = component * count + row;
        let root = root[at];
        if root == 0.0 {
            continue;
        }
        collected.row.push((start + row) as u32);
        let unknown = block.unknown[row * block.components + component];
        collected.values.extend(unknown.iter().map(|value| value * root));
        collected.values.extend(block.columns().map(|column| column[at] * root));
        collected.values.push(block.residual[at] * root);
    }
    collected
}

/// The rows of a block, each component times its factor.
fn scaled(block: &Block, factor: &[f64]) -> Rows {
    let mut rows = Rows::zeros(factor.len(), block.columns().len() + 1);
    for (to, from) in rows.columns_mut().zip(block.columns().chain([block.residual.as_slice()])) {
        for ((to, from), factor) in to.iter_mut().zip(from).zip(factor) {
            *to = from * factor;
        }
    }
    rows
}

/// A pass over rows in memory: its tally, and the residuals.
#[derive(Debug, Clone)]
pub struct Sweep {
    /// The sums that steps and outcomes need.
    pub tally: Tally,
    /// Measured minus predicted, row by row, component by component, rad or m.
    pub residual: Vec<f64>,
    /// Per row, whether the chain has a finite value there.
    pub defined: Vec<bool>,
    /// What was eliminated, where rows observe objects.
    pub eliminated: Option<Eliminated>,
}

/// The first kind of component of each series, and how many there are.
fn first_kinds(observations: &Observations) -> (Vec<usize>, usize) {
    let mut kinds = 0;
    let first = observations.poses.series.iter().map(|series| {
        kinds += series.measure.components();
        kinds - series.measure.components()
    });
    (first.collect(), kinds)
}

/// Tallies all rows, whitened by a standard deviation for each component, be it that of their noise or none.
pub fn tally(
    model: &Model,
    observations: &Observations,
    layout: &Layout,
    values: &[f64],
    sigma: &[f64],
    weighting: Weighting,
) -> Result<Tally, FitError> {
    Ok(eliminated(model, observations, layout, values, sigma, weighting, &[])?.0)
}

/// The same without the rows that are aside (one flag a row, or none at all), residuals kept.
pub fn sweep(
    model: &Model,
    observations: &Observations,
    layout: &Layout,
    values: &[f64],
    sigma: &[f64],
    weighting: Weighting,
    aside: &[bool],
) -> Result<Sweep, FitError> {
    let keep = |block: &Block| (block.by_row(&block.residual), block.defined.clone());
    let (rows, components) = (layout.rows(), layout.components());
    let (mut residual, mut defined) = (Vec::with_capacity(components), Vec::with_capacity(rows));
    let take = |(own, of_rows): (Vec<f64>, Vec<bool>)| {
        residual.extend(own);
        defined.extend(of_rows);
    };
    let (tally, eliminated) =
        sweep_with(model, observations, layout, values, sigma, weighting, aside, Starts::Hold, keep, take)?;
    Ok(Sweep { tally, residual, defined, eliminated })
}

/// What rows tell of objects and stations, which start nowhere, without the rows that are aside; none where they observe none.
pub fn eliminated(
    model: &Model,
    observations: &Observations,
    layout: &Layout,
    values: &[f64],
    sigma: &[f64],
    weighting: Weighting,
    aside: &[bool],
) -> Result<(Tally, Option<Eliminated>), FitError> {
    sweep_with(model, observations, layout, values, sigma, weighting, aside, Starts::Ignore, |_| (), |()| ())
}

/// What poses would show at which nothing was measured, each component with unit weight.
pub fn design(model: &Model, poses: &Poses, values: &[f64]) -> Result<Partial, FitError> {
    let parts = model.map_poses(poses, values, |_, _, block| {
        Partial::new(model.columns()).with(scaled(block, &vec![1.0; block.residual.len()]))
    })?;
    Ok(parts.into_iter().fold(Partial::new(model.columns()), |whole, part| {
        let Ok(merged) = whole.merge(&part) else { unreachable!("the parts are of one model") };
        merged
    }))
}

/// Residuals alone.
pub fn residuals(model: &Model, observations: &Observations, values: &[f64]) -> Result<Vec<f64>, FitError> {
    let mut residual = Vec::with_capacity(observations.poses.components());
    let own = |_: usize, _: Range<usize>, block: &Block| block.by_row(&block.residual);
    model.each_block(observations, values, own, |own| residual.extend(own))?;
    Ok(residual)
}

#[allow(clippy::too_many_arguments)]
fn sweep_with<T: Send>(
    model: &Model,
    observations: &Observations,
    layout: &Layout,
    values: &[f64],
    sigma: &[f64],
    weighting: Weighting,
    aside: &[bool],
    starts: Starts,
    keep: impl Fn(&Block) -> T + Sync,
    mut take: impl FnMut(T) + Send,
) -> Result<(Tally, Option<Eliminated>), FitError> {
    let (first_kind, kinds) = first_kinds(observations);
    let empty = Tally::new(model.columns(), kinds);
    let made = |series: usize, rows: Range<usize>, block: &Block| {
        let (sigma, aside) =
            (&sigma[layout.of_rows(rows.clone())], aside.get(rows.clone()).unwrap_or_default());
        let mut tally = empty.clone();
        let root = tally.weighed(block, first_kind[series], sigma, weighting, aside);
        let rows = observations.unknowns.as_ref().map(|_| collected(block, &root, rows.start));
        if rows.is_none() {
            tally.partial = tally.partial.with(scaled(block, &root));
        }
        (tally, keep(block), rows)
    };
    let mut whole = empty.clone();
    let mut rows = Vec::new();
    model.each_block(observations, values, made, |(part, own, collected)| {
        let before = std::mem::replace(&mut whole, Tally::new(0, 0));
        let Ok(merged) = before.merge(&part) else { unreachable!("the parts are of one model and no pass") };
        whole = merged;
        take(own);
        rows.extend(collected);
    })?;
    let eliminated = observations.unknowns.as_ref().map(|unknowns| {
        let components = rows.iter().map(|rows| rows.row.len() as u64).sum();
        let state = model.state(values);
        let eliminated = Eliminated::of(unknowns, &rows, state, model.columns(), components, starts);
        whole.partial = eliminated.partial.clone();
        whole.objective += eliminated.objective;
        eliminated
    });
    Ok((whole, eliminated))
}
