//! The interpreter of programs: the reference for every generated language, and what fits run on.
//!
//! One pose at a time it walks the nodes. Over structure of arrays it runs the evaluated stage in blocks of
//! rows (`tape`), after the prepared stage has run once.

mod tape;

use model_core::SymbolId;

use crate::program::{NodeId, Op, Program, Stage};
use crate::vector::{arc_tangent, root, saturate, sin_cos, step};
use tape::Tape;

/// Runs one program, on its own working memory: no call allocates.
#[derive(Debug, Clone)]
pub struct Interpreter {
    nodes: Vec<Op>,
    prepared: usize,
    outputs: Vec<NodeId>,
    inputs: Vec<(SymbolId, Stage)>,
    values: Vec<f64>,
    tape: Tape,
}

/// Why a program cannot run on what it was given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum ShapeError {
    /// A symbol has no value.
    #[error("symbol {symbol} of the program has no value: {values} values were given")]
    NoValue {
        /// Index of the symbol.
        symbol: usize,
        /// How many values there are.
        values: usize,
    },
    /// The wrong number of outputs.
    #[error("the program has {expected} outputs, room was given for {found}")]
    Outputs {
        /// Of the program.
        expected: usize,
        /// Given.
        found: usize,
    },
    /// Columns or outputs of different lengths.
    #[error("columns and outputs must be equally long: one has {found} rows, another {expected}")]
    Rows {
        /// Rows of the first output.
        expected: usize,
        /// Rows of the one that differs.
        found: usize,
    },
    /// A column for a symbol that is prepared once for all rows.
    #[error("symbol {symbol} is an error or a constant: it has one value for all rows, not a column")]
    PreparedColumn {
        /// Index of the symbol.
        symbol: usize,
    },
}

impl Interpreter {
    /// Working memory for a program.
    #[must_use]
    pub fn new(program: &Program) -> Self {
        Self {
            nodes: program.nodes.clone(),
            prepared: program.prepared,
            outputs: program.outputs.clone(),
            inputs: program.inputs(),
            values: vec![0.0; program.nodes.len()],
            tape: Tape::new(program),
        }
    }

    /// One pose. `values` holds every symbol's value in SI, by [`SymbolId`]; `out` is laid out as
    /// [`Program::layout`] says. Not-a-number and infinities pass through.
    ///
    /// # Errors
    /// Too few values, or not as many outputs as the program has.
    pub fn eval(&mut self, values: &[f64], out: &mut [f64]) -> Result<(), ShapeError> {
        self.require_values(values, |_| true)?;
        self.require_outputs(out.len())?;
        self.run(0..self.nodes.len(), values);
        for (slot, output) in out.iter_mut().zip(&self.outputs) {
            *slot = self.values[output.index()];
        }
        Ok(())
    }

    /// Many poses, structure of arrays: a column for each symbol that differs from row to row, and one slice for
    /// each output. Symbols without a column take their value from `constants`, by [`SymbolId`]. Each row's
    /// result depends on that row alone.
    ///
    /// # Errors
    /// Too few constants, columns or outputs of different lengths, not as many outputs as the program has, or a
    /// column for an error or a constant.
    pub fn eval_batch(
        &mut self,
        columns: &[(SymbolId, &[f64])],
        constants: &[f64],
        out: &mut [&mut [f64]],
    ) -> Result<(), ShapeError> {
        self.require_values(constants, |symbol| !columns.iter().any(|&(id, _)| id == symbol))?;
        self.require_outputs(out.len())?;
        let Some(rows) = out.first().map(|first| first.len()) else { return Ok(()) };
        let lengths =
            columns.iter().map(|(_, column)| column.len()).chain(out.iter().map(|slice| slice.len()));
        for found in lengths {
            if found != rows {
                return Err(ShapeError::Rows { expected: rows, found });
            }
        }
        for &(symbol, _) in columns {
            if self.inputs.contains(&(symbol, Stage::Prepared)) {
                return Err(ShapeError::PreparedColumn { symbol: symbol.index() });
            }
        }
        self.run(0..self.prepared, constants);
        self.tape.run(&self.values, columns, constants, rows, out);
        Ok(())
    }

    fn run(&mut self, nodes: std::ops::Range<usize>, symbols: &[f64]) {
        for index in nodes {
            let at = |id: NodeId| self.values[id.index()];
            self.values[index] = match self.nodes[index] {
                Op::Constant(literal) => literal.value(),
                Op::Input(symbol) => symbols[symbol.index()],
                Op::Neg(a) => -at(a),
                Op::Add(a, b) => at(a) + at(b),
                Op::Sub(a, b) => at(a) - at(b),
                Op::Mul(a, b) => at(a) * at(b),
                Op::Div(a, b) => at(a) / at(b),
                Op::Sin(a) => sin_cos(at(a)).0,
                Op::Cos(a) => sin_cos(at(a)).1,
                Op::Saturate(a) => saturate(at(a)),
                Op::Step(a) => step(at(a)),
                Op::Root(a) => root(at(a)),
                Op::ArcTangent(a, b) => arc_tangent(at(a), at(b)),
            };
        }
    }

    fn require_values(&self, values: &[f64], wanted: impl Fn(SymbolId) -> bool) -> Result<(), ShapeError> {
        let missing = self
            .inputs
            .iter()
            .map(|&(symbol, _)| symbol)
            .find(|&symbol| wanted(symbol) && symbol.index() >= values.len());
        match missing {
            Some(symbol) => Err(ShapeError::NoValue { symbol: symbol.index(), values: values.len() }),
            None => Ok(()),
        }
    }

    fn require_outputs(&self, found: usize) -> Result<(), ShapeError> {
        let expected = self.outputs.len();
        if found == expected { Ok(()) } else { Err(ShapeError::Outputs { expected, found }) }
    }
}
