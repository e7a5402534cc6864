//! How uncertain what is observed is, by the covariance of the errors that were found.

use codegen::{Form, build};
use model_core::{Chain, ObservableId, SymbolId};
use nalgebra::{DMatrix, SymmetricEigen};

use crate::Instrument;
use crate::evaluation::Evaluator;
use crate::refusal::Refusal;

/// Computes covariances of what an observable shows.
pub struct Uncertain {
    evaluator: Evaluator,
    /// A root of the covariance of the parameters, a column each.
    root: DMatrix<f64>,
    /// How many numbers the observable shows.
    shown: usize,
}

impl Uncertain {
    /// Of an observable of a chain that has the symbols of the instrument's; `values` are those of all of its symbols.
    ///
    /// # Errors
    /// The instrument file has no covariance.
    pub fn of(
        instrument: &Instrument,
        chain: &Chain,
        observable: ObservableId,
        values: &[f64],
    ) -> Result<Self, Refusal> {
        let Some(covariance) = &instrument.covariance else {
            return Err(Refusal::Input(format!(
                "`{}` does not say how sure its values are: it has no [covariance]; calibrate again, or leave --uncertainty out",
                instrument.declaration.path.display()
            )));
        };
        let count = covariance.of.len();
        let parts = SymmetricEigen::new(DMatrix::from_fn(count, count, |a, b| covariance.rows[a][b]));
        let root =
            &parts.eigenvectors * DMatrix::from_diagonal(&parts.eigenvalues.map(|own| own.max(0.0).sqrt()));
        let program = build(chain, &[observable], Form::ExactJacobian, &covariance.of);
        let shown = chain.observable(observable).shown.len();
        let evaluator = Evaluator::of_program(chain, observable, program, shown * count, values);
        Ok(Self { evaluator, root, shown })
    }

    /// The covariance of the numbers that are shown, in SI: a column for each pair of them, the first with all others first.
    ///
    /// # Errors
    /// Readings that the observable depends on are not there.
    pub fn columns(&self, readings: &[(SymbolId, &[f64])], rows: usize) -> Result<Vec<Vec<f64>>, Refusal> {
        let (shown, count) = (self.shown, self.root.nrows());
        if count == 0 {
            return Ok(vec![vec![0.0; rows]; shown * shown]);
        }
        let derivatives = self.evaluator.columns(readings, rows)?;
        let mut all = vec![Vec::with_capacity(rows); shown * shown];
        (0..rows).for_each(|row| {
            let own =
                DMatrix::from_fn(shown, count, |at, parameter| derivatives[at * count + parameter][row]);
            let moved = own * &self.root;
            let covariance = &moved * moved.transpose();
            for (at, column) in all.iter_mut().enumerate() {
                column.push(covariance[(at / shown, at % shown)]);
            }
        });
        Ok(all)
    }
}

/// The standard uncertainty of a number with this gradient by what is shown, in one row.
pub(super) fn along(gradient: &[f64], covariance: &[Vec<f64>], row: usize) -> f64 {
    let shown = gradient.len();
    let pairs = (0..shown).flat_map(|a| (0..shown).map(move |b| (a, b)));
    pairs
        .map(|(a, b)| gradient[a] * gradient[b] * covariance[a * shown + b][row])
        .sum::<f64>()
        .max(0.0)
        .sqrt()
}
