//! The columns of a search: what a unit of each declared error, and of each effect, would do to every residual
//! component.
//!
//! One probe error for each place in the chain that an effect uses; its derivative comes from the exact form at the
//! fitted errors, once, and is multiplied by the effect's functions of the readings.

pub(crate) mod functions;
mod seen;

use std::ops::Range;

use codegen::vector::{self, Arithmetic};
use faer::Mat;
use model_core::algebra::Poly;
use model_core::{Chain, Quantity, SymbolId, SymbolKind};

use effects::candidate::{Effect, EffectId, Place, add_error, insert};
use fit::{Block, FitError, Model};
use functions::Functions;
use observe::unknowns::{Unknowns, WIDTH};
use observe::{Observations, Poses};
use seen::Extent;

pub use seen::Seen;

/// A place that moves the observations this many times less than the place that moves them most is seen only
/// through products of errors.
const UNSEEN: f64 = 1e-3;

/// A chain with a probe error at each place that effects use, at the values of a fit.
#[derive(Debug, Clone)]
pub struct Probed {
    model: Model,
    /// Of every symbol, probes included.
    values: Vec<f64>,
    parameters: usize,
    places: Vec<Place>,
}

/// Everything before whitening, row by row, component by component.
#[derive(Debug, Clone)]
pub struct Columns {
    /// Measured minus predicted, rad or m.
    pub residual: Vec<f64>,
    /// Derivative by each declared parameter; behind them by the numbers of stations that are estimated.
    pub declared: Mat<f64>,
    /// Row of the observations that each component belongs to.
    pub row: Vec<u32>,
    /// Per component the derivatives by what is unknown of object and station; empty where nothing is.
    pub(crate) unknown: Vec<[f64; WIDTH]>,
    places: Vec<Place>,
    probes: Mat<f64>,
}

/// What became of one block of rows.
struct Evaluated {
    rows: Range<usize>,
    residual: Vec<f64>,
    derivatives: Vec<Vec<f64>>,
    unknown: Vec<[f64; WIDTH]>,
}

impl Evaluated {
    fn of(_series: usize, rows: Range<usize>, block: &Block) -> Self {
        Self {
            rows,
            residual: block.by_row(&block.residual),
            derivatives: block.columns().map(|values| block.by_row(values)).collect(),
            unknown: block.unknown.clone(),
        }
    }
}

impl Probed {
    /// At `values` (of the chain's symbols), for rows of these series.
    ///
    /// # Errors
    /// Missing readings, or parameters that cannot be estimated.
    pub fn new(
        chain: &Chain,
        poses: &Poses,
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
        let (symbols, state) = values.split_at(values.len().min(chain.symbols.len()));
        let mut values = symbols.to_vec();
        values.resize(probed.symbols.len(), 0.0);
        values.extend(state);
        let model = Model::new(&probed, poses, &wrt)?.adjusted();
        let places = places.iter().take(wrt.len() - parameters.len()).copied().collect();
        Ok(Self { model, values, parameters: parameters.len(), places })
    }

    /// Evaluates some observations.
    ///
    /// # Errors
    /// Values or observations that do not fit the chain.
    pub fn columns(&self, observations: &Observations) -> Result<Columns, FitError> {
        let blocks = self.model.map_blocks(observations, &self.values, Evaluated::of)?;
        Ok(self.put_together(blocks, observations.unknowns.as_ref()))
    }

    /// Evaluates poses at which nothing was measured; residuals are zero.
    ///
    /// # Errors
    /// Values or poses that do not fit the chain.
    pub fn columns_at(&self, poses: &Poses) -> Result<Columns, FitError> {
        let blocks = self.model.map_poses(poses, &self.values, Evaluated::of)?;
        Ok(self.put_together(blocks, None))
    }

    fn put_together(&self, blocks: Vec<Evaluated>, unknowns: Option<&Unknowns>) -> Columns {
        let n: usize = blocks.iter().map(|block| block.residual.len()).sum();
        let of_stations = unknowns.map_or(0, Unknowns::of_stations);
        let mut columns = Columns {
            residual: Vec::with_capacity(n),
            declared: Mat::zeros(n, self.parameters + of_stations),
            row: Vec::with_capacity(n),
            unknown: Vec::new(),
            places: self.places.clone(),
            probes: Mat::zeros(n, self.places.len()),
        };
        let mut start = 0;
        for Evaluated { rows, residual, derivatives, unknown } in blocks {
            columns.unknown.extend(unknown);
            let count = residual.len();
            let components = count / rows.len().max(1);
            columns.residual.extend(residual);
            for row in rows {
                columns.row.extend(std::iter::repeat_n(row as u32, components));
            }
            for (j, column) in self.model.column_of().iter().enumerate() {
                let Some(column) = *column else { continue };
                let target = match j.checked_sub(self.parameters) {
                    None => &mut columns.declared.col_as_slice_mut(j)[start..start + count],
                    Some(probe) => &mut columns.probes.col_as_slice_mut(probe)[start..start + count],
                };
                target.copy_from_slice(&derivatives[column]);
            }
            start += count;
        }
        if let Some(unknowns) = unknowns {
            let stations = unknowns.station_columns(&columns.row, &columns.unknown);
            columns.declared.subcols_mut(self.parameters, of_stations).copy_from(&stations);
        }
        columns
    }
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
        Probed::new(chain, &observations.poses, parameters, values, places)?.columns(observations)
    }

    /// Every place with the derivative by a unit there.
    pub(crate) fn probes(&self) -> impl Iterator<Item = (Place, &[f64])> {
        self.places.iter().enumerate().map(|(number, place)| (*place, self.probes.col_as_slice(number)))
    }

    /// The derivative by a unit at a place; `None` where these observations hardly see it.
    #[must_use]
    pub fn probe(&self, place: Place) -> Option<&[f64]> {
        let at = self.places.iter().position(|known| *known == place)?;
        let alike = self.places.iter().zip(self.probes.col_iter());
        let alike = alike.filter(|(other, _)| other.freedom.kind == place.freedom.kind);
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
        poses: &Poses,
        values: &[f64],
    ) -> Vec<Vec<Vec<f64>>> {
        let (mut columns, seen) = self.of_part(chain, effects, poses, values, |_| true);
        keep(&mut columns, &seen.usable(effects));
        columns
    }

    /// The columns of each effect that is wanted over a part of the rows, zero where there is no finite value; and
    /// what the part shows of which of them are usable, which all parts together decide.
    #[must_use]
    pub fn of_part(
        &self,
        chain: &Chain,
        effects: &[Effect],
        poses: &Poses,
        values: &[f64],
        wanted: impl Fn(EffectId) -> bool,
    ) -> (Vec<Vec<Vec<f64>>>, Seen) {
        let mut columns = vec![Vec::new(); effects.len()];
        let seen = self.each_column(chain, effects, poses, values, wanted, |effect, fill| {
            let mut column = vec![0.0; self.row.len()];
            fill(&mut column);
            columns[effect.0].push(column);
        });
        (columns, seen)
    }

    /// The same column by column: `take` is given, effect by effect, what fills a column of as many components as there are.
    pub(crate) fn each_column(
        &self,
        chain: &Chain,
        effects: &[Effect],
        poses: &Poses,
        values: &[f64],
        wanted: impl Fn(EffectId) -> bool,
        mut take: impl FnMut(EffectId, &dyn Fn(&mut [f64])),
    ) -> Seen {
        let mut readings = Functions::new(chain, poses, values);
        let mut seen = self.seen_of_probes();
        // Many effects have the same functions at other places; each is spread over the components of its rows once.
        let mut known: Vec<(&Poly, Option<Vec<f64>>, Extent)> = Vec::new();
        for (number, effect) in effects.iter().enumerate() {
            if !wanted(EffectId(number)) {
                seen.effects.push(Vec::new());
                continue;
            }
            let places = effect.places();
            let mut extents = Vec::new();
            for function in &effect.functions {
                // Derivatives with the functions that they are multiplied by.
                let mut parts: Vec<(&[f64], usize)> = Vec::new();
                for &place in &places {
                    let Some(number) = self.places.iter().position(|known| *known == place) else { continue };
                    let probe = self.probes.col_as_slice(number);
                    for amount in function.at(effect.place, place) {
                        let at = known.iter().position(|(other, ..)| *other == amount).unwrap_or_else(|| {
                            let mut by_row = readings.column(amount);
                            let symbols = amount.symbols();
                            // How small a function of a length is depends on the unit.
                            let has_size = |&id: &SymbolId| {
                                let symbol = chain.symbol(id);
                                symbol.kind == SymbolKind::Input
                                    || symbol.kind == SymbolKind::Joint && symbol.quantity == Quantity::Length
                            };
                            let of_joints = !symbols.iter().any(has_size);
                            let extent = Extent::of(by_row.as_deref_mut(), of_joints);
                            let spread =
                                |by_row: Vec<f64>| self.row.iter().map(|&row| by_row[row as usize]).collect();
                            known.push((amount, by_row.map(spread), extent));
                            known.len() - 1
                        });
                        extents.push(known[at].2.clone());
                        parts.push((probe, at));
                    }
                }
                let present = parts.iter().filter_map(|&(probe, at)| Some((probe, known[at].1.as_deref()?)));
                let present: Vec<(&[f64], &[f64])> = present.collect();
                take(EffectId(number), &|column| {
                    vector::run(vector::path(), Summed { column, parts: &present })
                });
            }
            seen.effects.push(extents);
        }
        seen
    }

    /// What these rows [show](Seen) of probes: to be asked before anything is whitened.
    pub(crate) fn seen_of_probes(&self) -> Seen {
        Seen::of_probes(&self.places, &self.probes)
    }

    /// Each component times its factor: whitens, where that is all that whitening does.
    pub(crate) fn scale(&mut self, factor: &[f64]) {
        let scale =
            |column: &mut [f64]| column.iter_mut().zip(factor).for_each(|(value, factor)| *value *= factor);
        scale(&mut self.residual);
        for columns in [&mut self.declared, &mut self.probes] {
            (0..columns.ncols()).for_each(|j| scale(columns.col_as_slice_mut(j)));
        }
    }
}

/// The column of a function: derivatives, each times what it is multiplied by, added up.
struct Summed<'a> {
    column: &'a mut [f64],
    parts: &'a [(&'a [f64], &'a [f64])],
}

impl vector::Work for Summed<'_> {
    #[inline(always)]
    fn run<A: Arithmetic>(self, _: A) {
        let Self { column, parts } = self;
        let Some((&(probe, function), others)) = parts.split_first() else { return column.fill(0.0) };
        for ((sum, probe), value) in column.iter_mut().zip(probe).zip(function) {
            *sum = probe * value;
        }
        for (probe, function) in others {
            for ((sum, probe), value) in column.iter_mut().zip(*probe).zip(*function) {
                *sum += probe * value;
            }
        }
    }
}

/// Forgets the columns of effects that are not usable.
pub(crate) fn keep(columns: &mut [Vec<Vec<f64>>], usable: &[bool]) {
    for (columns, usable) in columns.iter_mut().zip(usable) {
        if !usable {
            columns.clear();
        }
    }
}

/// The places that some effects use, each once.
#[must_use]
pub fn places(effects: &[Effect]) -> Vec<Place> {
    let mut places: Vec<Place> = effects.iter().flat_map(Effect::places).collect();
    places.sort_unstable();
    places.dedup();
    places
}
