//! All rows on their way into cells: of each the columns are made, whitened, and forgotten again.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use faer::Mat;

use super::cells::{ByCell, Cells};
use super::chunk::{Chunk, Unfilled, whitening_scales};
use super::columns::Seen;
use super::context::Context;
use super::fitted::Fitted;
use super::folds::Folds;
use super::row_set::{RowSet, components};
use super::spanning::Spanning;
use super::stretches::{Chunks, stretches};
use super::{SearchError, Stage};
use observe::golden;

/// Rows of one cell whose columns are made at a time: what a processor just made is still near it when their products are taken.
const PORTION: usize = 128;

/// Chunks of rows that are made at once.
const AT_ONCE: usize = 4;

/// Components that tell which columns follow from others, for each column.
const SAMPLE: usize = 3;

/// All rows, merged in cells.
pub(super) struct Filled {
    pub cells: Cells,
    /// Which columns the cells have, and how the others follow from them.
    pub spanning: Spanning,
    /// What the rows show.
    pub seen: Option<Seen>,
}

impl Filled {
    /// Of all rows, each of so many columns, in about so many cells.
    pub fn of(
        whole: &Context<'_>,
        fitted: &Fitted,
        folds: &Folds,
        most: usize,
        width: usize,
    ) -> Result<Self, SearchError> {
        let spanned = |spanning| Self::spanned(whole, fitted, folds, most, spanning);
        let filled = match spanned(spanning(whole, fitted, width)?) {
            Err(Unfilled::NotSpanned) => spanned(Spanning::all(width)),
            filled => filled,
        };
        filled.map_err(|why| match why {
            Unfilled::Search(error) => error,
            Unfilled::NotSpanned => unreachable!("all columns span all"),
        })
    }

    fn spanned(
        whole: &Context<'_>,
        fitted: &Fitted,
        folds: &Folds,
        most: usize,
        spanning: Spanning,
    ) -> Result<Self, Unfilled> {
        let (mut cells, of_groups) = Cells::new(folds, most, spanning.count());
        let cell = |row: usize| of_groups.cell(folds.group(fitted.layout.first(row)));
        let seen = if whitening_scales(whole, fitted) {
            filled_by_cell(whole, fitted, &spanning, &mut cells, cell)?
        } else {
            let sorted = |components: &[usize]| of_groups.sorted(&folds.groups_of(components));
            filled_in_order(whole, fitted, &spanning, &mut cells, sorted, cell)?
        };
        Ok(Self { cells, spanning, seen })
    }
}

/// The columns that span all, by a sample of the rows.
fn spanning(whole: &Context<'_>, fitted: &Fitted, width: usize) -> Result<Spanning, SearchError> {
    let observations = whole.request.observations;
    let rows = observations.rows();
    let count = (SAMPLE * width * rows).div_ceil(fitted.layout.components().max(1)).min(rows);
    // A share of the rows.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let chosen = |at: usize| (golden::share(at) * rows as f64) as u32;
    let mut chosen: Vec<u32> = (0..count).map(chosen).collect();
    chosen.sort_unstable();
    chosen.dedup();
    let sample = RowSet::of(whole, fitted, &stretches(observations, &chosen), |_| true)?;
    Ok(Spanning::of(&sample.all_columns()))
}

/// Fills cells with rows that whitening only scales, each cell by one processor; returns what they show.
fn filled_by_cell(
    whole: &Context<'_>,
    fitted: &Fitted,
    spanning: &Spanning,
    cells: &mut Cells,
    cell: impl Fn(usize) -> usize + Sync,
) -> Result<Option<Seen>, Unfilled> {
    let observations = whole.request.observations;
    let mut of_cell = vec![Vec::new(); cells.count()];
    (0..observations.rows()).for_each(|row| of_cell[cell(row)].push(row as u32));
    let (done, of) = (AtomicUsize::new(0), observations.rows());
    (whole.tell)(Stage::Columns { rows: 0, of });
    let parts = cells.filled(|cell, add| {
        let (mut seen, mut room) = (None, Mat::new());
        for rows in of_cell[cell].chunks(PORTION) {
            let chunk = Chunk::scaled(whole, fitted, &stretches(observations, rows), spanning, room)?;
            add(chunk.columns.subcols(0, spanning.count()));
            merge(&mut seen, chunk.seen);
            room = chunk.columns;
            let rows = rows.len() + done.fetch_add(rows.len(), Ordering::Relaxed);
            (whole.tell)(Stage::Columns { rows, of });
        }
        Ok::<_, Unfilled>(seen)
    })?;
    let mut seen = None;
    parts.into_iter().flatten().for_each(|part| merge(&mut seen, part));
    Ok(seen)
}

/// Fills cells with rows of which whitening mixes some, in the order that `sorted` puts the components of a chunk in; returns what
/// they show.
fn filled_in_order(
    whole: &Context<'_>,
    fitted: &Fitted,
    spanning: &Spanning,
    cells: &mut Cells,
    sorted: impl Fn(&[usize]) -> ByCell + Sync,
    cell: impl Fn(usize) -> usize + Sync,
) -> Result<Option<Seen>, Unfilled> {
    let observations = whole.request.observations;
    // Matrices of chunks that were taken in: a new one each time would cost as much as filling it.
    let room: Mutex<Vec<Mat<f64>>> = Mutex::default();
    let rooms = || room.lock().unwrap_or_else(PoisonError::into_inner);
    let made = |stretches: &[Range<usize>]| {
        let by_cell = sorted(&components(fitted, stretches));
        let room = rooms().pop().unwrap_or_else(Mat::new);
        let chunk = Chunk::in_order(whole, fitted, stretches, spanning, &by_cell.order, room)?;
        Ok::<_, Unfilled>((chunk, by_cell))
    };
    // Of objects a chunk is of few cells: products of few rows each would cost several times as much.
    let chunks = match fitted.fit.noise.mixes_rows() {
        true => Chunks::in_order(observations),
        false => Chunks::by(observations, cell),
    };
    let (mut rows, mut seen) = (0, None);
    each_chunk(&chunks, made, |some: Vec<(Chunk, ByCell)>| {
        (whole.tell)(Stage::Columns { rows, of: observations.rows() });
        let parts = some.iter().map(|(chunk, by_cell)| (chunk.columns.as_ref(), by_cell));
        cells.add(&parts.collect::<Vec<_>>());
        for (chunk, _) in some {
            rows += chunk.rows;
            merge(&mut seen, chunk.seen);
            rooms().push(chunk.columns);
        }
    })?;
    Ok(seen)
}

/// Adds what more rows show.
fn merge(seen: &mut Option<Seen>, more: Seen) {
    match seen {
        None => *seen = Some(more),
        Some(seen) => seen.merge(&more),
    }
}

/// Lets `take` have what `make` makes of all rows, some chunks at a time. Those are far from each other, so that they are of different
/// cells, and always the same: the number of processors changes no bit.
pub(super) fn each_chunk<T: Send, E: Send>(
    chunks: &Chunks<'_>,
    make: impl Fn(&[Range<usize>]) -> Result<T, E> + Sync,
    mut take: impl FnMut(Vec<T>),
) -> Result<(), E> {
    let apart = chunks.count().div_ceil(AT_ONCE);
    for first in 0..apart {
        let some: Vec<usize> = (first..chunks.count()).step_by(apart).collect();
        let made = parallel::each_of(some, |chunk| make(&chunks.stretches(chunk)));
        take(made.into_iter().collect::<Result<_, _>>()?);
    }
    Ok(())
}
