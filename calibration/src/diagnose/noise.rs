//! The noise that was found, as numbers: how large, how it varies with the joints, how it remembers, and what was stated.

use model_core::{Chain, SymbolId};
use serde::Serialize;

use fit::FitResult;
use fit::noise::{Layout, VarianceTerm};
use observe::{NoiseOf, Observations, SiUnit};

/// The noise.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NoiseFound {
    /// File by file.
    pub series: Vec<SeriesNoise>,
    /// RMS over rows of the length of the residual that noise alone would leave, SI.
    pub expected_rms: f64,
    /// The standard deviation of each component that the study states, SI; none where it states none.
    pub stated: Option<f64>,
    /// What was found over what the study or the data state; none where nothing is stated.
    pub over_stated: Option<f64>,
    /// How the logarithm of the variance depends on joints and ranges: of angles, of lengths and across a beam a sum of these.
    pub variance: Vec<VarianceFound>,
    /// The joints and inputs whose readings are not exact, and how uncertain the study says they are. What readings bring into the
    /// residuals is beside the standard deviations above.
    pub readings: Vec<UncertainReading>,
    /// How many times as uncertain readings were found to be; none where all are exact.
    pub readings_over_stated: Option<f64>,
    /// What a row keeps of the row before, if the rows remember.
    pub serial: Option<SerialFound>,
    /// Whether rows remember in the order of the file, which nobody declared to be that of acquisition. Without
    /// [serial](Self::serial) it may as well be something that the declaration lacks, and only the uncertainties allow for it.
    pub undeclared_order: bool,
}

/// The noise of one file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SeriesNoise {
    /// The file.
    pub source: String,
    /// The residual components.
    pub components: Vec<&'static str>,
    /// Standard deviation of each, SI; a factor on what the data state where they do.
    pub sigma: Vec<f64>,
    /// `rad`, `m`, or `1` for a factor.
    pub unit: SiUnit,
    /// Whether it is a factor on the standard uncertainties that the data state.
    pub of_stated: bool,
}

/// How uncertain the readings of a joint or input are.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct UncertainReading {
    /// The joint or input.
    pub name: String,
    /// Root mean square over the rows that state any, SI.
    pub sigma: f64,
    /// `rad`, `m`, or `1`.
    pub unit: SiUnit,
}

/// A term of the logarithm of the variance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VarianceFound {
    /// The components whose variance it is.
    pub noise_of: NoiseOf,
    /// `cos`, `sin` or `ln`.
    pub function: &'static str,
    /// The joint or range.
    pub of: String,
    /// How many times a turn; 1 for `ln`.
    pub multiple: u8,
    /// Its coefficient.
    pub coefficient: f64,
}

/// ARMA(1,1) from row to row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SerialFound {
    /// Coefficient of the value before.
    pub autoregressive: f64,
    /// Coefficient of the innovation before.
    pub moving_average: f64,
    /// Whether rows remember in axes that stand still in space, and not across and along a beam that turns.
    pub in_space: bool,
}

/// The noise of a fit; `stated` is the study's own figure for every component, SI.
pub(super) fn noise(
    chain: &Chain,
    observations: &Observations,
    fit: &FitResult,
    stated: Option<f64>,
) -> NoiseFound {
    let mut floors = fit.noise.floor.iter().copied();
    let series: Vec<SeriesNoise> = observations
        .poses
        .series
        .iter()
        .map(|series| {
            let of_stated = observations.states_sigma(series);
            SeriesNoise {
                source: series.source.clone(),
                components: series.measure.component_names().to_vec(),
                sigma: floors.by_ref().take(series.measure.components()).collect(),
                unit: if of_stated { SiUnit::ONE } else { series.measure.unit() },
                of_stated,
            }
        })
        .collect();
    let over_stated = over_stated(&series, stated);
    let unit = observations.poses.series.first().map_or(SiUnit::RAD, |series| series.measure.unit());
    let expected_rms = expected_rms(observations, fit, unit);
    let variance =
        fit.noise.variance.iter().flat_map(|model| model.terms.iter().map(|term| (model.of, *term)));
    let variance = variance.map(|(noise_of, (term, coefficient))| {
        let (function, id, multiple): (_, SymbolId, _) = match term {
            VarianceTerm::Cos(id, multiple) => ("cos", id, multiple),
            VarianceTerm::Sin(id, multiple) => ("sin", id, multiple),
            VarianceTerm::LogRange(id) => ("ln", id, 1),
        };
        VarianceFound { noise_of, function, of: chain.symbol(id).name.clone(), multiple, coefficient }
    });
    NoiseFound {
        expected_rms,
        stated,
        over_stated,
        variance: variance.collect(),
        readings: observations.reading_sigma.iter().filter_map(|own| uncertain(chain, own)).collect(),
        readings_over_stated: (!observations.reading_sigma.is_empty()).then_some(fit.noise.of_readings),
        serial: fit.noise.serial.map(|serial| SerialFound {
            autoregressive: serial.autoregressive,
            moving_average: serial.moving_average,
            in_space: fit.noise.in_space.is_some(),
        }),
        undeclared_order: fit.noise.undeclared_order,
        series,
    }
}

fn uncertain(chain: &Chain, (id, sigma): &(SymbolId, Vec<f64>)) -> Option<UncertainReading> {
    let stated = || sigma.iter().filter(|sigma| **sigma > 0.0);
    let symbol = chain.symbol(*id);
    let squares: f64 = stated().map(|sigma| sigma * sigma).sum();
    let rms = (squares / stated().count() as f64).sqrt();
    (squares > 0.0).then(|| UncertainReading {
        name: symbol.name.clone(),
        sigma: rms,
        unit: symbol.quantity.into(),
    })
}

/// Root mean square over components of what was found over what is stated.
fn over_stated(series: &[SeriesNoise], stated: Option<f64>) -> Option<f64> {
    let ratios = series.iter().flat_map(|series| {
        let divisor = if series.of_stated { Some(1.0) } else { stated };
        series.sigma.iter().filter_map(move |sigma| Some(sigma / divisor?))
    });
    let (squares, count) = ratios.fold((0.0, 0.0), |(sum, count), ratio| (sum + ratio * ratio, count + 1.0));
    (count > 0.0).then(|| f64::sqrt(squares / count))
}

/// RMS over rows whose residuals have a unit of the length that the noise gives a residual.
pub(crate) fn expected_rms(observations: &Observations, fit: &FitResult, unit: SiUnit) -> f64 {
    let (sigma, layout) = (fit.noise.sigma_without_memory(), Layout::of(observations));
    let (mut squares, mut rows) = (0.0, 0.0_f64);
    for series in observations.poses.series.iter().filter(|series| series.measure.unit() == unit) {
        let own = &sigma[layout.of_rows(series.rows.clone())];
        squares += own.iter().map(|sigma| sigma * sigma).sum::<f64>();
        rows += series.rows.len() as f64;
    }
    (squares / rows.max(1.0)).sqrt()
}
