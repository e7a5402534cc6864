//! The rows that pictures draw, in the units of their axes, and the same as the script reads them.

use std::fmt::Write as _;

use calibration::data::SiUnit;
use calibration::report::numbers::{self, Reading};

use crate::report::Reported;
use crate::report::residuals;

/// A column over the drawn rows.
pub struct Column {
    /// Its key for the script.
    pub key: String,
    /// What it shows, with its unit.
    pub label: String,
    /// Values in the unit of the label.
    pub values: Vec<Option<f64>>,
}

/// A residual component over the drawn rows.
pub struct Component {
    /// `across`
    pub name: &'static str,
    /// Its label with the unit.
    pub label: String,
    /// Before and after.
    pub before: Column,
    /// After.
    pub after: Column,
}

/// Everything drawn.
pub struct Rows {
    /// Number of each drawn row in its file.
    pub numbers: Vec<u64>,
    /// How many rows there are.
    pub of: usize,
    /// Whether each was set aside.
    pub aside: Vec<bool>,
    /// Joints and inputs.
    pub readings: Vec<Column>,
    /// Residual components.
    pub components: Vec<Component>,
    /// For each effect, without it and what is left, at its place.
    pub effects: Vec<[Column; 2]>,
    /// Length of the residual before and after.
    lengths: [Vec<Option<f64>>; 2],
    /// Unit of residuals.
    pub unit: Reading,
}

impl Rows {
    /// Of a calibration.
    pub fn of(reported: &Reported<'_>) -> Self {
        let calibration = reported.calibration;
        let observations = reported.observations;
        let drawn = &calibration.drawn;
        let number = |&row: &usize| observations.row_numbers.get(row).copied().unwrap_or(row as u64 + 1);
        let weight = &calibration.after.residuals.weight;
        let all = residuals::components(reported);
        let largest = all
            .iter()
            .flat_map(|component| component.before.iter().chain(&component.after))
            .flatten()
            .filter(|value| value.is_finite())
            .fold(0.0, |a: f64, b| a.max(b.abs()));
        let unit = numbers::reading(calibration.diagnosis.unit, largest);
        let column = |key: String, label: &str, values: &[Option<f64>], reading: &Reading| Column {
            key,
            label: label.to_owned(),
            values: drawn.iter().map(|&row| values[row].map(|si| si / reading.in_si)).collect(),
        };
        let components: Vec<Component> = all
            .iter()
            .map(|component| {
                let reading = if component.unit == calibration.diagnosis.unit {
                    unit.clone()
                } else {
                    numbers::reading(component.unit, largest)
                };
                let label = numbers::name_with_unit(component.name, &reading.name);
                Component {
                    name: component.name,
                    before: column(format!("{} before", component.name), &label, &component.before, &reading),
                    after: column(format!("{} after", component.name), &label, &component.after, &reading),
                    label,
                }
            })
            .collect();
        let readings = calibration.diagnosis.instrument.readings.iter().zip(&observations.poses.columns);
        let readings = readings.map(|(shown, (_, values))| {
            let reading = numbers::reading(shown.unit, axis_size(shown.unit, &shown.range));
            Column {
                key: shown.name.clone(),
                label: numbers::name_with_unit(&shown.name, &reading.name),
                values: drawn.iter().map(|&row| Some(values[row] / reading.in_si)).collect(),
            }
        });
        let effects = calibration.traces.iter().zip(1..).map(|(trace, number): (_, usize)| {
            let reading = trace_reading(trace);
            ["without", "left"].map(|kind| Column {
                key: format!("effect {number} {kind}"),
                label: reading.name.clone(),
                values: (if kind == "left" { &trace.left } else { &trace.without })
                    .iter()
                    .map(|value| value.map(|si| si / reading.in_si))
                    .collect(),
            })
        });
        let length = |which: fn(&Component) -> &Column| -> Vec<Option<f64>> {
            (0..drawn.len())
                .map(|at| {
                    let parts = components.iter().filter_map(|component| which(component).values[at]);
                    let (sum, count) = parts.fold((0.0, 0), |(sum, count), v| (sum + v * v, count + 1));
                    (count > 0).then(|| f64::sqrt(sum))
                })
                .collect()
        };
        Self {
            numbers: drawn.iter().map(number).collect(),
            of: observations.rows(),
            aside: drawn.iter().map(|&row| weight.get(row) == Some(&0.0)).collect(),
            readings: readings.collect(),
            effects: effects.collect(),
            lengths: [length(|component| &component.before), length(|component| &component.after)],
            components,
            unit,
        }
    }

    /// What the script reads.
    pub fn json(&self) -> String {
        let list = |values: &[Option<f64>]| {
            let told = values.iter().map(|value| match value {
                Some(value) if value.is_finite() => short(*value),
                _ => "null".to_owned(),
            });
            format!("[{}]", told.collect::<Vec<_>>().join(","))
        };
        let numbers = self.numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
        let aside = self.aside.iter().map(|&aside| u8::from(aside).to_string()).collect::<Vec<_>>().join(",");
        let mut columns = String::new();
        let order = Column {
            key: "order".to_owned(),
            label: String::new(),
            values: self.numbers.iter().map(|&number| Some(number as f64)).collect(),
        };
        let of_components =
            self.components.iter().flat_map(|component| [&component.before, &component.after]);
        let each =
            self.readings.iter().chain(of_components).chain(self.effects.iter().flatten()).chain([&order]);
        for column in each {
            let comma = if columns.is_empty() { "" } else { "," };
            let _ = write!(columns, "{comma}{}:{}", quoted(&column.key), list(&column.values));
        }
        let names = self.readings.iter().map(|reading| quoted(&reading.key)).collect::<Vec<_>>().join(",");
        format!(
            "{{\"rows\":[{numbers}],\"of\":{},\"unit\":{},\"aside\":[{aside}],\"readings\":[{names}],\"before\":{},\
             \"after\":{},\"columns\":{{{columns}}}}}",
            self.of,
            quoted(&self.unit.name),
            list(&self.lengths[0]),
            list(&self.lengths[1])
        )
    }
}

/// Text as JSON has it, and as markup lets it stand in a script.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string().replace('<', "\\u003c")
}

/// Four significant digits: finer than a picture shows.
fn short(value: f64) -> String {
    let text = format!("{value:.3e}");
    let plain: f64 = text.parse().unwrap_or(value);
    format!("{plain}")
}

/// The unit in which an effect is drawn.
pub fn trace_reading(trace: &calibration::diagnose::Trace) -> Reading {
    let all = trace.without.iter().chain(&trace.left).flatten();
    numbers::reading(trace.unit, all.fold(0.0, |a: f64, b| a.max(b.abs())))
}

/// The size by which a reading's unit is chosen: angles of joints in degrees, however small.
pub fn axis_size(unit: SiUnit, range: &[f64; 2]) -> f64 {
    if unit == SiUnit::RAD { 1.0 } else { range[0].abs().max(range[1].abs()) }
}
