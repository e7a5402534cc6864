// Blocks of rows: slices of any length in and out, worked through block by block on one path.
//
// Part of the text that goes unchanged into generated files.

/// What is computed of a block of rows: `IN` columns in, and what comes out.
pub trait Block<const IN: usize, Out>: Copy {
    /// Does it. Implementations are `#[inline(always)]`, so that they are compiled with the path's instructions.
    fn compute<A: Arithmetic>(self, arithmetic: A, columns: [&[f64; ROWS]; IN], out: Out);
}

/// At least [`ROWS`] rows, block by block; all slices have this many.
#[inline]
pub fn run_rows<const IN: usize, const OUT: usize>(
    wanted: Path,
    block: impl for<'a> Block<IN, [&'a mut [f64; ROWS]; OUT]>,
    rows: usize,
    columns: [&[f64]; IN],
    out: [&mut [f64]; OUT],
) {
    struct All<'a, B, const IN: usize, const OUT: usize> {
        block: B,
        rows: usize,
        columns: [&'a [f64]; IN],
        out: [&'a mut [f64]; OUT],
    }
    impl<B, const IN: usize, const OUT: usize> Work for All<'_, B, IN, OUT>
    where
        B: for<'a> Block<IN, [&'a mut [f64; ROWS]; OUT]>,
    {
        #[inline(always)]
        fn run<A: Arithmetic>(mut self, arithmetic: A) {
            let mut start = 0;
            while start < self.rows {
                // The last block may do rows again that the one before it did.
                let first = start.min(self.rows - ROWS);
                let columns = self.columns.map(|column| match column[first..].first_chunk() {
                    Some(block) => block,
                    None => unreachable!("the caller has seen that all slices have as many rows"),
                });
                let out = self.out.each_mut().map(|out| match out[first..].first_chunk_mut() {
                    Some(block) => block,
                    None => unreachable!("the caller has seen that all slices have as many rows"),
                });
                self.block.compute(arithmetic, columns, out);
                start += ROWS;
            }
        }
    }
    run(wanted, All { block, rows, columns, out });
}

/// One block of at most [`ROWS`] rows.
#[inline]
pub fn run_block<const IN: usize, Out>(
    wanted: Path,
    block: impl Block<IN, Out>,
    columns: [&[f64]; IN],
    out: Out,
) {
    struct One<'a, B, Out, const IN: usize> {
        block: B,
        columns: [&'a [f64; ROWS]; IN],
        out: Out,
    }
    impl<B: Block<IN, Out>, Out, const IN: usize> Work for One<'_, B, Out, IN> {
        #[inline(always)]
        fn run<A: Arithmetic>(self, arithmetic: A) {
            self.block.compute(arithmetic, self.columns, self.out);
        }
    }
    let mut spaces = [const { None }; IN];
    let mut columns = columns.into_iter();
    let columns = spaces.each_mut().map(|space| whole(columns.next().unwrap_or_default(), space));
    run(wanted, One { block, columns, out });
}
