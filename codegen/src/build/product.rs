//! The exact form as a product of matrices: which transform stands where, and a program of their amounts.
//!
//! For those who want the product itself, as the theory writes it; [`super::exact`] multiplies it out as far as can be
//! done before a pose is known.

use model_core::{Axis, Chain, ObservableId, TransformKind};

use super::amount::{lower, turn};
use super::exact::{component_errors, components};
use super::path;
use crate::builder::{Builder, Value};
use crate::program::{Layout, Program};

/// A step of the way from the device to the ground; numbers are outputs of the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// A rotation by an error, of this angle.
    SmallRotation {
        /// About which axis.
        axis: Axis,
        /// Its angle.
        angle: usize,
    },
    /// A shift by an error.
    SmallShift {
        /// Along which axis.
        axis: Axis,
        /// By how much.
        amount: usize,
    },
    /// A rotation by design; whole quarter turns are exact.
    Rotation {
        /// About which axis.
        axis: Axis,
        /// The sine of its angle.
        sin: usize,
        /// The cosine of its angle.
        cos: usize,
    },
    /// A shift by design.
    Shift {
        /// Along which axis.
        axis: Axis,
        /// By how much.
        amount: usize,
    },
}

/// The product of an observable's matrices.
#[derive(Debug, Clone, PartialEq)]
pub struct MatrixProduct {
    /// The amounts; of no form, so that its layout is empty. First come the components of the observable in the frame of its
    /// body, without errors and what errors add to them.
    pub program: Program,
    /// From the device to the ground.
    pub steps: Vec<Step>,
}

/// The product of an observable's matrices.
#[must_use]
pub fn matrix_product(chain: &Chain, observable: ObservableId) -> MatrixProduct {
    let path = path::path(chain, observable);
    let mut b = Builder::new(chain, &[]);
    let mut outputs: Vec<Value> = Vec::new();
    outputs.extend(components(&mut b, &path));
    outputs.extend(component_errors(&mut b, &path));
    let mut steps = Vec::new();
    let mut put = |value: Value| {
        outputs.push(value);
        outputs.len() - 1
    };
    for step in path.steps.iter().rev() {
        let axis = step.axis;
        if !step.amount.error.is_zero() {
            let amount = put(lower(&mut b, &step.amount.error));
            steps.push(match step.kind {
                TransformKind::Rotation => Step::SmallRotation { axis, angle: amount },
                TransformKind::Translation => Step::SmallShift { axis, amount },
            });
        }
        if !step.amount.nominal.is_zero() {
            steps.push(match step.kind {
                TransformKind::Rotation => {
                    let turn = turn(&mut b, &step.amount.nominal);
                    Step::Rotation { axis, sin: put(turn.sin), cos: put(turn.cos) }
                }
                TransformKind::Translation => {
                    Step::Shift { axis, amount: put(lower(&mut b, &step.amount.nominal)) }
                }
            });
        }
    }
    let layout =
        Layout { forms: Vec::new(), observables: vec![observable], shown: Vec::new(), wrt: Vec::new() };
    MatrixProduct { program: b.finish(layout, &outputs), steps }
}
