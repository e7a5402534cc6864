//! Errors that stand for zero of an input from which the data lie far: `index` beside `drift*temperature` is the index at 0 degrees. And
//! errors beside a function that was found at their place: they stand for where it is zero.

use model_core::algebra::Poly;
use model_core::{Chain, Role, SymbolId, SymbolKind};
use serde::Serialize;

use super::units::of_reading;
use crate::search::context::Context;
use crate::search::fitted::Fitted;
use effects::candidate::{Effect, Place, Setting};
use effects::families::SHAPE;
use fit::FitResult;
use observe::{Observations, SiUnit};

/// Standard deviations of an input that its mean is from zero where the data lie far from there.
const FAR: f64 = 3.0;

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
) -> Vec<AtZero> {
    let inputs = observations.poses.columns.iter();
    let inputs = inputs.filter(|(id, _)| chain.symbol(*id).kind == SymbolKind::Input);
    let of_input = |(id, values): &(SymbolId, Vec<f64>)| {
        let errors = beside(chain, fit, *id);
        if errors.is_empty() {
            return None;
        }
        let counted = values.iter().zip(&fit.residuals.weight).filter(|(_, weight)| **weight > 0.0);
        let counted: Vec<f64> = counted.map(|(value, _)| *value).collect();
        let rows = counted.len() as f64;
        let mean = counted.iter().sum::<f64>() / rows;
        let variance = counted.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / rows;
        let is_far = mean.abs() > FAR * variance.sqrt();
        let from = counted.iter().copied().fold(f64::INFINITY, f64::min);
        let to = counted.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let symbol = chain.symbol(*id);
        let (input, unit) = (symbol.name.clone(), of_reading(setting, chain, *id));
        is_far.then_some(AtZero { errors, input, from, to, unit })
    };
    inputs.filter_map(of_input).collect()
}

/// The errors that the data tell apart and that move what another error times the input moves.
fn beside(chain: &Chain, fit: &FitResult, input: SymbolId) -> Vec<String> {
    let told = fit.parameters.iter().zip(&fit.separable);
    let told: Vec<SymbolId> = told.filter(|(_, separable)| **separable).map(|(id, _)| *id).collect();
    let mut names = Vec::new();
    for body in &chain.bodies {
        for factor in &body.factors {
            let at_place = body.factors.iter().filter(|other| {
                (other.role, other.kind, other.axis) == (factor.role, factor.kind, factor.axis)
            });
            let columns: Vec<Poly> = at_place
                .flat_map(|other| told.iter().map(|&error| other.amount.derivative(error)))
                .filter(|column| !column.is_zero())
                .collect();
            let input = Poly::symbol(input);
            for &error in &told {
                let own = factor.amount.derivative(error);
                let name = &chain.symbol(error).name;
                if !own.is_zero() && columns.contains(&(&own * &input)) && !names.contains(name) {
                    names.push(name.clone());
                }
            }
        }
    }
    names
}
