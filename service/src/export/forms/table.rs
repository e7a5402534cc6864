//! A table of corrections over one joint or two, for controllers that interpolate between nodes.

use std::fmt::Write as _;

use model_core::{Chain, SymbolId};

use super::{Form, Made, Shown, Subject};
use crate::export::grid::{Axes, Grid, units, written};
use crate::export::said::size;
use crate::export::subject::Difference;
use crate::refusal::Refusal;
use crate::source::Source;

pub const FORM: Form = Form {
    name: "table",
    what: "a table of corrections over one joint or two, as CSV",
    template: None,
    write,
    read,
};

/// Joints that a table goes over at most.
const MOST: usize = 2;

fn write(subject: &Subject, _: Option<&Source>) -> Result<Made, Refusal> {
    let chain = &subject.chain;
    let axes = Axes::of(subject, FORM.name, MOST)?;
    let (grid, left) = axes.grid(subject)?;
    let said = said(subject, &axes, &grid, &left, "Add a correction to its reading.");
    let mut text: String = said.lines().map(|line| format!("# {line}\n")).collect();
    let mut headings: Vec<String> =
        axes.either.iter().map(|(id, _)| chain.symbol(*id).name.clone()).collect();
    headings.extend(axes.joints.iter().map(|(id, _)| heading(chain, *id, "", 0)));
    headings.extend(axes.joints.iter().map(|(id, _)| heading(chain, *id, "_correction", 1)));
    let _ = writeln!(text, "{}", headings.join(","));
    for (either, corrections) in grid.either.iter().zip(&grid.corrections) {
        for (at, correction) in corrections.iter().enumerate() {
            let mut cells: Vec<String> = axes.either.iter().map(|_| either.to_string()).collect();
            let mut rest = at;
            let mut places: Vec<String> = Vec::new();
            for ((id, _), nodes) in axes.joints.iter().zip(&grid.nodes).rev() {
                let [(_, unit), _] = units(chain.symbol(*id).quantity);
                places.push(written(nodes[rest % nodes.len()] / unit).to_string());
                rest /= nodes.len();
            }
            cells.extend(places.into_iter().rev());
            cells.extend(axes.joints.iter().zip(correction).map(|((id, _), own)| {
                let [_, (_, unit)] = units(chain.symbol(*id).quantity);
                format!("{:.6}", own / unit)
            }));
            let _ = writeln!(text, "{}", cells.join(","));
        }
    }
    Ok(Made { text, said, lost: None })
}

/// `azimuth_correction [arcsec]`
fn heading(chain: &Chain, id: SymbolId, behind: &str, which: usize) -> String {
    let symbol = chain.symbol(id);
    match units(symbol.quantity)[which].0 {
        "1" => format!("{}{behind}", symbol.name),
        unit => format!("{}{behind} [{unit}]", symbol.name),
    }
}

/// What the table is, for people: in the file, and in what the command prints; `sense` says what its numbers are to be added to.
pub fn said(subject: &Subject, axes: &Axes, grid: &Grid, left: &Difference, sense: &str) -> String {
    let chain = &subject.chain;
    let nodes: Vec<String> = axes
        .joints
        .iter()
        .zip(&grid.nodes)
        .map(|((id, _), nodes)| format!("{} nodes of {}", nodes.len(), chain.symbol(*id).name))
        .collect();
    let mut text = format!(
        "Corrections at {}. {sense}\nBetween the nodes go straight. That leaves {}.\n",
        nodes.join(" by "),
        size(subject, left)
    );
    for (id, value) in &axes.held {
        let symbol = chain.symbol(*id);
        let [low, high] = subject.range(*id);
        if low < high {
            let _ = writeln!(
                text,
                "The table holds for {} = {value}, the middle of its range. What changes with it is left.",
                symbol.name
            );
        }
    }
    text
}

fn read(subject: &Subject, text: &str, _: Option<&Source>) -> Result<Shown, Refusal> {
    let chain = &subject.chain;
    let axes = Axes::of(subject, FORM.name, MOST)?;
    let mut lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let (sides, joints) = (usize::from(axes.either.is_some()), axes.joints.len());
    let mut grid = Grid { nodes: vec![Vec::new(); joints], either: Vec::new(), corrections: Vec::new() };
    let push = |values: &mut Vec<f64>, value: f64| {
        if !values.contains(&value) {
            values.push(value);
        }
    };
    lines.try_for_each(|line| {
        let cells: Vec<f64> = line.split(',').filter_map(|cell| cell.parse().ok()).collect();
        if cells.len() != sides + 2 * joints {
            return Err(Refusal::Input(format!(
                "the file that was written has a line of another form: {line}"
            )));
        }
        let either = if sides == 1 { cells[0] } else { 0.0 };
        if !grid.either.contains(&either) {
            grid.either.push(either);
            grid.corrections.push(Vec::new());
        }
        for (at, (id, _)) in axes.joints.iter().enumerate() {
            let [(_, unit), _] = units(chain.symbol(*id).quantity);
            push(&mut grid.nodes[at], cells[sides + at] * unit);
        }
        let own = axes.joints.iter().enumerate().map(|(at, (id, _))| {
            let [_, (_, unit)] = units(chain.symbol(*id).quantity);
            cells[sides + joints + at] * unit
        });
        if let Some(last) = grid.corrections.last_mut() {
            last.push(own.collect());
        }
        Ok(())
    })?;
    grid.shown(subject, &axes)
}
