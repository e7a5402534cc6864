//! Every row: a calibration of some of the rows takes its errors from a fit of all, and is judged on the others.

use model_core::Chain;

use super::Calibration;
use crate::diagnose::{Caution, EveryRow, Foretold, SharedByFiles};
use fit::{StreamedResult, Validation};

/// An effect is borne out if one of its coefficients differs from zero by so many of its standard uncertainties.
const BORNE_OUT: f64 = 3.0;

/// What every row says of an amended declaration.
#[derive(Debug, Clone, Copy)]
pub struct OfEveryRow<'a> {
    /// The amended declaration.
    pub chain: &'a Chain,
    /// Its fit to every row.
    pub fit: &'a StreamedResult,
    /// The same fit to the rows that the calibration read: how far its ± are from the calibration's, the others' are too.
    pub drawn: &'a StreamedResult,
    /// The files that all rows came in.
    pub files: usize,
    /// How the rows that the calibration did not read are foretold.
    pub validation: Option<Validation>,
}

impl Calibration {
    /// Takes the errors that every row says, and what that makes of the calibration.
    pub fn take_every_row(&mut self, every: OfEveryRow<'_>) {
        let validation = every.validation.and_then(foretold);
        let OfEveryRow { fit, drawn, files, .. } = every;
        let has_fit = fit.converged && drawn.converged;
        let shared_by_files =
            fit.shared.as_ref().map(|shared| SharedByFiles { ratio: shared.ratio, p_value: shared.p_value });
        self.diagnosis.every_row = Some(EveryRow {
            rows: fit.rows[0],
            used: fit.rows[1],
            files,
            converged: has_fit,
            shared_by_files,
            validation,
        });
        if has_fit {
            self.take_errors(every);
        } else {
            self.diagnosis.cautions.push(Caution::EveryRowNotFitted);
        }
        if let Some(Foretold { before_kept: before, after_kept: after, .. }) = validation
            && after > before
            && !self.diagnosis.effects.is_empty()
        {
            self.diagnosis.cautions.push(Caution::WorseHeldOut { before, after, unit: self.diagnosis.unit });
        }
    }

    fn take_errors(&mut self, every: OfEveryRow<'_>) {
        let OfEveryRow { chain, fit, .. } = every;
        let used = &self.diagnosis.observations;
        let has_groups = used.groups < used.rows;
        let place = |name: &str| {
            let id = chain.find_symbol(name)?;
            fit.parameters.iter().position(|known| *known == id)
        };
        let estimate = |at: usize| fit.values[fit.parameters[at].index()];
        for (symbol, value) in self.chain.symbols.iter().zip(&mut self.after.values) {
            if let Some(at) = place(&symbol.name) {
                *value = estimate(at);
            }
        }
        for error in &mut self.diagnosis.errors {
            let Some(at) = place(&error.name) else { continue };
            error.value = estimate(at);
            if let Some(searched) = error.standard_uncertainty {
                error.standard_uncertainty = Some(every.uncertainty(&[(at, 1.0)], searched, has_groups));
            }
        }
        let combinations = self.after.estimable.iter().filter(|one| one.combination.len() > 1);
        let told = combinations.filter(|one| one.standard_uncertainty.is_some());
        for (own, told) in self.diagnosis.estimable.iter_mut().zip(told) {
            let parts = told
                .combination
                .iter()
                .map(|(id, factor)| Some((place(&self.chain.symbol(*id).name)?, *factor)));
            let Some(parts) = parts.collect::<Option<Vec<_>>>() else { continue };
            own.value = parts.iter().map(|(at, factor)| factor * estimate(*at)).sum();
            own.standard_uncertainty = every.uncertainty(&parts, own.standard_uncertainty, has_groups);
        }
        let mut not_borne_out = Vec::new();
        for effect in &mut self.diagnosis.effects {
            let mut largest: f64 = 0.0;
            for (name, value) in &mut effect.coefficients {
                let Some(error) = self.diagnosis.errors.iter().find(|error| error.name == *name) else {
                    continue;
                };
                *value = error.value;
                // What is not determined by itself is not what speaks against an effect.
                largest =
                    largest.max(error.standard_uncertainty.map_or(f64::INFINITY, |u| error.value.abs() / u));
            }
            if largest < BORNE_OUT {
                not_borne_out.push(effect.names[0].clone());
            }
        }
        if let Some(shared) = &fit.shared {
            let (files, ratio) = (shared.units, shared.ratio);
            self.diagnosis.cautions.push(Caution::FilesShareErrors { files, ratio });
        }
        if !not_borne_out.is_empty() {
            self.diagnosis.cautions.push(Caution::NotBorneOut { effects: not_borne_out });
        }
    }
}

impl OfEveryRow<'_> {
    /// The standard uncertainty of a combination of parameters from every row. A fit of all counts rows of a file as independent, or files:
    /// what else the calibration knows of its noise makes its ± `searched` of the rows drawn, and those of all by as much larger.
    fn uncertainty(&self, combination: &[(usize, f64)], searched: f64, has_groups: bool) -> f64 {
        let own = self.fit.standard_uncertainty(combination);
        if has_groups {
            // More rows of the same groups tell less than more groups would.
            return own.max(searched);
        }
        let of_drawn = self.drawn.standard_uncertainty(combination);
        if of_drawn > 0.0 { own * (searched / of_drawn).max(1.0) } else { own }
    }
}

/// Means of the sums; none without rows that count.
fn foretold(sums: Validation) -> Option<Foretold> {
    let Validation { rows, kept, squares, squares_kept } = sums;
    if kept == 0 {
        return None;
    }
    let [before, after] = squares.map(|sum| (sum / rows as f64).sqrt());
    let [before_kept, after_kept] = squares_kept.map(|sum| (sum / kept as f64).sqrt());
    Some(Foretold { rows, rows_kept: kept, before, after, before_kept, after_kept })
}
