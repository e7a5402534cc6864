//! Set-ups that nobody labelled: where along the order the instrument was moved, each stretch with tilts of its own.

mod draw;
mod sums;

use faer::Mat;

use crate::algebra::{cholesky, dot, solve_lower};
use crate::bench::Bench;
use crate::families::{Law, Where, add_setups};
use crate::function::Function;

pub(crate) use sums::Cuts;
use sums::{Sums, price};

impl Bench<'_> {
    /// Cuts of the order into stretches, and how much they gain; none where one stretch explains the rows as well.
    pub(crate) fn cuts(&self, noise: usize, point: usize) -> Option<Cuts> {
        let rows = self.problem.rows.count;
        if !self.problem.rows.in_order
            || (rows as f64) < self.policy.rows_for_order
            || self.problem.rows.labels.is_some()
        {
            return None;
        }
        let pair = self.places.frames.iter().find_map(|frame| frame.tilts)?;
        let sums = self.sums(noise, point, pair)?;
        let mut first = sums.first(&sums.residual, sums.energy / sums.freedom, self.policy)?;
        if !first.1.is_empty() {
            // Once more with the declared errors fitted beside the stretches, which takes from them what is not theirs.
            let (residual, variance) = sums.refitted(&first.1, first.0)?;
            first = sums.first(&residual, variance, self.policy)?;
        }
        let cuts = sums.improved(first.1, self.policy);
        (!cuts.is_empty()).then_some(cuts)
    }

    /// Adds the families of found set-ups: one a place, and one for both tilts of a frame.
    pub(crate) fn add_cuts(&mut self, cuts: &Cuts) -> Vec<usize> {
        let few = self.problem.rows.joints.len() as f64 <= self.policy.few_joints;
        let rows = self.problem.rows.count;
        let places = self
            .places
            .distinct
            .iter()
            .enumerate()
            .filter(|(_, place)| !place.is_range && if few { place.turns } else { place.at_base });
        let mut all: Vec<(Where, Vec<usize>)> =
            places.map(|(number, _)| (Where::Place(number), vec![number])).collect();
        let frames = self.places.frames.iter().filter(|frame| few || frame.frame == 0);
        all.extend(frames.filter_map(|frame| Some((Where::Tilts(frame.frame), frame.tilts?.to_vec()))));
        let functions = stretches(cuts, rows);
        let price = (all.len() as f64).ln() + price(rows, functions.len(), self.policy);
        let law = Law::Setups(functions.len());
        let added = all
            .iter()
            .map(|(place, members)| add_setups(&mut self.dictionary, *place, members, &functions, law, price))
            .collect();
        self.take_in();
        added
    }

    fn sums(&self, noise: usize, point: usize, pair: [usize; 2]) -> Option<Sums> {
        let (point, noise) = (&self.points[point], &self.noises[noise]);
        let (rows, m) = (self.problem.rows.count, self.problem.components);
        let weighed = |column: &[f64]| -> Vec<f64> {
            column.iter().zip(&noise.weights).map(|(value, weight)| value * weight).collect()
        };
        let declared: Vec<Vec<f64>> = point.declared.iter().map(|column| weighed(column)).collect();
        let k = declared.len();
        let products = Mat::from_fn(k, k, |a, b| dot(&declared[a], &declared[b]));
        let factor = cholesky(&products)?;
        // Orthonormal columns: L⁻¹ J′, row by row.
        let mut orthonormal = Mat::from_fn(k, rows * m, |a, at| declared[a][at]);
        solve_lower(factor.as_ref(), orthonormal.as_mut());
        let mut residual = weighed(&point.residual);
        let along: Vec<f64> =
            (0..k).map(|a| (0..rows * m).map(|at| orthonormal[(a, at)] * residual[at]).sum()).collect();
        for (at, value) in residual.iter_mut().enumerate() {
            *value -= (0..k).map(|a| along[a] * orthonormal[(a, at)]).sum::<f64>();
        }
        let mut tilts = pair.map(|place| weighed(&point.places[place]));
        let size = (tilts.iter().map(|tilt| dot(tilt, tilt)).sum::<f64>() / (2 * rows * m) as f64).sqrt();
        tilts.iter_mut().flatten().for_each(|value| *value /= size);
        let mut sums = Sums {
            rows,
            tilts: vec![[0.0; 3]],
            residual: vec![[0.0; 2]],
            declared: vec![vec![0.0; 2 * k]],
            energy: dot(&residual, &residual),
            freedom: self.scaling.freedom,
        };
        for row in 0..rows {
            let (mut own, mut with, mut beside) =
                (sums.tilts[row], sums.residual[row], sums.declared[row].clone());
            for at in row * m..(row + 1) * m {
                let (x, y) = (tilts[0][at], tilts[1][at]);
                own = [own[0] + x * x, own[1] + x * y, own[2] + y * y];
                with = [with[0] + x * residual[at], with[1] + y * residual[at]];
                for a in 0..k {
                    beside[2 * a] += x * orthonormal[(a, at)];
                    beside[2 * a + 1] += y * orthonormal[(a, at)];
                }
            }
            sums.tilts.push(own);
            sums.residual.push(with);
            sums.declared.push(beside);
        }
        Some(sums)
    }
}

/// The indicator of each stretch.
pub(crate) fn stretches(cuts: &Cuts, rows: usize) -> Vec<Function> {
    let from = std::iter::once(0).chain(cuts.iter().copied());
    let to = cuts.iter().copied().chain(std::iter::once(rows));
    from.zip(to).map(|(from, to)| Function::Stretch(from, to)).collect()
}
