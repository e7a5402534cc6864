//! Residuals and Jacobian of all observations at one point, in memory, and what weights make of them.

use faer::Mat;
use rayon::prelude::*;

use super::model::Model;
use super::partial::Partial;
use super::{FitError, robust};
use crate::noise::{Layout, Noise};
use crate::observations::Observations;

/// Rows of a matrix that are factored at a time.
const CHUNK: usize = 1024;

/// All residual components at one point, before whitening.
#[derive(Debug, Clone)]
pub struct Raw {
    /// Measured minus predicted, length n.
    pub residual: Vec<f64>,
    /// Derivatives of the prediction, n × p.
    pub jacobian: Mat<f64>,
    /// Gradient of each component by x, y, z, length n.
    pub projection: Vec<[f64; 3]>,
    /// Per row, whether the chain has a finite value there.
    pub defined: Vec<bool>,
}

/// The same, whitened.
#[derive(Debug, Clone)]
pub struct White {
    /// Length n.
    pub residual: Vec<f64>,
    /// n × p.
    pub jacobian: Mat<f64>,
}

impl Raw {
    /// Evaluates every observation.
    pub fn at(model: &Model, observations: &Observations, values: &[f64]) -> Result<Self, FitError> {
        let blocks = model.map_blocks(observations, values, |_, _, block| block)?;
        let n = blocks.iter().map(|block| block.residual.len()).sum();
        let mut raw = Self {
            residual: Vec::with_capacity(n),
            jacobian: Mat::zeros(n, model.parameters().len()),
            projection: Vec::with_capacity(n),
            defined: Vec::new(),
        };
        for block in blocks {
            let start = raw.residual.len();
            raw.jacobian.subrows_mut(start, block.residual.len()).copy_from(&block.jacobian);
            raw.residual.extend(block.residual);
            raw.projection.extend(block.projection);
            raw.defined.extend(block.defined);
        }
        Ok(raw)
    }

    /// Whitens residual and Jacobian.
    pub fn whiten(&self, noise: &Noise) -> White {
        White { residual: self.residual.clone(), jacobian: self.jacobian.clone() }
            .each_column(|column| noise.whiten(column))
    }
}

impl White {
    /// Every column changed in the same way.
    fn each_column(mut self, change: impl Fn(&mut [f64]) + Sync) -> Self {
        change(&mut self.residual);
        let columns: Vec<_> = self.jacobian.as_mut().col_iter_mut().collect();
        columns.into_par_iter().for_each(|column| {
            if let Some(column) = column.try_as_col_major_mut() {
                change(column.as_slice_mut());
            }
        });
        self
    }

    /// The columns whose products with each other are those of these with the correlation matrix in between.
    pub fn coloured(&self, noise: &Noise) -> Self {
        self.clone().each_column(|column| noise.colour(column))
    }

    /// The factor of [√w J | √w r], rows weighted by their row's weight.
    pub fn partial(&self, layout: &Layout, weight: &[f64]) -> Partial {
        let (n, p) = (self.residual.len(), self.jacobian.ncols());
        let root: Vec<f64> = weight.iter().map(|weight| weight.sqrt()).collect();
        let starts: Vec<usize> = (0..n).step_by(CHUNK).collect();
        let parts: Vec<Partial> = starts
            .into_par_iter()
            .map(|start| {
                let rows = Mat::from_fn(CHUNK.min(n - start), p + 1, |row, column| {
                    let at = start + row;
                    let value = if column < p { self.jacobian[(at, column)] } else { self.residual[at] };
                    value * root[layout.row[at] as usize]
                });
                Partial::new(p).with_rows(rows.as_ref())
            })
            .collect();
        parts.iter().fold(Partial::new(p), |whole, part| whole.merge(part))
    }

    /// The weight of each row; rows without a value have none.
    pub fn weights(&self, layout: &Layout, raw: &Raw, weight: impl Fn(f64, usize) -> f64) -> Vec<f64> {
        layout
            .norms(&self.residual)
            .zip(layout.first.windows(2))
            .zip(&raw.defined)
            .map(|((norm, ends), &defined)| if defined { weight(norm, ends[1] - ends[0]) } else { 0.0 })
            .collect()
    }

    /// The sum that the biweight minimises, or the plain sum of squares.
    pub fn objective(&self, layout: &Layout, raw: &Raw, biweight: bool) -> f64 {
        let loss =
            |norm: f64, components| if biweight { robust::loss(norm, components) } else { norm * norm };
        self.weights(layout, raw, loss).iter().sum()
    }
}
