//! What one term more or less does to held-out rows: the regression at the fit, without each fold, with other columns.
//!
//! A declared error that is left out is zero, not where it was estimated: what it explains goes back into the residual. So does an effect.

use faer::Mat;
use model_core::SymbolId;

use crate::search::SearchError;
use crate::search::columns::Columns;
use crate::search::context::{Context, declared};
use crate::search::round::Round;
use crate::search::row_set::dealt;
use crate::search::sweep::Sweep;
use ::effects::candidate::EffectId;

/// A column before whitening, and whitened.
struct Column {
    raw: Vec<f64>,
    white: Vec<f64>,
}

/// The columns of a frozen model and of effects beside it, with the products of their rows fold by fold.
pub(super) struct Trials {
    /// Those of the terms, of the effects beside them, and the residual.
    columns: Vec<Column>,
    /// The estimate of each column of a term.
    values: Vec<f64>,
    /// The columns of each effect among the terms.
    effects: Vec<Vec<usize>>,
    /// The columns of each effect beside them.
    others: Vec<Vec<usize>>,
    /// Of each component its fold, and the row that it belongs to where the row is of the first unit and has weight.
    places: Vec<(usize, Option<u32>)>,
    products: Vec<Mat<f64>>,
}

impl Trials {
    /// At the fit of a round; `None` where rows observe unknown objects, or there is nothing to hold out.
    pub fn of(
        whole: &Context<'_>,
        round: &Round<'_>,
        others: &[EffectId],
    ) -> Result<Option<Self>, SearchError> {
        let (rows, fitted) = (&round.search.rows, &round.fitted);
        let observations = &*rows.observations;
        let hold_out = &whole.request.plan.hold_out;
        let folds = dealt(observations, &fitted.fit.noise, hold_out.folds, hold_out.seed);
        if observations.unknowns.is_some() || folds.count() < 2 {
            return Ok(None);
        }
        let estimated = declared(whole);
        let values = &fitted.fit.values;
        let exact = Columns::at(&fitted.chain, observations, estimated, values, &[])?;
        let column = |raw: &[f64]| Column { raw: raw.to_vec(), white: rows.whiten_but_for_memory(raw) };
        let mut columns: Vec<Column> =
            (0..estimated.len()).map(|at| column(exact.declared.col_as_slice(at))).collect();
        let mut own: Vec<f64> = estimated.iter().map(|id| values[id.index()]).collect();
        let add = |columns: &mut Vec<Column>, effect: EffectId| -> Vec<usize> {
            let start = columns.len();
            columns.extend(rows.effects[effect.0].iter().map(|raw| column(raw)));
            (start..columns.len()).collect()
        };
        let mut effects = Vec::new();
        for (found, errors) in fitted.found.iter().zip(&fitted.errors) {
            let places = add(&mut columns, found.effect);
            own.extend(errors.iter().take(places.len()).map(|id| values[id.index()]));
            effects.push(places);
        }
        let others = others.iter().map(|&effect| add(&mut columns, effect)).collect();
        columns.push(column(&rows.columns.residual));
        let units = observations.poses.unit_of_row();
        let first = observations.poses.units().first().copied();
        let places: Vec<(usize, Option<u32>)> = (exact.row.iter().enumerate())
            .map(|(component, &row)| {
                let is_judged = Some(units[row as usize]) == first && rows.counts(component);
                (folds.of_row(component), is_judged.then_some(row))
            })
            .collect();
        let products = (0..folds.count())
            .map(|fold| {
                let of: Vec<usize> = (0..places.len()).filter(|&at| places[at].0 == fold).collect();
                Mat::from_fn(columns.len(), columns.len(), |i, j| {
                    let (a, b) = (&columns[i].white, &columns[j].white);
                    if i < j { 0.0 } else { of.iter().map(|&at| a[at] * b[at]).sum() }
                })
            })
            .collect();
        Ok(Some(Self { columns, values: own, effects, others, places, products }))
    }

    /// How many rows the figures are over.
    pub fn rows(&self) -> usize {
        let mut rows: Vec<u32> = self.places.iter().filter_map(|(_, row)| *row).collect();
        rows.dedup();
        rows.len()
    }

    /// RMS of held-out rows with all terms.
    pub fn as_it_is(&self) -> Option<f64> {
        self.rms(&[], &[])
    }

    /// The same without a declared error.
    pub fn without_error(&self, whole: &Context<'_>, error: SymbolId) -> Option<f64> {
        let at = declared(whole).iter().position(|own| *own == error)?;
        self.rms(&[at], &[])
    }

    /// The same without one of the effects among the terms.
    pub fn without_effect(&self, effect: usize) -> Option<f64> {
        self.rms(&self.effects[effect], &[])
    }

    /// The same with one of the effects beside them.
    pub fn with(&self, other: usize) -> Option<f64> {
        self.rms(&[], &self.others[other])
    }

    fn rms(&self, without: &[usize], with: &[usize]) -> Option<f64> {
        let last = self.columns.len() - 1;
        let terms = (0..self.values.len()).filter(|at| !without.contains(at));
        let used: Vec<usize> = terms.chain(with.iter().copied()).collect();
        // What is to be explained: the residual, and what is left out.
        let left: Vec<(usize, f64)> =
            without.iter().map(|&at| (at, self.values[at])).chain([(last, 1.0)]).collect();
        let picked: Vec<usize> = used.iter().copied().chain(left.iter().map(|(at, _)| *at)).collect();
        let small = |products: &Mat<f64>| {
            Mat::from_fn(picked.len(), picked.len(), |i, j| {
                products[(picked[i].max(picked[j]), picked[i].min(picked[j]))]
            })
        };
        let parts: Vec<Mat<f64>> = self.products.iter().map(small).collect();
        let mut all = Mat::zeros(picked.len(), picked.len());
        parts.iter().for_each(|part| all += part);
        // Of each fold how much of each column goes into what is left there.
        let shares: Vec<Vec<(usize, f64)>> = parts
            .iter()
            .map(|part| {
                let mut sweep = Sweep::new(&all - part);
                let inside: Vec<usize> = (0..used.len()).filter(|&column| sweep.add(column)).collect();
                let taken = inside.into_iter().map(|column| {
                    let explained = left
                        .iter()
                        .enumerate()
                        .map(|(number, (_, times))| times * sweep.entry(column, used.len() + number));
                    (used[column], -explained.sum::<f64>())
                });
                taken.chain(left.iter().copied()).collect()
            })
            .collect();
        let (mut squares, mut rows, mut before) = (0.0, 0_usize, None);
        for (component, (fold, row)) in self.places.iter().enumerate() {
            let Some(row) = row else { continue };
            let value: f64 =
                shares[*fold].iter().map(|(at, times)| times * self.columns[*at].raw[component]).sum();
            squares += value * value;
            rows += usize::from(before != Some(*row));
            before = Some(*row);
        }
        let rms = (squares / rows.max(1) as f64).sqrt();
        (rows > 0 && rms.is_finite()).then_some(rms)
    }
}
