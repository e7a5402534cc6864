//! The exact form in numbers: the reference that generated code is compared with.
//!
//! The difference is carried through the chain beside the vector itself, with sin ε and −2 sin²(ε/2) in place of
//! R − 1, so that it keeps full relative precision however small the errors are.

use nalgebra::Vector3;

use crate::algebra::Poly;
use crate::chain::{Axis, Chain, Motion, ObservableId, ObservableKind};
use crate::forms::error_table;
use crate::symbol::SymbolKind;

/// The factors of one observable, with every amount split into nominal part and error.
#[derive(Debug, Clone)]
pub struct Path {
    /// From the device to the ground.
    steps: Vec<Step>,
    vector: [Split; 3],
}

#[derive(Debug, Clone)]
struct Step {
    motion: Motion,
    axis: Axis,
    amount: Split,
}

#[derive(Debug, Clone)]
struct Split {
    nominal: Poly,
    error: Poly,
}

/// A vector without errors, and what the errors add to it.
struct Pair {
    nominal: Vector3<f64>,
    difference: Vector3<f64>,
}

impl Path {
    /// The way from an observable to the ground.
    #[must_use]
    pub fn new(chain: &Chain, id: ObservableId) -> Self {
        let is_error = error_table(chain);
        let split = |amount: &Poly| {
            let nominal = amount.graded_part(|symbol| is_error[symbol.index()], 0);
            Split { error: amount - &nominal, nominal }
        };
        let observable = chain.observable(id);
        let moves = |motion| motion == Motion::Rotation || observable.kind == ObservableKind::Point;
        let steps = chain
            .factors_to(id)
            .into_iter()
            .rev()
            .filter(|factor| moves(factor.motion))
            .map(|factor| Step { motion: factor.motion, axis: factor.axis, amount: split(&factor.amount) })
            .collect();
        Self { steps, vector: observable.components.each_ref().map(split) }
    }

    /// The observable with errors, in the ground frame. `values` is indexed by
    /// [`SymbolId`](crate::SymbolId), in SI units, π included.
    #[must_use]
    pub fn value(&self, values: &[f64]) -> Vector3<f64> {
        let pair = self.pair(values);
        pair.nominal + pair.difference
    }

    /// What the errors add to the observable: exact, with full relative precision.
    #[must_use]
    pub fn error(&self, values: &[f64]) -> Vector3<f64> {
        self.pair(values).difference
    }

    fn pair(&self, values: &[f64]) -> Pair {
        let start =
            |part: fn(&Split) -> &Poly| Vector3::from_fn(|axis, _| part(&self.vector[axis]).eval(values));
        let mut pair =
            Pair { nominal: start(|split| &split.nominal), difference: start(|split| &split.error) };
        for step in &self.steps {
            let nominal = step.amount.nominal.eval(values);
            let error = step.amount.error.eval(values);
            match step.motion {
                Motion::Translation => {
                    pair.nominal[step.axis.index()] += nominal;
                    pair.difference[step.axis.index()] += error;
                }
                Motion::Rotation => pair.rotate(step.axis, nominal, error),
            }
        }
        pair
    }
}

impl Pair {
    /// R(nominal) R(error): with v the vector and d its difference, d becomes
    /// R(nominal) (d + (R(error) − 1)(v + d)).
    fn rotate(&mut self, axis: Axis, nominal_rad: f64, error_rad: f64) {
        let (a, b) = ((axis.index() + 1) % 3, (axis.index() + 2) % 3);
        let sine = error_rad.sin();
        let half = (error_rad / 2.0).sin();
        let cosine_less_one = -2.0 * half * half;
        let moved = self.nominal + self.difference;
        self.difference[a] += cosine_less_one * moved[a] - sine * moved[b];
        self.difference[b] += sine * moved[a] + cosine_less_one * moved[b];
        if nominal_rad != 0.0 {
            let (sine, cosine) = nominal_rad.sin_cos();
            for vector in [&mut self.nominal, &mut self.difference] {
                let (x, y) = (vector[a], vector[b]);
                vector[a] = cosine * x - sine * y;
                vector[b] = sine * x + cosine * y;
            }
        }
    }
}

/// The observable with errors, in the ground frame: see [`Path::value`].
#[must_use]
pub fn value(chain: &Chain, observable: ObservableId, values: &[f64]) -> Vector3<f64> {
    Path::new(chain, observable).value(values)
}

/// What the errors add to the observable: see [`Path::error`].
#[must_use]
pub fn error(chain: &Chain, observable: ObservableId, values: &[f64]) -> Vector3<f64> {
    Path::new(chain, observable).error(values)
}

impl Chain {
    /// A value for every symbol, in SI units, indexed by [`SymbolId`](crate::SymbolId): π, constants at their declared
    /// value, everything else (joints, errors, inputs) at zero.
    #[must_use]
    pub fn nominal_values(&self) -> Vec<f64> {
        let value = |symbol: &crate::Symbol| match symbol.kind {
            SymbolKind::Pi => std::f64::consts::PI,
            _ => symbol.value.unwrap_or(0.0),
        };
        self.symbols.iter().map(value).collect()
    }
}
