//! From a chain to a program: the chain is walked body by body and never multiplied out.
//!
//! `path` says what lies between the ground and an observable, `amount` turns amounts into nodes, and one
//! module a form carries vectors along the path: `exact`, `first_order`, `jacobian`.

mod amount;
mod exact;
mod first_order;
mod jacobian;
mod path;
mod product;
mod ramp;
mod vectors;

use model_core::{Chain, ObservableId, SymbolId};

use crate::builder::{Builder, Value};
use crate::program::{Form, Layout, Program};
use path::Path;

pub use product::{MatrixProduct, Step, matrix_product};

/// The program of one form of some observables. `wrt` are the columns of Jacobians; other forms ignore it.
///
/// Outputs come observable by observable, component by component, column by column:
/// `out[(3 * observable + component) * wrt.len() + column]`.
#[must_use]
pub fn build(chain: &Chain, observables: &[ObservableId], form: Form, wrt: &[SymbolId]) -> Program {
    build_all(chain, observables, &[form], wrt)
}

/// One program for several forms, which share what they have in common; outputs form by form, each as
/// [`build`] orders them.
#[must_use]
pub fn build_all(chain: &Chain, observables: &[ObservableId], forms: &[Form], wrt: &[SymbolId]) -> Program {
    Builds { chain, values: &[] }.build(observables, forms, wrt)
}

/// What programs are built from.
pub(crate) struct Builds<'a> {
    pub(crate) chain: &'a Chain,
    /// Errors and constants whose values are numbers of the program.
    pub(crate) values: &'a [(SymbolId, f64)],
}

impl Builds<'_> {
    /// One program for several forms.
    pub(crate) fn build(&self, observables: &[ObservableId], forms: &[Form], wrt: &[SymbolId]) -> Program {
        let layout = Layout { forms: forms.to_vec(), observables: observables.to_vec(), wrt: wrt.to_vec() };
        let paths: Vec<Path> =
            observables.iter().map(|&observable| path::path(self.chain, observable)).collect();
        let motions = paths.iter().map(first_order::motions).max().unwrap_or(0);
        let meetings = if forms.contains(&Form::FirstOrderError) { 0..=motions } else { 0..=0 };
        let mut best = self.candidate(&paths, &layout, *meetings.start());
        for meeting in meetings.skip(1) {
            let other = self.candidate(&paths, &layout, meeting);
            if cost(&other) < cost(&best) {
                best = other;
            }
        }
        best
    }

    fn candidate(&self, paths: &[Path], layout: &Layout, meeting: usize) -> Program {
        let chain = self.chain;
        let mut b = Builder::new(chain, self.values);
        let mut outputs: Vec<Value> = Vec::new();
        for &form in &layout.forms {
            for path in paths {
                let b = &mut b;
                match form {
                    Form::ExactValue => outputs.extend(exact::value(b, path)),
                    Form::ExactError => outputs.extend(exact::error(b, path)),
                    Form::FirstOrderError => outputs.extend(first_order::error(b, chain, path, meeting)),
                    Form::ExactJacobian | Form::FirstOrderJacobian => {
                        let at = if form == Form::ExactJacobian {
                            jacobian::At::Errors
                        } else {
                            jacobian::At::Nominal
                        };
                        let columns = jacobian::columns(b, chain, path, at, &layout.wrt);
                        outputs.extend((0..3).flat_map(|i| columns.iter().map(move |column| column[i])));
                    }
                }
            }
        }
        b.finish(layout.clone(), &outputs)
    }
}

/// All operations, then those of every pose.
fn cost(program: &Program) -> (usize, usize) {
    let counts = program.counts();
    (counts.prepared.operations + counts.evaluated.operations, counts.evaluated.operations)
}
