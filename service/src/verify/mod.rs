//! Whether a calibration is still valid, by a few new rows: still valid, recalibrate, or cannot say with these rows.

mod added;
mod agreement;
mod chance;
mod json;
mod policy;
mod rows;
mod text;

use nalgebra::{DMatrix, DVector};
use observe::SiUnit;
use study::OpenTable;

use crate::Instrument;
use crate::refusal::Refusal;
use crate::warn::Warn;
use agreement::{Agreement, agreement};
use chance::Squares;
use rows::Rows;

pub use added::Added;
pub use agreement::Part;
pub use json::as_json;
pub use policy::FALSE_ALARM;
pub use text::as_text;

/// What is asked.
pub struct Asked<'a> {
    /// The change of what is observed, root mean square over the measured region, that matters, as it is written; by default what one
    /// observation of the instrument is uncertain by.
    pub goal: Option<&'a str>,
    /// The chance of RECALIBRATE for an instrument that did not change.
    pub false_alarm: f64,
}

/// The answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The rows agree with the calibration, and would have shown a change as large as the goal.
    StillValid,
    /// The instrument changed, by surely less than the goal.
    BelowGoal,
    /// The rows disagree with the calibration.
    Recalibrate,
    /// The rows agree, and could not have shown a change as large as the goal.
    CannotSay,
    /// No row lies inside the measured region.
    NoRows,
    /// The rows disagree so much that a column is misread.
    Misread,
}

/// What an error says of the rows, and they of it.
#[derive(Debug, Clone, PartialEq)]
pub struct OfError {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: SiUnit,
    /// Its change, if nothing else changed, with its standard uncertainty, SI; none where these rows say nothing of it.
    pub change: Option<[f64; 2]>,
    /// By how much that makes the sum of squares less.
    pub gain: f64,
    /// The change of what is observed, root mean square over the measured region, rad or m, that these rows show by this error alone.
    pub shown: f64,
    /// The least that any number of rows shows, by what the calibration itself leaves uncertain.
    pub least: f64,
}

/// The answer with what it rests on.
#[derive(Debug, Clone, PartialEq)]
pub struct Verified {
    /// The answer.
    pub verdict: Verdict,
    /// `rad` or `m`.
    pub unit: SiUnit,
    /// The name of the observable.
    pub observable: String,
    /// The change that matters, root mean square over the measured region.
    pub goal: f64,
    /// Whether somebody asked for it.
    pub goal_is_asked: bool,
    /// The chance of a false alarm.
    pub false_alarm: f64,
    /// Rows that were judged, by their numbers in the file.
    pub judged: Vec<u64>,
    /// Rows outside of the measured region.
    pub outside: Vec<u64>,
    /// Rows for which the chain has no finite value.
    pub undefined: Vec<u64>,
    /// Root mean square of the residuals' lengths.
    pub rms: f64,
    /// What of the disagreement a change of errors explains.
    pub explained: Part,
    /// What no change of errors explains.
    pub rest: Part,
    /// The chance of as much where nothing changed: of both parts together.
    pub p_value: f64,
    /// Every error that moves what is observed.
    pub errors: Vec<OfError>,
    /// The change of what is observed that explains the rows best, root mean square over the measured region, with its standard uncertainty.
    pub change: [f64; 2],
    /// The errors that explain the rows alone, the best first; empty where none does.
    pub explaining: Vec<usize>,
    /// The row without which the others agree, by its number.
    pub one_row: Option<u64>,
    /// Rows that would make the check conclusive.
    pub added: Option<Added>,
    /// The units of joints and inputs.
    pub units: Vec<(String, SiUnit)>,
}

impl Verified {
    /// Whether the calibration may be used on.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        matches!(self.verdict, Verdict::StillValid | Verdict::BelowGoal)
    }
}

/// Checks an instrument with the rows of a table.
///
/// # Errors
/// The instrument lacks what a check needs, the table cannot be read, or the goal is of another quantity.
pub fn verify(
    instrument: &Instrument,
    file: &str,
    open: &mut OpenTable<'_>,
    asked: &Asked<'_>,
    warn: Warn<'_>,
) -> Result<Verified, Refusal> {
    if !(asked.false_alarm > 0.0 && asked.false_alarm < 1.0) {
        return Err(Refusal::Input("a chance of a false alarm lies between 0 and 1: write 0.05".to_owned()));
    }
    let rows = Rows::read(instrument, file, open, warn)?;
    let unit = rows.measure().unit();
    let expected = rows.sigma.iter().map(|sigma| sigma * sigma).sum::<f64>().sqrt();
    let goal = asked.goal.map(|text| wanted(text, unit)).transpose()?;
    let found = agreement(
        &rows
            .whitened(&DMatrix::from_column_slice(rows.residual.len(), 1, rows.residual.as_slice()))
            .column(0)
            .into_owned(),
        &rows.whitened(&rows.columns),
        &rows.covariance,
        rows.sigma.len(),
        rows.noise,
    );
    let level = level(asked.false_alarm, &found);
    let mut verified = judged(&rows, &found, goal.unwrap_or(expected), asked.false_alarm, level);
    verified.goal_is_asked = goal.is_some();
    if verified.verdict == Verdict::CannotSay || verified.verdict == Verdict::NoRows {
        verified.added = added::added(&rows, &instrument.found, verified.goal, level)?;
    }
    Ok(verified)
}

/// A goal in rad or m.
fn wanted(text: &str, unit: SiUnit) -> Result<f64, Refusal> {
    let quantity = match unit {
        SiUnit::RAD => model_core::Quantity::Angle,
        SiUnit::METRE => model_core::Quantity::Length,
        _ => model_core::Quantity::Number,
    };
    let goal =
        tables::units::parse(text, quantity).map_err(|why| Refusal::Input(format!("--goal: {why}")))?;
    if goal > 0.0 {
        return Ok(goal);
    }
    let example = tables::units::example(quantity);
    Err(Refusal::Input(format!("--goal: `{text}` is no size: write a size above zero, such as {example}")))
}

/// The level of each part, so that both together alarm with this chance: the parts are independent.
fn level(false_alarm: f64, found: &Agreement) -> f64 {
    let both = found.explained.freedom > 0 && found.rest.freedom > 0;
    if both { 1.0 - (1.0 - false_alarm).sqrt() } else { false_alarm }
}

fn judged(rows: &Rows, found: &Agreement, goal: f64, false_alarm: f64, level: f64) -> Verified {
    let [explained, rest] = [found.explained, found.rest];
    let smaller = explained.p_value.min(rest.p_value);
    let both = explained.freedom > 0 && rest.freedom > 0;
    let p_value = if both { 1.0 - (1.0 - smaller).powi(2) } else { smaller };
    let is_rejected = smaller < level;
    let needed = Squares::new(explained.freedom.max(1), rows.noise).needed(level, policy::POWER);
    let errors = of_errors(rows, found, needed);
    let change = change_of_region(rows, found);
    let count = rows.inside.len() as f64;
    let rms = if count > 0.0 { rows.residual.norm() / count.sqrt() } else { 0.0 };
    let is_shown = errors.iter().all(|error| error.shown <= goal);
    let limit = change[0] + normal_quantile(policy::BELOW_GOAL) * change[1];
    let verdict = if rows.inside.is_empty() {
        Verdict::NoRows
    } else if rms > policy::MISREAD * goal && is_rejected {
        Verdict::Misread
    } else if is_rejected {
        let is_below = rest.p_value >= level && is_shown && limit <= goal;
        if is_below { Verdict::BelowGoal } else { Verdict::Recalibrate }
    } else if is_shown {
        Verdict::StillValid
    } else {
        Verdict::CannotSay
    };
    let total = explained.sum + rest.sum;
    let parts = explained.freedom + rest.freedom;
    let agrees = |sum: f64, used: usize| {
        parts > used && Squares::new(parts - used, rows.noise).beyond(sum.max(0.0)) >= false_alarm
    };
    let one_row = most(&found.gain_of_row).filter(|_| verdict == Verdict::Recalibrate);
    let one_row = one_row.filter(|(_, gain)| agrees(total - gain, rows.sigma.len()));
    let explaining =
        if is_rejected { explaining(&errors, |gain| agrees(total - gain, 1)) } else { Vec::new() };
    Verified {
        verdict,
        unit: rows.measure().unit(),
        observable: rows.chain.observable(rows.watched.observable).name.clone(),
        goal,
        goal_is_asked: false,
        false_alarm,
        judged: rows.inside.clone(),
        outside: rows.outside.clone(),
        undefined: rows.undefined.clone(),
        rms,
        explained,
        rest,
        p_value,
        one_row: one_row
            .filter(|(_, gain)| {
                explaining.first().is_none_or(|best: &usize| errors[*best].gain + policy::AS_WELL < *gain)
            })
            .map(|(row, _)| rows.inside[row]),
        errors,
        change,
        explaining,
        added: None,
        units: rows
            .chain
            .symbols
            .iter()
            .map(|symbol| (symbol.name.clone(), symbol.quantity.into()))
            .collect(),
    }
}

/// What the rows say of each error alone, and what they could show of it.
fn of_errors(rows: &Rows, found: &Agreement, needed: f64) -> Vec<OfError> {
    let least = least_shown(&rows.covariance, needed);
    let of = |(at, (symbol, size)): (usize, &(model_core::SymbolId, f64))| {
        let declared = rows.chain.symbol(*symbol);
        let (information, score) = (found.information[at], found.score[at]);
        let is_seen = information > 0.0 && information.is_finite();
        OfError {
            name: declared.name.clone(),
            unit: declared.quantity.into(),
            change: is_seen.then(|| [score / information * size, size / information.sqrt()]),
            gain: if is_seen { score * score / information } else { 0.0 },
            shown: if is_seen { (needed / information).sqrt() } else { f64::INFINITY },
            least: least[at],
        }
    };
    rows.errors.iter().enumerate().map(of).collect()
}

/// The change of each error that rows without number would show.
fn least_shown(covariance: &DMatrix<f64>, needed: f64) -> Vec<f64> {
    let count = covariance.nrows();
    let scale = DVector::from_fn(count, |at, _| covariance[(at, at)].sqrt());
    if scale.iter().any(|own| *own <= 0.0) {
        return vec![0.0; count];
    }
    let correlation = DMatrix::from_fn(count, count, |a, b| covariance[(a, b)] / scale[a] / scale[b]);
    let Some(inverse) = correlation.try_inverse() else { return vec![0.0; count] };
    (0..count).map(|at| scale[at] * (needed / inverse[(at, at)].max(f64::MIN_POSITIVE)).sqrt()).collect()
}

/// The change of what is observed that explains the rows best, root mean square over the measured region, with its standard uncertainty.
fn change_of_region(rows: &Rows, found: &Agreement) -> [f64; 2] {
    let poses = (rows.of_region.nrows() / rows.sigma.len().max(1)) as f64;
    let moved = &rows.of_region * &found.change;
    let rms = (moved.norm_squared() / poses).sqrt();
    if rms <= 0.0 || !rms.is_finite() {
        return [0.0, 0.0];
    }
    let along = rows.of_region.tr_mul(&moved) / (poses * rms);
    [rms, (along.transpose() * &found.uncertainty * &along)[(0, 0)].max(0.0).sqrt()]
}

/// The errors that explain all alone, the best first, and what explains it as well.
fn explaining(errors: &[OfError], agrees: impl Fn(f64) -> bool) -> Vec<usize> {
    let mut sorted: Vec<usize> = (0..errors.len()).filter(|at| agrees(errors[*at].gain)).collect();
    sorted.sort_by(|a, b| errors[*b].gain.total_cmp(&errors[*a].gain));
    let best = sorted.first().map_or(0.0, |at| errors[*at].gain);
    sorted.retain(|at| errors[*at].gain >= best - policy::AS_WELL);
    sorted
}

fn most(values: &[f64]) -> Option<(usize, f64)> {
    values.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
}

fn normal_quantile(part: f64) -> f64 {
    use statrs::distribution::{ContinuousCDF as _, Normal};
    Normal::standard().inverse_cdf(part)
}
