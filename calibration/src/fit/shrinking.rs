//! Scales of ranges beside unknown objects: a residual in metres is as many times as large as the room that a scale makes of the readings.
//!
//! A fit that makes residuals small would make the room small: with N components, and a scale that is known to σ, by N·σ². So residuals
//! are divided by the scale: they are as large as the readings' noise makes them where ranges are what was read.
//!
//! Source: W. A. Fuller, Measurement Error Models (1987), section 1.3: the variance of a residual hangs on what is estimated.

use model_core::{Chain, Quantity, SymbolId, SymbolKind, exact};
use nalgebra::Vector3;

use super::beam::range_of;
use super::block::Block;
use crate::data::{Measure, Poses, Series};

/// Poses at which a symbol has to move the point as a scale does.
const POSES: usize = 5;

/// By how much symbols are moved to see what they do, relative to one; and what is left of it where they are such a scale.
const STEP: f64 = 1e-4;
const ROUNDING: f64 = 1e-6;

/// An error that multiplies the range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    symbol: SymbolId,
    /// Its column, where it is estimated.
    column: Option<usize>,
    /// How much larger ranges are where it is one.
    factor: f64,
}

/// The scales of each series; none where its residuals are no places of unknown objects.
pub(super) fn of_series(
    chain: &Chain,
    poses: &Poses,
    parameters: &[SymbolId],
    column_of: &[Option<usize>],
) -> Vec<Vec<Scale>> {
    let of = |series: &Series| {
        let range = match series.measure {
            Measure::Target | Measure::Plane => range_of(chain, series.observable),
            _ => None,
        };
        let Some(range) = range else { return Vec::new() };
        let is_number = |id: &SymbolId| chain.symbol(*id).quantity == Quantity::Number;
        let numbers: Vec<SymbolId> = chain.symbols_of(SymbolKind::Error).filter(is_number).collect();
        if numbers.is_empty() || series.rows.is_empty() {
            return Vec::new();
        }
        let path = exact::Path::new(chain, series.observable);
        let scales = numbers.into_iter().filter_map(|symbol| {
            let at = parameters.iter().position(|own| *own == symbol);
            let column = at.and_then(|at| column_of.get(at).copied().flatten());
            let factor = factor(&path, chain, poses, series, range, symbol)?;
            Some(Scale { symbol, column, factor })
        });
        scales.collect()
    };
    poses.series.iter().map(of).collect()
}

/// How much larger ranges are where a symbol is one; `None` where it does anything else.
fn factor(
    path: &exact::Path,
    chain: &Chain,
    poses: &Poses,
    series: &Series,
    range: SymbolId,
    symbol: SymbolId,
) -> Option<f64> {
    let mut known: Option<f64> = None;
    for at in 0..POSES {
        let row = series.rows.start + at * (series.rows.len() - 1) / (POSES - 1);
        let mut values = chain.nominal_values();
        poses.columns.iter().for_each(|(id, readings)| values[id.index()] = readings[row]);
        let reading = values[range.index()];
        let mut moved = |id: SymbolId, by: f64| -> Vector3<f64> {
            let own = values[id.index()];
            values[id.index()] = own + by;
            let there = path.value(&values);
            values[id.index()] = own;
            there
        };
        let by_symbol = (moved(symbol, STEP) - moved(symbol, -STEP)) / (2.0 * STEP);
        let by_range = (moved(range, STEP) - moved(range, -STEP)) / (2.0 * STEP) * reading;
        let factor = by_symbol.dot(&by_range) / by_range.norm_squared();
        let is_scale = (by_symbol - by_range * factor).norm() <= ROUNDING * by_range.norm()
            && factor.abs() > ROUNDING
            && known.is_none_or(|known| (factor - known).abs() <= ROUNDING * known.abs());
        if !is_scale {
            return None;
        }
        known = Some(factor);
    }
    known
}

impl Block {
    /// Divides what is of places by how much larger these scales make them; where a `step` is to be made, it knows of that. Derivatives where
    /// rows would have no residual know of none.
    pub(super) fn shrink(&mut self, scales: &[Scale], values: &[f64], step: bool) {
        let larger: f64 = scales.iter().map(|own| own.factor * values[own.symbol.index()]).sum();
        let share = 1.0 / (1.0 + larger);
        if scales.is_empty() || !(share > 0.0 && share.is_finite()) {
            return;
        }
        self.residual.iter_mut().for_each(|value| *value *= share);
        self.jacobian.iter_mut().for_each(|value| *value *= share);
        self.unknown.iter_mut().flatten().for_each(|value| *value *= share);
        if !step {
            return;
        }
        let count = self.residual.len().max(1);
        for (column, own) in self.jacobian.chunks_exact_mut(count).enumerate() {
            let factor: f64 =
                scales.iter().filter(|scale| scale.column == Some(column)).map(|scale| scale.factor).sum();
            if factor != 0.0 {
                own.iter_mut().zip(&self.residual).for_each(|(own, left)| *own += factor * share * left);
            }
        }
    }
}
