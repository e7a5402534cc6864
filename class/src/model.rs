//! A declaration as something that computes: where an instrument points, and how that depends on its errors.

use codegen::{Form, Interpreter, Program, build};
use model_core::escape::clipped;
use model_core::{Chain, Mistake, ObservableId, ObservableKind, SymbolId, SymbolKind};

use crate::instrument::Instrument;
use crate::readings::{Pose, columns};

/// What the sheet calls the observable.
pub const OBSERVABLE: &str = "pointing";

/// The longest declaration that is read, bytes. An amended one has some hundred more than the sheet's.
const LONGEST: usize = 1 << 16;

/// A checked declaration of an instrument that points.
#[derive(Debug, Clone)]
pub struct Model {
    /// The chain.
    pub chain: Chain,
    /// Where it points.
    pub pointing: ObservableId,
}

/// Why a declaration is none of the instrument.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ModelError {
    /// Longer than any amended declaration.
    #[error("the declaration has more than {LONGEST} bytes")]
    TooLong,
    /// Mistakes of the language.
    #[error("the declaration has a mistake in {0}")]
    Mistake(String),
    /// No direction of that name.
    #[error(
        "the declaration shows no direction `{OBSERVABLE}`: keep the line `observe {OBSERVABLE}: direction(…)`"
    )]
    NoPointing,
    /// A joint or an input that the data do not have.
    #[error("the declaration needs readings of `{0}`, and the data have none")]
    NoReadings(String),
}

impl Model {
    /// Reads a declaration of the instrument.
    ///
    /// # Errors
    /// It is too long, has a mistake, shows no `pointing`, or needs readings that the data lack.
    pub fn of(text: &str, instrument: &Instrument) -> Result<Self, ModelError> {
        if text.len() > LONGEST {
            return Err(ModelError::TooLong);
        }
        let chain = Chain::from_text(text).map_err(|mistakes| {
            let first = mistakes.iter().next();
            let told =
                |mistake: &Mistake| format!("line {}: {}", mistake.place.line, clipped(&mistake.message));
            ModelError::Mistake(first.map_or_else(String::new, told))
        })?;
        let pointing = chain.find_observable(OBSERVABLE).ok_or(ModelError::NoPointing)?;
        let shown = chain.observable(pointing);
        if shown.kind != ObservableKind::Direction || !shown.is_vector() {
            return Err(ModelError::NoPointing);
        }
        let known: Vec<&str> = instrument.joints().into_iter().chain(["temperature", "second"]).collect();
        for id in chain.symbols_of_way(pointing) {
            let symbol = chain.symbol(id);
            let is_reading = matches!(symbol.kind, SymbolKind::Joint | SymbolKind::Input);
            if is_reading && !known.contains(&symbol.name.as_str()) {
                return Err(ModelError::NoReadings(symbol.name.clone()));
            }
        }
        Ok(Self { chain, pointing })
    }

    /// The errors that the pointing depends on, in order.
    #[must_use]
    pub fn errors(&self) -> Vec<SymbolId> {
        let mut symbols = self.chain.symbols_of_way(self.pointing);
        symbols.retain(|&id| self.chain.symbol(id).kind == SymbolKind::Error);
        symbols
    }

    /// Where the instrument points at poses; `values` by symbol, SI.
    #[must_use]
    pub fn pointing(&self, instrument: &Instrument, poses: &[Pose], values: &[f64]) -> Vec<[f64; 3]> {
        let program = build(&self.chain, &[self.pointing], Form::ExactValue, &[]);
        let columns = self.evaluated(&program, instrument, poses, values);
        (0..poses.len()).map(|row| [0, 1, 2].map(|axis| columns[axis][row])).collect()
    }

    /// How the pointing changes with each of some errors where all are zero: a column each, x, y and z of the first row, then of the
    /// second.
    #[must_use]
    pub fn columns(&self, instrument: &Instrument, poses: &[Pose], errors: &[SymbolId]) -> Vec<Vec<f64>> {
        let program = build(&self.chain, &[self.pointing], Form::FirstOrderJacobian, errors);
        let outputs = self.evaluated(&program, instrument, poses, &self.chain.nominal_values());
        let column = |at: usize| {
            let axes = [0, 1, 2].map(|axis| &outputs[axis * errors.len() + at]);
            (0..poses.len()).flat_map(|row| axes.map(|axis| axis[row])).collect()
        };
        (0..errors.len()).map(column).collect()
    }

    fn evaluated(
        &self,
        program: &Program,
        instrument: &Instrument,
        poses: &[Pose],
        values: &[f64],
    ) -> Vec<Vec<f64>> {
        let readings = columns(poses, instrument, &self.chain);
        let readings: Vec<_> = readings.iter().map(|(id, column)| (*id, column.as_slice())).collect();
        let mut outputs = vec![vec![0.0; poses.len()]; program.outputs().len()];
        let mut slices: Vec<&mut [f64]> = outputs.iter_mut().map(Vec::as_mut_slice).collect();
        Interpreter::new(program)
            .eval_batch(&readings, values, &mut slices)
            .unwrap_or_else(|error| unreachable!("every reading of the way has a column: {error}"));
        outputs
    }
}
