//! The rows that pictures draw, in the units of their axes, and the same as the script reads them.

use std::fmt::Write as _;

use crate::words::numbers::{self, Reading};
use crate::words::side;
use model_core::escape::json_in_script;
use observe::SiUnit;

use crate::Reported;
use crate::residuals;

/// Bytes that the marks and numbers of rows may take in the page, about.
const BYTES: usize = 620_000;

/// A column over the drawn rows.
pub struct Column {
    /// Its key for the script.
    pub key: String,
    /// What it shows, with its unit.
    pub label: String,
    /// Values in the unit of the label.
    pub values: Vec<Option<f64>>,
    /// That unit, in SI.
    pub in_si: f64,
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
    /// What is left, of every row, drawn or not, in SI; nothing before where nothing changed.
    pub every: residuals::Component,
}

/// Everything drawn.
pub struct Rows {
    /// Number of each drawn row in its file.
    pub numbers: Vec<u64>,
    /// How many rows there are.
    pub of: usize,
    /// Whether each drawn row was set aside.
    pub aside: Vec<bool>,
    /// Whether each of all rows was set aside.
    pub every_aside: Vec<bool>,
    /// Whether anything was added to the declaration: else what was before is what is after.
    pub changed: bool,
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
        let weight = &calibration.after.residuals.weight;
        let every_aside: Vec<bool> =
            (0..observations.rows()).map(|row| weight.get(row) == Some(&0.0)).collect();
        let all = residuals::components(reported, &(0..observations.rows()).collect::<Vec<_>>());
        let places = thinned(
            &calibration.drawn,
            &every_aside,
            bytes_of_a_row(observations.poses.columns.len(), all.len(), calibration.traces.len()),
        );
        let drawn: Vec<usize> = places.iter().map(|&at| calibration.drawn[at]).collect();
        let largest_in = |unit: SiUnit| {
            all.iter()
                .filter(|component| component.unit == unit)
                .flat_map(|component| component.before.iter().chain(&component.after))
                .flatten()
                .filter(|value| value.is_finite())
                .fold(0.0, |a: f64, b| a.max(b.abs()))
        };
        let units: Vec<(SiUnit, Reading)> = observations
            .poses
            .units()
            .into_iter()
            .map(|unit| (unit, numbers::reading(unit, largest_in(unit))))
            .collect();
        let main = calibration.diagnosis.unit;
        let unit = numbers::reading(main, largest_in(main));
        let column = |key: String, label: &str, values: &[Option<f64>], reading: &Reading| Column {
            key,
            label: label.to_owned(),
            values: drawn.iter().map(|&row| values[row].map(|si| si / reading.in_si)).collect(),
            in_si: reading.in_si,
        };
        let changed = !calibration.diagnosis.effects.is_empty();
        let components: Vec<Component> = all
            .into_iter()
            .map(|component| {
                let of_unit = units.iter().find(|(known, _)| *known == component.unit);
                let reading = of_unit.map_or_else(|| unit.clone(), |(_, reading)| reading.clone());
                let label = numbers::name_with_unit(side(component.name), &reading.name);
                Component {
                    name: component.name,
                    before: column(format!("{} before", component.name), &label, &component.before, &reading),
                    after: column(format!("{} after", component.name), &label, &component.after, &reading),
                    label,
                    every: if changed {
                        component
                    } else {
                        residuals::Component { before: Vec::new(), ..component }
                    },
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
                in_si: reading.in_si,
            }
        });
        let effects = calibration.traces.iter().zip(1..).map(|(trace, number): (_, usize)| {
            let reading = trace_reading(trace);
            ["without", "left"].map(|kind| {
                let values = if kind == "left" { &trace.left } else { &trace.without };
                Column {
                    key: format!("effect {number} {kind}"),
                    label: reading.name.clone(),
                    values: places.iter().map(|&at| values[at].map(|si| si / reading.in_si)).collect(),
                    in_si: reading.in_si,
                }
            })
        });
        let length = |which: fn(&Component) -> &Column| -> Vec<Option<f64>> {
            (0..drawn.len())
                .map(|at| {
                    // Rows whose residual has another unit have no length on this axis.
                    let own = components.iter().filter(|component| component.every.unit == main);
                    let parts = own.filter_map(|component| which(component).values[at]);
                    let (sum, count) = parts.fold((0.0, 0), |(sum, count), v| (sum + v * v, count + 1));
                    (count > 0).then(|| f64::sqrt(sum))
                })
                .collect()
        };
        Self {
            numbers: drawn.iter().map(|&row| observations.row_number(row)).collect(),
            of: observations.rows(),
            aside: drawn.iter().map(|&row| every_aside[row]).collect(),
            changed,
            every_aside,
            readings: readings.collect(),
            effects: effects.collect(),
            lengths: [length(|component| &component.before), length(|component| &component.after)],
            components,
            unit,
        }
    }

    /// A reading and a residual of every row that was kept, drawn or not, in the units of their axes.
    pub fn kept<'a>(
        &'a self,
        reading: impl Fn(usize) -> f64 + 'a,
        component: &'a Component,
    ) -> impl Iterator<Item = (f64, f64)> + 'a {
        let values = component.every.after.iter().zip(&self.every_aside).enumerate();
        values
            .filter(|(_, (_, aside))| !**aside)
            .filter_map(move |(row, (value, _))| Some((reading(row), (*value)? / component.after.in_si)))
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
            in_si: 1.0,
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

/// About what a row takes in the page: two marks in each picture of rows, and a number in each column.
fn bytes_of_a_row(readings: usize, components: usize, effects: usize) -> usize {
    let pictures = readings * components + 2 * components + effects + 1;
    let columns = readings + 2 * components + 2 * effects + 3;
    30 * pictures + 7 * columns
}

/// Places among the drawn rows of those that the page has room for: every row that was set aside, and others evenly.
fn thinned(drawn: &[usize], aside: &[bool], bytes: usize) -> Vec<usize> {
    let room = BYTES / bytes.max(1);
    let (set_aside, kept): (Vec<usize>, Vec<usize>) = (0..drawn.len()).partition(|&at| aside[drawn[at]]);
    let room = room.saturating_sub(set_aside.len()).max(room / 4);
    let mut places: Vec<usize> = set_aside.into_iter().take(room).collect();
    let count = kept.len().min(room);
    places.extend((0..count).map(|at| kept[at * kept.len() / count]));
    places.sort_unstable();
    places
}

/// Text as JSON has it, and as markup lets it stand in a script.
fn quoted(text: &str) -> String {
    json_in_script(&serde_json::Value::from(text).to_string())
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_thinned_evenly_and_those_set_aside_stay() {
        let drawn: Vec<usize> = (0..2000).collect();
        let aside: Vec<bool> = (0..2000).map(|row| row % 500 == 7).collect();
        let places = thinned(&drawn, &aside, BYTES / 100);
        assert_eq!(places.len(), 100);
        assert!([7, 507, 1007, 1507].iter().all(|row| places.contains(row)), "{places:?}");
        assert!(places.windows(2).all(|two| two[0] < two[1] && two[1] - two[0] <= 25), "{places:?}");
        assert_eq!(thinned(&drawn, &aside, 1), drawn);
        // Nearly all set aside: some of them, and some of the others.
        let most: Vec<bool> = (0..2000).map(|row| row % 10 != 0).collect();
        let places = thinned(&drawn, &most, BYTES / 100);
        assert_eq!(places.len(), 50);
        assert!(places.iter().any(|row| row % 10 == 0), "{places:?}");
        assert!(thinned(&[], &[], 10).is_empty());
    }
}
