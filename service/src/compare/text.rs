//! A comparison in words.

use std::fmt::Write as _;

use model_core::escape::Screen;
use observe::SiUnit;
use report::style::{BAD, GOOD, HEADING};
use report::words::numbers;

use super::{Comparison, Observed, Value};

/// Values that a headline names.
const NAMED: usize = 3;

/// Letters of a line of a table of a history.
const WIDTH: usize = 98;

/// Letters of a day, and what stands between two columns.
const DAY: usize = 16;

/// What the row of drifts is called.
const DRIFT: &str = "drift per month";

/// A comparison as text.
#[must_use]
pub fn as_text(comparison: &Comparison) -> Screen {
    let mut out = Screen::default();
    let (changed, rest) = headline(comparison);
    let style = if comparison.is_changed() { BAD } else { GOOD };
    out.styled([&style, &format_args!("{style:#}")], changed);
    let _ = writeln!(out, " {rest}\n");
    for observed in &comparison.observed {
        let _ = writeln!(out, "{}", told(comparison, observed));
    }
    if !comparison.observed.is_empty() {
        out.append(&"\n".into());
    }
    out.append(&table(comparison));
    let _ = write!(out, "\n{}", notes(comparison));
    out
}

/// The verdict, and the sentences behind it.
fn headline(comparison: &Comparison) -> (&'static str, String) {
    let mut changed: Vec<&Value> = comparison.values.iter().filter(|value| value.is_changed()).collect();
    changed.sort_by(|a, b| tested(a).total_cmp(&tested(b)));
    let mut said = Vec::new();
    let moved: Vec<String> = changed.iter().take(NAMED).map(|value| moved(comparison, value)).collect();
    if !moved.is_empty() {
        said.push(format!("{}.", moved.join(", ")));
    }
    if changed.len() > NAMED {
        let more = changed.len() - NAMED;
        said.push(format!("{more} more value{} changed, see below.", if more == 1 { "" } else { "s" }));
    }
    let lacking: Vec<&Value> = comparison.values.iter().filter(|value| value.is_lacking()).collect();
    said.extend(lacking.iter().take(NAMED).map(|value| only_in(comparison, value)));
    match (comparison.is_changed(), changed.is_empty()) {
        (false, _) => {
            let count = comparison.values.iter().filter(|value| value.p_value.is_some()).count();
            let what = if count == 1 { "The value is".to_owned() } else { format!("All {count} values are") };
            ("NO SIGNIFICANT CHANGE.", format!("{what} within the uncertainty."))
        }
        (true, false) => {
            said.push("Everything else is within its uncertainty.".to_owned());
            ("CHANGED.", said.join(" "))
        }
        (true, true) if comparison.is_changed_jointly() => {
            let p_value = comparison.joint.map_or(0.0, |joint| joint.p_value);
            said.insert(
                0,
                format!(
                    "The values changed together ({}). No single value stands out.",
                    numbers::chance(p_value)
                ),
            );
            ("CHANGED.", said.join(" "))
        }
        (true, true) => {
            said.push("The values that all files have are within their uncertainty.".to_owned());
            ("ANOTHER MODEL.", said.join(" "))
        }
    }
}

/// The p of a value that changed.
fn tested(value: &Value) -> f64 {
    value.p_value.unwrap_or_else(|| unreachable!("a value that changed was tested"))
}

/// `azimuth_index moved by 12.0 ± 3.0″`
fn moved(comparison: &Comparison, value: &Value) -> String {
    match (value.change, comparison.files.len()) {
        (Some([by, uncertainty]), 2) => {
            format!("{} moved by {}", value.name, numbers::estimate(by, uncertainty, value.unit))
        }
        (_, files) => {
            let p_value = numbers::chance(tested(value));
            format!("{} is not one value in {files} files ({p_value})", value.name)
        }
    }
}

/// `Only new.toml has sag, 3.20 ± 0.40″.`
fn only_in(comparison: &Comparison, value: &Value) -> String {
    let files = comparison.files.iter().zip(&value.points);
    let having: Vec<&str> =
        files.filter(|(_, point)| point.is_some()).map(|((name, _), _)| name.as_str()).collect();
    let last = value.points.iter().flatten().next_back();
    let size = last.map_or_else(String::new, |point| format!(", {}", cell(value.unit, Some(*point))));
    format!(
        "Only {} {} {}{size}.",
        having.join(" and "),
        if having.len() == 1 { "has" } else { "have" },
        value.name
    )
}

/// What the change does to what is observed.
fn told(comparison: &Comparison, observed: &Observed) -> String {
    let estimate = |[value, uncertainty]: [f64; 2]| numbers::estimate(value, uncertainty, observed.unit);
    let at: Vec<String> = observed
        .at
        .iter()
        .map(|(name, value)| {
            let unit =
                comparison.region.iter().find(|(own, ..)| own == name).map_or(SiUnit::ONE, |own| own.1);
            format!("{name} {}", reading(*value, unit))
        })
        .collect();
    format!(
        "Over the common measured region {} changed by {} RMS, and by {} at most ({}).",
        observed.name,
        estimate(observed.rms),
        estimate(observed.largest),
        at.join(", ")
    )
}

/// A reading of a joint or input.
fn reading(value: f64, unit: SiUnit) -> String {
    match unit {
        SiUnit::RAD => format!("{:.1}°", value.to_degrees()),
        SiUnit::METRE => format!("{value:.3} m"),
        _ => format!("{value:.3}"),
    }
}

fn cell(unit: SiUnit, point: Option<super::Point>) -> String {
    match point {
        None => "none".to_owned(),
        Some(point) => match point.standard_uncertainty {
            Some(uncertainty) => numbers::estimate(point.value, uncertainty, unit),
            None => format!("{} (no ±)", numbers::told(point.value, unit)),
        },
    }
}

/// Rows of cells below their heads, each column as wide as it must be.
fn laid_out(heads: &[String], rows: &[Vec<String>]) -> (String, String) {
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column)).chain(heads.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let line = |cells: &[String]| {
        let padded = cells.iter().enumerate().map(|(at, cell)| format!("{cell:<width$}", width = width(at)));
        format!("  {}", padded.collect::<Vec<_>>().join("  ")).trim_end().to_owned()
    };
    (line(heads), rows.iter().map(|row| format!("{}\n", line(row))).collect())
}

fn table(comparison: &Comparison) -> Screen {
    let is_history = comparison.files.len() > 2;
    let chance = |value: &Value| {
        value.corrected.map_or_else(String::new, |p_value| {
            let mark = if value.is_changed() { " changed" } else { "" };
            format!("{}{mark}", numbers::chance(p_value))
        })
    };
    let mut out = Screen::default();
    let mut add = |(heads, rows): (String, String)| {
        out.styled([&HEADING, &format_args!("{HEADING:#}")], &heads);
        out.append(&format!("\n{rows}").into());
    };
    if !is_history {
        let heads = ["", "first", "last", "change", "corrected p"].map(str::to_owned);
        let rows = comparison.values.iter().map(|value| {
            let points = value.points.iter().map(|point| cell(value.unit, *point));
            let change = value.change.map(|[by, uncertainty]| numbers::estimate(by, uncertainty, value.unit));
            let cells = std::iter::once(value.name.clone()).chain(points);
            cells.chain([change.unwrap_or_default(), chance(value)]).collect()
        });
        add(laid_out(&heads, &rows.collect::<Vec<_>>()));
        return out;
    }
    for some in in_width(comparison) {
        add(history(comparison, some, &chance));
    }
    out
}

/// The values in tables that are no wider than a page: one row a file, a column for each value.
fn in_width(comparison: &Comparison) -> Vec<&[Value]> {
    let files = comparison.files.iter().map(|(name, _)| name.chars().count() + DAY);
    let first = files.max().unwrap_or(0).max(DRIFT.chars().count());
    let width = |value: &Value| {
        let cells = value.points.iter().map(|point| cell(value.unit, *point));
        let all = cells.chain([value.name.clone(), drift(value), "p ≤ 0.001 changed".to_owned()]);
        all.map(|cell| cell.chars().count() + 2).max().unwrap_or(0)
    };
    let (mut tables, mut start, mut used) = (Vec::new(), 0, first);
    for (at, value) in comparison.values.iter().enumerate() {
        if at > start && used + width(value) > WIDTH {
            tables.push(&comparison.values[start..at]);
            (start, used) = (at, first);
        }
        used += width(value);
    }
    tables.push(&comparison.values[start..]);
    tables
}

fn history(comparison: &Comparison, values: &[Value], chance: &dyn Fn(&Value) -> String) -> (String, String) {
    let names = values.iter().map(|value| value.name.clone());
    let heads: Vec<String> = ["file", "day"].map(str::to_owned).into_iter().chain(names).collect();
    let files = comparison.files.iter().enumerate().map(|(at, (name, date))| {
        let points = values.iter().map(|value| cell(value.unit, value.points[at]));
        [name.clone(), date.clone().unwrap_or_default()].into_iter().chain(points).collect()
    });
    let last = |label: &str, of: &dyn Fn(&Value) -> String| {
        [label.to_owned(), String::new()].into_iter().chain(values.iter().map(of)).collect::<Vec<String>>()
    };
    let rows: Vec<Vec<String>> = files.chain([last(DRIFT, &drift), last("corrected p", chance)]).collect();
    laid_out(&heads, &rows)
}

fn drift(value: &Value) -> String {
    value.drift.map_or_else(String::new, |own| {
        numbers::estimate(own.per_month, own.standard_uncertainty, value.unit)
    })
}

fn notes(comparison: &Comparison) -> String {
    let mut lines = Vec::new();
    if let Some(joint) = &comparison.joint {
        lines.push(format!(
            "All values at once: χ² = {:.1} with {} degrees of freedom, {}.",
            joint.chi_squared,
            joint.freedom,
            numbers::chance(joint.p_value)
        ));
    }
    lines.push(
        "The ± takes the calibrations as independent estimates. What both share, such as a wrong reference, does not show."
            .to_owned(),
    );
    lines.push(format!(
        "At most {} % of comparisons call an unchanged instrument changed. The p of each value is corrected for the number of values.",
        100.0 * super::FALSE_ALARM
    ));
    if comparison.files.len() > 2 && comparison.files.iter().any(|(_, date)| date.is_none()) {
        lines.push("Some files have no day. Give the days with --dates to see the drift.".to_owned());
    }
    lines.iter().map(|line| format!("{line}\n")).collect()
}
