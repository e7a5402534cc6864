//! From a chain to a program: the chain is walked body by body and never multiplied out.
//!
//! `path` says what lies between the ground and an observable, `amount` turns amounts into nodes, and one
//! module a form carries vectors along the path: `exact`, `first_order`, `jacobian`.

mod amount;
mod exact;
mod first_order;
mod image;
mod jacobian;
mod path;
mod product;
mod ramp;
mod readings;
mod region;
mod sight;
mod uncertain;
mod vectors;

use model_core::{Chain, ObservableId, SymbolId, SymbolKind};

use crate::builder::{Builder, Value};
use crate::program::{Form, Layout, Program};
use path::Path;
use vectors::{NOTHING, Vector};

pub use product::{MatrixProduct, Step, matrix_product};
pub use region::Measured;
pub use uncertain::Covariance;

/// The program of one form of some observables. `wrt` are the columns of Jacobians; other forms ignore it.
///
/// Outputs come observable by observable, component by component, column by column:
/// `out[(place + component) * wrt.len() + column]`, the place being how many numbers the observables before show: three for
/// each vector.
///
/// # Example
///
/// ```
/// use codegen::{Form, Interpreter, build};
/// use model_core::Chain;
///
/// let chain = Chain::from_text(
///     "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); } \
///      observe edge: direction(1, 0, 0) of top; }",
/// )?;
/// let edge = chain.find_observable("edge").ok_or("none")?;
/// let program = build(&chain, &[edge], Form::FirstOrderError, &[]);
///
/// let mut values = chain.nominal_values();
/// values[chain.find_symbol("index").ok_or("none")?.index()] = 1e-4;
/// let mut error = [0.0; 3];
/// Interpreter::new(&program).eval(&values, &mut error)?;
/// assert_eq!(error, [0.0, 1e-4, 0.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn build(chain: &Chain, observables: &[ObservableId], form: Form, wrt: &[SymbolId]) -> Program {
    build_all(chain, observables, &[form], wrt)
}

/// One program for several forms, which share what they have in common; outputs form by form, each as
/// [`build`] orders them.
#[must_use]
pub fn build_all(chain: &Chain, observables: &[ObservableId], forms: &[Form], wrt: &[SymbolId]) -> Program {
    Builds { chain, values: &[], covariance: None }.build(observables, forms, wrt)
}

/// The program of the standard uncertainties of what some observables show: [`Form::Uncertainty`]. In the other functions here
/// that form is zero, for nothing is unsure there.
#[must_use]
pub fn build_uncertainty(chain: &Chain, observables: &[ObservableId], covariance: Covariance<'_>) -> Program {
    Builds { chain, values: &[], covariance: Some(covariance) }.build(observables, &[Form::Uncertainty], &[])
}

/// What programs are built from.
pub(crate) struct Builds<'a> {
    pub(crate) chain: &'a Chain,
    /// Errors and constants whose values are numbers of the program.
    pub(crate) values: &'a [(SymbolId, f64)],
    /// How sure they are.
    pub(crate) covariance: Option<Covariance<'a>>,
}

impl Builds<'_> {
    /// The program that says whether a pose lies in the region that was measured: one number, 1 or 0.
    pub(crate) fn region(&self, ranges: &[Measured]) -> Program {
        let mut b = Builder::new(self.chain, self.values);
        let inside = region::inside(&mut b, ranges);
        let layout = Layout { forms: vec![], observables: vec![], shown: vec![], wrt: vec![] };
        b.finish(layout, &[inside])
    }

    /// One program for several forms.
    pub(crate) fn build(&self, observables: &[ObservableId], forms: &[Form], wrt: &[SymbolId]) -> Program {
        let layout = Layout {
            forms: forms.to_vec(),
            observables: observables.to_vec(),
            shown: observables.iter().map(|&id| self.chain.observable(id).shown.len()).collect(),
            wrt: wrt.to_vec(),
        };
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
                if let Some(camera) = &path.camera {
                    match form {
                        Form::ExactValue => outputs.extend(image::value(b, path, camera)),
                        Form::ExactError => outputs.extend(image::error(b, path, camera)),
                        Form::FirstOrderError => {
                            outputs.extend(image::first_order(b, chain, path, camera, meeting));
                        }
                        Form::ExactJacobian | Form::FirstOrderJacobian | Form::Uncertainty => {
                            self.derivatives(b, path, form, &layout.wrt, &mut outputs);
                        }
                    }
                    continue;
                }
                match form {
                    Form::ExactValue | Form::ExactError if path.is_orientation() => {
                        let axes = path.to_axes().each_ref().map(|axis| exact::both(b, axis));
                        let turned = readings::rotation(b, &axes);
                        outputs.extend(path.rotations_of(&turned));
                    }
                    Form::FirstOrderError if path.is_orientation() => {
                        let axes = path.to_axes().each_ref().map(|axis| {
                            (nominal(b, path, axis), first_order::error(b, chain, axis, meeting))
                        });
                        let turned = readings::sine(b, &axes);
                        outputs.extend(path.rotations_of(&turned));
                    }
                    Form::ExactValue if path.has_components_only() => {
                        let value = exact::value(b, path);
                        outputs.extend(path.components_of(&value));
                    }
                    Form::ExactValue => {
                        let (nominal, error) = exact::both(b, path);
                        outputs
                            .extend(path.shown.iter().map(|one| readings::value(b, one, &nominal, &error)));
                    }
                    Form::ExactError => {
                        let (nominal, error) = exact::both(b, path);
                        outputs
                            .extend(path.shown.iter().map(|one| readings::error(b, one, &nominal, &error)));
                    }
                    Form::FirstOrderError => {
                        let error = first_order::error(b, chain, path, meeting);
                        let nominal = nominal(b, path, path);
                        outputs.extend(path.shown.iter().map(|one| readings::rate(b, one, &nominal, &error)));
                    }
                    Form::ExactJacobian | Form::FirstOrderJacobian | Form::Uncertainty => {
                        self.derivatives(b, path, form, &layout.wrt, &mut outputs);
                    }
                }
            }
        }
        b.finish(layout.clone(), &outputs)
    }

    /// A form that is made of derivatives.
    fn derivatives(
        &self,
        b: &mut Builder,
        path: &Path,
        form: Form,
        wrt: &[SymbolId],
        outputs: &mut Vec<Value>,
    ) {
        let chain = self.chain;
        match (form, self.covariance.filter(|known| !known.of.is_empty())) {
            (Form::Uncertainty, Some(covariance)) => {
                let derivatives = jacobian_rows(b, chain, path, jacobian::At::Errors, covariance.of);
                outputs.extend(uncertain::standard(b, &derivatives, &covariance));
            }
            (Form::Uncertainty, None) => outputs.extend(path.shown.iter().map(|_| Builder::ZERO)),
            (Form::FirstOrderJacobian, _) => {
                outputs.extend(jacobian_rows(b, chain, path, jacobian::At::Nominal, wrt));
            }
            _ => outputs.extend(jacobian_rows(b, chain, path, jacobian::At::Errors, wrt)),
        }
    }
}

/// The vector at the end of a way without errors, where what is shown needs it.
fn nominal(b: &mut Builder, shown: &Path, way: &Path) -> Vector {
    if shown.has_components_only() { NOTHING } else { exact::both(b, way).0 }
}

/// The rows of a Jacobian, one behind the other.
fn jacobian_rows(
    b: &mut Builder,
    chain: &Chain,
    path: &Path,
    at: jacobian::At,
    wrt: &[SymbolId],
) -> Vec<Value> {
    if let Some(camera) = &path.camera {
        return image::jacobian_rows(b, chain, path, camera, at, wrt);
    }
    if path.is_orientation() {
        return orientation_rows(b, chain, path, at, wrt);
    }
    let columns = jacobian::columns(b, chain, path, at, wrt);
    if path.has_components_only() {
        let component = |i: usize| columns.iter().map(move |column| column[i]);
        return path.axes().flat_map(component).collect();
    }
    let (nominal, error) = match at {
        jacobian::At::Errors => exact::both(b, path),
        jacobian::At::Nominal => (exact::both(b, path).0, NOTHING),
    };
    let real = vectors::add(b, &nominal, &error);
    // The vector without errors changes with joints, inputs and constants.
    let designed = jacobian::columns(b, chain, path, jacobian::At::Nominal, wrt);
    let of_design = |symbol: SymbolId, column: &Vector| {
        if chain.symbol(symbol).kind == SymbolKind::Error { NOTHING } else { *column }
    };
    let mut rows = Vec::new();
    for one in &path.shown {
        for (index, &symbol) in wrt.iter().enumerate() {
            let change = of_design(symbol, &designed[index]);
            rows.push(readings::derivative(b, one, (&nominal, &change), &error, (&real, &columns[index])));
        }
    }
    rows
}

/// The rows of the Jacobian of a small rotation vector.
fn orientation_rows(
    b: &mut Builder,
    chain: &Chain,
    path: &Path,
    at: jacobian::At,
    wrt: &[SymbolId],
) -> Vec<Value> {
    let ways = path.to_axes();
    let axes = ways.each_ref().map(|way| match at {
        jacobian::At::Errors => exact::both(b, way),
        jacobian::At::Nominal => (exact::both(b, way).0, NOTHING),
    });
    let real = ways.each_ref().map(|way| jacobian::columns(b, chain, way, at, wrt));
    let designed = ways.each_ref().map(|way| jacobian::columns(b, chain, way, jacobian::At::Nominal, wrt));
    let rates: Vec<Vector> = wrt
        .iter()
        .enumerate()
        .map(|(index, &symbol)| {
            let is_error = chain.symbol(symbol).kind == SymbolKind::Error;
            let changes = std::array::from_fn(|axis: usize| {
                (if is_error { NOTHING } else { designed[axis][index] }, real[axis][index])
            });
            readings::rotation_rate(b, &axes, &changes)
        })
        .collect();
    let axes = path.shown.iter().filter_map(|reading| reading.rotation());
    axes.flat_map(|axis| rates.iter().map(move |rate| rate[axis.index()])).collect()
}

/// All operations, then those of every pose.
fn cost(program: &Program) -> (usize, usize) {
    let counts = program.counts();
    (counts.prepared.operations + counts.evaluated.operations, counts.evaluated.operations)
}
