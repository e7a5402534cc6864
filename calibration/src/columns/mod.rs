//! The columns of a search: what a unit of each declared error, and of each effect, would do to every residual
//! component.
//!
//! One probe error for each place in the chain that an effect uses; its derivative comes from the exact form at the
//! fitted errors, once, and is multiplied by the effect's functions of the readings.

mod functions;

use faer::Mat;
use model_core::algebra::Poly;
use model_core::{Chain, Motion, SymbolId, SymbolKind};

use crate::effects::{Effect, Function, Place, add_error, insert};
use crate::fit::{FitError, Model};
use crate::observations::Observations;
use functions::Functions;

/// Values of a function more than this many times its RMS make the column hang on a single observation.
const TOO_STEEP: f64 = 1e3;

/// Functions of joints alone that stay this small are not what an instrument shows: gravity seen across a base that is
/// all but level.
const TOO_FLAT: f64 = 1e-2;

/// A place that moves the observations this many times less than the place that moves them most is seen only
/// through products of errors.
const UNSEEN: f64 = 1e-3;

/// Everything before whitening, row by row, component by component.
#[derive(Debug, Clone)]
pub struct Columns {
    /// Measured minus predicted, rad or m.
    pub residual: Vec<f64>,
    /// Derivative by each declared parameter.
    pub declared: Mat<f64>,
    /// Row of the observations that each component belongs to.
    pub row: Vec<u32>,
    places: Vec<Place>,
    probes: Mat<f64>,
}

impl Columns {
    /// Evaluates at `values` (of the chain's symbols).
    ///
    /// # Errors
    /// Missing readings, or values that do not fit the chain.
    pub fn at(
        chain: &Chain,
        observations: &Observations,
        parameters: &[SymbolId],
        values: &[f64],
        places: &[Place],
    ) -> Result<Self, FitError> {
        let mut probed = chain.clone();
        let mut wrt = parameters.to_vec();
        for (number, &place) in places.iter().enumerate() {
            let name = format!("probe {number}");
            let Some(id) = add_error(&mut probed, name, place.freedom.quantity()) else { break };
            insert(&mut probed, place, Poly::symbol(id), String::new());
            wrt.push(id);
        }
        let mut all = values.to_vec();
        all.resize(probed.symbols.len(), 0.0);
        let model = Model::new(&probed, observations, &wrt)?;
        let blocks = model.map_blocks(observations, &all, |_, rows, block| {
            let by_row = |values| block.by_row(values).collect::<Vec<_>>();
            (rows, by_row(&block.residual), block.columns().map(by_row).collect::<Vec<_>>())
        })?;
        let n: usize = blocks.iter().map(|(_, residual, _)| residual.len()).sum();
        let mut columns = Self {
            residual: Vec::with_capacity(n),
            declared: Mat::zeros(n, parameters.len()),
            row: Vec::with_capacity(n),
            places: places.to_vec(),
            probes: Mat::zeros(n, wrt.len() - parameters.len()),
        };
        let mut start = 0;
        for (rows, residual, derivatives) in blocks {
            let count = residual.len();
            let components = count / rows.len().max(1);
            columns.residual.extend(residual);
            for row in rows {
                columns.row.extend(std::iter::repeat_n(row as u32, components));
            }
            for (j, column) in model.column_of().iter().enumerate() {
                let Some(column) = *column else { continue };
                let target = match j.checked_sub(parameters.len()) {
                    None => &mut columns.declared.col_as_slice_mut(j)[start..start + count],
                    Some(probe) => &mut columns.probes.col_as_slice_mut(probe)[start..start + count],
                };
                target.copy_from_slice(&derivatives[column]);
            }
            start += count;
        }
        Ok(columns)
    }

    /// The derivative by a unit at a place; `None` where these observations hardly see it.
    #[must_use]
    pub fn probe(&self, place: Place) -> Option<&[f64]> {
        let at = self.places.iter().position(|known| *known == place)?;
        let alike = self.places.iter().zip(self.probes.col_iter());
        let alike = alike.filter(|(other, _)| other.freedom.motion == place.freedom.motion);
        let most = alike.map(|(_, probe)| probe.norm_l2()).fold(0.0, f64::max);
        (self.probes.col(at).norm_l2() > UNSEEN * most).then(|| self.probes.col_as_slice(at))
    }

    /// The columns of each effect, one for each of its functions; empty where a reading is missing, or a function
    /// is not finite, or it hangs on a single row.
    #[must_use]
    pub fn of_effects(
        &self,
        chain: &Chain,
        effects: &[Effect],
        observations: &Observations,
        values: &[f64],
    ) -> Vec<Vec<Vec<f64>>> {
        let mut readings = Functions::new(observations, values);
        let strength: Vec<f64> = (0..self.probes.ncols()).map(|j| self.probes.col(j).norm_l2()).collect();
        let strongest = |motion| {
            let own = self.places.iter().zip(&strength).filter(|(place, _)| place.freedom.motion == motion);
            own.map(|(_, &s)| s).fold(0.0, f64::max)
        };
        let (turn, shift) = (strongest(Motion::Rotation), strongest(Motion::Translation));
        let seen = |place: Place| {
            let number = self.places.iter().position(|known| *known == place)?;
            let most = if place.freedom.motion == Motion::Rotation { turn } else { shift };
            Some((number, strength[number] >= UNSEEN * most))
        };
        effects
            .iter()
            .map(|effect| {
                let places: Option<Vec<(Place, usize, bool)>> = effect
                    .places()
                    .into_iter()
                    .map(|place| seen(place).map(|(number, strong)| (place, number, strong)))
                    .collect();
                let Some(places) = places.filter(|places| places.iter().any(|&(.., strong)| strong)) else {
                    return Vec::new();
                };
                let column = |function: &Function| {
                    let mut sum = vec![0.0; self.row.len()];
                    for &(place, number, _) in &places {
                        let probe = self.probes.col_as_slice(number);
                        for amount in function.at(effect.place, place) {
                            let by_row = steady(&mut readings, chain, amount)?;
                            let moved = probe.iter().zip(&self.row);
                            sum.iter_mut()
                                .zip(moved)
                                .for_each(|(s, (p, &row))| *s += p * by_row[row as usize]);
                        }
                    }
                    Some(sum)
                };
                effect.functions.iter().map(column).collect::<Option<_>>().unwrap_or_default()
            })
            .collect()
    }
}

/// A function's value at each row; `None` where it has none, or is no function that an instrument shows.
fn steady(readings: &mut Functions<'_>, chain: &Chain, amount: &Poly) -> Option<Vec<f64>> {
    let by_row = readings.column(amount)?;
    if by_row.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let rms = (by_row.iter().map(|v| v * v).sum::<f64>() / by_row.len() as f64).sqrt();
    let of_joints = amount.symbols().iter().all(|&symbol| chain.symbol(symbol).kind != SymbolKind::Input);
    let flat = of_joints && rms < TOO_FLAT;
    let steep = by_row.iter().any(|value| value.abs() > TOO_STEEP * rms);
    (!flat && !steep).then_some(by_row)
}

/// The places that some effects use, each once.
#[must_use]
pub fn places(effects: &[Effect]) -> Vec<Place> {
    let mut places: Vec<Place> = effects.iter().flat_map(Effect::places).collect();
    places.sort_unstable();
    places.dedup();
    places
}
