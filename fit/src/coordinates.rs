//! Where the components of the residual stand among the combinations that the data determine.

use std::ops::Range;

use faer::Mat;

use super::FitError;
use super::block::Block;
use super::objects::{self as places, Eliminated, FollowedShare, Reduction};
use super::solver::{Course, Solver};
use super::sweep::collected;
use observe::unknowns::Unknowns;

/// Where the components stand among the determined combinations.
pub(super) struct Coordinates {
    /// Orthonormal columns, n × k.
    pub q: Mat<f64>,
    pub residual: Vec<f64>,
    /// What is stated of objects and stations has part in: its columns' products with each other, k × k; none where nothing is.
    pub of_stated: Option<Mat<f64>>,
}

impl Solver<'_> {
    /// The columns of J, whitened and each row by the root of its weight, times the root; and the residual alike.
    pub(super) fn coordinates(
        &self,
        course: &Course,
        weight: &[f64],
        root: &Mat<f64>,
    ) -> Result<Coordinates, FitError> {
        let k = root.ncols();
        let by_column = self.by_column(root);
        let sigma = course.noise.sigma_without_memory();
        let layout = &self.layout;
        let mut whole = Mat::zeros(self.layout.components(), k);
        let mut residual = Vec::with_capacity(self.layout.components());
        let mut unknown = Vec::new();
        // Of many rows the columns are most of what is held: they are never there twice.
        let made = |_: usize, rows: Range<usize>, block: &Block| {
            let whitened = |values: &[f64]| -> Vec<f64> {
                let from = layout.first(rows.start);
                let by_row = block.by_row(values).into_iter().enumerate();
                let scaled = by_row.map(|(at, value)| {
                    value * weight[rows.start + at / block.components].sqrt() / sigma[from + at]
                });
                scaled.collect()
            };
            let residual = whitened(&block.residual);
            let mut q = Mat::<f64>::zeros(residual.len(), k);
            for (column, values) in block.columns().enumerate() {
                let values = whitened(values);
                for j in 0..k {
                    let share = by_column[(column, j)];
                    q.col_as_slice_mut(j).iter_mut().zip(&values).for_each(|(q, value)| *q += share * value);
                }
            }
            (q, residual, block.unknown.clone())
        };
        self.model.each_block(self.observations, &course.point.values, made, |(q, own, of_objects)| {
            whole.subrows_mut(residual.len(), own.len()).copy_from(&q);
            residual.extend(own);
            unknown.extend(of_objects);
        })?;
        let mut of_stated = None;
        if let Some(unknowns) = &self.observations.unknowns {
            let mut row: Vec<u32> = self.layout.row_of_each().map(|row| row as u32).collect();
            let scale = row.iter().zip(sigma.iter()).map(|(&row, sigma)| weight[row as usize].sqrt() / sigma);
            let mut scale: Vec<f64> = scale.collect();
            let stated = places::Stated::of(unknowns);
            if let Some(stated) = &stated {
                row.extend((unknowns.object.len() as u32..).take(stated.scale.len()));
                unknown.extend(&stated.unknown);
                scale.extend(&stated.scale);
                whole.resize_with(row.len(), k, |_, _| 0.0);
            }
            let unknowns = stated.as_ref().map_or(unknowns, |stated| &stated.unknowns);
            Reduction::new(unknowns, &row, &unknown, scale).project(unknowns, &row, &unknown, &mut whole);
            if stated.is_some() {
                let (count, own) = (residual.len(), row.len() - residual.len());
                let rows = whole.subrows(count, own);
                of_stated = Some(rows.transpose() * rows);
                whole.truncate(count, k);
            }
        }
        Ok(Coordinates { q: whole, residual, of_stated })
    }

    /// Of each component what is followed of a residual of its own, where rows observe objects; the root is that of the
    /// [coordinates](Self::coordinates).
    pub(super) fn followed(
        &self,
        course: &Course,
        weight: &[f64],
        root: &Mat<f64>,
        (unknowns, eliminated): (&Unknowns, &Eliminated),
    ) -> Result<Vec<FollowedShare>, FitError> {
        let sigma = course.noise.sigma_without_memory();
        let layout = &self.layout;
        let made = |_: usize, rows: Range<usize>, block: &Block| {
            let first = layout.first(rows.start);
            let scale = (0..block.components).flat_map(|component| {
                let of_row = rows.clone().zip((first + component..).step_by(block.components));
                let sigma = &sigma;
                of_row.map(move |(row, at)| weight[row].sqrt() / sigma[at])
            });
            collected(block, &scale.collect::<Vec<_>>(), rows.start)
        };
        let mut parts = Vec::new();
        self.model.each_block(self.observations, &course.point.values, made, |part| parts.push(part))?;
        let first = |row: usize| layout.first(row);
        Ok(eliminated.followed(unknowns, &parts, &self.by_column(root), first, layout.components()))
    }

    /// A matrix with a row for each parameter, as one with a row for each column of the model.
    fn by_column(&self, root: &Mat<f64>) -> Mat<f64> {
        let mut by_column = Mat::<f64>::zeros(self.model.columns(), root.ncols());
        for (from, column) in root.row_iter().zip(self.model.column_of()) {
            if let Some(column) = *column {
                by_column.row_mut(column).iter_mut().zip(from.iter()).for_each(|(sum, part)| *sum += part);
            }
        }
        by_column
    }
}
