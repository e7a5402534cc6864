//! The chain as a fit sees it: residual components of observations and their derivatives.

use std::ops::Range;

use codegen::{Form, Interpreter, Program, build_all};
use faer::Mat;
use model_core::{Chain, SymbolId, SymbolKind};
use nalgebra::Vector3;
use rayon::prelude::*;

use super::FitError;
use crate::observations::{Measure, Observations, Series, tangent_frame};

/// Rows evaluated at a time: what a block holds stays in the second-level cache.
pub const BLOCK_ROWS: usize = 512;

/// Evaluates observables and their derivatives by what is estimated.
#[derive(Debug, Clone)]
pub struct Model {
    parameters: Vec<SymbolId>,
    /// One per series of the observations: exact value, then exact Jacobian.
    programs: Vec<Program>,
}

/// Residuals of some rows of one series, before whitening.
#[derive(Debug, Clone)]
pub struct Block {
    /// Measured minus predicted, row by row, component by component, rad or m.
    pub residual: Vec<f64>,
    /// Derivative of the predicted components by each parameter, components × parameters.
    pub jacobian: Mat<f64>,
    /// The gradient of each predicted component by the observable's x, y, z.
    pub projection: Vec<[f64; 3]>,
    /// Per row, whether the chain has a finite value there.
    pub defined: Vec<bool>,
}

impl Model {
    /// Builds the programs for the observables of these series.
    ///
    /// # Errors
    /// A parameter that cannot be estimated, or a joint or input without readings.
    pub fn new(
        chain: &Chain,
        observations: &Observations,
        parameters: &[SymbolId],
    ) -> Result<Self, FitError> {
        if parameters.is_empty() {
            return Err(FitError::NothingToEstimate);
        }
        for &parameter in parameters {
            let symbol = chain.symbol(parameter);
            let kind = match symbol.kind {
                SymbolKind::Error | SymbolKind::Constant => continue,
                SymbolKind::Joint => "a joint",
                SymbolKind::Input => "an input",
                SymbolKind::Pi => "a number",
            };
            return Err(FitError::NotEstimable { name: symbol.name.clone(), kind });
        }
        let program = |series: &Series| {
            let forms = [Form::ExactValue, Form::ExactJacobian];
            let program = build_all(chain, &[series.observable], &forms, parameters);
            for (symbol, _) in program.inputs() {
                let measured = matches!(chain.symbol(symbol).kind, SymbolKind::Joint | SymbolKind::Input);
                if measured && observations.column(symbol).is_none() {
                    return Err(FitError::NoReadings {
                        name: chain.symbol(symbol).name.clone(),
                        observable: chain.observable(series.observable).name.clone(),
                    });
                }
            }
            Ok(program)
        };
        let programs = observations.series.iter().map(program).collect::<Result<_, _>>()?;
        Ok(Self { parameters: parameters.to_vec(), programs })
    }

    /// What is estimated, in the order of the columns.
    #[must_use]
    pub fn parameters(&self) -> &[SymbolId] {
        &self.parameters
    }

    /// Evaluates all rows, block by block on all threads; `f` makes of each block (with the index of its series and
    /// its rows) what is kept, in order.
    ///
    /// # Errors
    /// Values or observations that do not fit the chain the model was built for.
    pub fn map_blocks<T: Send>(
        &self,
        observations: &Observations,
        values: &[f64],
        f: impl Fn(usize, Range<usize>, Block) -> T + Sync,
    ) -> Result<Vec<T>, FitError> {
        let mut tasks = Vec::new();
        for (index, series) in observations.series.iter().enumerate() {
            let starts = series.rows.clone().step_by(BLOCK_ROWS);
            tasks.extend(starts.map(|start| (index, start..(start + BLOCK_ROWS).min(series.rows.end))));
        }
        tasks
            .into_par_iter()
            .map_init(
                || self.programs.iter().map(Interpreter::new).collect::<Vec<_>>(),
                |interpreters, (index, rows)| {
                    let (Some(interpreter), Some(series)) =
                        (interpreters.get_mut(index), observations.series.get(index))
                    else {
                        return Err(FitError::WrongShape {
                            why: "more series than the model has".to_string(),
                        });
                    };
                    let block = self.block(interpreter, observations, series, rows.clone(), values)?;
                    Ok(f(index, rows, block))
                },
            )
            .collect()
    }

    /// Evaluates consecutive rows of one series.
    fn block(
        &self,
        interpreter: &mut Interpreter,
        observations: &Observations,
        series: &Series,
        rows: Range<usize>,
        values: &[f64],
    ) -> Result<Block, FitError> {
        let (count, width) = (rows.len(), self.parameters.len());
        let columns: Vec<(SymbolId, &[f64])> = observations
            .columns
            .iter()
            .filter_map(|(id, column)| Some((*id, column.get(rows.clone())?)))
            .collect();
        let mut buffer = vec![0.0; 3 * (1 + width) * count];
        let mut outputs: Vec<&mut [f64]> = buffer.chunks_exact_mut(count.max(1)).collect();
        interpreter
            .eval_batch(&columns, values, &mut outputs)
            .map_err(|error| FitError::WrongShape { why: error.to_string() })?;
        let output = |which: usize, row: usize| outputs[which][row];
        let measures = series.measure.components();
        let mut block = Block {
            residual: Vec::with_capacity(count * measures),
            jacobian: Mat::zeros(count * measures, width),
            projection: Vec::with_capacity(count * measures),
            defined: Vec::with_capacity(count),
        };
        for row in 0..count {
            let predicted = Vector3::from_fn(|axis, _| output(axis, row));
            let measured = observations.measured.get(rows.start + row).copied().unwrap_or_default();
            let components = components(series.measure, &Vector3::from(measured), &predicted);
            let defined = components.iter().take(measures).all(|(residual, _)| residual.is_finite());
            block.defined.push(defined);
            for (residual, gradient) in components.into_iter().take(measures) {
                block.residual.push(if defined { residual } else { 0.0 });
                block.projection.push(gradient.into());
            }
        }
        for parameter in 0..width {
            let derivative = [0, 1, 2].map(|axis| &*outputs[3 + axis * width + parameter]);
            let mut column = block.jacobian.col_mut(parameter);
            for (at, gradient) in block.projection.iter().enumerate() {
                let row = at / measures;
                let change = gradient[0] * derivative[0][row]
                    + gradient[1] * derivative[1][row]
                    + gradient[2] * derivative[2][row];
                column[at] = if change.is_finite() { change } else { 0.0 };
            }
        }
        Ok(block)
    }
}

/// Residual components of one observation, and the gradient of each predicted component by x, y, z; only the first
/// [`Measure::components`] count.
fn components(
    measure: Measure,
    measured: &Vector3<f64>,
    predicted: &Vector3<f64>,
) -> [(f64, Vector3<f64>); 3] {
    match measure {
        Measure::Direction => {
            // On the tangent plane of what was measured; rotations keep the length, which is divided out.
            let length = predicted.norm();
            let [across, along] = tangent_frame(measured);
            let component = |axis: Vector3<f64>| (-axis.dot(predicted) / length, axis / length);
            let [mut across, mut along] = [across, along].map(component);
            if measured.dot(predicted) < 0.0 {
                // More than 90° away the tangent plane would show it near again: continue growing instead.
                let sine = across.0.hypot(along.0);
                let stretch = if sine > 0.0 { 2.0 / sine - 1.0 } else { 1.0 };
                across.0 *= stretch;
                along.0 = if sine > 0.0 { along.0 * stretch } else { 2.0 };
            }
            [across, along, (0.0, Vector3::zeros())]
        }
        Measure::Point => {
            let difference = measured - predicted;
            [(difference.x, Vector3::x()), (difference.y, Vector3::y()), (difference.z, Vector3::z())]
        }
        Measure::Range => {
            let length = predicted.norm();
            let none = (0.0, Vector3::zeros());
            [(measured.x - length, predicted / length), none, none]
        }
        Measure::Azimuth => {
            let azimuth = predicted.x.atan2(predicted.y);
            let turns = ((measured.x - azimuth) / std::f64::consts::TAU).round();
            let square = predicted.x * predicted.x + predicted.y * predicted.y;
            let gradient = Vector3::new(predicted.y / square, -predicted.x / square, 0.0);
            let none = (0.0, Vector3::zeros());
            [(measured.x - azimuth - turns * std::f64::consts::TAU, gradient), none, none]
        }
    }
}
