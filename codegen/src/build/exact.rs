//! The exact form: a vector carried from the device down to the ground, with its difference from the vector of
//! the perfect instrument carried beside it, so that nothing cancels.
//!
//! With `v` the perfect instrument's vector and `v + δ` the real one's, an error `E` makes δ into
//! `δ + (E − I)(v + δ) + t`, where `E − I` is made of sin ε and 1 − cos ε. A motion turns both alike. The value
//! is its own difference from zero.

use model_core::{Axis, TransformKind};

use super::amount::{lower, small_turn, turn};
use super::path::Path;
use super::vectors::{Matrix, NOTHING, Turn, Vector, add, affine, along, matrix_add, others, product};
use crate::builder::{Builder, Value};
use crate::program::Stage;

const NO_TURN: Matrix = [NOTHING; 3];
const IDENTITY: Matrix = [
    [Builder::ONE, Builder::ZERO, Builder::ZERO],
    [Builder::ZERO, Builder::ONE, Builder::ZERO],
    [Builder::ZERO, Builder::ZERO, Builder::ONE],
];

/// The observable with errors.
pub(super) fn value(b: &mut Builder, path: &Path) -> Vector {
    let (nominal, error) = (components(b, path), component_errors(b, path));
    let real = add(b, &nominal, &error);
    let mut carried = Carried::new(NOTHING, real);
    carried.down(b, path, Origin::Difference)
}

/// The observable without errors, and what they add to it.
pub(super) fn both(b: &mut Builder, path: &Path) -> (Vector, Vector) {
    let (nominal, error) = (components(b, path), component_errors(b, path));
    let mut carried = Carried::new(nominal, error);
    let error = carried.down(b, path, Origin::Nominal);
    (carried.nominal[0], error)
}

/// The observable in the frame of the body that carries it, without errors.
pub(super) fn components(b: &mut Builder, path: &Path) -> Vector {
    std::array::from_fn(|i| lower(b, &path.components[i].nominal))
}

/// What errors add to it there.
pub(super) fn component_errors(b: &mut Builder, path: &Path) -> Vector {
    std::array::from_fn(|i| lower(b, &path.components[i].error))
}

/// Which of the two vectors a shift of the design belongs to.
#[derive(Clone, Copy)]
enum Origin {
    Nominal,
    Difference,
}

/// An error transform less the identity: `E v = v + bend v + shift`.
struct Bend {
    bend: Matrix,
    shift: Vector,
}

impl Bend {
    fn rotation(b: &mut Builder, axis: Axis, amount: &model_core::algebra::Poly) -> Self {
        let small = small_turn(b, amount);
        let (j, k) = others(axis);
        let mut bend = NO_TURN;
        bend[j][j] = -small.versine;
        bend[k][k] = -small.versine;
        bend[j][k] = -small.sin;
        bend[k][j] = small.sin;
        Self { bend, shift: NOTHING }
    }

    /// `E₁ E₂ − I = bend₁ + bend₂ + bend₁ bend₂`
    fn then(&self, b: &mut Builder, upper: &Self) -> Self {
        let both = product(b, &self.bend, &upper.bend);
        let bend = matrix_add(b, &self.bend, &upper.bend);
        let bend = matrix_add(b, &bend, &both);
        let shift = affine(b, &self.bend, &upper.shift, &upper.shift);
        Self { bend, shift: add(b, &self.shift, &shift) }
    }

    fn is_prepared(&self, b: &Builder) -> bool {
        self.bend.iter().chain([&self.shift]).all(|row| is_prepared(b, row))
    }
}

/// Two vectors, both linear in 1, cos θ and sin θ of at most one evaluated angle θ.
///
/// While the factors of 1, cos θ and sin θ are prepared, errors act on those factors, before any pose is
/// known; the next motion puts the sum together.
struct Carried {
    nominal: [Vector; 3],
    difference: [Vector; 3],
    turn: Option<Turn>,
}

impl Carried {
    fn new(nominal: Vector, difference: Vector) -> Self {
        Self { nominal: [nominal, NOTHING, NOTHING], difference: [difference, NOTHING, NOTHING], turn: None }
    }

    /// From the device to the ground; the difference there.
    fn down(&mut self, b: &mut Builder, path: &Path, origin: Origin) -> Vector {
        let mut run: Option<Bend> = None;
        for step in path.steps.iter().rev() {
            if !step.amount.error.is_zero() {
                let bend = match step.kind {
                    TransformKind::Rotation => Bend::rotation(b, step.axis, &step.amount.error),
                    TransformKind::Translation => {
                        let amount = lower(b, &step.amount.error);
                        Bend { bend: NO_TURN, shift: along(step.axis, amount) }
                    }
                };
                run = Some(match run {
                    Some(upper) if upper.is_prepared(b) && bend.is_prepared(b) => bend.then(b, &upper),
                    Some(upper) => {
                        self.bend(b, &upper);
                        bend
                    }
                    None => bend,
                });
            }
            if !step.amount.nominal.is_zero() {
                if let Some(bend) = run.take() {
                    self.bend(b, &bend);
                }
                match step.kind {
                    TransformKind::Rotation => {
                        let turn = turn(b, &step.amount.nominal);
                        self.turn(b, step.axis, turn);
                    }
                    TransformKind::Translation => {
                        let amount = lower(b, &step.amount.nominal);
                        self.shift(b, step.axis, amount, origin);
                    }
                }
            }
        }
        if let Some(bend) = run {
            self.bend(b, &bend);
        }
        self.settle(b);
        self.difference[0]
    }

    fn turn(&mut self, b: &mut Builder, axis: Axis, turn: Turn) {
        let evaluated = b.stage(turn.sin).max(b.stage(turn.cos)) == Stage::Evaluated;
        if evaluated && self.turn.is_none() && self.parts().all(|part| is_prepared(b, part)) {
            for parts in [&mut self.nominal, &mut self.difference] {
                *parts = turned_parts(axis, &parts[0]);
            }
            self.turn = Some(turn);
            return;
        }
        if evaluated {
            self.settle(b);
        }
        for part in self.nominal.iter_mut().chain(&mut self.difference) {
            *part = turn.apply(b, axis, part);
        }
    }

    fn shift(&mut self, b: &mut Builder, axis: Axis, amount: Value, origin: Origin) {
        if b.stage(amount) == Stage::Evaluated {
            self.settle(b);
        }
        let vector = match origin {
            Origin::Nominal => &mut self.nominal[0],
            Origin::Difference => &mut self.difference[0],
        };
        *vector = add(b, vector, &along(axis, amount));
    }

    fn bend(&mut self, b: &mut Builder, error: &Bend) {
        if !error.is_prepared(b) {
            self.settle(b);
        }
        if self.nominal.iter().all(|part| is_prepared(b, part)) {
            let turn = matrix_add(b, &IDENTITY, &error.bend);
            for (k, (v, difference)) in self.nominal.iter().zip(&mut self.difference).enumerate() {
                let shift = if k == 0 { error.shift } else { NOTHING };
                let bent = affine(b, &error.bend, v, &shift);
                *difference = affine(b, &turn, difference, &bent);
            }
        } else {
            let real = add(b, &self.nominal[0], &self.difference[0]);
            let bent = affine(b, &error.bend, &real, &error.shift);
            self.difference[0] = add(b, &self.difference[0], &bent);
        }
    }

    /// Puts the parts together.
    fn settle(&mut self, b: &mut Builder) {
        let Some(turn) = self.turn.take() else { return };
        for parts in [&mut self.nominal, &mut self.difference] {
            let [constant, cos, sin] = *parts;
            let sum = std::array::from_fn(|i| {
                b.dot([(turn.cos, cos[i]), (turn.sin, sin[i]), (Builder::ONE, constant[i])])
            });
            *parts = [sum, NOTHING, NOTHING];
        }
    }

    fn parts(&self) -> impl Iterator<Item = &Vector> {
        self.nominal.iter().chain(&self.difference)
    }
}

/// `R v` as what stands beside 1, cos and sin.
fn turned_parts(axis: Axis, v: &Vector) -> [Vector; 3] {
    let mut across = *v;
    across[axis.index()] = Builder::ZERO;
    [along(axis, v[axis.index()]), across, super::vectors::axis_cross(axis, v)]
}

fn is_prepared(b: &Builder, vector: &Vector) -> bool {
    vector.iter().all(|&value| b.stage(value) == Stage::Prepared)
}
