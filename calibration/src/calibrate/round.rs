//! One round: the declaration with the effects accepted so far is fitted, and the search starts from there.

use faer::Mat;
use model_core::{Chain, SymbolId};

use super::{CalibrateError, Found, Loop, all_places, declared};
use crate::columns::Columns;
use crate::fit::{FitOptions, FitResult, fit};
use crate::noise::NoiseOptions;
use crate::search::{Accepted, Class, Problem, ProblemError, Selection, classes, select};

/// A fit, and the whitened problem at it.
pub(crate) struct Round {
    /// The declaration with the accepted effects.
    pub chain: Chain,
    /// The accepted effects in the order they came in.
    pub found: Vec<Found>,
    /// The new errors of each accepted effect.
    pub errors: Vec<Vec<SymbolId>>,
    /// The fit of that chain.
    pub fit: FitResult,
    /// Combinations of the declared errors that these data determine, one a column.
    pub combinations: Mat<f64>,
    /// Columns before whitening, at the fit, of those combinations and of the effects' places.
    pub columns: Columns,
    /// The columns of each effect of the catalogue before whitening; empty where they cannot be had.
    pub effects: Vec<Vec<Vec<f64>>>,
    /// Measured minus predicted without the accepted effects, before whitening.
    pub without: Vec<f64>,
    /// The whitened problem: candidates are the catalogue's effects in order.
    pub problem: Problem,
    /// Effects that these data cannot tell apart.
    pub classes: Vec<Class>,
}

impl Round {
    /// The declaration as it is.
    pub fn first(whole: &Loop<'_>) -> Result<Self, CalibrateError> {
        let plan = whole.request.plan;
        Self::fitted(whole, plan.chain.clone(), Vec::new(), Vec::new(), plan.fit.clone())
    }

    /// The declaration with some effects, fitted from where the last round ended.
    pub fn with(whole: &Loop<'_>, found: Vec<Found>, last: &Self) -> Result<Self, CalibrateError> {
        let plan = whole.request.plan;
        let mut chain = plan.chain.clone();
        let mut options = plan.fit.clone();
        let mut errors = Vec::new();
        let mut kept = Vec::new();
        for found in found {
            // A chain that has no room for more symbols takes no more effects.
            let Some((amended, new)) = whole.catalogue[found.effect].add_to(&chain) else { continue };
            chain = amended;
            options.estimate.extend(&new);
            errors.push(new);
            kept.push(found);
        }
        for &parameter in &plan.fit.estimate {
            options.start[parameter.index()] = last.fit.values[parameter.index()];
        }
        options.start.resize(chain.symbols.len(), 0.0);
        Self::fitted(whole, chain, kept, errors, options)
    }

    fn fitted(
        whole: &Loop<'_>,
        chain: Chain,
        found: Vec<Found>,
        errors: Vec<Vec<SymbolId>>,
        options: FitOptions,
    ) -> Result<Self, CalibrateError> {
        let observations = whole.request.observations;
        // While something is missing, residuals are larger than the noise: weights go by what they are.
        let noise = NoiseOptions { sigma: None, ..options.noise };
        let options = FitOptions { noise, ..options };
        let fit = fit(&chain, observations, &options)?;
        let mut columns =
            Columns::at(&chain, observations, declared(whole), &fit.values, &all_places(whole))?;
        let effects = columns.of_effects(&chain, &whole.catalogue, observations, &fit.values);
        let mut without = columns.residual.clone();
        for (found, new) in found.iter().zip(&errors) {
            for (column, error) in effects[found.effect].iter().zip(new) {
                let value = fit.values[error.index()];
                without.iter_mut().zip(column).for_each(|(r, z)| *r += value * z);
            }
        }
        let whitened = |column: &[f64]| whiten(&fit, &columns.row, column);
        let n = columns.residual.len();
        let combinations = determined(&fit, columns.declared.ncols())?;
        columns.declared = &columns.declared * &combinations;
        let mut declared_white = Mat::zeros(n, columns.declared.ncols());
        for j in 0..columns.declared.ncols() {
            declared_white.col_as_slice_mut(j).copy_from_slice(&whitened(columns.declared.col_as_slice(j)));
        }
        let mut blocks = Vec::new();
        let mut count = 0;
        for effect in &effects {
            blocks.push(count..count + effect.len());
            count += effect.len();
        }
        let mut candidates = Mat::zeros(n, count);
        for (j, column) in effects.iter().flatten().enumerate() {
            candidates.col_as_slice_mut(j).copy_from_slice(&whitened(column));
        }
        let groups = groups(whole, &columns.row);
        let hold_out = &whole.request.plan.hold_out;
        let problem = Problem::new(
            declared_white.as_ref(),
            candidates.as_ref(),
            &blocks,
            &whitened(&without),
            &groups,
            hold_out.folds,
            hold_out.seed,
        )?;
        let classes = classes(&problem);
        Ok(Self { chain, found, errors, fit, combinations, columns, effects, without, problem, classes })
    }

    /// A column of residual components, whitened as the fit whitened its own.
    pub fn whitened(&self, column: &[f64]) -> Vec<f64> {
        whiten(&self.fit, &self.columns.row, column)
    }

    /// The class that an effect belongs to.
    pub fn class_of(&self, effect: usize) -> Option<usize> {
        self.classes.iter().position(|class| class.members.contains(&effect))
    }

    /// The classes of the accepted effects.
    pub fn accepted_classes(&self) -> Vec<usize> {
        self.found.iter().filter_map(|found| self.class_of(found.effect)).collect()
    }

    /// The linear search from the accepted effects.
    pub fn selection(&self, whole: &Loop<'_>) -> Selection {
        let start: Vec<Accepted> = self
            .found
            .iter()
            .filter_map(|found| {
                Some(Accepted { class: self.class_of(found.effect)?, p_value: found.p_value })
            })
            .collect();
        select(&self.problem, &self.classes, &start, |_| true, &whole.options)
    }

    /// What the search ends with: accepted effects keep their name and p, a new class lends its first member's.
    pub fn search(&self, whole: &Loop<'_>) -> Vec<Found> {
        let kept = self.accepted_classes();
        self.selection(whole)
            .accepted
            .into_iter()
            .map(|accepted| match kept.iter().position(|&class| class == accepted.class) {
                Some(at) => self.found[at].clone(),
                None => {
                    let alike = self.classes[accepted.class].members.clone();
                    Found { effect: alike[0], p_value: accepted.p_value, alike }
                }
            })
            .collect()
    }

    /// Whether these are the accepted effects.
    pub fn holds(&self, sorted: &[usize]) -> bool {
        let mut own: Vec<usize> = self.found.iter().map(|found| found.effect).collect();
        own.sort_unstable();
        own == sorted
    }
}

fn groups(whole: &Loop<'_>, row: &[u32]) -> Vec<usize> {
    row.iter().map(|&row| whole.request.observations.groups[row as usize] as usize).collect()
}

fn whiten(fit: &FitResult, row: &[u32], column: &[f64]) -> Vec<f64> {
    let mut column = column.to_vec();
    fit.noise.whiten(&mut column);
    for (value, &row) in column.iter_mut().zip(row) {
        *value *= fit.residuals.weight[row as usize].sqrt();
    }
    column
}

/// An orthonormal basis of the declared errors' space without what the fit found undetermined; the rest would only
/// be seen through products of errors.
fn determined(fit: &FitResult, declared: usize) -> Result<Mat<f64>, ProblemError> {
    let null = fit.null_space.subrows(0, declared);
    let svd = null.svd().map_err(|_| ProblemError::Singular)?;
    let values = svd.S().column_vector();
    let rank = (0..values.nrows()).filter(|&i| values[i] > 1e-8).count();
    Ok(svd.U().subcols(rank, declared - rank).to_owned())
}
