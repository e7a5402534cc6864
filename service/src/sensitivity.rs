//! What errors and constants do to what a source observes: derivatives of its residual components, at poses spread over a region.

use std::f64::consts::TAU;

use fit::Model;
use model_core::budget::spread;
use model_core::{Chain, Meaning, ObservableId, Quantity, SymbolId, SymbolKind};
use nalgebra::DMatrix;
use observe::{Measure, Poses, Series};

use crate::errors_file::FoundOver;
use crate::evaluation::readings_of;
use crate::refusal::Refusal;

/// Poses at which changes are looked at.
///
/// Source: of a sum of sines and cosines up to the fourth of three joints, the rms over so many poses of the Kronecker sequence differs from
/// that over all by less than 2 %.
pub const POSES: usize = 512;

/// Combinations whose singular value is below this part of the largest are not observed.
///
/// Source: the threshold of `fit` (`subspace`), by which a calibration decides what its data determine.
pub const OBSERVED: f64 = 1e-8;

/// What a source observes, wherever it is pointed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Watched {
    /// The observable.
    pub observable: ObservableId,
    /// Its residual components, where nothing stands that is observed.
    pub measure: Measure,
}

impl Watched {
    /// Poses spread evenly over ranges of readings; none where a reading has no range and is no angle of a joint. An angle of a joint without
    /// a range makes a full turn. An input that has two values takes its two ends.
    #[must_use]
    pub fn poses(&self, chain: &Chain, ranges: &[FoundOver], count: usize) -> Option<Poses> {
        let readings = readings_of(chain, self.observable);
        let bounds: Option<Vec<(f64, f64)>> = readings.iter().map(|id| bounds(chain, ranges, *id)).collect();
        Some(self.at(spread_over(chain, &readings, &bounds?, count), count))
    }

    /// Poses with these readings.
    #[must_use]
    pub fn at(&self, columns: Vec<(SymbolId, Vec<f64>)>, count: usize) -> Poses {
        let measure = self.measure.bare();
        let series = Series { observable: self.observable, measure, rows: 0..count, source: String::new() };
        Poses { series: vec![series], columns }
    }
}

/// Readings spread evenly between bounds, a column each.
pub(crate) fn spread_over(
    chain: &Chain,
    readings: &[SymbolId],
    bounds: &[(f64, f64)],
    count: usize,
) -> Vec<(SymbolId, Vec<f64>)> {
    let mut columns: Vec<(SymbolId, Vec<f64>)> =
        readings.iter().map(|id| (*id, Vec::with_capacity(count))).collect();
    for pose in spread(bounds, count) {
        for ((at, (id, column)), value) in columns.iter_mut().enumerate().zip(pose) {
            column.push(taken(chain.symbol(*id).meaning, value, bounds[at]));
        }
    }
    columns
}

/// The range of a reading; an angle of a joint without one makes a full turn.
pub(crate) fn bounds(chain: &Chain, ranges: &[FoundOver], reading: SymbolId) -> Option<(f64, f64)> {
    let symbol = chain.symbol(reading);
    match ranges.iter().find(|own| own.symbol == reading) {
        Some(own) => Some((own.low, own.high)),
        None if symbol.kind == SymbolKind::Joint && symbol.quantity == Quantity::Angle => Some((0.0, TAU)),
        None => None,
    }
}

/// The value that a reading of a meaning has nearest to one between its bounds.
fn taken(meaning: Option<Meaning>, value: f64, (low, high): (f64, f64)) -> f64 {
    match meaning {
        Some(Meaning::Side | Meaning::Direction | Meaning::Session) => {
            if value - low < high - value {
                low
            } else {
                high
            }
        }
        Some(Meaning::Turns) => value.round().clamp(low, high),
        _ => value,
    }
}

/// The values of all symbols with every error zero: where it is decided what is observed at all. Products of two small errors would else make
/// nearly everything look observed.
#[must_use]
pub fn without_errors(chain: &Chain, values: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    chain.symbols_of(SymbolKind::Error).for_each(|error| values[error.index()] = 0.0);
    values
}

/// Derivatives of what would be observed at poses: a row for each component of each pose, pose by pose, and a column for each of some errors
/// and constants, at the values of all symbols.
///
/// # Errors
/// A reading that the observable depends on is not there.
pub fn derivatives(
    chain: &Chain,
    poses: &Poses,
    values: &[f64],
    by: &[SymbolId],
) -> Result<DMatrix<f64>, Refusal> {
    if by.is_empty() {
        return Ok(DMatrix::zeros(poses.components(), 0));
    }
    let model = Model::new(chain, poses, by).map_err(Refusal::of)?;
    let blocks = model.map_poses(poses, values, |_, _, block| {
        block.columns().map(|column| block.by_row(column)).collect::<Vec<_>>()
    });
    Ok(stacked(&model, &blocks.map_err(Refusal::of)?, poses.components()))
}

/// The columns of blocks of rows, one below the other, a column for each parameter of a model.
pub(crate) fn stacked(model: &Model, blocks: &[Vec<Vec<f64>>], components: usize) -> DMatrix<f64> {
    let mut all = DMatrix::zeros(components, model.parameters().len());
    for (parameter, column) in model.column_of().iter().enumerate() {
        let Some(column) = *column else { continue };
        let numbers = blocks.iter().flat_map(|block| &block[column]);
        all.column_mut(parameter).iter_mut().zip(numbers).for_each(|(to, from)| *to = *from);
    }
    all
}
