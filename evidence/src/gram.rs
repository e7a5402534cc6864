//! The Gram matrix of [y J Z] after whitening: all that a contest reads of the rows.

use faer::{Accum, Mat, Par};

use crate::algebra::{add_products, column, column_mut, mirror};
use crate::design::Table;
use crate::noise::{Memory, Noise};
use crate::point::Point;

/// Rows of a block: enough for the products to run at full speed, few enough to stay in the processor's cache.
const BLOCK: usize = 128;

/// A Gram matrix with the logarithm of the determinant of the whitening.
#[derive(Debug, Clone)]
pub(crate) struct Gram {
    /// Inner products of [y J Z], whole.
    pub products: Mat<f64>,
    /// Σ log weights − ½ m log|C|.
    pub log_det: f64,
}

impl Gram {
    /// The products of all columns of a table at a point.
    pub fn of(table: &Table, point: &Point, rows: usize, noise: &Noise, memory: Option<Memory>) -> Self {
        let width = table.width(point);
        Self::extended(None, table, point, rows, noise, memory, width)
    }

    /// The products once a table has more columns than a Gram matrix that is known.
    pub fn grown(
        &self,
        table: &Table,
        point: &Point,
        rows: usize,
        noise: &Noise,
        memory: Option<Memory>,
    ) -> Self {
        let width = table.width(point);
        Self::extended(Some(&self.products), table, point, rows, noise, memory, width)
    }

    fn extended(
        known: Option<&Mat<f64>>,
        table: &Table,
        point: &Point,
        rows: usize,
        noise: &Noise,
        memory: Option<Memory>,
        width: usize,
    ) -> Self {
        let components = point.residual.len() / rows;
        let old = known.map_or(0, Mat::ncols);
        let filter = memory.map(|memory| memory.filter(rows));
        let mut states = vec![0.0; if filter.is_some() { width * components } else { 0 }];
        // The lower triangle, its rows above those that are new already known.
        let mut products = Mat::zeros(width, width);
        for (at, known) in known.into_iter().flat_map(|known| (0..old).map(move |at| (at, column(known, at))))
        {
            column_mut(&mut products, at)[..old].copy_from_slice(known);
        }
        let mut block = Mat::zeros(BLOCK.min(rows) * components, width);
        for from in (0..rows).step_by(BLOCK) {
            let to = (from + BLOCK).min(rows);
            let height = (to - from) * components;
            let weights = &noise.weights[from * components..to * components];
            for number in 0..width {
                let values = &mut column_mut(&mut block, number)[..height];
                table.any(point, number, from..to, values);
                for (value, weight) in values.iter_mut().zip(weights) {
                    *value *= weight;
                }
                if let Some(filter) = &filter {
                    let state = &mut states[number * components..(number + 1) * components];
                    filter.apply(from, values, state);
                }
            }
            let whole = block.as_ref().subrows(0, height);
            if old == 0 {
                add_products(products.as_mut(), whole);
            } else {
                let new = whole.subcols(old, width - old).transpose();
                let into = products.as_mut().subrows_mut(old, width - old);
                faer::linalg::matmul::matmul(into, Accum::Add, new, whole, 1.0, Par::Seq);
            }
        }
        mirror(&mut products);
        Self { products, log_det: noise.log_det(memory, rows, components) }
    }
}
