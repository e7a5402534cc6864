//! Accepted effects row by row, as pictures draw them: what moves at an effect's place without it, what is left with it,
//! and the fitted function with its uncertainty.

use model_core::{SymbolId, SymbolKind};

use super::units::of_reading;
use crate::search::SearchError;
use crate::search::columns::functions::Functions;
use crate::search::context::Context;
use crate::search::round::Round;
use effects::candidate::{Dependence, Effect, Function};
use observe::{Poses, SiUnit};

/// Points of a curve.
const POINTS: usize = 73;

/// Periods that a curve shows at most; of more it shows one.
const PERIODS: f64 = 20.0;

/// Rows at which a place moves the observation less than this share of the most are left out: they say nothing of it.
const SEEN: f64 = 0.3;

/// An accepted effect over the rows that are drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// The one joint or input that its function follows; none where there are more.
    pub driver: Option<SymbolId>,
    /// Unit of the driver.
    pub driver_unit: SiUnit,
    /// Unit of the motion at its place: rad or m.
    pub unit: SiUnit,
    /// What each row says that its place moves, all else declared: without this effect. None where the row hardly sees it.
    pub without: Vec<Option<f64>>,
    /// The same with the effect: what is left.
    pub left: Vec<Option<f64>>,
    /// The fitted function: driver, value, two standard uncertainties, SI; empty where it follows more than one reading.
    pub curve: Vec<[f64; 3]>,
    /// Where the function repeats too often to be drawn over the whole reading: its period, in the unit of the driver; the curve
    /// is one of it.
    pub period: Option<f64>,
}

/// Every accepted effect over some rows.
pub(crate) fn traces(
    whole: &Context<'_>,
    last: &Round<'_>,
    rows: &[usize],
) -> Result<Vec<Trace>, SearchError> {
    let fitted = &last.fitted;
    let observations = whole.request.observations.select(rows);
    let columns = fitted.probed.columns(&observations)?;
    let values = &fitted.fit.values;
    let effects: Vec<Effect> =
        fitted.found.iter().map(|found| whole.catalogue[found.effect].clone()).collect();
    let (of_effects, _) = columns.of_part(&fitted.chain, &effects, &observations.poses, values, |_| true);
    let mut traces = Vec::new();
    for ((effect, own), errors) in effects.iter().zip(&of_effects).zip(&fitted.errors) {
        let mut trace = Trace {
            driver: None,
            driver_unit: SiUnit::ONE,
            unit: effect.place.freedom.quantity().into(),
            without: vec![None; rows.len()],
            left: vec![None; rows.len()],
            curve: Vec::new(),
            period: None,
        };
        if let Some(probe) = columns.probe(effect.place) {
            let mut sums = vec![[0.0; 3]; rows.len()];
            for (at, &row) in columns.row.iter().enumerate() {
                let moved: f64 =
                    own.iter().zip(errors).map(|(column, error)| column[at] * values[error.index()]).sum();
                let [square, left, effect] = &mut sums[row as usize];
                *square += probe[at] * probe[at];
                *left += probe[at] * columns.residual[at];
                *effect += probe[at] * moved;
            }
            let most = sums.iter().map(|sum| sum[0]).fold(0.0, f64::max);
            for (row, [square, left, effect]) in sums.into_iter().enumerate() {
                if square > SEEN * SEEN * most && left.is_finite() {
                    trace.left[row] = Some(left / square);
                    trace.without[row] = Some((left + effect) / square);
                }
            }
        }
        curve(whole, last, effect, errors, &mut trace);
        traces.push(trace);
    }
    Ok(traces)
}

/// The function of an effect that follows one reading.
fn curve(whole: &Context<'_>, last: &Round<'_>, effect: &Effect, errors: &[SymbolId], trace: &mut Trace) {
    let (chain, fit) = (&last.fitted.chain, &last.fitted.fit);
    let mut readings: Vec<SymbolId> = effect
        .functions
        .iter()
        .flat_map(Function::amounts)
        .flat_map(|amount| chain.symbols_in(amount))
        .collect();
    readings.retain(|&id| matches!(chain.symbol(id).kind, SymbolKind::Joint | SymbolKind::Input));
    readings.sort_unstable();
    readings.dedup();
    let [driver] = readings[..] else { return };
    if effect.functions.iter().any(|function| !function.elsewhere.is_empty()) {
        return;
    }
    let Some(read) = whole.request.observations.poses.column(driver) else { return };
    let (low, high) =
        read.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &q| (low.min(q), high.max(q)));
    let period = match effect.form {
        Dependence::Harmonic { order } => Some(std::f64::consts::TAU / f64::from(order)),
        _ => None,
    };
    let period = period.filter(|period| (high - low) / period > PERIODS);
    let reach = period.unwrap_or(high - low);
    let grid: Vec<f64> = (0..POINTS).map(|point| low + reach * point as f64 / (POINTS - 1) as f64).collect();
    let over = Poses { columns: vec![(driver, grid.clone())], ..Poses::default() };
    let mut functions = Functions::new(chain, &over, &fit.values);
    let columns: Option<Vec<Vec<f64>>> =
        effect.functions.iter().map(|function| functions.column(&function.amount)).collect();
    let at: Option<Vec<usize>> =
        errors.iter().map(|error| fit.parameters.iter().position(|id| id == error)).collect();
    let (Some(columns), Some(at)) = (columns, at) else { return };
    trace.driver = Some(driver);
    trace.period = period;
    trace.driver_unit = of_reading(&whole.setting, chain, driver);
    trace.curve = grid
        .into_iter()
        .enumerate()
        .map(|(point, q)| {
            let f: Vec<f64> = columns.iter().map(|column| column[point]).collect();
            let value: f64 = f.iter().zip(errors).map(|(f, error)| f * fit.values[error.index()]).sum();
            let variance: f64 = (0..f.len())
                .flat_map(|i| (0..f.len()).map(move |j| (i, j)))
                .map(|(i, j)| f[i] * f[j] * fit.covariance[(at[i], at[j])])
                .sum();
            [q, value, 2.0 * variance.max(0.0).sqrt()]
        })
        .collect();
}
