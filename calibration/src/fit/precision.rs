//! What the data can say: how well each error is determined, what it hangs together with, which rows carry the fit, and
//! what went wrong if something did.

use std::collections::BTreeMap;

use faer::Mat;
use model_core::{Chain, Quantity, SymbolId, SymbolKind};
use serde::Serialize;

use super::{FitResult, Model, Outcome, Subspace};
use crate::fit::partial::Partial;
use crate::noise::VarianceTerm;
use crate::observations::{Measure, Observations};

/// Correlations from here on are listed.
const STRONG: f64 = 0.9;

/// Rows with so many times the mean leverage are listed.
const HIGH_LEVERAGE: f64 = 3.0;

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
    for (at, parameter) in fit.parameters.iter().enumerate() {
        if !fit.separable[at] || !sigma(at).is_finite() || sigma(at) == 0.0 {
            continue;
        }
        let column = fit.linear.jacobian.col(at).squared_norm_l2();
        let alone = fit.degrees_of_freedom.max(1.0) / fit.chi_squared.max(f64::MIN_POSITIVE);
        determined.push(Determined {
            name: name(parameter),
            variance_inflation: (fit.covariance[(at, at)] * column * alone.min(1.0)).max(1.0),
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
        leverage: leverage(observations, fit),
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

/// Parameters linked by undetermined combinations, set by set.
#[must_use]
pub fn linked(fit: &FitResult) -> Vec<Vec<SymbolId>> {
    let p = fit.parameters.len();
    // The projector on what is undetermined: parameters that share an entry of it are linked.
    let scale: Vec<f64> = (0..p)
        .map(|at| fit.linear.jacobian.col(at).norm_l2())
        .map(|length| if length > 0.0 { length } else { 1.0 })
        .collect();
    let scaled =
        Mat::from_fn(p, fit.null_space.ncols(), |row, column| fit.null_space[(row, column)] * scale[row]);
    let Ok(svd) = scaled.thin_svd() else { return Vec::new() };
    let projector = svd.U() * svd.U().transpose();
    let mut set_of: Vec<usize> = (0..p).collect();
    for a in 0..p {
        for b in 0..a {
            if projector[(a, b)].abs() > 1e-6 {
                let (from, to) = (set_of[a], set_of[b]);
                set_of.iter_mut().filter(|set| **set == from).for_each(|set| *set = to);
            }
        }
    }
    let mut sets: BTreeMap<usize, Vec<SymbolId>> = BTreeMap::new();
    for (at, set) in set_of.into_iter().enumerate() {
        if !fit.separable[at] {
            sets.entry(set).or_default().push(fit.parameters[at]);
        }
    }
    sets.into_values().collect()
}

fn not_separable(chain: &Chain, observations: &Observations, fit: &FitResult) -> Vec<NotSeparable> {
    linked(fit)
        .into_iter()
        .map(|set| {
            let at_spread_poses = spread_rank(chain, observations, &set);
            let seen_here = rank_of(fit, &set);
            let names = set.iter().map(|id| chain.symbol(*id).name.clone()).collect();
            // Structural if poses spread all round would not determine one more combination of the set.
            NotSeparable { names, structural: at_spread_poses.is_none_or(|rank| rank <= seen_here) }
        })
        .collect()
}

/// The rank of some columns at the poses measured.
fn rank_of(fit: &FitResult, set: &[SymbolId]) -> usize {
    let columns: Vec<usize> =
        set.iter().filter_map(|id| fit.parameters.iter().position(|parameter| parameter == id)).collect();
    let rows = Mat::from_fn(fit.linear.jacobian.nrows(), columns.len(), |row, column| {
        fit.linear.jacobian[(row, columns[column])]
    });
    let inside = Subspace::determined(&Partial::new(columns.len()).with_rows(rows.as_ref())).rank();
    inside.min(set.len())
}

/// The rank that poses all round would give, without errors; `None` where it cannot be computed.
fn spread_rank(chain: &Chain, observations: &Observations, set: &[SymbolId]) -> Option<usize> {
    let rows = 24 * set.len() + 48;
    let mut spread = observations.clone();
    let mut start = 0;
    spread.series = observations
        .series
        .iter()
        .map(|series| {
            let own = crate::observations::Series { rows: start..start + rows, ..series.clone() };
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
    let model = Model::new(chain, &spread, set).ok()?;
    let partials = model
        .map_blocks(&spread, &chain.nominal_values(), |_, _, block| {
            Partial::new(set.len()).with_rows(block.jacobian.as_ref())
        })
        .ok()?;
    let whole = partials.iter().fold(Partial::new(set.len()), |whole, part| whole.merge(part));
    Some(Subspace::determined(&whole).rank())
}

/// Rows whose leverage is several times the mean, the largest first.
fn leverage(observations: &Observations, fit: &FitResult) -> Vec<(u64, f64)> {
    let Ok(svd) = fit.linear.jacobian.thin_svd() else { return Vec::new() };
    let mut of_row = vec![0.0; observations.rows()];
    for (at, &row) in fit.linear.row.iter().enumerate() {
        let u = svd.U();
        of_row[row as usize] +=
            (0..fit.rank.min(u.ncols())).map(|column| u[(at, column)].powi(2)).sum::<f64>();
    }
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

fn noise(chain: &Chain, observations: &Observations, fit: &FitResult) -> Vec<String> {
    let mut said = Vec::new();
    let mut floors = fit.noise.floor.iter();
    for series in &observations.series {
        let floors: Vec<String> =
            floors.by_ref().take(series.measure.components()).map(|floor| format!("{floor:.3e}")).collect();
        let unit =
            if observations.sigma.is_empty() { series.measure.unit() } else { "times what the data state" };
        said.push(format!("{}: standard deviation {} {unit}", series.source, floors.join(", ")));
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
        if series.measure == Measure::Direction && fit.rms > 0.2 {
            hints.push(format!(
                "{}: the residual is {:.0} deg: a swapped sign, swapped axes or a wrong unit is likely",
                series.source,
                fit.rms.to_degrees()
            ));
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
