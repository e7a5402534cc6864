//! Errors that stand for zero of an input from which the data lie far: `index` beside `drift*temperature` is the index at 0 degrees. And
//! errors beside a function that was found at their place: they stand for where it is zero.

use faer::Mat;
use faer::linalg::solvers::SolveLstsq;
use model_core::algebra::Poly;
use model_core::{Chain, Role, SymbolId, SymbolKind};
use serde::Serialize;

use super::units::of_reading;
use crate::search::columns::Columns;
use crate::search::context::Context;
use crate::search::fitted::Fitted;
use effects::candidate::{Effect, Place, Setting};
use effects::families::SHAPE;
use fit::{FitError, FitResult};
use observe::{Observations, SiUnit};

/// Standard deviations of an input that its mean is from zero where the data lie far from there.
const FAR: f64 = 3.0;

/// What may be left of a constant, over its size, where the errors move all that it moves.
const SAME: f64 = 1e-3;

/// Rows that say what an error moves, at most.
const ENOUGH: usize = 2_000;

/// Errors whose values are those at zero of an input, and where the data lie.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AtZero {
    /// The errors.
    pub errors: Vec<String>,
    /// The input.
    pub input: String,
    /// The least that was read of it, in rows with weight, SI.
    pub from: f64,
    /// The most.
    pub to: f64,
    /// Its SI unit.
    pub unit: SiUnit,
}

/// Errors at the place of a function that was found, whose form the data chose: what it has of a constant is theirs or its own.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BesideFunction {
    /// The errors.
    pub errors: Vec<String>,
    /// The function.
    pub function: String,
}

/// Those beside the functions that were accepted.
pub(super) fn beside_functions(whole: &Context<'_>, last: &Fitted) -> Vec<BesideFunction> {
    let effects = last.found.iter().map(|found| &whole.catalogue[found.effect]);
    let shapes = effects.filter(|effect| effect.family == SHAPE);
    let beside = |effect: &Effect| {
        let Place { body, role, freedom } = effect.place;
        let own = last.chain.bodies.get(usize::from(body.0))?.factors.iter();
        // A body that nothing moves has one side.
        let moves = own.clone().any(|factor| factor.role == Role::Motion);
        let there = own.filter(|factor| {
            (factor.kind, factor.axis) == (freedom.kind, freedom.axis) && (factor.role == role || !moves)
        });
        let constant =
            |error: &&SymbolId| there.clone().any(|factor| factor.amount.derivative(**error) == Poly::one());
        let name = |id: &SymbolId| last.chain.symbol(*id).name.clone();
        let errors: Vec<String> = last.fit.parameters.iter().filter(constant).map(name).collect();
        (!errors.is_empty()).then(|| BesideFunction { errors, function: effect.name.clone() })
    };
    shapes.filter_map(beside).collect()
}

/// Those of a chain that was fitted, input by input.
pub(super) fn at_zero(
    setting: &Setting<'_>,
    chain: &Chain,
    observations: &Observations,
    fit: &FitResult,
) -> Result<Vec<AtZero>, FitError> {
    let mut all = Vec::new();
    for (id, values) in &observations.poses.columns {
        if chain.symbol(*id).kind != SymbolKind::Input {
            continue;
        }
        let counted = values.iter().zip(&fit.residuals.weight).filter(|(_, weight)| **weight > 0.0);
        let counted: Vec<f64> = counted.map(|(value, _)| *value).collect();
        let rows = counted.len() as f64;
        let mean = counted.iter().sum::<f64>() / rows;
        let variance = counted.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / rows;
        let is_far = mean.abs() > FAR * variance.sqrt();
        let errors = if is_far { moved(chain, observations, fit, *id, mean)? } else { Vec::new() };
        if !errors.is_empty() {
            let from = counted.iter().copied().fold(f64::INFINITY, f64::min);
            let to = counted.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let (input, unit) = (chain.symbol(*id).name.clone(), of_reading(setting, chain, *id));
            all.push(AtZero { errors, input, from, to, unit });
        }
    }
    Ok(all)
}

/// The errors that the data tell apart and that would come out otherwise, by more than their standard uncertainty, if what is in proportion
/// to the input counted from its mean: what the input moves at a constant value, they move too.
fn moved(
    chain: &Chain,
    observations: &Observations,
    fit: &FitResult,
    input: SymbolId,
    mean: f64,
) -> Result<Vec<String>, FitError> {
    let is_in_proportion = |id: SymbolId| {
        let mut factors = chain.factors();
        factors.any(|factor| {
            let own = factor.amount.derivative(id);
            let rest = own.derivative(input);
            !own.is_zero() && &rest * &Poly::symbol(input) == own
        })
    };
    let (follow, stay): (Vec<usize>, Vec<usize>) =
        (0..fit.parameters.len()).partition(|&at| is_in_proportion(fit.parameters[at]));
    let told: Vec<usize> = stay.into_iter().filter(|&at| fit.separable[at]).collect();
    if follow.is_empty() || told.is_empty() {
        return Ok(Vec::new());
    }
    let mut at_one =
        if observations.rows() > ENOUGH { observations.sample(ENOUGH) } else { observations.clone() };
    for (_, values) in at_one.poses.columns.iter_mut().filter(|(id, _)| *id == input) {
        values.fill(1.0);
    }
    let columns = Columns::at(chain, &at_one, &fit.parameters, &fit.values, &[])?.declared;
    let lengths: Vec<f64> = told.iter().map(|&at| columns.col(at).norm_l2()).collect();
    let beside =
        Mat::from_fn(columns.nrows(), told.len(), |row, own| columns[(row, told[own])] / lengths[own]);
    let factor = beside.qr();
    let mut shifts = vec![0.0; told.len()];
    for at in follow {
        let constant = columns.subcols(at, 1);
        let share = factor.solve_lstsq(constant);
        let left = constant - &beside * &share;
        if left.norm_l2() <= SAME * constant.norm_l2() {
            let by = fit.values[fit.parameters[at].index()] * mean;
            for (own, shift) in shifts.iter_mut().enumerate() {
                *shift += by * share[(own, 0)] / lengths[own];
            }
        }
    }
    let moved = told.iter().zip(shifts).filter(|&(&at, shift)| shift.powi(2) > fit.covariance[(at, at)]);
    Ok(moved.map(|(&at, _)| chain.symbol(fit.parameters[at]).name.clone()).collect())
}
