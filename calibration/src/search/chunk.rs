//! A chunk of many rows on its way into cells: whitened, and forgotten again.

use std::ops::Range;

use faer::Mat;

use super::columns::Seen;
use super::context::Context;
use super::error::SearchError;
use super::fitted::Fitted;
use super::row_set::{RowSet, components, sized};
use super::spanning::Spanning;

/// Whitened columns of a chunk, and what its rows show of effects.
pub(crate) struct Chunk {
    /// Declared combinations, the columns of each effect of the catalogue, and the residual without the accepted effects: those that
    /// span come first.
    pub columns: Mat<f64>,
    /// How many rows of the data it has.
    pub rows: usize,
    pub seen: Seen,
}

/// Whether whitening makes of each component a multiple of itself, whatever the other rows.
pub(crate) fn whitening_scales(whole: &Context<'_>, fitted: &Fitted) -> bool {
    let has_objects = whole.request.observations.unknowns.is_some();
    !fitted.fit.noise.mixes_rows() && !has_objects && fitted.adjusted.is_none()
}

/// Why there is no chunk.
pub(crate) enum Unfilled {
    /// Its rows cannot be evaluated.
    Search(SearchError),
    /// A column follows from others in a sample of the rows, but not in these.
    NotSpanned,
}

impl<E: Into<SearchError>> From<E> for Unfilled {
    fn from(error: E) -> Self {
        Self::Search(error.into())
    }
}

impl Chunk {
    /// Of some stretches of rows, the components in another order, those columns that span alone; `room` is the matrix of an earlier
    /// chunk, for its memory.
    pub fn in_order(
        whole: &Context<'_>,
        fitted: &Fitted,
        stretches: &[Range<usize>],
        spanning: &Spanning,
        order: &[usize],
        room: Mat<f64>,
    ) -> Result<Self, Unfilled> {
        let rows = RowSet::of(whole, fitted, stretches, |_| true)?;
        let (all, width) = (rows.all_columns(), spanning.count());
        if !spanning.holds(|column| all[column]) {
            return Err(Unfilled::NotSpanned);
        }
        let mut columns = sized(room, rows.without.len(), width);
        for (at, column) in all.iter().enumerate().filter(|(at, _)| spanning.place(*at) < width) {
            let white = rows.whiten(column);
            let target = columns.col_as_slice_mut(spanning.place(at));
            target.iter_mut().zip(order).for_each(|(to, &from)| *to = white[from]);
        }
        Ok(Self { columns, rows: rows.observations.rows(), seen: rows.seen })
    }

    /// Of some stretches of rows that [whitening only scales](whitening_scales): columns are made whitened, where they are to lie.
    pub fn scaled(
        whole: &Context<'_>,
        fitted: &Fitted,
        stretches: &[Range<usize>],
        spanning: &Spanning,
        room: Mat<f64>,
    ) -> Result<Self, Unfilled> {
        let weight = &fitted.fit.residuals.weight;
        let whitening = |at: usize| weight[fitted.layout.row(at)].sqrt() / fitted.fit.noise.sigma[at];
        let factor: Vec<f64> = components(fitted, stretches).into_iter().map(whitening).collect();
        let own = whole.request.observations;
        let own = own.select(&stretches.iter().flat_map(Clone::clone).collect::<Vec<_>>());
        let mut white = fitted.probed.columns(&own)?;
        let of_probes = white.seen_of_probes();
        white.scale(&factor);
        let declared = &white.declared * &fitted.combinations;
        let (count, start) = (white.residual.len(), declared.ncols());
        let functions: usize = whole.catalogue.iter().map(|effect| effect.functions.len()).sum();
        let width = start + functions + 1;
        let mut columns = sized(room, count, width);
        for (j, column) in declared.col_iter().enumerate() {
            columns.col_mut(spanning.place(j)).copy_from(column);
        }
        let (mut next, mut of_effect) = (start, vec![start..start; whole.catalogue.len()]);
        let values = &fitted.fit.values;
        let seen = white.each_column(
            &fitted.chain,
            &whole.catalogue,
            &own.poses,
            values,
            |_| true,
            |effect, fill| {
                fill(columns.col_as_slice_mut(spanning.place(next)));
                if of_effect[effect.0].is_empty() {
                    of_effect[effect.0] = next..next;
                }
                next += 1;
                of_effect[effect.0].end = next;
            },
        );
        let mut without = white.residual;
        fitted.put_back(&mut without, |effect| {
            of_effect[effect.0].clone().map(|column| columns.col_as_slice(spanning.place(column)))
        });
        columns.col_as_slice_mut(spanning.place(width - 1)).copy_from_slice(&without);
        if !spanning.holds(|column| columns.col_as_slice(spanning.place(column))) {
            return Err(Unfilled::NotSpanned);
        }
        Ok(Self { columns, rows: own.rows(), seen: seen.with_probes(of_probes) })
    }
}
