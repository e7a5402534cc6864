//! What the data can say: how well each error is determined, what it hangs together with, which rows carry the fit, and
//! what went wrong if something did.

use faer::Mat;
use model_core::{Chain, Quantity, SymbolId, SymbolKind};
use serde::Serialize;

use crate::data::{Measure, Observations, Series};
use crate::fit::noise::{Layout, VarianceTerm};
use crate::fit::sweep::{Weighting, tally};
use crate::fit::{FitError, FitResult, Model, Outcome, Subspace, robust};

/// Correlations from here on are listed.
const STRONG: f64 = 0.9;

/// Rows with so many times the mean leverage are listed.
const HIGH_LEVERAGE: f64 = 3.0;

/// Residuals of this share of what was measured (of a radian for directions) are no noise: something is read wrongly.
const OUT_OF_PLACE: f64 = 0.2;

/// One second of arc, in radians.
const ARCSEC_RAD: f64 = std::f64::consts::PI / 648_000.0;

/// A change is detectable when it is found with 80 % chance by a two-sided test of 5 %: so many standard uncertainties.
///
/// Source: Φ⁻¹(0.975) + Φ⁻¹(0.8).
const DETECTABLE: f64 = 2.801_585_218_312_992;

/// What is reported of a fit beyond its estimates.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Precision {
    /// How it ended, in words.
    pub outcome: String,
    /// Combinations that the data determine, of how many parameters.
    pub rank: [usize; 2],
    /// Per parameter that is determined by itself.
    pub determined: Vec<Determined>,
    /// Pairs of parameters whose estimates hang together: names and correlation.
    pub correlations: Vec<(String, String, f64)>,
    /// Sets of which the data determine combinations alone.
    pub not_separable: Vec<NotSeparable>,
    /// Rows that carry more than their share: number in the file, and leverage (0 to the number of components).
    pub leverage: Vec<(u64, f64)>,
    /// What was found of the noise, in words.
    pub noise: Vec<String>,
    /// What may have gone wrong with the data, in words.
    pub hints: Vec<String>,
}

/// How well a parameter is determined.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Determined {
    /// Its name.
    pub name: String,
    /// By how much its variance is larger than if nothing else were estimated.
    pub variance_inflation: f64,
    /// The smallest change of it that these data would show, SI.
    pub smallest_detectable: f64,
}

/// A set of parameters that cannot be told apart.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NotSeparable {
    /// Their names.
    pub names: Vec<String>,
    /// Whether no data of these observables could tell them apart; else it is owed to these poses.
    pub structural: bool,
}

/// Puts together what the data can say.
#[must_use]
pub fn precision(chain: &Chain, observations: &Observations, fit: &FitResult) -> Precision {
    let name = |id: &SymbolId| chain.symbol(*id).name.clone();
    let sigma = |at: usize| fit.covariance[(at, at)].sqrt();
    let mut determined = Vec::new();
    let mut correlations = Vec::new();
    let design = fit.subspace.covariance(&fit.factor);
    for (at, parameter) in fit.parameters.iter().enumerate() {
        if !fit.separable[at] || !sigma(at).is_finite() || sigma(at) == 0.0 {
            continue;
        }
        determined.push(Determined {
            name: name(parameter),
            variance_inflation: (design[(at, at)] * fit.factor.length(at).powi(2)).max(1.0),
            smallest_detectable: DETECTABLE * sigma(at),
        });
        for (other, second) in fit.parameters.iter().enumerate().skip(at + 1) {
            let correlation = fit.covariance[(at, other)] / (sigma(at) * sigma(other));
            if fit.separable[other] && correlation.abs() >= STRONG && correlation.is_finite() {
                correlations.push((name(parameter), name(second), correlation));
            }
        }
    }
    Precision {
        outcome: outcome(&fit.outcome),
        rank: [fit.rank, fit.parameters.len()],
        determined,
        correlations,
        not_separable: not_separable(chain, observations, fit),
        leverage: leverage(chain, observations, fit),
        noise: noise(chain, observations, fit),
        hints: hints(chain, observations, fit),
    }
}

fn outcome(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Converged { iterations } => format!("converged after {iterations} steps"),
        Outcome::NotConverged { iterations } => format!("did not converge in {iterations} steps"),
        Outcome::TooFewObservations { components, parameters } => {
            format!("too few observations: {components} measured components for {parameters} parameters")
        }
    }
}

fn not_separable(chain: &Chain, observations: &Observations, fit: &FitResult) -> Vec<NotSeparable> {
    let all_round = all_round(chain, observations, fit);
    let sets = fit.subspace.linked().into_iter();
    sets.map(|(members, undetermined)| {
        let names = members.iter().map(|&at| chain.symbol(fit.parameters[at]).name.clone()).collect();
        let inside = |other: &&(Vec<usize>, usize)| other.0.iter().all(|at| members.contains(at));
        let left =
            |sets: &Vec<(Vec<usize>, usize)>| sets.iter().filter(inside).map(|set| set.1).sum::<usize>();
        // Structural if poses spread all round would leave as many combinations of the set.
        NotSeparable { names, structural: all_round.as_ref().is_none_or(|sets| left(sets) >= undetermined) }
    })
    .collect()
}

/// What poses all round would leave undetermined, without errors; `None` where it cannot be computed.
fn all_round(
    chain: &Chain,
    observations: &Observations,
    fit: &FitResult,
) -> Option<Vec<(Vec<usize>, usize)>> {
    let rows = 24 * fit.parameters.len() + 48;
    let mut spread = observations.clone();
    let mut start = 0;
    spread.series = observations
        .series
        .iter()
        .map(|series| {
            let own = Series { rows: start..start + rows, ..series.clone() };
            start += rows;
            own
        })
        .collect();
    for (index, (id, values)) in spread.columns.iter_mut().enumerate() {
        let symbol = chain.symbol(*id);
        let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &value| {
            (low.min(value), high.max(value))
        });
        let turns = symbol.kind == SymbolKind::Joint && symbol.quantity == Quantity::Angle;
        let (low, high) = if turns {
            (-3.1, 3.1)
        } else if low < high {
            (low, high)
        } else {
            (low - 1.0, high + 1.0)
        };
        // Additive recurrence with the roots of primes: even over any number of joints, without a generator.
        let step = f64::from([2u8, 3, 5, 7, 11, 13, 17, 19, 23, 29][index % 10]).sqrt().fract();
        *values = (0..start).map(|row| low + (high - low) * (row as f64 * step + 0.5).fract()).collect();
    }
    spread.measured = vec![[0.0, 1.0, 0.0]; start];
    spread.sigma.clear();
    let model = Model::new(chain, &spread, &fit.parameters).ok()?;
    let layout = Layout::of(&spread);
    let sigma = vec![1.0; layout.components()];
    let mut values = chain.nominal_values();
    for id in chain.symbols_of(SymbolKind::Constant) {
        values[id.index()] = fit.values[id.index()];
    }
    let tally = tally(&model, &spread, &layout, &values, &sigma, Weighting::Full).ok()?;
    Some(Subspace::determined(&tally.partial.spread(model.column_of())).linked())
}

/// Rows whose leverage is several times the mean, the largest first.
fn leverage(chain: &Chain, observations: &Observations, fit: &FitResult) -> Vec<(u64, f64)> {
    let Ok(of_row) = leverages(chain, observations, fit) else { return Vec::new() };
    let mean = fit.rank as f64 / (observations.rows() as f64).max(1.0);
    let mut high: Vec<(u64, f64)> = of_row
        .into_iter()
        .enumerate()
        .filter(|(_, leverage)| *leverage > HIGH_LEVERAGE * mean)
        .map(|(row, leverage)| {
            (observations.row_numbers.get(row).copied().unwrap_or(row as u64 + 1), leverage)
        })
        .collect();
    high.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    high.truncate(10);
    high
}

/// The leverage of every row.
fn leverages(chain: &Chain, observations: &Observations, fit: &FitResult) -> Result<Vec<f64>, FitError> {
    let model = Model::new(chain, observations, &fit.parameters)?;
    let by_parameter = fit.subspace.covariance_root(&fit.factor);
    let mut by_column = Mat::<f64>::zeros(model.columns(), by_parameter.ncols());
    for (from, column) in by_parameter.row_iter().zip(model.column_of()) {
        if let Some(column) = *column {
            by_column.row_mut(column).iter_mut().zip(from.iter()).for_each(|(sum, part)| *sum += part);
        }
    }
    let layout = Layout::of(observations);
    let sigma = fit.noise.sigma_without_memory();
    let blocks = model.map_blocks(observations, &fit.values, |_, rows, block| {
        let mut shares = vec![0.0; block.residual.len()];
        for root in by_column.col_iter() {
            let mut share = vec![0.0; shares.len()];
            for (column, factor) in block.columns().zip(root.iter()) {
                share.iter_mut().zip(column).for_each(|(share, derivative)| *share += factor * derivative);
            }
            shares.iter_mut().zip(share).for_each(|(sum, share)| *sum += share * share);
        }
        let sigma = &sigma[layout.first[rows.start]..layout.first[rows.end]];
        let whitened = block.by_row(&shares).zip(sigma).map(|(share, sigma)| share / (sigma * sigma));
        let whitened: Vec<f64> = whitened.collect();
        let by_row = whitened.chunks_exact(block.components).zip(rows);
        by_row.map(|(shares, row)| shares.iter().sum::<f64>() * fit.residuals.weight[row]).collect::<Vec<_>>()
    })?;
    Ok(blocks.concat())
}

/// The unit in which noise is told, and its size, rad or m.
fn told_in(measure: Measure) -> (&'static str, f64) {
    match measure {
        Measure::Direction | Measure::Azimuth => ("arcsec", ARCSEC_RAD),
        Measure::Point | Measure::Range => ("mm", 1e-3),
    }
}

fn noise(chain: &Chain, observations: &Observations, fit: &FitResult) -> Vec<String> {
    let mut said = Vec::new();
    let mut floors = fit.noise.floor.iter();
    for series in &observations.series {
        let (unit, in_si) = match series.measure {
            _ if observations.states_sigma(series) => ("times what the data state", 1.0),
            measure => told_in(measure),
        };
        let own = floors.by_ref().take(series.measure.components());
        let told: Vec<String> = own.map(|floor| format!("{:.4}", floor / in_si)).collect();
        said.push(format!("{}: standard deviation {} {unit}", series.source, told.join(", ")));
    }
    if let Some(model) = &fit.noise.variance {
        let terms = model.terms.iter().map(|(term, coefficient)| {
            let of = |id: &SymbolId, function: &str, multiple: u8| {
                let name = &chain.symbol(*id).name;
                let multiple = if multiple == 1 { String::new() } else { format!("{multiple}") };
                format!("{coefficient:+.2} {function}({multiple}{name})")
            };
            match term {
                VarianceTerm::Cos(id, multiple) => of(id, "cos", *multiple),
                VarianceTerm::Sin(id, multiple) => of(id, "sin", *multiple),
                VarianceTerm::LogRange(id) => of(id, "ln", 1),
            }
        });
        said.push(format!(
            "the variance depends on the joints: its logarithm is {}",
            terms.collect::<Vec<_>>().join(" ")
        ));
    }
    if let Some(serial) = fit.noise.serial {
        said.push(format!(
            "rows remember the row before: ARMA(1,1) with {:.3} and {:.3}",
            serial.autoregressive, serial.moving_average
        ));
    }
    said
}

/// RMS of the residuals' lengths over the rows of one series, with weight or without.
fn rms_of(series: &Series, observations: &Observations, fit: &FitResult) -> f64 {
    let layout = Layout::of(observations);
    let own = layout.first[series.rows.start]..layout.first[series.rows.end];
    let squares: f64 = fit.residuals.raw[own].iter().map(|residual| residual * residual).sum();
    (squares / (series.rows.len() as f64).max(1.0)).sqrt()
}

/// What the size of the residual suggests: a wrong unit, a sign, swapped axes.
fn hints(chain: &Chain, observations: &Observations, fit: &FitResult) -> Vec<String> {
    let mut hints = Vec::new();
    for series in &observations.series {
        for (id, values) in &observations.columns {
            let symbol = chain.symbol(*id);
            let angle = symbol.kind == SymbolKind::Joint && symbol.quantity == Quantity::Angle;
            let readings = values.get(series.rows.clone()).unwrap_or_default();
            let largest = readings.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
            if angle && largest > 4.0 * std::f64::consts::TAU {
                hints.push(format!(
                    "{}: `{}` reaches {largest:.0} rad, {:.0} turns: are these degrees taken for radians?",
                    series.source,
                    symbol.name,
                    largest / std::f64::consts::TAU
                ));
            }
            if angle && readings.len() > 10 && largest > 0.0 && largest < 0.12 {
                hints.push(format!(
                    "{}: `{}` stays within {:.1} deg: were radians taken for degrees?",
                    series.source,
                    symbol.name,
                    largest.to_degrees()
                ));
            }
        }
        let rms = rms_of(series, observations, fit);
        match series.measure {
            Measure::Direction | Measure::Azimuth if rms > OUT_OF_PLACE => hints.push(format!(
                "{}: the residual is {:.0} deg: a swapped sign, swapped axes or a wrong unit is likely",
                series.source,
                rms.to_degrees()
            )),
            Measure::Point | Measure::Range => {
                let distance = |row: usize| nalgebra::Vector3::from(observations.measured[row]).norm();
                let typical = robust::median(series.rows.clone().map(distance).collect());
                if rms > OUT_OF_PLACE * typical {
                    hints.push(format!(
                        "{}: the residual is {rms:.3} m where {typical:.3} m were measured: a wrong unit, a swapped sign or \
                         swapped axes are likely",
                        series.source
                    ));
                }
            }
            _ => {}
        }
    }
    for (at, parameter) in fit.parameters.iter().enumerate() {
        let symbol = chain.symbol(*parameter);
        let value = fit.values[parameter.index()];
        if symbol.kind == SymbolKind::Error
            && symbol.quantity == Quantity::Angle
            && fit.separable[at]
            && value.abs() > 0.5
        {
            hints.push(format!(
                "`{}` comes out at {:.0} deg, which is no small error: a swapped sign, an axis or an offset in the declaration?",
                symbol.name,
                value.to_degrees()
            ));
        }
    }
    hints
}
