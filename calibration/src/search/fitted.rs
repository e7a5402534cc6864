//! The declaration with some effects, fitted.

use faer::Mat;
use model_core::{Chain, Quantity, SymbolId};

use super::context::{Context, Found, declared};
use super::readings::{ByReading, adjusted};
use super::{SearchError, Stage};
use crate::search::ProblemError;
use crate::search::columns::{Columns, Probed, places};
use effects::candidate::{Effect, EffectId};
use fit::noise::Layout;
use fit::{BESIDE_OBJECTS, FitError, FitOptions, FitResult, fit};
use observe::Poses;
use observe::unknowns::{OfStation, Unknowns};
use study::Plan;

/// The columns of each effect, one a function.
pub(crate) type OfEffects = Vec<Vec<Vec<f64>>>;

/// A fit of the declaration with the effects accepted so far.
#[derive(Clone)]
pub(crate) struct Fitted {
    /// The declaration with these effects.
    pub chain: Chain,
    /// The effects in the order they came in.
    pub found: Vec<Found>,
    /// The new errors of each effect.
    pub errors: Vec<Vec<SymbolId>>,
    /// The fit of that chain.
    pub fit: FitResult,
    /// Combinations of the declared errors that these data determine, one a column; behind them the numbers of stations.
    pub combinations: Mat<f64>,
    /// That chain at the fit, with a probe at each place of the catalogue.
    pub probed: Probed,
    /// How the components of all rows lie.
    pub layout: Layout,
    /// Where uncertain readings stand as far as the residuals say, at which effects are judged; `None` where all are exact.
    pub adjusted: Option<ByReading>,
}

impl Fitted {
    /// The declaration as it is.
    pub fn first(whole: &Context<'_>) -> Result<Self, SearchError> {
        let plan = whole.request.plan;
        Self::of(whole, plan.chain.clone(), Vec::new(), Vec::new(), plan.fit.clone())
    }

    /// The declaration with some effects, fitted from where another fit ended.
    pub fn with(whole: &Context<'_>, found: Vec<Found>, last: &Self) -> Result<Self, SearchError> {
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
            if options.anchored {
                // As large as errors may be that are declared: the amended declaration, calibrated again, is the same fit.
                let size = |&id: &SymbolId| (id, tolerance_of(plan, chain.symbol(id).quantity));
                options.sizes.extend(new.iter().map(size));
            }
            errors.push(new);
            kept.push(found);
        }
        for &parameter in &plan.fit.estimate {
            options.start[parameter.index()] = last.fit.values[parameter.index()];
        }
        options.start.resize(chain.symbols.len(), 0.0);
        // Objects and stations start where they came to stand.
        options.start.extend(&last.fit.values[last.chain.symbols.len()..]);
        Self::of(whole, chain, kept, errors, options)
    }

    /// Adds to residuals what the effects explain of them; `columns` gives those of an effect.
    pub fn put_back<'c, C: Iterator<Item = &'c [f64]>>(
        &self,
        residual: &mut [f64],
        columns: impl Fn(EffectId) -> C,
    ) {
        for (found, errors) in self.found.iter().zip(&self.errors) {
            for (column, error) in columns(found.effect).zip(errors) {
                let value = self.fit.values[error.index()];
                residual.iter_mut().zip(column).for_each(|(r, z)| *r += value * z);
            }
        }
    }

    /// What the sizes of the declared errors say of their combinations: a row for each, and how far it is from where it is expected,
    /// both in units of its size.
    pub fn sizes(&self, declared: usize) -> (Mat<f64>, Vec<f64>) {
        let nominal = self.chain.nominal_values();
        let sizes = &self.fit.subspace.size()[..declared];
        let stated =
            Mat::from_fn(declared, self.combinations.ncols(), |i, j| self.combinations[(i, j)] / sizes[i]);
        let away = sizes
            .iter()
            .zip(&self.fit.parameters)
            .map(|(size, id)| (nominal[id.index()] - self.fit.values[id.index()]) / size);
        (stated, away.collect())
    }

    /// What the study states of stations: of each number its column among the combinations, its standard uncertainty, and how far from
    /// where it is stated it came to stand.
    pub fn stated_of_stations(&self, unknowns: Option<&Unknowns>) -> Vec<OfStation> {
        let Some(unknowns) = unknowns else { return Vec::new() };
        let first = self.combinations.ncols() - unknowns.of_stations();
        let stated = unknowns.stated_of_stations(unknowns.state(&self.fit.values)).into_iter();
        stated.map(|own| OfStation { at: first + own.at, ..own }).collect()
    }

    /// The columns at poses at which nothing was measured, and those of each effect.
    ///
    /// # Errors
    /// Poses that do not fit the chain.
    pub fn at_poses(&self, catalogue: &[Effect], poses: &Poses) -> Result<(Columns, OfEffects), FitError> {
        let columns = self.probed.columns_at(poses)?;
        let (effects, _) = columns.of_part(&self.chain, catalogue, poses, &self.fit.values, |_| true);
        Ok((columns, effects))
    }

    /// The combinations for columns that may know of no stations.
    pub fn of_errors(&self, columns: &Columns) -> Mat<f64> {
        let errors = columns.declared.ncols();
        self.combinations.subrows(0, errors).to_owned()
    }

    fn of(
        whole: &Context<'_>,
        chain: Chain,
        found: Vec<Found>,
        errors: Vec<Vec<SymbolId>>,
        options: FitOptions,
    ) -> Result<Self, SearchError> {
        let observations = whole.request.observations;
        let options = FitOptions { noise: options.noise.by_residuals(), ..options };
        (whole.tell)(Stage::Fit { effects: found.len() });
        let fit = fit(&chain, observations, &options)?;
        let places = places(&whole.catalogue);
        let probed = Probed::new(&chain, &observations.poses, declared(whole), &fit.values, &places)?;
        let of_stations = observations.unknowns.as_ref().map_or(0, Unknowns::of_stations);
        let combinations = determined(&fit, declared(whole).len(), of_stations)?;
        let layout = Layout::of(observations);
        let adjusted = adjusted(&chain, observations, &layout, &fit)?;
        Ok(Self { chain, found, errors, fit, combinations, probed, layout, adjusted })
    }
}

/// How large an effect may be that the data do not show: as the largest declared error of its quantity of which it is said.
pub(super) fn tolerance_of(plan: &Plan, quantity: Quantity) -> f64 {
    let sizes = plan.fit.sizes.iter().filter(|(own, _)| plan.chain.symbol(*own).quantity == quantity);
    sizes.map(|(_, size)| *size).reduce(f64::max).unwrap_or(BESIDE_OBJECTS)
}

/// An orthonormal basis of the declared errors' space without what the fit found undetermined; the rest would only
/// be seen through products of errors.
fn determined(fit: &FitResult, declared: usize, of_stations: usize) -> Result<Mat<f64>, ProblemError> {
    // What a combination with an effect's coefficients leaves open, the declared errors by themselves may well determine.
    let null = fit.subspace.of_first(declared).null_space();
    let svd = null.svd().map_err(|_| ProblemError::Singular)?;
    let values = svd.S().column_vector();
    let rank = (0..values.nrows()).filter(|&i| values[i] > 1e-8).count();
    let mut combinations = Mat::zeros(declared + of_stations, declared - rank + of_stations);
    combinations
        .submatrix_mut(0, 0, declared, declared - rank)
        .copy_from(svd.U().subcols(rank, declared - rank));
    for number in 0..of_stations {
        combinations[(declared + number, declared - rank + number)] = 1.0;
    }
    Ok(combinations)
}
