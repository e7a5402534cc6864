//! One likelihood for every reading of the data: of the numbers as the file has them, with a prior on the errors.

use fit::noise::Layout;
use fit::{FitOptions, Model, Why, fit_by};
use observe::unknowns::Station;
use observe::{Observations, SiUnit};
use statrs::function::gamma::ln_gamma;
use study::{Plan, Read, SampledColumn};

use super::hypotheses::Hypothesis;
use super::prior::{Priors, measured_size};
use super::size;
use super::stations::strayed;

/// Degrees of freedom of the residual's distribution: heavy enough for outliers.
const DEGREES: f64 = 4.0;

/// The share of the rows furthest off that the RMS leaves out.
const FURTHEST: f64 = 0.02;

/// What a reading of the data comes to.
#[derive(Debug, Clone)]
pub(super) struct Score {
    /// Logarithm of the likelihood with all prices.
    pub total: f64,
    /// The scale of the residual, the geometric mean over its units, against the numbers as they are written: what only shrinks the
    /// data explains nothing.
    pub scale: f64,
    /// RMS of the residual of the first unit without the rows furthest off, SI.
    pub rms: f64,
    /// The size of what was measured, SI.
    pub size: f64,
    /// What the sizes of the errors cost, and stations that are nowhere near their rough places.
    pub penalty: f64,
    /// Whether an error is too large to be one, or stations are nowhere near.
    pub is_beyond: bool,
    /// Where the fit came to.
    pub values: Vec<f64>,
    /// How many numbers these data determine.
    pub rank: usize,
}

impl Score {
    /// The residual over the size of what was measured.
    pub fn relative(&self) -> f64 {
        self.rms / self.size
    }

    /// Whether more is left than a share of what was measured, or an error is too large to be one.
    pub fn is_off(&self, share: f64) -> bool {
        self.relative() > share || self.is_beyond
    }

    /// The same by the file's own numbers, where a fit was of observations that are turned.
    pub fn of_numbers(&mut self, own: &Observations, turned: &Observations, columns: &[SampledColumn]) {
        let numbers = own.poses.components() as f64;
        let more = jacobian(own, columns, None, None) - jacobian(turned, columns, None, None);
        self.total += (numbers - self.rank as f64).max(1.0) / numbers * more;
        self.scale *= (-more / numbers).exp();
    }
}

/// The score of the data as they are read, fitted; `None` where there is no fit.
pub(super) fn score(
    plan: &Plan,
    model: &Model,
    observations: &Observations,
    options: &FitOptions,
    priors: &Priors,
    columns: &[SampledColumn],
    hypothesis: Option<&Hypothesis>,
) -> Option<Score> {
    let fit = fit_by(model.clone(), &plan.chain, observations, options).ok()?;
    let of_objects = match &observations.unknowns {
        Some(_) => Some(size::of_objects(&plan.chain, observations, &fit.values)?),
        None => None,
    };
    // What shows nothing of a row, as a camera that looks away, is no reading of it.
    if fit.set_aside.iter().any(|own| own.why == Why::NoValue) {
        return None;
    }
    let layout = Layout::of(observations);
    let mut units: Vec<(SiUnit, Vec<f64>, Vec<f64>)> = Vec::new();
    let mut at = 0;
    let norms: Vec<f64> = layout.norms(&fit.residuals.raw).collect();
    for series in &observations.poses.series {
        let (unit, components) = (series.measure.unit(), series.measure.components());
        let own = fit.residuals.raw.get(at..at + components * series.rows.len())?;
        at += own.len();
        let norms = norms.get(series.rows.clone())?;
        match units.iter_mut().find(|(known, ..)| *known == unit) {
            Some((_, all, rows)) => {
                all.extend(own);
                rows.extend(norms);
            }
            None => units.push((unit, own.to_vec(), norms.to_vec())),
        }
    }
    if units.iter().any(|(_, own, _)| own.iter().any(|value| !value.is_finite())) {
        return None;
    }
    let numbers: usize = units.iter().map(|(_, own, _)| own.len()).sum();
    let jacobian = jacobian(observations, columns, hypothesis, of_objects.map(|own| own.across_m));
    let (mut log, mut scale) = (jacobian, -jacobian / numbers as f64);
    for (_, own, _) in &units {
        let width = width(own);
        log += log_density(own, width);
        scale += width.ln() * own.len() as f64 / numbers as f64;
    }
    let unknowns = observations.unknowns.as_ref();
    let strayed = unknowns.and_then(|own| strayed(&written(plan, hypothesis), own, &fit.values));
    let penalty = priors.penalty(&fit, strayed.is_some());
    let free = (numbers as f64 - fit.rank as f64).max(1.0);
    let (_, _, rows_of_first) = units.into_iter().next()?;
    let (price, digits) = hypothesis.map_or((0.0, 0.0), |own| (own.price, own.digits));
    let total = free / numbers as f64 * log - price + digits - penalty;
    total.is_finite().then(|| Score {
        total,
        scale: scale.exp(),
        rms: trimmed(&rows_of_first),
        size: of_objects.map_or_else(|| measured_size(observations), |own| own.usual_m),
        penalty,
        is_beyond: strayed.is_some() || priors.is_beyond(&fit.values),
        rank: fit.rank,
        values: fit.values,
    })
}

/// Where a study writes that stations stand, read so.
pub(super) fn written(plan: &Plan, hypothesis: Option<&Hypothesis>) -> Vec<Station> {
    let mut stations = plan.places.stations.clone();
    let changes = hypothesis.into_iter().flat_map(|own| &own.places);
    changes.for_each(|change| change.make(&mut [], &mut stations));
    stations
}

/// The logarithm of how much the residual changes with the numbers as they are written. What observes unknown objects has no number of its
/// own: its residual counts by how wide things are.
pub(super) fn jacobian(
    observations: &Observations,
    columns: &[SampledColumn],
    hypothesis: Option<&Hypothesis>,
    across_m: Option<f64>,
) -> f64 {
    let mut all = 0.0;
    for (number, series) in observations.poses.series.iter().enumerate() {
        let rows = series.rows.len() as f64;
        if series.measure.shape().is_some() {
            let is_length = series.measure.unit() == SiUnit::METRE;
            let size_m = across_m.filter(|_| is_length).unwrap_or(1.0);
            all += rows * series.measure.components() as f64 * size_m.ln();
            continue;
        }
        let observed: Vec<&SampledColumn> = columns
            .iter()
            .filter(|column| column.place.source == number && matches!(column.read, Read::Observed(_)))
            .collect();
        for column in &observed {
            let factor = hypothesis.map_or(column.factor, |own| own.factor(column));
            all += rows * factor.abs().ln();
        }
        // An azimuth moves a direction by the cosine of the elevation.
        if observed.len() == 2 {
            let own = observations.measured.get(series.rows.clone()).unwrap_or_default();
            all += own
                .iter()
                .filter_map(|measured| measured.direction())
                .map(|direction| direction.x.hypot(direction.y).max(1e-3).ln())
                .sum::<f64>();
        }
    }
    all
}

/// The scale of a t distribution that suits residuals best.
pub(super) fn width(residual: &[f64]) -> f64 {
    let mut squares: Vec<f64> = residual.iter().map(|value| value * value).collect();
    squares.sort_by(f64::total_cmp);
    let middle = squares.get(squares.len() / 2).copied().unwrap_or(0.0);
    let floor = 1e-18;
    let mut variance = (1.44 * middle).max(floor);
    for _ in 0..30 {
        let weighted: f64 = squares.iter().map(|square| square / (DEGREES + square / variance)).sum();
        variance = (weighted * (DEGREES + 1.0) / squares.len() as f64).max(floor);
    }
    variance.sqrt()
}

pub(super) fn log_density(residual: &[f64], width: f64) -> f64 {
    let constant = ln_gamma((DEGREES + 1.0) / 2.0)
        - ln_gamma(DEGREES / 2.0)
        - 0.5 * (DEGREES * std::f64::consts::PI).ln();
    let kernel = |value: &f64| -(DEGREES + 1.0) / 2.0 * ((value / width).powi(2) / DEGREES).ln_1p();
    residual.iter().map(kernel).sum::<f64>() + residual.len() as f64 * (constant - width.ln())
}

pub(super) fn trimmed(norms: &[f64]) -> f64 {
    let mut squares: Vec<f64> = norms.iter().map(|norm| norm * norm).collect();
    squares.sort_by(f64::total_cmp);
    squares.truncate(squares.len() - (squares.len() as f64 * FURTHEST) as usize);
    (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
}
