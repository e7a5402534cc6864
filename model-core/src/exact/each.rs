//! What each error does by itself, for all errors of an observable in one pass along its way: the cost is that of the way and
//! of the errors, not their product.

use std::cell::RefCell;

use nalgebra::{Matrix3, Vector3};

use super::{Parts, Path};
use crate::algebra::Poly;
use crate::chain::{Axis, Chain, ObservableId, TransformKind};
use crate::forms::error_table;
use crate::symbol::{SymbolId, SymbolKind};

/// An observable and the errors that act on it.
#[derive(Debug, Clone)]
pub struct Each {
    path: Path,
    errors: Vec<SymbolId>,
    /// For each step, from the device, the errors in its amount.
    steps: Vec<Vec<Use>>,
    vector: [Vec<Use>; 3],
    /// Errors that act at several places, or with others only.
    is_spread: Vec<bool>,
    /// The last place where each error acts.
    places: Vec<Option<Place>>,
    /// The steps that are there without errors.
    design: Vec<usize>,
}

/// Where an error acts: in the amount of a step or in a component of the vector, and there in which use.
#[derive(Debug, Clone, Copy)]
enum Place {
    Step(usize, usize),
    Component(usize, usize),
}

/// An error in an amount.
#[derive(Debug, Clone)]
struct Use {
    /// Index into the errors.
    error: usize,
    /// What multiplies it, to first order.
    slope: Poly,
    /// All of the amount that has no other error in it, and none of it without this one.
    own: Poly,
}

impl Each {
    /// Of an observable, with all errors of its chain.
    #[must_use]
    pub fn new(chain: &Chain, id: ObservableId) -> Self {
        let path = Path::new(chain, id);
        let errors: Vec<SymbolId> = chain.symbols_of(SymbolKind::Error).collect();
        let is_error = error_table(chain);
        let mut uses = vec![0_usize; errors.len()];
        let mut of = |split: &super::Split| -> Vec<Use> {
            let amount = &split.linear + &split.beyond;
            let mut found: Vec<Use> = Vec::new();
            for (monomial, part) in amount.collect_by(|symbol| is_error[symbol.index()]) {
                for (symbol, _) in &monomial {
                    let Ok(error) = errors.binary_search(symbol) else { continue };
                    uses[error] += 1;
                    let [(only, power)] = monomial.as_slice() else { continue };
                    let own = &(0..*power).fold(Poly::one(), |own, _| &own * &Poly::symbol(*only)) * &part;
                    let slope = if *power == 1 { part.clone() } else { Poly::zero() };
                    match found.iter_mut().find(|one| one.error == error) {
                        Some(one) => {
                            uses[error] -= 1;
                            (one.slope, one.own) = (&one.slope + &slope, &one.own + &own);
                        }
                        None => found.push(Use { error, slope, own }),
                    }
                }
            }
            found
        };
        let steps: Vec<Vec<Use>> = path.steps.iter().map(|step| of(&step.amount)).collect();
        let vector = [of(&path.vector[0]), of(&path.vector[1]), of(&path.vector[2])];
        let is_spread = uses.iter().map(|&count| count > 1).collect();
        let mut places = vec![None; errors.len()];
        let mut act = |uses: &[Use], place: &dyn Fn(usize) -> Place| {
            for (at, one) in uses.iter().enumerate() {
                places[one.error] = Some(place(at));
            }
        };
        steps.iter().enumerate().for_each(|(step, uses)| act(uses, &|at| Place::Step(step, at)));
        vector.iter().enumerate().for_each(|(axis, uses)| act(uses, &|at| Place::Component(axis, at)));
        let is_there = |&step: &usize| !path.steps[step].amount.nominal.is_zero();
        let design = (0..path.steps.len()).filter(is_there).collect();
        Self { path, errors, steps, vector, is_spread, places, design }
    }

    /// All errors of the chain, in order.
    #[must_use]
    pub fn errors(&self) -> &[SymbolId] {
        &self.errors
    }

    /// The vector without errors, and what a unit of each error adds to it to first order, in the order of [`Self::errors`].
    #[must_use]
    pub fn slopes(&self, values: &[f64]) -> (Vector3<f64>, Vec<Vector3<f64>>) {
        let values = &*self.path.with_derived(values);
        self.pass(values, |one, values, axis, before| {
            let slope = one.slope.eval(values);
            match before {
                Some(before) => axis.cross(&before) * slope,
                None => axis * slope,
            }
        })
    }

    /// The vector without errors, and what each error of its size adds to it when it acts alone: exact, with full relative
    /// precision. `values` has all errors at zero; `sizes` is in the order of [`Self::errors`].
    #[must_use]
    pub fn alone(&self, values: &mut [f64], sizes: &[f64]) -> (Vector3<f64>, Vec<Vector3<f64>>) {
        let scratch = RefCell::new(self.path.with_derived(values).into_owned());
        let start = scratch.borrow().clone();
        let (nominal, mut added) = self.pass(&start, |one, _, axis, before| {
            if sizes[one.error] == 0.0 {
                return Vector3::zeros();
            }
            let mut values = scratch.borrow_mut();
            let slot = self.errors[one.error].index();
            values[slot] = sizes[one.error];
            let amount = one.own.eval(&values);
            values[slot] = 0.0;
            moved(axis, before, amount)
        });
        for (index, error) in self.errors.iter().enumerate().filter(|(index, _)| self.is_spread[*index]) {
            if sizes[index] != 0.0 {
                values[error.index()] = sizes[index];
                added[index] = self.path.error(values);
                values[error.index()] = 0.0;
            }
        }
        (nominal, added)
    }

    /// The same of one error, in the frame of the place where it acts: lengths and angles are those that the observable has in its
    /// own frame, and nothing between that place and the ground counts. `None` for an error that acts at several places. `values`
    /// has all errors at zero, and has them so afterwards.
    #[must_use]
    pub fn one_alone(&self, values: &mut [f64], error: SymbolId, size: f64) -> Option<[Vector3<f64>; 2]> {
        let index = self.errors.binary_search(&error).ok()?;
        if self.is_spread[index] {
            return None;
        }
        let mut with_derived;
        let values = if self.path.ramps.is_empty() && self.path.angles.is_empty() {
            values
        } else {
            with_derived = self.path.with_derived(values).into_owned();
            &mut with_derived
        };
        let nominal = Vector3::from_fn(|axis, _| self.path.vector[axis].nominal.eval(values));
        let mut amount = |one: &Use| {
            values[error.index()] = size;
            let amount = one.own.eval(values);
            values[error.index()] = 0.0;
            amount
        };
        let (acts_in, at) = match self.places[index] {
            Some(Place::Step(step, at)) => (step, at),
            Some(Place::Component(axis, at)) => {
                let amount = amount(&self.vector[axis][at]);
                return Some([nominal, moved(Vector3::ith(axis, 1.0), None, amount)]);
            }
            None => return Some([nominal, Vector3::zeros()]),
        };
        let amount = amount(&self.steps[acts_in][at]);
        let mut parts = Parts { nominal, first: Vector3::zeros(), rest: Vector3::zeros() };
        for step in self.design.iter().take_while(|&&step| step < acts_in).map(|&step| &self.path.steps[step])
        {
            let by = step.amount.nominal.eval(values);
            match step.kind {
                TransformKind::Translation => parts.nominal[step.axis.index()] += by,
                TransformKind::Rotation => parts.rotate(step.axis, by, 0.0, 0.0),
            }
        }
        let step = &self.path.steps[acts_in];
        let is_turn = step.kind == TransformKind::Rotation;
        let axis = Vector3::ith(step.axis.index(), 1.0);
        // A shift moves what it has shifted; lengths do not count the difference, angles of directions have none.
        Some([parts.nominal, moved(axis, is_turn.then_some(parts.nominal), amount)])
    }

    /// What the errors of a step add, given the unit vector of its axis and, of a rotation, the vector that it turns; carried to
    /// the frame that the observable is seen in, and added up by error.
    fn pass(
        &self,
        values: &[f64],
        added: impl Fn(&Use, &[f64], Vector3<f64>, Option<Vector3<f64>>) -> Vector3<f64>,
    ) -> (Vector3<f64>, Vec<Vector3<f64>>) {
        let start = Vector3::from_fn(|axis, _| self.path.vector[axis].nominal.eval(values));
        let mut parts = Parts { nominal: start, first: Vector3::zeros(), rest: Vector3::zeros() };
        let mut before = Vec::with_capacity(self.steps.len());
        for step in &self.path.steps {
            let amount = step.amount.nominal.eval(values);
            before.push((parts.nominal, amount));
            match step.kind {
                TransformKind::Translation => parts.nominal[step.axis.index()] += amount,
                TransformKind::Rotation => parts.rotate(step.axis, amount, 0.0, 0.0),
            }
        }
        let mut sums = vec![Vector3::zeros(); self.errors.len()];
        let mut frame = Matrix3::identity();
        for ((step, uses), (vector, amount)) in self.path.steps.iter().zip(&self.steps).zip(before).rev() {
            let is_turn = step.kind == TransformKind::Rotation;
            if is_turn && amount != 0.0 {
                turn(&mut frame, step.axis, amount);
            }
            for one in uses {
                let axis = Vector3::ith(step.axis.index(), 1.0);
                sums[one.error] += frame * added(one, values, axis, is_turn.then_some(vector));
            }
        }
        for (axis, uses) in self.vector.iter().enumerate() {
            for one in uses {
                sums[one.error] += frame * added(one, values, Vector3::ith(axis, 1.0), None);
            }
        }
        (parts.nominal, sums)
    }
}

/// What an amount adds: along an axis, or to the vector that it turns about it.
fn moved(axis: Vector3<f64>, before: Option<Vector3<f64>>, amount: f64) -> Vector3<f64> {
    let Some(before) = before else { return axis * amount };
    let half = (amount / 2.0).sin();
    // R(ε) − 1 = sin ε (axis ×) + (1 − cos ε) (axis × axis ×)
    let across = axis.cross(&before);
    across * amount.sin() + axis.cross(&across) * (2.0 * half * half)
}

/// A frame times the rotation about one of its axes.
fn turn(frame: &mut Matrix3<f64>, axis: Axis, angle_rad: f64) {
    let (a, b) = ((axis.index() + 1) % 3, (axis.index() + 2) % 3);
    let (sine, cosine) = angle_rad.sin_cos();
    let (x, y) = (frame.column(a).into_owned(), frame.column(b).into_owned());
    frame.set_column(a, &(x * cosine + y * sine));
    frame.set_column(b, &(y * cosine - x * sine));
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    const CHAIN: &str = "chain C {
        input range: length; const k: angle = 0.7;
        body a on ground { position: Tx(0.3), Rx(k); motion: Rz(q - pi/2); motion_error: Rx(e1), Tx(e2), Ry(e1*cos(q)); }
        body b on a { position_error: Ry(e3 + e4*sin(q)), Tz(2*e5); motion: Rx(-2*p); motion_error: Rz(e6 + e6^2), Rx(e7*e3); }
        observe tip: point(0.1, 0, range + e8) of b;
        observe seen: direction(0.3, 0.2, 1) of b;
    }";

    #[test]
    fn verify_each_error_alone_against_the_exact_form() {
        let text = CHAIN.replace("range + e8", "range");
        let chain = Chain::from_text(&text).unwrap();
        let mut values = chain.nominal_values();
        for (name, value) in [("q", 0.4), ("p", -1.1), ("range", 3.0)] {
            values[chain.find_symbol(name).unwrap().index()] = value;
        }
        for observable in ["tip", "seen"].map(|name| chain.find_observable(name).unwrap()) {
            let each = Each::new(&chain, observable);
            let path = Path::new(&chain, observable);
            for size in [0.3, 1e-9] {
                let (nominal, alone) = each.alone(&mut values, &vec![size; each.errors().len()]);
                let (_, slopes) = each.slopes(&values);
                assert!((nominal - path.value(&values)).norm() < 1e-15);
                for ((error, alone), slope) in each.errors().iter().zip(&alone).zip(&slopes) {
                    values[error.index()] = size;
                    let exact = path.error(&values);
                    let first = exact - path.remainder(&values);
                    values[error.index()] = 0.0;
                    let name = &chain.symbol(*error).name;
                    assert!((exact - alone).norm() <= 1e-14 * size, "{name}: {exact} {alone}");
                    assert!((first / size - slope).norm() < 1e-14, "{name}: {first} {slope}");
                }
            }
        }
    }
}
