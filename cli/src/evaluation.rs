//! Observables over columns of readings: what `eval`, `apply` and `simulate` compute.

use codegen::{Form, Interpreter, build};
use model_core::{Chain, ObservableId, SymbolId, SymbolKind};

use crate::failure::Failure;

/// The exact form, or the first-order one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Exactness {
    /// The product of all transforms
    Exact,
    /// Products of two or more errors dropped
    FirstOrder,
}

/// What of an observable is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Quantity {
    /// What the errors add to it
    Error,
    /// The observable itself, with its errors
    Value,
}

/// Programs for some observables of a chain, with their errors filled in.
pub struct Evaluator {
    /// The observables, in the order of the output columns.
    pub observables: Vec<ObservableId>,
    /// The joints and inputs that they need, each once, in order of the chain.
    pub readings: Vec<SymbolId>,
    /// How many numbers the observables show together.
    shown: usize,
    /// Programs whose outputs add up, each with the values of errors and constants.
    parts: Vec<(Interpreter, Vec<f64>)>,
}

impl Evaluator {
    /// Builds what computes `quantity` of the observables; `values` as an errors file gives them.
    #[must_use]
    pub fn new(
        chain: &Chain,
        observables: Vec<ObservableId>,
        exactness: Exactness,
        quantity: Quantity,
        values: &[f64],
    ) -> Self {
        let mut without_errors = values.to_vec();
        for error in chain.symbols_of(SymbolKind::Error) {
            without_errors[error.index()] = 0.0;
        }
        let forms = match (exactness, quantity) {
            (Exactness::Exact, Quantity::Error) => vec![(Form::ExactError, values.to_vec())],
            (Exactness::Exact, Quantity::Value) => vec![(Form::ExactValue, values.to_vec())],
            (Exactness::FirstOrder, Quantity::Error) => vec![(Form::FirstOrderError, values.to_vec())],
            (Exactness::FirstOrder, Quantity::Value) => {
                vec![(Form::ExactValue, without_errors), (Form::FirstOrderError, values.to_vec())]
            }
        };
        let parts = forms
            .into_iter()
            .map(|(form, values)| (Interpreter::new(&build(chain, &observables, form, &[])), values))
            .collect();
        let mut readings: Vec<SymbolId> =
            observables.iter().flat_map(|&observable| readings_of(chain, observable)).collect();
        readings.sort_unstable();
        readings.dedup();
        let shown = observables.iter().map(|&id| chain.observable(id).shown.len()).sum();
        Self { observables, readings, shown, parts }
    }

    /// What all observables show over columns of readings, a column each, those of the first observable first.
    ///
    /// # Errors
    /// Columns of different lengths, or one missing.
    pub fn columns(
        &mut self,
        readings: &[(SymbolId, &[f64])],
        rows: usize,
    ) -> Result<Vec<Vec<f64>>, Failure> {
        let mut sum = vec![vec![0.0; rows]; self.shown];
        let mut part = sum.clone();
        for (interpreter, values) in &mut self.parts {
            let mut out: Vec<&mut [f64]> = part.iter_mut().map(Vec::as_mut_slice).collect();
            interpreter
                .eval_batch(readings, values, &mut out)
                .map_err(|error| Failure::Input(error.to_string()))?;
            for (sum, part) in sum.iter_mut().flatten().zip(part.iter().flatten()) {
                *sum += part;
            }
        }
        Ok(sum)
    }
}

/// The joints and inputs that an observable depends on, in order of the chain.
#[must_use]
pub fn readings_of(chain: &Chain, observable: ObservableId) -> Vec<SymbolId> {
    let mut symbols = chain.symbols_of_way(observable);
    symbols.retain(|&id| matches!(chain.symbol(id).kind, SymbolKind::Joint | SymbolKind::Input));
    symbols
}

/// Names of the columns of observables: `pointing_x`, `pointing_y`, `pointing_z`, or `sky_azimuth`.
///
/// # Errors
/// A joint or an input has the name of one.
pub fn column_names(chain: &Chain, observables: &[ObservableId]) -> Result<Vec<String>, Failure> {
    let columns: Vec<String> = observables
        .iter()
        .map(|&id| chain.observable(id))
        .flat_map(|observable| observable.labels().map(|label| format!("{}_{label}", observable.name)))
        .collect();
    let is_reading = |id| matches!(chain.symbol(id).kind, SymbolKind::Joint | SymbolKind::Input);
    let again = columns.iter().enumerate().find(|(at, name)| columns[..*at].contains(name));
    if let Some((_, name)) = again {
        return Err(Failure::Input(format!(
            "two observables of chain {} have a column `{name}`: rename one",
            chain.name
        )));
    }
    let taken = columns.iter().find(|name| chain.find_symbol(name).is_some_and(is_reading));
    match taken {
        None => Ok(columns),
        Some(name) => Err(Failure::Input(format!(
            "`{name}` is both a joint or input of chain {} and the column of an observable: rename one of the two",
            chain.name
        ))),
    }
}
