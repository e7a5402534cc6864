//! What the data can say: how well each error is determined, what it hangs together with, and which rows carry the fit.

use faer::Mat;
use model_core::{Chain, Quantity, SymbolId, SymbolKind};
use serde::Serialize;

use fit::noise::Layout;
use fit::sweep::design;
use fit::{FitError, FitResult, Model, Subspace};
use observe::{Observations, Series};

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
    /// Combinations that the data determine, of how many parameters.
    pub rank: [usize; 2],
    /// Per parameter that is determined by itself.
    pub determined: Vec<Determined>,
    /// Pairs of parameters whose estimates hang together: names and correlation.
    pub correlations: Vec<(String, String, f64)>,
    /// The correlation of every two of those that are determined, each by itself: row by row, in the order of `determined`.
    pub correlation_matrix: Vec<Vec<f64>>,
    /// Sets of which the data determine combinations alone.
    pub not_separable: Vec<NotSeparable>,
    /// Rows that carry more than their share: number in the file, and leverage (0 to the number of components).
    pub leverage: Vec<(u64, f64)>,
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

/// A set of parameters, two at least, that cannot be told apart.
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
    let alone: Vec<usize> = (0..fit.parameters.len())
        .filter(|&at| fit.separable[at] && sigma(at).is_finite() && sigma(at) > 0.0)
        .collect();
    let correlation = |a: usize, b: usize| fit.covariance[(a, b)] / (sigma(a) * sigma(b));
    let design = fit.design_covariance();
    for (number, &at) in alone.iter().enumerate() {
        determined.push(Determined {
            name: name(&fit.parameters[at]),
            variance_inflation: (design[(at, at)] * fit.factor.length(at).powi(2)).max(1.0),
            smallest_detectable: DETECTABLE * sigma(at),
        });
        for &other in &alone[number + 1..] {
            let correlation = correlation(at, other);
            if correlation.abs() >= STRONG && correlation.is_finite() {
                correlations.push((name(&fit.parameters[at]), name(&fit.parameters[other]), correlation));
            }
        }
    }
    let row = |&a: &usize| alone.iter().map(|&b| correlation(a, b)).collect();
    Precision {
        rank: [fit.rank, fit.parameters.len()],
        determined,
        correlations,
        correlation_matrix: alone.iter().map(row).collect(),
        not_separable: not_separable(chain, observations, fit),
        leverage: leverage(chain, observations, fit),
    }
}

fn not_separable(chain: &Chain, observations: &Observations, fit: &FitResult) -> Vec<NotSeparable> {
    let all_round = all_round(chain, observations, fit);
    // What moves nothing has nobody to be told from: it is not shown.
    let sets = fit.subspace.linked().into_iter().filter(|(members, _)| members.len() > 1);
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
    if observations.unknowns.is_some() {
        // Which poses, places and objects would do is for `objects::identify` to say.
        return Some(Vec::new());
    }
    let rows = 24 * fit.parameters.len() + 48;
    let mut spread = observations.poses.clone();
    let mut start = 0;
    spread.series = observations
        .poses
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
    let model = Model::new(chain, &spread, &fit.parameters).ok()?;
    let mut values = chain.nominal_values();
    for id in chain.symbols_of(SymbolKind::Constant) {
        values[id.index()] = fit.values[id.index()];
    }
    let partial = design(&model, &spread, &values).ok()?.spread(model.column_of());
    Some(Subspace::determined(&partial, vec![1.0; fit.parameters.len()]).linked())
}

/// Rows whose leverage is several times the mean, the largest first.
fn leverage(chain: &Chain, observations: &Observations, fit: &FitResult) -> Vec<(u64, f64)> {
    if observations.unknowns.is_some() {
        // Much of a row's own leverage goes into its object.
        return Vec::new();
    }
    let Ok(of_row) = leverages(chain, observations, fit) else { return Vec::new() };
    let mean = fit.rank as f64 / (observations.rows() as f64).max(1.0);
    let mut high: Vec<(u64, f64)> = of_row
        .into_iter()
        .enumerate()
        .filter(|(_, leverage)| *leverage > HIGH_LEVERAGE * mean)
        .map(|(row, leverage)| (observations.row_number(row), leverage))
        .collect();
    high.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    high.truncate(10);
    high
}

/// The leverage of every row.
fn leverages(chain: &Chain, observations: &Observations, fit: &FitResult) -> Result<Vec<f64>, FitError> {
    let model = Model::new(chain, &observations.poses, &fit.parameters)?;
    let by_parameter = fit.design_root();
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
        let sigma = &sigma[layout.of_rows(rows.clone())];
        let whitened =
            block.by_row(&shares).into_iter().zip(sigma).map(|(share, sigma)| share / (sigma * sigma));
        let whitened: Vec<f64> = whitened.collect();
        let by_row = whitened.chunks_exact(block.components).zip(rows);
        by_row.map(|(shares, row)| shares.iter().sum::<f64>() * fit.residuals.weight[row]).collect::<Vec<_>>()
    })?;
    Ok(blocks.concat())
}
