//! Where to measure next: poses by which the worst-determined errors gain most.
//!
//! Source: V. V. Fedorov, Theory of Optimal Experiments (1972), chapter 3: exchange of support points; D-optimal makes the
//! volume of the uncertainties smallest, A-optimal their sum of squares.

pub mod campaign;
pub(crate) mod discrimination;
mod exchange;
pub(crate) mod places;

use std::ops::Range;

use model_core::{Chain, Quantity, SymbolId, SymbolKind};
use nalgebra::DMatrix;
use serde::Serialize;

use fit::{FitError, FitResult, Model};
use observe::{Observations, Poses};

use exchange::{Aim, Choice, Rule};

pub use discrimination::{Separation, Told};
pub use places::{Addition, Place, PlaceProposal, Pointing};

/// Poses that are compared.
const CANDIDATES: usize = 600;

/// One pose is proposed so often at most: a rule that wants more of it is met about as well by its neighbours, which show
/// what the model lacks, too.
const OFTEN: usize = 2;

/// Sweeps of exchange at most.
const SWEEPS: usize = 5;

/// What is made small.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Criterion {
    /// The volume of the region of uncertainty.
    D,
    /// The sum of the variances, each in units of what the error does to an observation.
    A,
}

/// Poses to measure next, and what they promise.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Proposal {
    /// What they make small.
    pub criterion: Criterion,
    /// The joints, in the order of the poses' values.
    pub joints: Vec<String>,
    /// One list of joint values a pose, rad or m.
    pub poses: Vec<Vec<f64>>,
    /// Per error: name, its standard uncertainty now, and with these poses measured, SI.
    pub uncertainties: Vec<(String, f64, f64)>,
}

/// Proposes poses within joint ranges (those of the data where none is stated); inputs stay at their medians.
///
/// Errors that nothing determines so far count as just about unknown, so that poses that would determine them win.
///
/// # Errors
/// As a fit at those poses would have.
pub fn propose(
    chain: &Chain,
    observations: &Observations,
    fit: &FitResult,
    count: usize,
    ranges: &[(SymbolId, Range<f64>)],
    criterion: Criterion,
) -> Result<Proposal, FitError> {
    let candidates = spread(chain, &observations.poses, ranges);
    let model = Model::new(chain, &candidates, &fit.parameters)?;
    let m = candidates.series.first().map_or(1, |series| series.measure.components());
    let sigma = fit.noise.expected(observations);
    let p = fit.parameters.len();
    // In units in which every column of the Jacobian so far has length one.
    let scale: Vec<f64> = (0..p)
        .map(|at| fit.factor.length(at))
        .map(|length| if length > 0.0 { length } else { 1.0 })
        .collect();
    let rows: Vec<DMatrix<f64>> = model
        .map_poses(&candidates, &fit.values, |_, _, block| {
            let columns: Vec<&[f64]> = block.columns().collect();
            let derivative =
                |column: Option<usize>, at: usize| column.map_or(0.0, |column| columns[column][at]);
            let row = |row: usize| {
                DMatrix::from_fn(m, p, |component, parameter| {
                    let at = component * block.rows + row;
                    derivative(model.column_of()[parameter], at) / sigma[component] / scale[parameter]
                })
            };
            (0..block.rows).map(row).collect::<Vec<_>>()
        })?
        .into_iter()
        .flatten()
        .filter(|row| row.iter().all(|value| value.is_finite()))
        .collect();
    let factor = fit.factor.factor();
    let jacobian = DMatrix::from_fn(p, p, |row, column| factor[(row, column)] / scale[column]);
    let information = jacobian.transpose() * &jacobian + DMatrix::identity(p, p) * 1e-9;
    let Some(before) = information.cholesky().map(|factor| factor.inverse()) else {
        return Err(FitError::WrongShape { why: "the information so far is not finite".to_string() });
    };
    let aim = match criterion {
        Criterion::D => Aim::Volume,
        Criterion::A => Aim::Sum,
    };
    let rule = Rule { rows: &rows, aim: &aim, often: OFTEN };
    let mut choice = Choice::new(before.clone());
    choice.grow(&rule, count.min(rows.len()));
    (0..SWEEPS).any(|_| !choice.exchange(&rule));
    let Choice { chosen, covariance } = choice;
    let joints: Vec<SymbolId> = joints(chain, &candidates);
    let value =
        |id: &SymbolId, row: usize| candidates.column(*id).and_then(|column| column.get(row)).copied();
    let poses = chosen.iter().map(|&row| joints.iter().filter_map(|id| value(id, row)).collect()).collect();
    let uncertainty = |covariance: &DMatrix<f64>, at: usize| covariance[(at, at)].max(0.0).sqrt() / scale[at];
    let uncertainties = fit.parameters.iter().enumerate().map(|(at, id)| {
        (chain.symbol(*id).name.clone(), uncertainty(&before, at), uncertainty(&covariance, at))
    });
    let uncertainties = uncertainties.collect();
    let joints = joints.iter().map(|id| chain.symbol(*id).name.clone()).collect();
    Ok(Proposal { criterion, joints, poses, uncertainties })
}

/// The joints that have readings.
pub(crate) fn joints(chain: &Chain, poses: &Poses) -> Vec<SymbolId> {
    let ids = poses.columns.iter().map(|(id, _)| *id);
    ids.filter(|id| chain.symbol(*id).kind == SymbolKind::Joint).collect()
}

/// Poses spread over the ranges, at which the first series is observed.
pub(crate) fn spread(chain: &Chain, poses: &Poses, ranges: &[(SymbolId, Range<f64>)]) -> Poses {
    let mut spread = poses.select(&[0]);
    let generator = generator(joints(chain, poses).len());
    let mut axis = 0;
    for (id, values) in &mut spread.columns {
        let measured = poses.column(*id);
        let mut sorted =
            measured.map_or_else(|| unreachable!("the columns are those of the poses"), <[f64]>::to_vec);
        sorted.sort_by(f64::total_cmp);
        let stated = ranges.iter().find(|(known, _)| known == id).map(|(_, range)| range.clone());
        let symbol = chain.symbol(*id);
        if symbol.kind != SymbolKind::Joint {
            *values = vec![sorted[sorted.len() / 2]; CANDIDATES];
            continue;
        }
        let full = if symbol.quantity == Quantity::Angle { 0.0 } else { 1.0 };
        let (low, high) = match (stated, sorted.first(), sorted.last()) {
            (Some(range), _, _) => (range.start, range.end),
            (None, Some(&low), Some(&high)) => (low, high),
            _ => (0.0, full),
        };
        let step = generator[axis];
        axis += 1;
        *values =
            (0..CANDIDATES).map(|row| low + (high - low) * ((row as f64 + 0.5) * step).fract()).collect();
    }
    spread.series.retain(|series| !series.rows.is_empty());
    for series in &mut spread.series {
        series.rows = 0..CANDIDATES;
    }
    spread
}

/// Steps that spread points evenly over so many dimensions.
///
/// Source: M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences (2018): powers of the root of
/// x^(d+1) = x + 1.
pub(crate) fn generator(dimensions: usize) -> Vec<f64> {
    let power = dimensions as f64 + 1.0;
    let mut root = 1.5f64;
    for _ in 0..60 {
        root = (1.0 + root).powf(1.0 / power);
    }
    (1..=dimensions).map(|axis| root.powf(-(axis as f64))).collect()
}
