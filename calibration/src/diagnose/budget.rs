//! Uncertainty budgets as the GUM writes them: of each error, and of a corrected reading.
//!
//! Source: JCGM 100:2008 (GUM), 5.1 and annex G.4 (effective degrees of freedom of Welch and Satterthwaite).

use model_core::{Chain, SymbolId};
use serde::Serialize;

use super::ErrorFound;
use fit::noise::Layout;
use fit::{Estimable, FitError, FitResult, FromReference, Input, Model, residuals};
use observe::{Observations, SiUnit};

/// The confidence of the expanded uncertainty.
const CONFIDENCE: f64 = 0.95;

/// Rows at most among which the least certain correction is looked for.
const ROWS: usize = 1000;

/// By how much each error is moved to either side, SI.
const STEP: f64 = 1e-6;

/// The budget of one result.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Budget {
    /// The error, or `corrected reading`.
    pub of: String,
    /// Of a corrected reading its row and its component, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place: Option<[u64; 2]>,
    /// Its SI unit.
    pub unit: SiUnit,
    /// What has part in it, the noise first.
    pub parts: Vec<BudgetPart>,
    /// All together, SI.
    pub standard_uncertainty: f64,
    /// By Welch and Satterthwaite; absent where they are infinite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub effective_degrees_of_freedom: Option<f64>,
    /// The coverage factor for 95 %, Student's t with those.
    pub coverage: f64,
    /// The standard uncertainty times that, SI.
    pub expanded_uncertainty: f64,
}

/// What an input has part in.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BudgetPart {
    /// Which.
    pub input: &'static str,
    /// `A`, from the scatter of these rows, or `B`, stated.
    pub kind: &'static str,
    /// Its standard uncertainty.
    pub of_input: f64,
    /// The unit of that.
    pub input_unit: SiUnit,
    /// What the input adds over its standard uncertainty; of several axes or targets the root of the sum of squares.
    pub sensitivity: f64,
    /// What it adds, SI.
    pub contribution: f64,
    /// Absent where they are infinite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub degrees_of_freedom: Option<f64>,
}

/// The budget of each error that these data determine, and of the least certain corrected reading; none where nothing is stated of the
/// reference.
pub(super) fn budgets(
    chain: &Chain,
    observations: &Observations,
    fit: &FitResult,
    errors: &[ErrorFound],
) -> Result<Vec<Budget>, FitError> {
    if fit.from_reference.is_empty() {
        return Ok(Vec::new());
    }
    let of_error = |(at, id): (usize, &SymbolId)| {
        let name = &chain.symbol(*id).name;
        let error = errors.iter().find(|error| error.name == *name)?;
        let uncertainty = error.standard_uncertainty?;
        let freedom = fit.parameter_degrees_of_freedom[at];
        let stated = stated(fit, &[(at, 1.0)]);
        let noise = (uncertainty.powi(2) - sum_of_squares(&stated)).max(0.0).sqrt();
        // Only the noise has degrees of freedom that end.
        let own = freedom * (noise / uncertainty).powi(4);
        let rows = scatter("scatter of the rows", noise, error.unit, own);
        budget(name.clone(), None, error.unit, std::iter::once(rows).chain(stated).collect())
    };
    let mut budgets: Vec<Budget> = fit.parameters.iter().enumerate().filter_map(of_error).collect();
    budgets.extend(of_reading(chain, observations, fit)?);
    Ok(budgets)
}

/// The budget of the corrected reading whose correction is least certain: what remains of it is the noise of its own row and the error of
/// its correction.
fn of_reading(
    chain: &Chain,
    observations: &Observations,
    fit: &FitResult,
) -> Result<Option<Budget>, FitError> {
    let layout = Layout::of(observations);
    let few: Vec<usize> =
        (0..observations.rows()).step_by(observations.rows().div_ceil(ROWS).max(1)).collect();
    let rows = observations.select(&few);
    let model = Model::without_columns(chain, &rows.poses);
    let mut columns = Vec::new();
    for id in &fit.parameters {
        let there = |side: f64| {
            let mut values = fit.values.clone();
            values[id.index()] += side * STEP;
            residuals(&model, &rows, &values)
        };
        let both = there(1.0)?.into_iter().zip(there(-1.0)?);
        columns.push(both.map(|(above, below)| (below - above) / (2.0 * STEP)).collect::<Vec<f64>>());
    }
    let p = fit.parameters.len();
    let variance = |own: &Vec<(usize, f64)>| fit::variance_of(own, |i, j| fit.covariance[(i, j)]);
    let components = few.iter().flat_map(|&row| layout.of_rows(row..row + 1).map(move |at| (row, at)));
    let each = components.enumerate().filter(|(_, (row, _))| fit.residuals.weight[*row] > 0.0);
    let each =
        each.map(|(own, (row, at))| ((0..p).map(|k| (k, columns[k][own])).collect::<Vec<_>>(), row, at));
    let each = each.filter(|(own, ..)| variance(own).is_finite());
    let Some((own, row, at)) = each.max_by(|one, other| variance(&one.0).total_cmp(&variance(&other.0)))
    else {
        return Ok(None);
    };
    let Some(series) = observations.poses.series.iter().find(|series| series.rows.contains(&row)) else {
        return Ok(None);
    };
    let unit = series.measure.unit();
    let stated = stated(fit, &own);
    let noise = (variance(&own) - sum_of_squares(&stated)).max(0.0).sqrt();
    let of_row = fit.noise.sigma_without_memory()[at];
    let freedom = fit.degrees_of_freedom;
    let parts = [
        scatter("scatter of one reading", of_row, unit, freedom),
        scatter("scatter of the rows, by the errors", noise, unit, freedom),
    ];
    let place = [observations.row_number(row), (at - layout.first(row) + 1) as u64];
    Ok(budget("corrected reading".to_owned(), Some(place), unit, parts.into_iter().chain(stated).collect()))
}

/// What the stated inputs add to a combination of errors.
fn stated(fit: &FitResult, combination: &[(usize, f64)]) -> Vec<BudgetPart> {
    let part = |own: &FromReference| {
        let (input, input_unit) = match own.input {
            Input::Scale => ("scale of the reference", SiUnit::ONE),
            Input::Targets => ("coordinates of targets", SiUnit::METRE),
            Input::Rotation => ("rotation of the reference frame", SiUnit::RAD),
            Input::Shift => ("origin of the reference frame", SiUnit::METRE),
        };
        let contribution = own.contribution(combination);
        let sensitivity = contribution / own.sigma;
        BudgetPart {
            input,
            kind: "B",
            of_input: own.sigma,
            input_unit,
            sensitivity,
            contribution,
            degrees_of_freedom: None,
        }
    };
    fit.from_reference.iter().map(part).collect()
}

fn scatter(input: &'static str, size: f64, unit: SiUnit, degrees_of_freedom: f64) -> BudgetPart {
    BudgetPart {
        input,
        kind: "A",
        of_input: size,
        input_unit: unit,
        sensitivity: 1.0,
        contribution: size,
        degrees_of_freedom: Some(degrees_of_freedom).filter(|freedom| freedom.is_finite()),
    }
}

fn sum_of_squares(parts: &[BudgetPart]) -> f64 {
    parts.iter().map(|part| part.contribution.powi(2)).sum()
}

/// All together; none without any degrees of freedom.
fn budget(of: String, place: Option<[u64; 2]>, unit: SiUnit, parts: Vec<BudgetPart>) -> Option<Budget> {
    let variance = sum_of_squares(&parts);
    let of_freedom = |part: &BudgetPart| part.degrees_of_freedom.map(|own| part.contribution.powi(4) / own);
    let fourths: f64 = parts.iter().filter_map(of_freedom).filter(|own| own.is_finite()).sum();
    let freedom = if fourths > 0.0 { variance.powi(2) / fourths } else { f64::INFINITY };
    let standard_uncertainty = variance.sqrt();
    let own = Estimable {
        combination: Vec::new(),
        value: 0.0,
        standard_uncertainty: Some(standard_uncertainty),
        degrees_of_freedom: freedom,
    };
    let expanded_uncertainty = own.half_width(CONFIDENCE)?;
    Some(Budget {
        of,
        place,
        unit,
        parts,
        standard_uncertainty,
        effective_degrees_of_freedom: Some(freedom).filter(|freedom| freedom.is_finite()),
        coverage: expanded_uncertainty / standard_uncertainty,
        expanded_uncertainty,
    })
}
