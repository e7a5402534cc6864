//! Many rows: how they are shared out among threads, and a program over them, each thread with an interpreter of its own.

use std::mem;
use std::ops::Range;

use codegen::{Interpreter, Program, ShapeError};
use model_core::SymbolId;
use rayon::prelude::*;

/// Rows below which a second thread costs more than it saves.
const FEW: usize = 1 << 14;

/// Rows that vector code works on together. What a thread does begins with such a block.
const BLOCK: usize = 64;

/// Shares out rows among `threads`, or where there is no such number among as many as there are processors. Every share is a block
/// of vector code or more, and begins where a block of all rows would: the number of threads changes no bit.
pub fn shares(rows: usize, threads: Option<usize>) -> Vec<Range<usize>> {
    let threads = threads.unwrap_or_else(rayon::current_num_threads).min(rows.div_ceil(FEW)).max(1);
    let start = |share| if share == threads { rows } else { rows / BLOCK * share / threads * BLOCK };
    (0..threads).map(|share| start(share)..start(share + 1)).collect()
}

/// Evaluates a program over columns. `out` holds all rows of the first output, then of the next, and so on. `threads` as of
/// [`shares`]. Between rows for all threads `go_on` may end it.
pub fn evaluate<E: From<ShapeError> + Send>(
    program: &Program,
    columns: &[(SymbolId, &[f64])],
    constants: &[f64],
    out: &mut [f64],
    (rows, threads): (usize, Option<usize>),
    mut go_on: impl FnMut() -> Result<(), E>,
) -> Result<(), E> {
    if rows == 0 {
        return Ok(());
    }
    let mut outputs: Vec<&mut [f64]> = out.chunks_exact_mut(rows).collect();
    let at_a_time = FEW * threads.unwrap_or_else(rayon::current_num_threads).max(1);
    for start in (0..rows).step_by(at_a_time) {
        if start > 0 {
            go_on()?;
        }
        let count = at_a_time.min(rows - start);
        let mut parts: Vec<(Range<usize>, Vec<&mut [f64]>)> =
            shares(count, threads).into_iter().map(|share| (share, Vec::new())).collect();
        for output in &mut outputs {
            for (share, part) in &mut parts {
                let (piece, rest) = mem::take(output).split_at_mut(share.len());
                part.push(piece);
                *output = rest;
            }
        }
        let one = |(share, mut out): (Range<usize>, Vec<&mut [f64]>)| {
            let own = start + share.start..start + share.end;
            let columns: Vec<(SymbolId, &[f64])> =
                columns.iter().map(|&(symbol, column)| (symbol, &column[own.clone()])).collect();
            Interpreter::new(program).eval_batch(&columns, constants, &mut out)
        };
        match parts.len() {
            // On the caller's own thread.
            1 => parts.into_iter().try_for_each(one),
            _ => parts.into_par_iter().try_for_each(one),
        }?;
    }
    Ok(())
}
