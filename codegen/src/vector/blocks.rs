// Blocks of rows: slices of any length in and out, worked through block by block on one path.
//
// Part of the text that goes unchanged into generated files.

/// What is computed of rows, block by block: `IN` columns in, `OUT` columns out.
pub trait Rows<const IN: usize, const OUT: usize>: Copy {
    /// Does the block of rows that begins at `first`. Implementations are `#[inline(always)]`, so that they are compiled
    /// with the path's instructions.
    fn compute<A: Arithmetic>(
        self,
        arithmetic: A,
        columns: &[&[f64]; IN],
        out: &mut [&mut [f64]; OUT],
        first: usize,
    );
}

/// At least [`ROWS`] rows, block by block; all slices have this many.
#[inline]
pub fn run_rows<const IN: usize, const OUT: usize>(
    wanted: Path,
    block: impl Rows<IN, OUT>,
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
    impl<B: Rows<IN, OUT>, const IN: usize, const OUT: usize> Work for All<'_, B, IN, OUT> {
        #[inline(always)]
        fn run<A: Arithmetic>(mut self, arithmetic: A) {
            let mut start = 0;
            while start < self.rows {
                // The last block may do rows again that the one before it did.
                let first = start.min(self.rows - ROWS);
                self.block.compute(arithmetic, &self.columns, &mut self.out, first);
                start += ROWS;
            }
        }
    }
    run(wanted, All { block, rows, columns, out });
}

/// What is computed of one block of rows: `IN` columns in, a block of `OUT` columns out.
pub trait Block<const IN: usize, const OUT: usize>: Copy {
    /// Does it. Implementations are `#[inline(always)]`, as those of [`Rows`].
    fn compute<A: Arithmetic>(
        self,
        arithmetic: A,
        columns: [&[f64; ROWS]; IN],
        out: &mut [[f64; ROWS + 8]; OUT],
    );
}

/// One block of rows.
#[inline]
pub fn run_block<const IN: usize, const OUT: usize>(
    wanted: Path,
    block: impl Block<IN, OUT>,
    columns: [&[f64; ROWS]; IN],
    out: &mut [[f64; ROWS + 8]; OUT],
) {
    struct One<'a, B, const IN: usize, const OUT: usize> {
        block: B,
        columns: [&'a [f64; ROWS]; IN],
        out: &'a mut [[f64; ROWS + 8]; OUT],
    }
    impl<B: Block<IN, OUT>, const IN: usize, const OUT: usize> Work for One<'_, B, IN, OUT> {
        #[inline(always)]
        fn run<A: Arithmetic>(self, arithmetic: A) {
            self.block.compute(arithmetic, self.columns, self.out);
        }
    }
    run(wanted, One { block, columns, out });
}
