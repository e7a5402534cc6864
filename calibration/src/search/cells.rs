//! Many rows merged into few: a cell holds groups of one fold, and gives way to fewer rows with the same inner products.
//!
//! All that the search asks of rows is inner products of columns, over a fold or over what a sign flip turns; so rows
//! come chunk by chunk and are forgotten, and a search costs the same however many they were.

use std::ops::Range;

use codegen::vector::{self, Arithmetic};
use faer::{Mat, MatMut, MatRef};

use super::folds::Folds;
use super::products::{add_products, mirrored};
use super::spanning::Unfolding;

/// What is left of a column, as a share of its sum of squares, below which it counts as explained by those before it.
const NOTHING: f64 = 1e-13;

/// Inner products of the rows seen so far, cell by cell.
#[derive(Debug, Clone)]
pub struct Cells {
    width: usize,
    fold_of_cell: Vec<usize>,
    rows_of_fold: Vec<usize>,
    /// Of each cell a matrix, column by column, of which the lower half counts: in one piece, whose memory is given back as a whole.
    products: Vec<f64>,
}

/// Which cell each group belongs to.
#[derive(Debug, Clone)]
pub struct CellsOfGroups(Vec<u32>);

/// Rows put in an order in which those of one cell follow each other.
#[derive(Debug, Clone)]
pub struct ByCell {
    /// The rows in that order.
    pub order: Vec<usize>,
    /// Cells that have some of them, with their places in that order.
    cells: Vec<(usize, Range<usize>)>,
}

impl CellsOfGroups {
    /// The cell of a group, as the folds number them.
    #[must_use]
    pub fn cell(&self, group: u32) -> usize {
        self.0[group as usize] as usize
    }

    /// The order of some rows, whose groups are given as the folds number them.
    #[must_use]
    pub fn sorted(&self, group_of_row: &[u32]) -> ByCell {
        let cell = |row: usize| self.cell(group_of_row[row]);
        let mut order: Vec<usize> = (0..group_of_row.len()).collect();
        order.sort_by_key(|&row| cell(row));
        let mut cells: Vec<(usize, Range<usize>)> = Vec::new();
        for (at, &row) in order.iter().enumerate() {
            match cells.last_mut() {
                Some((last, places)) if *last == cell(row) => places.end = at + 1,
                _ => cells.push((cell(row), at..at + 1)),
            }
        }
        ByCell { order, cells }
    }
}

impl Cells {
    /// No rows yet, of `width` columns: about `most` cells, at least one for each fold that has rows; and the cell of each
    /// group. Groups of a fold that follow each other share a cell.
    #[must_use]
    pub fn new(folds: &Folds, most: usize, width: usize) -> (Self, CellsOfGroups) {
        let in_fold = (most / folds.count().max(1)).max(1);
        let mut size = vec![0_usize; folds.count()];
        folds.fold_of_group.iter().for_each(|&fold| size[fold as usize] += 1);
        let mut first = Vec::new();
        let mut fold_of_cell = Vec::new();
        for (fold, &groups) in size.iter().enumerate() {
            first.push(fold_of_cell.len());
            fold_of_cell.extend(std::iter::repeat_n(fold, groups.min(in_fold)));
        }
        let mut seen = vec![0_usize; folds.count()];
        let cell_of_group = folds.fold_of_group.iter().map(|&fold| {
            let fold = fold as usize;
            seen[fold] += 1;
            (first[fold] + (seen[fold] - 1) * size[fold].min(in_fold) / size[fold]) as u32
        });
        let cell_of_group = CellsOfGroups(cell_of_group.collect());
        let mut products = vec![0.0; fold_of_cell.len() * width * width];
        // Memory that is written before it is read is cheaper: what is read first has to be moved as soon as it is written, and every
        // processor told of it.
        parallel::each_of(products.chunks_mut(width * width), |own| own.fill(0.0));
        let cells = Self { width, rows_of_fold: folds.rows_of_fold.clone(), products, fold_of_cell };
        (cells, cell_of_group)
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.fold_of_cell.len()
    }

    /// Lets each cell take in rows of its own: `give` gives those of a cell, some after others. Each is of one processor, which
    /// still has in its cache what it made.
    ///
    /// # Errors
    /// Those of `give`.
    pub fn filled<T: Send, E: Send>(
        &mut self,
        give: impl Fn(usize, &mut dyn FnMut(MatRef<'_, f64>)) -> Result<T, E> + Sync,
    ) -> Result<Vec<T>, E> {
        let width = self.width;
        let cells = self.products.chunks_mut(width * width).enumerate();
        let filled = parallel::each_of(cells, |(cell, products)| {
            let mut products = MatMut::from_column_major_slice_mut(products, width, width);
            give(cell, &mut |rows| add_products(products.as_mut(), rows))
        });
        filled.into_iter().collect()
    }

    /// Takes in parts of the rows, each put in the order of its cells.
    pub fn add(&mut self, parts: &[(MatRef<'_, f64>, &ByCell)]) {
        let (width, mut own) = (self.width, vec![Vec::new(); self.fold_of_cell.len()]);
        for (rows, by_cell) in parts {
            for (cell, places) in &by_cell.cells {
                own[*cell].push(rows.subrows(places.start, places.len()));
            }
        }
        let cells = self.products.chunks_mut(width * width).zip(own);
        parallel::each_of(cells.filter(|(_, own)| !own.is_empty()), |(products, own)| {
            let mut products = MatMut::from_column_major_slice_mut(products, width, width);
            own.into_iter().for_each(|rows| add_products(products.as_mut(), rows));
        });
    }

    /// The rows that stand for all, with the columns that unfold from those of the cells, and the folds that they lie in.
    #[must_use]
    pub fn merged(self, unfolding: &Unfolding) -> (Mat<f64>, Folds) {
        let Self { width, fold_of_cell, rows_of_fold, mut products } = self;
        let cells = products.chunks_mut(width * width);
        let roots = parallel::each_of(cells, |products| root(products, width, unfolding.behind()));
        let of_cell = |(cell, rows): (usize, &Vec<usize>)| std::iter::repeat_n(cell as u32, rows.len());
        let group_of_row: Vec<u32> = roots.iter().enumerate().flat_map(of_cell).collect();
        let fold_of_group = fold_of_cell.into_iter().map(|fold| fold as u32).collect();
        let mut rows = Mat::zeros(group_of_row.len(), unfolding.width());
        let (mut parts, mut rest) = (Vec::new(), rows.as_mut());
        for root in &roots {
            let (part, others) = rest.split_at_row_mut(root.len());
            parts.push(part);
            rest = others;
        }
        let cells = parts.into_iter().zip(&roots).zip(products.chunks(width * width));
        parallel::each_of(cells, |((part, root), products)| {
            let behind = unfolding.behind();
            let own = Mat::from_fn(root.len(), behind.len(), |i, j| products[root[i] * width + behind[j]]);
            unfolding.unfold(own.as_ref(), part);
        });
        (rows, Folds { group_of_row, fold_of_group, rows_of_fold, stated: 0 })
    }
}

/// Makes of inner products, of which the lower half is given, rows R with RᵀR those of the columns `kept`, as many as they have
/// rank: Cholesky's, the column of which most is left always next. Which columns of the products became its rows, in order.
fn root(products: &mut [f64], width: usize, kept: &[usize]) -> Vec<usize> {
    mirrored(MatMut::from_column_major_slice_mut(products, width, width));
    let scale: Vec<f64> = (0..width).map(|j| products[j * width + j]).collect();
    let mut left = scale.clone();
    let (mut pivots, mut row) = (Vec::new(), vec![0.0; width]);
    while pivots.len() < kept.len() {
        let share = |j: usize| if scale[j] > 0.0 { left[j] / scale[j] } else { 0.0 };
        let most = |best: (usize, f64), &j: &usize| {
            let own = share(j);
            if own >= best.1 { (j, own) } else { best }
        };
        let (pivot, most) = kept.iter().fold((0, f64::NEG_INFINITY), most);
        if most <= NOTHING {
            break;
        }
        let place = pivot * width..(pivot + 1) * width;
        row.copy_from_slice(&products[place.clone()]);
        let taken = Taken { row: &mut row, products, width, pivots: &pivots, pivot };
        vector::run(vector::path(), taken);
        let length = left[pivot].sqrt();
        for (value, left) in row.iter_mut().zip(&mut left) {
            *value /= length;
            *left -= *value * *value;
        }
        left[pivot] = 0.0;
        products[place].copy_from_slice(&row);
        pivots.push(pivot);
    }
    pivots
}

/// A row that loses its share of the known ones, told by their values at the pivot.
struct Taken<'a> {
    row: &'a mut [f64],
    products: &'a [f64],
    width: usize,
    /// Which columns of the products are known rows.
    pivots: &'a [usize],
    pivot: usize,
}

impl vector::Work for Taken<'_> {
    #[inline(always)]
    fn run<A: Arithmetic>(self, _: A) {
        let Self { row, products, width, pivots, pivot } = self;
        let known = |at: usize| &products[at * width..(at + 1) * width];
        // Four at a time: the row is read and written a quarter as often, with the same bits.
        let (fours, others) = pivots.as_chunks::<4>();
        for four in fours {
            let [a, b, c, d] = four.map(known);
            let factor = [a, b, c, d].map(|known| known[pivot]);
            for ((((own, a), b), c), d) in row.iter_mut().zip(a).zip(b).zip(c).zip(d) {
                *own = (((*own - factor[0] * a) - factor[1] * b) - factor[2] * c) - factor[3] * d;
            }
        }
        for &at in others {
            let known = known(at);
            let factor = known[pivot];
            for (own, known) in row.iter_mut().zip(known) {
                *own -= factor * known;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::products::picked;
    use super::super::spanning::Spanning;
    use super::*;
    use proptest::prelude::*;

    /// Inner products of the rows of one fold.
    fn products(rows: &Mat<f64>, folds: &Folds, fold: usize) -> Mat<f64> {
        let members: Vec<usize> = (0..rows.nrows()).filter(|&row| folds.of_row(row) == fold).collect();
        let part = picked(rows.as_ref(), &members);
        part.transpose() * &part
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// Merging rows, in chunks of any size, changes no inner product of any fold, and the columns that depend on others
        /// stay dependent.
        #[test]
        fn merged_rows_have_the_same_inner_products(
            values in prop::collection::vec(-1.0f64..1.0, 240), chunk in 1usize..60, groups in 2u32..40, most in 1usize..12
        ) {
            let mut rows = Mat::from_fn(60, 5, |i, j| values.get(4 * i + j).copied().unwrap_or(0.0));
            for i in 0..60 {
                rows[(i, 4)] = 2.0 * rows[(i, 0)] - rows[(i, 3)];
            }
            let numbers: Vec<u32> = (0..60).map(|row| row * 7 % groups).collect();
            let folds = Folds::deal(&numbers, 3, 1);
            let (mut cells, of_groups) = Cells::new(&folds, most, 5);
            for start in (0..60).step_by(chunk) {
                let end = (start + chunk).min(60);
                let by_cell = of_groups.sorted(&folds.group_of_row[start..end]);
                let part = picked(rows.subrows(start, end - start), &by_cell.order);
                cells.add(&[(part.as_ref(), &by_cell)]);
            }
            let (merged, of_merged) = cells.merged(&Spanning::all(5).unfolding(&[0, 1, 2, 3, 4]));
            prop_assert!(merged.nrows() <= 4 * of_merged.groups());
            prop_assert_eq!(&of_merged.rows_of_fold, &folds.rows_of_fold);
            for fold in 0..folds.count() {
                let apart = products(&merged, &of_merged, fold) - products(&rows, &folds, fold);
                prop_assert!(apart.norm_max() < 1e-11);
            }
        }
    }
}
