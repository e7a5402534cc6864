//! A chunk of many rows on its way into cells: whitened, in the order of the cells, and forgotten again.

use std::ops::Range;

use faer::Mat;

use super::cells::ByCell;
use super::columns::Seen;
use super::context::Context;
use super::error::SearchError;
use super::fitted::Fitted;
use super::row_set::{RowSet, components, sized};

/// Whitened columns of a chunk, and what its rows show of effects.
pub(crate) struct Chunk {
    /// Declared combinations, the columns of each effect of the catalogue, and the residual without the accepted effects.
    pub columns: Mat<f64>,
    /// Which of its components belong to which cell.
    pub by_cell: ByCell,
    /// How many rows of the data it has.
    pub rows: usize,
    pub seen: Seen,
}

impl Chunk {
    /// Of some stretches of rows; `room` is the matrix of an earlier chunk, for its memory.
    pub fn of(
        whole: &Context<'_>,
        fitted: &Fitted,
        stretches: &[Range<usize>],
        by_cell: ByCell,
        room: Mat<f64>,
    ) -> Result<Self, SearchError> {
        let observations = whole.request.observations;
        let noise = &fitted.fit.noise;
        if noise.mixes_rows() || observations.unknowns.is_some() || fitted.adjusted.is_some() {
            // Whitening makes more of a component than a multiple of itself.
            let rows = RowSet::of(whole, fitted, stretches, |_| true)?;
            return Ok(Self {
                columns: rows.whitened_in(&by_cell.order, room),
                by_cell,
                rows: rows.observations.rows(),
                seen: rows.seen,
            });
        }
        let components = components(fitted, stretches).into_iter();
        let weight = &fitted.fit.residuals.weight;
        let factor: Vec<f64> =
            components.map(|at| weight[fitted.layout.row(at)].sqrt() / noise.sigma[at]).collect();
        let own = observations.select(&stretches.iter().flat_map(Clone::clone).collect::<Vec<_>>());
        let bare = fitted.probed.columns(&own)?;
        let white = bare.scaled_in(&by_cell.order, &factor);
        let declared = &white.declared * &fitted.combinations;
        let (count, start) = (white.residual.len(), declared.ncols());
        let functions: usize = whole.catalogue.iter().map(|effect| effect.functions.len()).sum();
        let width = start + functions + 1;
        let mut columns = sized(room, count, width);
        columns.subcols_mut(0, start).copy_from(&declared);
        let (mut next, mut of_effect) = (start, vec![start..start; whole.catalogue.len()]);
        let values = &fitted.fit.values;
        let seen = white.each_column(
            &fitted.chain,
            &whole.catalogue,
            &own.poses,
            values,
            |_| true,
            |effect, fill| {
                fill(columns.col_as_slice_mut(next));
                if of_effect[effect.0].is_empty() {
                    of_effect[effect.0] = next..next;
                }
                next += 1;
                of_effect[effect.0].end = next;
            },
        );
        let mut without = white.residual;
        fitted.put_back(&mut without, |effect| {
            of_effect[effect.0].clone().map(|column| columns.col_as_slice(column))
        });
        columns.col_as_slice_mut(width - 1).copy_from_slice(&without);
        Ok(Self { columns, by_cell, rows: own.rows(), seen: seen.with_probes(&bare) })
    }
}
