//! Jacobians from what lies below and above each step: with `P` the turn from the ground up to the step and
//! `s` the vector from the step to the observable, a turn about axis `a` moves the observable by `P (a × s)`, a
//! shift along it by `P a`.
//!
//! With errors, that turn is written `P a × P s`: in the ground's axes a direction is the same vector for all steps, and
//! a point's differs by the shifts between them, so that no turn need be applied to it. Without errors `a × s` has
//! zeros and equal columns that products of the columns of `P` would hide.

use std::collections::BTreeMap;

use model_core::ramp::Ramp;
use model_core::sight::SightAngle;
use model_core::{Axis, Chain, SymbolId, TransformKind};

use super::amount::{lower, small_turn, turn};
use super::exact::{component_errors, components};
use super::path::{Path, Split, Step, is_error};
use super::ramp::slope;
use super::sight::sight_slope;
use super::vectors::{Matrix, NOTHING, Turn, Vector, add, affine, along, axis_cross, cross};
use crate::builder::{Builder, Value};

/// Where the derivative is taken.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum At {
    /// At the errors given.
    Errors,
    /// Where every error is zero.
    Nominal,
}

/// A column for each symbol.
pub(super) fn columns(b: &mut Builder, chain: &Chain, path: &Path, at: At, wrt: &[SymbolId]) -> Vec<Vector> {
    let places = places(b, path, at);
    let uses = uses(path);
    wrt.iter().map(|&symbol| column(b, chain, path, (&places, &uses), at, symbol)).collect()
}

/// The steps in whose amounts each symbol stands, in order: most symbols stand in one of many.
fn uses(path: &Path) -> BTreeMap<SymbolId, Vec<usize>> {
    let mut uses: BTreeMap<SymbolId, Vec<usize>> = BTreeMap::new();
    for (at, step) in path.steps.iter().enumerate() {
        let mut symbols = step.amount.nominal.symbols();
        symbols.extend(step.amount.error.symbols());
        symbols.sort_unstable();
        symbols.dedup();
        for symbol in symbols {
            uses.entry(symbol).or_default().push(at);
        }
    }
    uses
}

/// What lies below and above each step; the last is the device, with nothing above but the observable itself.
struct Places {
    below: Vec<Matrix>,
    /// In the axes of the step where errors are zero, in those of the ground elsewhere.
    above: Vec<Vector>,
}

fn places(b: &mut Builder, path: &Path, at: At) -> Places {
    let mut prefix: Matrix = [
        along_x(),
        [Builder::ZERO, Builder::ONE, Builder::ZERO],
        [Builder::ZERO, Builder::ZERO, Builder::ONE],
    ];
    let mut below = vec![prefix];
    for step in &path.steps {
        for turn in turns(b, step, at) {
            // A row times R is the row turned back.
            prefix = std::array::from_fn(|i| turn.back().apply(b, step.axis, &prefix[i]));
        }
        below.push(prefix);
    }
    let mut suffix = components(b, path);
    if at == At::Errors {
        let errors = component_errors(b, path);
        suffix = add(b, &suffix, &errors);
        suffix = affine(b, &prefix, &suffix, &NOTHING);
    }
    let mut above = vec![suffix];
    for (step, below) in path.steps.iter().zip(&below).rev() {
        suffix = match at {
            At::Errors => seen_from(b, step, below, &suffix),
            At::Nominal => lowered(b, step, &suffix),
        };
        above.push(suffix);
    }
    above.reverse();
    Places { below, above }
}

fn column(
    b: &mut Builder,
    chain: &Chain,
    path: &Path,
    (places, uses): (&Places, &BTreeMap<SymbolId, Vec<usize>>),
    at: At,
    symbol: SymbolId,
) -> Vector {
    let varying = Varying::new(b, symbol);
    let mut used: Vec<usize> =
        varying.symbols().filter_map(|symbol| uses.get(&symbol)).flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let derivative = |b: &mut Builder, amount: &Split| varying.derivative(b, chain, amount, at);
    let mut sum = NOTHING;
    for index in used {
        let (step, below, above) = (&path.steps[index], &places.below[index], &places.above[index]);
        let rate = derivative(b, &step.amount);
        let moved = match (step.kind, at) {
            (TransformKind::Rotation, At::Errors) => {
                let axis = column_of(below, step.axis);
                cross(b, &axis, above).map(|component| b.mul(rate, component))
            }
            (TransformKind::Rotation, At::Nominal) => {
                let moved = axis_cross(step.axis, above).map(|component| b.mul(rate, component));
                affine(b, below, &moved, &NOTHING)
            }
            (TransformKind::Translation, _) => affine(b, below, &along(step.axis, rate), &NOTHING),
        };
        sum = add(b, &sum, &moved);
    }
    let own = std::array::from_fn(|i| derivative(b, &path.components[i]));
    match places.below.last() {
        Some(below) => affine(b, below, &own, &sum),
        None => sum,
    }
}

/// A symbol, with the ramps and angles of lines of sight that vary with it.
pub(super) struct Varying {
    symbol: SymbolId,
    ramps: Vec<Ramp>,
    angles: Vec<SightAngle>,
}

impl Varying {
    pub(super) fn new(b: &Builder, symbol: SymbolId) -> Self {
        Self { symbol, ramps: b.ramps_of(symbol), angles: b.sight_angles_of(symbol) }
    }

    /// What varies.
    fn symbols(&self) -> impl Iterator<Item = SymbolId> {
        let derived = self.ramps.iter().map(|ramp| ramp.symbol);
        derived.chain(self.angles.iter().map(|angle| angle.symbol)).chain([self.symbol])
    }

    /// The derivative of an amount.
    pub(super) fn derivative(&self, b: &mut Builder, chain: &Chain, amount: &Split, at: At) -> Value {
        let amount = &amount.nominal + &amount.error;
        let partial = |b: &mut Builder, symbol| {
            let derivative = amount.derivative(symbol);
            match at {
                At::Errors => lower(b, &derivative),
                At::Nominal => lower(b, &derivative.graded_part(|id| is_error(chain, id), 0)),
            }
        };
        let mut sum = partial(b, self.symbol);
        for ramp in &self.ramps {
            let of_ramp = partial(b, ramp.symbol);
            let slope = slope(b, ramp, self.symbol);
            let part = b.mul(of_ramp, slope);
            sum = b.add(sum, part);
        }
        for angle in &self.angles {
            let of_angle = partial(b, angle.symbol);
            let slope = sight_slope(b, angle, self.symbol);
            let part = b.mul(of_angle, slope);
            sum = b.add(sum, part);
        }
        sum
    }
}

/// The turns that a step makes, of the design and of the errors.
fn turns(b: &mut Builder, step: &Step, at: At) -> Vec<Turn> {
    if step.kind == TransformKind::Translation {
        return Vec::new();
    }
    let mut turns = Vec::new();
    if !step.amount.nominal.is_zero() {
        turns.push(turn(b, &step.amount.nominal));
    }
    if at == At::Errors && !step.amount.error.is_zero() {
        let small = small_turn(b, &step.amount.error);
        turns.push(Turn { sin: small.sin, cos: b.sub(Builder::ONE, small.versine) });
    }
    turns
}

/// The perfect instrument's vector above a step as it is below it.
fn lowered(b: &mut Builder, step: &Step, vector: &Vector) -> Vector {
    match step.kind {
        TransformKind::Rotation => {
            turns(b, step, At::Nominal).into_iter().fold(*vector, |v, turn| turn.apply(b, step.axis, &v))
        }
        TransformKind::Translation => {
            let nominal = lower(b, &step.amount.nominal);
            add(b, vector, &along(step.axis, nominal))
        }
    }
}

/// The ground's vector from above a step as it is from below it.
fn seen_from(b: &mut Builder, step: &Step, below: &Matrix, vector: &Vector) -> Vector {
    match step.kind {
        TransformKind::Rotation => *vector,
        TransformKind::Translation => {
            let (nominal, error) = (lower(b, &step.amount.nominal), lower(b, &step.amount.error));
            let shift = b.add(nominal, error);
            affine(b, below, &along(step.axis, shift), vector)
        }
    }
}

/// An axis of a step in the ground's axes.
fn column_of(below: &Matrix, axis: Axis) -> Vector {
    below.map(|row| row[axis.index()])
}

fn along_x() -> Vector {
    [Builder::ONE, Builder::ZERO, Builder::ZERO]
}
