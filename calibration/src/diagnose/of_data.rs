//! What the data and the size of the residual suggest: a wrong unit, a sign, swapped axes; or that all is rounding.

use model_core::{Chain, Quantity, SymbolKind};

use super::caution::{Caution, SOME_FREEDOM};
use super::two_places::two_places;
use fit::noise::Layout;
use fit::{FitResult, robust};
use observe::{Grouping, Observations, Series, SiUnit};

/// Residuals of this share of what was measured (of a radian for directions, of how far pixels scatter) are no noise: something is
/// read wrongly.
const OUT_OF_PLACE: f64 = 0.2;

/// Where no more than this share of the rows was set aside, and the others are near, it is those rows that were read wrongly.
const FEW: f64 = 0.1;

/// Residuals of this share of what was measured (of a radian for directions) are what some fifty roundings leave.
const ROUNDING: f64 = 1e-14;

/// An angle that is no small error.
const LARGE_RAD: f64 = 0.5;

/// What the data and the size of the residual suggest: a wrong unit, a sign, swapped axes.
#[must_use]
pub fn of_data(chain: &Chain, observations: &Observations, fit: &FitResult) -> Vec<Caution> {
    let mut cautions = Vec::new();
    let rows = observations.rows();
    let groups = || observations.groups.iter().max().map_or(0, |last| *last as usize + 1);
    match observations.grouping {
        Grouping::Declared => {}
        Grouping::Places => {
            let beside_groups = !observations.crossed.is_empty();
            cautions.push(Caution::OfOnePlace { rows, places: groups(), beside_groups });
        }
        Grouping::Stretches { rows: of_stretch } => {
            cautions.push(Caution::OffAlike { rows, of_stretch, stretches: groups() });
        }
    }
    for series in &observations.poses.series {
        cautions.extend(out_of_place(observations, series, fit));
    }
    cautions.extend(rounding(observations, fit));
    cautions.extend(two_places(chain, observations, fit).map(Caution::TwoPlaces));
    for (&parameter, &separable) in fit.parameters.iter().zip(&fit.separable) {
        let (symbol, value_rad) = (chain.symbol(parameter), fit.values[parameter.index()]);
        let angle = symbol.kind == SymbolKind::Error && symbol.quantity == Quantity::Angle;
        if angle && separable && value_rad.abs() > LARGE_RAD {
            cautions.push(Caution::ErrorNotSmall { error: symbol.name.clone(), value_rad });
        }
    }
    cautions
}

/// Whether all that the fit leaves is the rounding of the numbers, as of data that were made up without noise.
#[must_use]
pub fn rounding(observations: &Observations, fit: &FitResult) -> Option<Caution> {
    let of_series = |series: &Series| {
        let measured = distance_m(observations, series).unwrap_or(1.0);
        (rms_of(series, observations, fit, |_| true), measured, series.measure.unit())
    };
    let all: Vec<(f64, f64, SiUnit)> = observations.poses.series.iter().map(of_series).collect();
    if all.is_empty()
        || fit.degrees_of_freedom < SOME_FREEDOM
        || all.iter().any(|(rms, measured, _)| rms.is_nan() || *rms > ROUNDING * measured)
    {
        return None;
    }
    let largest = all.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    largest.map(|(rms, _, unit)| Caution::ResidualIsRounding { rms, unit })
}

/// The usual distance that a series measures, m; none for directions, nor where nobody knows how far away things are.
fn distance_m(observations: &Observations, series: &Series) -> Option<f64> {
    let distance_m = series.measure.kind().distance_m;
    let distances = observations.measured[series.rows.clone()].iter().map(distance_m);
    let usual = distances.collect::<Option<Vec<f64>>>().map(robust::median)?;
    (usual > 0.0).then_some(usual)
}

/// How far the pixels of a series scatter about their mean: the size of what a camera shows; none for what is no image.
fn scatter_px(observations: &Observations, series: &Series) -> Option<f64> {
    let map = series.measure.kind().map.as_ref().filter(|_| series.measure.unit() == SiUnit::PIXEL)?;
    let places: Option<Vec<(f64, f64)>> =
        observations.measured[series.rows.clone()].iter().map(map.place).collect();
    let places = places.filter(|places| !places.is_empty())?;
    let count = places.len() as f64;
    let [u, v] = places.iter().fold([0.0; 2], |[u, v], place| [u + place.0 / count, v + place.1 / count]);
    let square = |place: &(f64, f64)| (place.0 - u).powi(2) + (place.1 - v).powi(2);
    Some((places.iter().map(square).sum::<f64>() / count).sqrt())
}

fn out_of_place(observations: &Observations, series: &Series, fit: &FitResult) -> Option<Caution> {
    let rms = rms_of(series, observations, fit, |_| true);
    let measured_m = distance_m(observations, series);
    let most = OUT_OF_PLACE * measured_m.or_else(|| scatter_px(observations, series)).unwrap_or(1.0);
    if rms.is_nan() || rms <= most {
        return None;
    }
    let counts = |row: usize| fit.residuals.weight[row] > 0.0;
    let aside = series.rows.clone().filter(|&row| !counts(row)).count();
    let is_few = aside as f64 <= FEW * series.rows.len() as f64;
    let is_rest_near = is_few && rms_of(series, observations, fit, counts) <= most;
    Some(Caution::OutOfPlace {
        source: series.source.clone(),
        rms,
        unit: series.measure.unit(),
        measured_m,
        but_for: is_rest_near.then_some([aside, series.rows.len()]),
    })
}

/// RMS of the residuals' lengths over the rows of one series that count.
fn rms_of(
    series: &Series,
    observations: &Observations,
    fit: &FitResult,
    counts: impl Fn(usize) -> bool,
) -> f64 {
    let layout = Layout::of(observations);
    let own = series.rows.clone().filter(|&row| counts(row));
    let square =
        |row: usize| fit.residuals.raw[layout.of_rows(row..row + 1)].iter().map(|r| r * r).sum::<f64>();
    let (sum, rows) = own.map(square).fold((0.0, 0), |(sum, rows), square| (sum + square, rows + 1));
    (sum / f64::from(rows).max(1.0)).sqrt()
}
