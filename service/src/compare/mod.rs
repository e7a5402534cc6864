//! What changed between calibrations of one instrument: values, what is observed, and drifts.

mod history;
mod joint;
mod json;
mod observed;
mod same;
mod text;

use model_core::SymbolId;
use nalgebra::{DMatrix, DVector};
use observe::SiUnit;

use crate::Instrument;
use crate::errors_file::FoundOver;
use crate::instrument::errors_and_constants;
use crate::refusal::Refusal;

pub use history::{Drift, days};
pub use joint::Joint;
pub use json::as_json;
pub use observed::Observed;
pub use text::as_text;

/// The share of comparisons of an unchanged instrument that are called changed.
///
/// Source: convention; R. A. Fisher, Statistical Methods for Research Workers (1925), section 12.
pub const FALSE_ALARM: f64 = 0.05;

/// A calibration.
#[derive(Debug, Clone)]
pub struct File<'a> {
    /// Its name, for messages.
    pub name: String,
    /// What it says.
    pub instrument: &'a Instrument,
    /// The day of it, as `2026-11-21`, if anybody said.
    pub date: Option<String>,
}

/// A value in one file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// The value, SI.
    pub value: f64,
    /// Its standard uncertainty; none where it was held, or where the data do not determine it by itself.
    pub standard_uncertainty: Option<f64>,
}

/// An error or constant over all files.
#[derive(Debug, Clone, PartialEq)]
pub struct Value {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: SiUnit,
    /// What each file says; none where a file does not have it.
    pub points: Vec<Option<Point>>,
    /// What the last file says less what the first says, with its standard uncertainty, where both determine it.
    pub change: Option<[f64; 2]>,
    /// The chance of values as different as these where nothing changed; none where less than two files determine it.
    pub p_value: Option<f64>,
    /// The same, corrected for the number of values that were looked at.
    pub corrected: Option<f64>,
    /// How it goes over the months, where files say their days.
    pub drift: Option<Drift>,
}

impl Value {
    /// Whether it changed by more than its uncertainty.
    #[must_use]
    pub fn is_changed(&self) -> bool {
        self.corrected.is_some_and(|p_value| p_value < FALSE_ALARM / 2.0)
    }

    /// Whether some file does not have it.
    #[must_use]
    pub fn is_lacking(&self) -> bool {
        self.points.iter().any(Option::is_none)
    }
}

/// What came of the comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The files, with their days.
    pub files: Vec<(String, Option<String>)>,
    /// Every value that some file has.
    pub values: Vec<Value>,
    /// The test of all that every file determines, at once.
    pub joint: Option<Joint>,
    /// The change of what is observed, from the first file to the last.
    pub observed: Vec<Observed>,
    /// Where all files measured, by names of joints and inputs, SI.
    pub region: Vec<(String, SiUnit, [f64; 2])>,
}

impl Comparison {
    /// Whether the test of all values at once finds a change. It has half of the false alarms, and the values one by one the other half.
    #[must_use]
    pub fn is_changed_jointly(&self) -> bool {
        self.joint.is_some_and(|joint| joint.p_value < FALSE_ALARM / 2.0)
    }

    /// Whether anything changed significantly, the list of errors and effects included.
    #[must_use]
    pub fn is_changed(&self) -> bool {
        self.is_changed_jointly() || self.values.iter().any(|value| value.is_changed() || value.is_lacking())
    }
}

/// Compares two or more calibrations, the oldest first.
///
/// # Errors
/// Less than two files; files of different instruments, or without a covariance, or without a common region.
pub fn compare(files: &[File<'_>]) -> Result<Comparison, Refusal> {
    let (Some(first), Some(last)) = (files.first(), files.last().filter(|_| files.len() > 1)) else {
        return Err(Refusal::Input(
            "one file alone has nothing to compare with: name two or more".to_owned(),
        ));
    };
    for file in files {
        if file.instrument.covariance.is_none() {
            return Err(Refusal::Input(format!(
                "`{}` does not say how sure its values are: it has no [covariance]; calibrate again",
                file.name
            )));
        }
        if let Some(date) = file.date.as_ref().filter(|date| days(date).is_none()) {
            let name = &file.name;
            return Err(Refusal::Input(format!("`{name}`: `{date}` is no day: write a day, as 2026-11-21")));
        }
        same::require_same([&first.name, &file.name], [&first.instrument.chain, &file.instrument.chain])?;
    }
    let region = observed::common_region(files)?;
    let mut values = values(files);
    correct(&mut values);
    let chain = &last.instrument.chain;
    let told = region.iter().map(|range| {
        let symbol = chain.symbol(range.symbol);
        (symbol.name.clone(), SiUnit::from(symbol.quantity), [range.low, range.high])
    });
    Ok(Comparison {
        files: files.iter().map(|file| (file.name.clone(), file.date.clone())).collect(),
        joint: joint(files, &values, &region)?,
        observed: observed::changes([first, last], &region)?,
        region: told.collect(),
        values,
    })
}

/// Every error, and every constant that some file estimated or has at another value, in the order of the last file.
fn values(files: &[File<'_>]) -> Vec<Value> {
    let mut named: Vec<(&str, SiUnit)> = Vec::new();
    for instrument in files.iter().rev().map(|file| file.instrument) {
        let chain = &instrument.chain;
        for id in errors_and_constants(chain) {
            let symbol = chain.symbol(id);
            if !named.iter().any(|(name, _)| *name == symbol.name) {
                named.push((&symbol.name, symbol.quantity.into()));
            }
        }
    }
    let all = named.into_iter().map(|(name, unit)| value(files, name, unit));
    let is_told = |value: &Value| {
        let held = value.points.iter().flatten().all(|point| point.standard_uncertainty.is_none());
        let first = value.points.first().copied().flatten();
        !held || value.points.iter().any(|point| *point != first)
    };
    all.filter(is_told).collect()
}

fn value(files: &[File<'_>], name: &str, unit: SiUnit) -> Value {
    let point = |file: &File<'_>| {
        let id = file.instrument.chain.find_symbol(name)?;
        let standard_uncertainty =
            file.instrument.covariance.as_ref().and_then(|own| own.standard_uncertainty(id));
        Some(Point { value: file.instrument.values[id.index()], standard_uncertainty })
    };
    let points: Vec<Option<Point>> = files.iter().map(point).collect();
    let determined =
        |point: &Option<Point>| point.and_then(|own| Some((own.value, own.standard_uncertainty?)));
    let ends = points.first().and_then(determined).zip(points.last().and_then(determined));
    let change = ends.map(|(first, last)| [last.0 - first.0, first.1.hypot(last.1)]);
    let estimates: Vec<(DVector<f64>, DMatrix<f64>)> = points
        .iter()
        .filter_map(determined)
        .map(|(value, own)| (DVector::from_element(1, value), DMatrix::from_element(1, 1, own * own)))
        .collect();
    let dated = files.iter().zip(&points).filter_map(|(file, point)| {
        let (value, uncertainty) = determined(point)?;
        Some((days(file.date.as_deref()?)?, value, uncertainty))
    });
    Value {
        name: name.to_owned(),
        unit,
        change,
        p_value: joint::homogeneous(&estimates).map(|joint| joint.p_value),
        corrected: None,
        drift: history::drift(&dated.collect::<Vec<_>>()),
        points,
    }
}

/// Corrects each chance for the number of values.
///
/// Source: Z. Šidák, "Rectangular confidence regions for the means of multivariate normal distributions", Journal of the American Statistical
/// Association 62 (1967) 626–633.
fn correct(values: &mut [Value]) {
    let count = values.iter().filter(|value| value.p_value.is_some()).count() as f64;
    for value in values {
        value.corrected = value.p_value.map(|p_value| -(count * (-p_value).ln_1p()).exp_m1());
    }
}

/// The test of all that every file determines: of combinations that are observed in the region; where nothing says where to look, of the
/// values that every file determines by themselves.
fn joint(files: &[File<'_>], values: &[Value], region: &[FoundOver]) -> Result<Option<Joint>, Refusal> {
    let in_file = |file: &File<'_>, name: &str| {
        let id = file.instrument.chain.find_symbol(name)?;
        file.instrument.covariance.as_ref().filter(|own| own.of.contains(&id)).map(|_| id)
    };
    let is_estimated = |value: &&Value| files.iter().all(|file| in_file(file, &value.name).is_some());
    let common: Vec<&Value> = values.iter().filter(is_estimated).collect();
    let symbols = |file: &File<'_>| -> Vec<SymbolId> {
        common.iter().filter_map(|value| in_file(file, &value.name)).collect()
    };
    let Some(last) = files.last() else { return Ok(None) };
    let seen = observed::combinations(last.instrument, &symbols(last), region)?;
    let seen = seen.unwrap_or_else(|| {
        let is_alone =
            |value: &Value| value.points.iter().flatten().all(|point| point.standard_uncertainty.is_some());
        let alone: Vec<usize> = (0..common.len()).filter(|at| is_alone(common[*at])).collect();
        DMatrix::from_fn(common.len(), alone.len(), |row, column| f64::from(u8::from(row == alone[column])))
    });
    let estimates = files.iter().filter_map(|file| {
        let (symbols, covariance) = (symbols(file), file.instrument.covariance.as_ref()?);
        let value = DVector::from_fn(symbols.len(), |at, _| file.instrument.values[symbols[at].index()]);
        let own =
            DMatrix::from_fn(symbols.len(), symbols.len(), |a, b| covariance.between(symbols[a], symbols[b]));
        Some((seen.tr_mul(&value), seen.transpose() * own * &seen))
    });
    Ok(joint::homogeneous(&estimates.collect::<Vec<_>>()))
}
