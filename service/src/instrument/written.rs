//! A calibration as an instrument file.

use std::fmt::Write as _;

use fit::noise::Layout;
use model_core::unit::Unit;
use model_core::{Chain, Quantity, SymbolKind};
use report::Reported;
use study::WrittenColumn;
use toml::{Table, Value};

use super::file::VERSION;
use crate::errors_file;

/// Keys of a study that say what the columns of its data mean.
const OF_COLUMNS: [&str; 12] = [
    "chain",
    "observable",
    "data",
    "id",
    "separator",
    "comment",
    "memory",
    "site",
    "trajectory",
    "columns",
    "observed",
    "also",
];

/// The same in tables of a study, by which inputs follow from other columns.
const OF_INPUTS: [(&str, &[&str]); 2] = [("search", &["inputs", "sequence"]), ("noise", &["order"])];

/// `instrument.toml`, where a usable model came out; `observed` is how each source writes what was observed, and `valid_until` the last
/// day on which it is to count, as `2027-06-30`.
#[must_use]
pub fn instrument(
    reported: &Reported<'_>,
    observed: &[Vec<WrittenColumn>],
    valid_until: Option<&str>,
) -> Option<String> {
    let calibration = reported.calibration;
    let amended = calibration.amended.as_ref()?;
    let over = errors_file::found_over_of(reported)?;
    let made = reported.provenance;
    let mut text = format!(
        "# Instrument {}, calibrated on {} with trueaxis {}.\n# `trueaxis apply`, `eval`, `generate`, `identify`, `bound` and `budget` take \
         this file in place of a declaration.\n{} = {VERSION}\n",
        calibration.chain.name,
        made.date,
        made.version,
        crate::source::INSTRUMENT,
    );
    if let Some(date) = valid_until {
        let _ = writeln!(text, "valid-until = {date}");
    }
    let _ = writeln!(text, "\nchain = {}", text_in_toml(amended));
    let _ = writeln!(text, "\n# Estimates, and errors that were held at a value.\n[errors]");
    let lines = errors_file::lines_of(reported);
    lines.iter().filter(|(kind, _)| *kind == SymbolKind::Error).for_each(|(_, line)| text.push_str(line));
    text.push_str(&constants(&calibration.chain, &calibration.after.values));
    text.push_str(&errors_file::ranges_of_readings(&calibration.chain, &over));
    text.push_str(&covariance(reported));
    text.push_str(&noise(reported));
    text.push_str(&study(reported, observed));
    text.push_str(&provenance(reported));
    Some(text)
}

/// Every constant with the value that the calibration used.
fn constants(chain: &Chain, values: &[f64]) -> String {
    let mut text = String::new();
    for id in chain.symbols_of(SymbolKind::Constant) {
        let symbol = chain.symbol(id);
        let value = errors_file::written_value(values[id.index()], symbol.quantity);
        let _ = writeln!(text, "{} = {value}", errors_file::key(&symbol.name));
    }
    if text.is_empty() { text } else { format!("\n[constants]\n{text}") }
}

/// How sure the estimates are together, as far as the data say; of every row where a part was searched.
fn covariance(reported: &Reported<'_>) -> String {
    let calibration = reported.calibration;
    let (chain, fit) = (&calibration.chain, &calibration.after);
    let count = fit.parameters.len();
    let name = |at: usize| &chain.symbol(fit.parameters[at]).name;
    // What every row says makes the ± another one than that of the rows that were searched.
    let factor: Vec<f64> = (0..count)
        .map(|at| {
            let found = calibration.diagnosis.errors.iter().find(|error| error.name == *name(at));
            let told = found.and_then(|error| error.standard_uncertainty);
            let own = fit.covariance[(at, at)].sqrt();
            told.filter(|_| own > 0.0).map_or(1.0, |told| told / own)
        })
        .collect();
    let entry = |row: usize, column: usize| fit.covariance[(row, column)] * factor[row] * factor[column];
    let is_finite = (0..count).all(|row| (0..count).all(|column| entry(row, column).is_finite()));
    if count == 0 || !is_finite {
        return String::new();
    }
    let list = |names: &[usize]| {
        let quoted: Vec<String> =
            names.iter().map(|at| Value::from(name(*at).as_str()).to_string()).collect();
        quoted.join(", ")
    };
    let all: Vec<usize> = (0..count).collect();
    let undetermined: Vec<usize> = all.iter().copied().filter(|at| !fit.separable[*at]).collect();
    let mut text = format!(
        "\n# Covariance of the estimates, SI. Of those that the data do not determine by themselves it has what was known before.\n\
         [covariance]\nof = [{}]\nundetermined = [{}]\nrows = [\n",
        list(&all),
        list(&undetermined)
    );
    for row in 0..count {
        // Of both sides of the diagonal the same number.
        let numbers: Vec<String> =
            (0..count).map(|column| format!("{:?}", entry(row.max(column), row.min(column)))).collect();
        let _ = writeln!(text, "  [{}],", numbers.join(", "));
    }
    text + "]\n"
}

/// How uncertain one observation of each source is, whatever the row before says of it; rows that were set aside do not count.
fn noise(reported: &Reported<'_>) -> String {
    let (fit, observations) = (&reported.calibration.after, reported.observations);
    let (sigma, layout) = (fit.noise.sigma_without_memory(), Layout::of(observations));
    let counts = |row: usize| fit.residuals.weight.get(row).is_some_and(|weight| *weight > 0.0);
    let mut text = String::new();
    for series in &observations.poses.series {
        let components = series.measure.components();
        let own = sigma.get(layout.of_rows(series.rows.clone())).unwrap_or_default();
        let kept = || series.rows.clone().zip(own.chunks_exact(components)).filter(|(row, _)| counts(*row));
        let count = kept().count() as f64;
        let rms = |at: usize| (kept().map(|(_, own)| own[at] * own[at]).sum::<f64>() / count).sqrt();
        let numbers: Vec<f64> = (0..components).map(rms).collect();
        if numbers.iter().any(|sigma| !sigma.is_finite() || *sigma <= 0.0) {
            return String::new();
        }
        let names: Vec<String> =
            series.measure.component_names().iter().map(|name| Value::from(*name).to_string()).collect();
        let numbers: Vec<String> = numbers.iter().map(|sigma| format!("{sigma:?}")).collect();
        let _ = writeln!(
            text,
            "\n[[noise]]\ncomponents = [{}]\nsigma = [{}]",
            names.join(", "),
            numbers.join(", ")
        );
        let is_estimated = fit.parameter_degrees_of_freedom.iter().any(|own| own.is_finite());
        if is_estimated && fit.degrees_of_freedom.is_finite() && fit.degrees_of_freedom >= 1.0 {
            let _ = writeln!(text, "degrees-of-freedom = {:?}", fit.degrees_of_freedom);
        }
    }
    format!("\n# Standard deviation of one observation, SI, component by component, source by source.{text}")
}

/// What the study says of columns, and how its data write what is observed.
fn study(reported: &Reported<'_>, observed: &[Vec<WrittenColumn>]) -> String {
    let Ok(whole) = toml::from_str::<Table>(&reported.provenance.study) else {
        unreachable!("a study was read as TOML before it was calibrated")
    };
    let mut kept: Table = whole
        .iter()
        .filter(|(key, _)| OF_COLUMNS.contains(&key.as_str()))
        .map(|(k, v)| (k.clone(), v.clone()))
        .collect();
    for (table, keys) in OF_INPUTS {
        let Some(Value::Table(own)) = whole.get(table) else { continue };
        let own = own.iter().filter(|(key, _)| keys.contains(&key.as_str()));
        let own: Table = own.map(|(key, value)| (key.clone(), value.clone())).collect();
        if !own.is_empty() {
            kept.insert(table.to_owned(), Value::Table(own));
        }
    }
    let mut corrected = Vec::new();
    for (source, columns) in reported.plan.sources.iter().zip(observed) {
        let mut own = Table::new();
        let turns = source.filled().is_some_and(|filled| filled.turns);
        for (at, (plan, column)) in source.observed_columns().zip(columns).enumerate() {
            let mut entry = Table::new();
            entry.insert("heading".to_owned(), Value::from(column.heading.as_str()));
            if let Some(unit) = unit(plan.quantity, column) {
                entry.insert("unit".to_owned(), Value::from(unit));
            }
            if turns && at == 0 {
                let from_deg = if column.below_zero { -180.0 } else { 0.0 };
                entry.insert("from-deg".to_owned(), Value::from(from_deg));
            }
            own.insert(plan.key.to_owned(), Value::Table(entry));
        }
        corrected.push(Value::Table(own));
    }
    let tables = [
        ("# What the columns of the data mean, as the study says it.", "study", Value::Table(kept)),
        (
            "# How `trueaxis apply` writes what is observed: as the data do.",
            "corrected",
            Value::Array(corrected),
        ),
    ];
    tables.into_iter().map(|(remark, key, value)| format!("\n{remark}\n{}", in_toml(key, value))).collect()
}

/// The unit of a column, where it has one.
fn unit(quantity: Quantity, column: &WrittenColumn) -> Option<&'static str> {
    let in_si = column.in_si?;
    let of_size = |unit: &Unit| unit.measures() == quantity.into() && unit.in_si() == in_si;
    Unit::all().find(of_size).filter(|unit| unit.name() != "1").map(|unit| unit.name())
}

/// Version, command, date, and the files with their checksums.
fn provenance(reported: &Reported<'_>) -> String {
    let made = reported.provenance;
    let mut own = Table::new();
    for (key, value) in
        [("trueaxis", made.version), ("command", made.command.as_str()), ("date", made.date.as_str())]
    {
        own.insert(key.to_owned(), Value::from(value));
    }
    let files = made.files.iter().map(|file| {
        let mut entry = Table::new();
        entry.insert("path".to_owned(), Value::from(file.path.as_str()));
        if let Some(sha256) = &file.sha256 {
            entry.insert("sha256".to_owned(), Value::from(sha256.as_str()));
        }
        Value::Table(entry)
    });
    own.insert("files".to_owned(), Value::Array(files.collect()));
    format!("\n{}", in_toml("provenance", Value::Table(own)))
}

/// One key with its table, or tables, as TOML.
fn in_toml(key: &str, value: Value) -> String {
    let table = Table::from_iter([(key.to_owned(), value)]);
    toml::to_string(&table)
        .unwrap_or_else(|error| unreachable!("tables of texts and numbers are TOML: {error}"))
}

/// A text of several lines as a value: letter by letter where that can be, so that a mistake in it has its line.
fn text_in_toml(text: &str) -> String {
    let is_plain = |letter: char| !letter.is_control() || letter == '\n' || letter == '\t';
    if text.contains("'''") || text.ends_with('\'') || !text.chars().all(is_plain) {
        return Value::from(text).to_string();
    }
    format!("'''\n{text}'''")
}
