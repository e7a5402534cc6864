//! The chain as a fit sees it: residual components of observations and their derivatives.

use std::ops::Range;

use codegen::{Form, Interpreter, NodeId, Op, Program, build_all};
use model_core::{Chain, SymbolId, SymbolKind};
use nalgebra::Vector3;

use super::FitError;
use super::beam::Beam;
use super::block::Block;
use super::shrinking::{self, Scales};
use super::spare::Spare;
use observe::kinds::{self, Compared, Predicted, TurnsBy, Unknown};
use observe::orientation::{AXES, axes_of};
use observe::unknowns::State;
use observe::{Observations, Poses, Series};

/// Rows evaluated at a time: what a block holds stays in the second-level cache.
pub const BLOCK_ROWS: usize = 256;

/// Blocks that are made before the first of them is taken.
const AT_ONCE: usize = 512;

/// Evaluates observables and their derivatives by what is estimated.
#[derive(Debug, Clone)]
pub struct Model {
    parameters: Vec<SymbolId>,
    /// Per parameter the column that holds its derivatives; none where it moves nothing. Parameters that move
    /// everything alike share one.
    column_of: Vec<Option<usize>>,
    /// The number of columns.
    columns: usize,
    /// One per series of the observations: exact value, then the columns of the exact Jacobian.
    programs: Vec<Program>,
    /// One per series: which way its observed point moves as the range grows; none where rows are seen along no beam.
    beams: Vec<Option<Beam>>,
    /// One per series: what makes its residuals larger, as a fit's steps have to know; none for anybody else.
    scales: Vec<Scales>,
    /// Symbols of the chain; values behind them are those of objects and stations.
    symbols: usize,
    turns_by: TurnsBy,
    spare: Spare<Running>,
}

/// What runs the programs, and room for a block.
#[derive(Debug)]
struct Running {
    /// Of each series its program and its beam's.
    interpreters: Vec<(Interpreter, Option<Interpreter>)>,
    block: Block,
}

/// Rows to evaluate: poses, and what was measured there if anything was.
#[derive(Clone, Copy)]
struct Rows<'a> {
    poses: &'a Poses,
    observed: Option<&'a Observations>,
}

impl Model {
    /// Builds the programs for the observables of these series.
    ///
    /// # Errors
    /// A parameter that cannot be estimated, or a joint or input without readings.
    pub fn new(chain: &Chain, poses: &Poses, parameters: &[SymbolId]) -> Result<Self, FitError> {
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
                SymbolKind::Ramp => "a ramp",
                SymbolKind::SightAngle => "the angle of a line of sight",
            };
            return Err(FitError::NotEstimable { name: symbol.name.clone(), kind });
        }
        let forms = [Form::ExactValue, Form::ExactJacobian];
        let build = |wrt: &[SymbolId]| -> Vec<Program> {
            poses.series.iter().map(|series| program(chain, series, &forms, wrt)).collect()
        };
        let mut programs = build(parameters);
        for (program, series) in programs.iter().zip(&poses.series) {
            for (symbol, _) in program.inputs() {
                let is_read = matches!(chain.symbol(symbol).kind, SymbolKind::Joint | SymbolKind::Input);
                if is_read && poses.column(symbol).is_none() {
                    return Err(FitError::NoReadings {
                        name: chain.symbol(symbol).name.clone(),
                        observable: chain.observable(series.observable).name.clone(),
                    });
                }
            }
        }
        let (column_of, kept) = distinct(&programs, parameters.len());
        if kept.len() < parameters.len() {
            let wrt: Vec<SymbolId> = kept.iter().map(|&parameter| parameters[parameter]).collect();
            programs = build(&wrt);
        }
        let beams = Beam::of_all(chain, poses);
        Ok(Self {
            scales: Vec::new(),
            parameters: parameters.to_vec(),
            column_of,
            columns: kept.len(),
            programs,
            beams,
            symbols: chain.symbols.len(),
            turns_by: TurnsBy::Object,
            spare: Spare::default(),
        })
    }

    /// The same as a fit's steps need it: residuals beside unknown objects are no smaller where everything is.
    #[must_use]
    pub(super) fn for_steps(self, chain: &Chain, poses: &Poses) -> Self {
        Self { scales: shrinking::of_series(chain, poses, &self.parameters, &self.column_of), ..self }
    }

    /// Takes residuals in metres as they are at these values: the largest share by which they were larger or smaller.
    pub(super) fn take_as_they_are(&mut self, values: &[f64]) -> f64 {
        self.scales.iter_mut().map(|scales| scales.take_as_they_are(values)).fold(0.0, f64::max)
    }

    /// The same with derivatives that tell what rows determine, not where a step leads.
    #[must_use]
    pub fn for_determination(&self) -> Self {
        Self { turns_by: TurnsBy::Prediction, ..self.clone() }
    }

    /// The same with derivatives where rows would hit what they observe: what a search reads.
    #[must_use]
    pub fn adjusted(self) -> Self {
        Self { turns_by: TurnsBy::Adjusted, ..self }
    }

    /// The programs of the observables' values alone.
    #[must_use]
    pub fn without_columns(chain: &Chain, poses: &Poses) -> Self {
        let of = |series| program(chain, series, &[Form::ExactValue], &[]);
        let programs: Vec<Program> = poses.series.iter().map(of).collect();
        let beams = Beam::of_all(chain, poses);
        let symbols = chain.symbols.len();
        Self {
            parameters: Vec::new(),
            column_of: Vec::new(),
            columns: 0,
            programs,
            beams,
            scales: Vec::new(),
            symbols,
            turns_by: TurnsBy::Object,
            spare: Spare::default(),
        }
    }

    /// What is estimated, in the order of the columns.
    #[must_use]
    pub fn parameters(&self) -> &[SymbolId] {
        &self.parameters
    }

    /// Per parameter its column; none where no observation depends on it.
    #[must_use]
    pub fn column_of(&self) -> &[Option<usize>] {
        &self.column_of
    }

    /// The number of columns: that of parameters, those that move nothing apart, those that move everything alike
    /// counted once.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The numbers of objects and stations among values.
    pub fn state<'a>(&self, values: &'a [f64]) -> &'a [f64] {
        values.get(self.symbols..).unwrap_or_default()
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
        f: impl Fn(usize, Range<usize>, &Block) -> T + Sync,
    ) -> Result<Vec<T>, FitError> {
        let mut made = Vec::new();
        self.each_block(observations, values, f, |own| made.push(own))?;
        Ok(made)
    }

    /// The same, where `take` is given what `f` makes, block by block in order, while further blocks are made: what is made of all
    /// rows is never held at once.
    pub fn each_block<T: Send>(
        &self,
        observations: &Observations,
        values: &[f64],
        f: impl Fn(usize, Range<usize>, &Block) -> T + Sync,
        take: impl FnMut(T) + Send,
    ) -> Result<(), FitError> {
        self.each(Rows { poses: &observations.poses, observed: Some(observations) }, values, f, take)
    }

    /// The same where nothing was measured: what would be seen if the chain were right. Residuals are zero.
    ///
    /// # Errors
    /// Values or poses that do not fit the chain the model was built for.
    pub fn map_poses<T: Send>(
        &self,
        poses: &Poses,
        values: &[f64],
        f: impl Fn(usize, Range<usize>, &Block) -> T + Sync,
    ) -> Result<Vec<T>, FitError> {
        if poses.series.iter().any(|series| series.measure != series.measure.bare()) {
            let why = "poses at which nothing was measured show no objects: take them bare".to_owned();
            return Err(FitError::WrongShape { why });
        }
        let mut made = Vec::new();
        self.each(Rows { poses, observed: None }, values, f, |own| made.push(own))?;
        Ok(made)
    }

    fn each<T: Send>(
        &self,
        of: Rows<'_>,
        values: &[f64],
        f: impl Fn(usize, Range<usize>, &Block) -> T + Sync,
        mut take: impl FnMut(T) + Send,
    ) -> Result<(), FitError> {
        let mut tasks = Vec::new();
        for (index, series) in of.poses.series.iter().enumerate() {
            let starts = series.rows.clone().step_by(BLOCK_ROWS);
            tasks.extend(starts.map(|start| (index, start..(start + BLOCK_ROWS).min(series.rows.end))));
        }
        let made = |some: &[(usize, Range<usize>)]| -> Result<Vec<T>, FitError> {
            let made = parallel::each_of(some.iter().cloned(), |(index, rows)| {
                let mut lent = self.spare.lent();
                let Running { interpreters, block } = lent.get_or_make(|| self.running());
                let (Some((interpreter, beam)), Some(series)) =
                    (interpreters.get_mut(index), of.poses.series.get(index))
                else {
                    return Err(FitError::WrongShape { why: "more series than the model has".to_string() });
                };
                let beam = self.beams.get(index).and_then(Option::as_ref).zip(beam.as_mut());
                self.evaluate(interpreter, beam, of, series, rows.clone(), values, block)?;
                let steps = self.turns_by == TurnsBy::Object && !block.unknown.is_empty();
                if let Some(scales) = self.scales.get(index).filter(|_| steps) {
                    block.shrink(scales, values);
                }
                Ok(f(index, rows, block))
            });
            made.into_iter().collect()
        };
        let mut before = Vec::new();
        for some in tasks.chunks(AT_ONCE) {
            let (next, ()) = rayon::join(|| made(some), || before.drain(..).for_each(&mut take));
            before = next?;
        }
        before.into_iter().for_each(take);
        Ok(())
    }

    fn running(&self) -> Running {
        let own = self.programs.iter().zip(&self.beams);
        let own = own.map(|(value, beam)| {
            (Interpreter::new(value), beam.as_ref().map(|beam| Interpreter::new(&beam.program)))
        });
        Running { interpreters: own.collect(), block: Block::default() }
    }

    /// Evaluates consecutive rows of one series into a block.
    #[allow(clippy::too_many_arguments)]
    fn evaluate(
        &self,
        interpreter: &mut Interpreter,
        beam: Option<(&Beam, &mut Interpreter)>,
        of: Rows<'_>,
        series: &Series,
        rows: Range<usize>,
        values: &[f64],
        block: &mut Block,
    ) -> Result<(), FitError> {
        let (kind, count) = (series.measure.kind(), rows.len());
        let m = kind.components.len();
        let mut columns: Vec<(SymbolId, &[f64])> = of
            .poses
            .columns
            .iter()
            .filter_map(|(id, column)| Some((*id, column.get(rows.clone())?)))
            .collect();
        (block.rows, block.components) = (count, m);
        let width = 3 * kind.predicted.vectors();
        block.outputs.resize(width * (1 + self.columns) * count, 0.0);
        block.residual.resize(m * count, 0.0);
        block.gradient.resize(width * m * count, 0.0);
        block.jacobian.resize(self.columns * m * count, 0.0);
        block.defined.clear();
        block.unknown.clear();
        let (values, state) = values.split_at_checked(self.symbols).ok_or_else(|| FitError::WrongShape {
            why: format!("{} values for {} symbols", values.len(), self.symbols),
        })?;
        let unknowns = of.observed.and_then(|observed| observed.unknowns.as_ref());
        let state = unknowns.map(|unknowns| State::new(unknowns, state));
        // Bare poses are seen as they are read: nothing stands at the end of a beam.
        let along = match beam.zip(state.as_ref()) {
            Some(((beam, interpreter), state)) => {
                let far = |row: usize, origin: &Vector3<f64>| state.distance_m(rows.start + row, origin);
                Some(beam.along(interpreter, &columns, values, count, far)?)
            }
            None => None,
        };
        if let Some((range, ranges)) = along.as_ref().and_then(|along| along.ranges.as_ref()) {
            columns.iter_mut().filter(|(id, _)| id == range).for_each(|(_, own)| *own = ranges);
        }
        let mut outputs: Vec<&mut [f64]> = block.outputs.chunks_exact_mut(count.max(1)).collect();
        interpreter
            .eval_batch(&columns, values, &mut outputs)
            .map_err(|error| FitError::WrongShape { why: error.to_string() })?;
        let Block { residual, defined, gradient, unknown, outputs, .. } = block;
        let of_block = kinds::Rows {
            count,
            predicted: outputs,
            measured: of.observed.map(|observed| &observed.measured[rows.clone()]),
            unknown: state.as_ref().map(|state| Unknown {
                state,
                start: rows.start,
                turns_by: self.turns_by,
            }),
            beams: along.as_ref().map(|along| along.axes.as_slice()),
        };
        (kind.compare)(&of_block, &mut Compared { residual, defined, gradient, unknown }).map_err(
            |mismatch| FitError::WrongShape {
                why: format!("row {}: {mismatch}", rows.start + mismatch.row + 1),
            },
        )?;
        block.project();
        Ok(())
    }
}

/// The program of what a series observes.
fn program(chain: &Chain, series: &Series, forms: &[Form], wrt: &[SymbolId]) -> Program {
    match series.measure.kind().predicted {
        Predicted::Axes => build_all(&axes_of(chain, series.observable), &AXES, forms, wrt),
        Predicted::Vector | Predicted::Image => build_all(chain, &[series.observable], forms, wrt),
    }
}

/// Which column each parameter has when equal ones are merged and those that are zero left out, and the first parameter of
/// each column.
fn distinct(programs: &[Program], parameters: usize) -> (Vec<Option<usize>>, Vec<usize>) {
    let mut columns: Vec<(Vec<NodeId>, usize)> = Vec::new();
    let zero = |program: &Program, id: NodeId| matches!(program.nodes().get(id.index()), Some(Op::Constant(literal)) if literal.value() == 0.0);
    let column_of = (0..parameters)
        .map(|parameter| {
            let own = |program: &Program| -> Vec<NodeId> {
                let numbers = program.outputs().len() / (1 + parameters);
                (0..numbers)
                    .map(|place| program.outputs()[numbers + place * parameters + parameter])
                    .collect()
            };
            let nodes: Vec<NodeId> = programs.iter().flat_map(own).collect();
            if programs.iter().all(|program| own(program).iter().all(|&id| zero(program, id))) {
                return None;
            }
            let known = columns.iter().position(|(known, _)| *known == nodes);
            Some(known.unwrap_or_else(|| {
                columns.push((nodes, parameter));
                columns.len() - 1
            }))
        })
        .collect();
    (column_of, columns.into_iter().map(|(_, parameter)| parameter).collect())
}
