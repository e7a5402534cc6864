//! Observables over columns of readings: what `eval`, `apply` and `simulate` compute.

use std::sync::{Mutex, PoisonError};

use codegen::{Form, Interpreter, Program, ShapeError, build};
use model_core::{Chain, ObservableId, SymbolId, SymbolKind};
use rayon::prelude::*;

use crate::refusal::Refusal;

/// Rows that one processor computes at a time.
const PIECE: usize = 1 << 13;

/// The exact form, or the first-order one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exactness {
    /// The product of all transforms.
    Exact,
    /// Products of two or more errors dropped.
    FirstOrder,
}

/// What of an observable is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// What the errors add to it.
    Error,
    /// The observable itself, with its errors.
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
    parts: Vec<(Program, Vec<f64>)>,
    /// Interpreters of the programs that nobody uses at the moment.
    idle: Mutex<Vec<Vec<Interpreter>>>,
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
        let parts =
            forms.into_iter().map(|(form, values)| (build(chain, &observables, form, &[]), values)).collect();
        let mut readings: Vec<SymbolId> =
            observables.iter().flat_map(|&observable| readings_of(chain, observable)).collect();
        readings.sort_unstable();
        readings.dedup();
        let shown = observables.iter().map(|&id| chain.observable(id).shown.len()).sum();
        Self { observables, readings, shown, parts, idle: Mutex::default() }
    }

    /// What a program of one observable puts out, so many numbers, with the values of errors and constants.
    pub(crate) fn of_program(
        chain: &Chain,
        observable: ObservableId,
        program: Program,
        outputs: usize,
        values: &[f64],
    ) -> Self {
        Self {
            observables: vec![observable],
            readings: readings_of(chain, observable),
            shown: outputs,
            parts: vec![(program, values.to_vec())],
            idle: Mutex::default(),
        }
    }

    /// What all observables show over columns of readings, a column each, those of the first observable first: computed on
    /// all processors, each row by itself, so that their number changes no bit.
    ///
    /// # Errors
    /// Columns of different lengths, or one missing.
    pub fn columns(&self, readings: &[(SymbolId, &[f64])], rows: usize) -> Result<Vec<Vec<f64>>, Refusal> {
        let mut all = vec![vec![0.0; rows]; self.shown];
        let mut pieces: Vec<Vec<&mut [f64]>> = (0..rows.div_ceil(PIECE)).map(|_| Vec::new()).collect();
        for column in &mut all {
            pieces.iter_mut().zip(column.chunks_mut(PIECE)).for_each(|(piece, own)| piece.push(own));
        }
        let evaluated = pieces.into_par_iter().enumerate().map(|(at, mut out)| {
            let own = at * PIECE..rows.min((at + 1) * PIECE);
            let piece =
                readings.iter().map(|&(id, column)| (id, column.get(own.clone()).unwrap_or_default()));
            self.piece(&piece.collect::<Vec<_>>(), &mut out)
        });
        evaluated.collect::<Result<(), ShapeError>>().map_err(|error| Refusal::Input(error.to_string()))?;
        Ok(all)
    }

    fn piece(&self, readings: &[(SymbolId, &[f64])], out: &mut [&mut [f64]]) -> Result<(), ShapeError> {
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let taken = idle().pop();
        let new = || self.parts.iter().map(|(program, _)| Interpreter::new(program)).collect();
        let mut interpreters: Vec<Interpreter> = taken.unwrap_or_else(new);
        for (number, (interpreter, (_, values))) in interpreters.iter_mut().zip(&self.parts).enumerate() {
            if number == 0 {
                interpreter.eval_batch(readings, values, out)?;
                continue;
            }
            let mut more: Vec<Vec<f64>> = out.iter().map(|column| vec![0.0; column.len()]).collect();
            let mut slices: Vec<&mut [f64]> = more.iter_mut().map(Vec::as_mut_slice).collect();
            interpreter.eval_batch(readings, values, &mut slices)?;
            for (column, more) in out.iter_mut().zip(&more) {
                column.iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
            }
        }
        idle().push(interpreters);
        Ok(())
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
pub fn column_names(chain: &Chain, observables: &[ObservableId]) -> Result<Vec<String>, Refusal> {
    let columns: Vec<String> = observables
        .iter()
        .map(|&id| chain.observable(id))
        .flat_map(|observable| observable.labels().map(|label| format!("{}_{label}", observable.name)))
        .collect();
    let is_reading = |id| matches!(chain.symbol(id).kind, SymbolKind::Joint | SymbolKind::Input);
    let again = columns.iter().enumerate().find(|(at, name)| columns[..*at].contains(name));
    if let Some((_, name)) = again {
        return Err(Refusal::Input(format!(
            "two observables of chain {} have a column `{name}`: rename one",
            chain.name
        )));
    }
    let taken = columns.iter().find(|name| chain.find_symbol(name).is_some_and(is_reading));
    match taken {
        None => Ok(columns),
        Some(name) => Err(Refusal::Input(format!(
            "`{name}` is both a joint or input of chain {} and the column of an observable: rename one of the two",
            chain.name
        ))),
    }
}
