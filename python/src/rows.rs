//! A program over many rows: on one thread or several, each with an interpreter of its own.

use codegen::{Interpreter, Program, ShapeError};
use model_core::SymbolId;
use rayon::prelude::*;

/// Rows below which a second thread costs more than it saves.
const FEW: usize = 1 << 14;

/// Evaluates a program over columns. `out` holds all rows of the first output, then of the next, and so on. `threads` none:
/// as many as there are processors. Each row's result depends on that row alone, so the number of threads changes no bit.
pub fn evaluate(
    program: &Program,
    columns: &[(SymbolId, &[f64])],
    constants: &[f64],
    out: &mut [f64],
    rows: usize,
    threads: Option<usize>,
) -> Result<(), ShapeError> {
    let mut outputs: Vec<&mut [f64]> =
        if rows == 0 { Vec::new() } else { out.chunks_exact_mut(rows).collect() };
    if rows == 0 {
        return Ok(());
    }
    let threads = threads.unwrap_or_else(rayon::current_num_threads).min(rows.div_ceil(FEW)).max(1);
    if threads == 1 {
        return Interpreter::new(program).eval_batch(columns, constants, &mut outputs);
    }
    let share = rows.div_ceil(threads);
    let mut parts: Vec<(usize, Vec<&mut [f64]>)> =
        (0..threads).map(|part| (part * share, Vec::with_capacity(outputs.len()))).collect();
    for output in outputs {
        for ((_, part), piece) in parts.iter_mut().zip(output.chunks_mut(share)) {
            part.push(piece);
        }
    }
    parts.into_par_iter().filter(|(_, out)| !out.is_empty()).try_for_each(|(start, mut out)| {
        let end = rows.min(start + share);
        let columns: Vec<(SymbolId, &[f64])> =
            columns.iter().map(|&(symbol, column)| (symbol, &column[start..end])).collect();
        Interpreter::new(program).eval_batch(&columns, constants, &mut out)
    })
}
