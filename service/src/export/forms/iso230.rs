//! A table of one axis as its calibration reports it: target positions, mean deviations and what compensates them.
//!
//! Source: ISO 230-2:2014, "Determination of accuracy and repeatability of positioning of numerically controlled axes": the deviation is the
//! actual position minus the target; approached in both directions there is a mean of each, and the reversal value is their difference.

use std::fmt::Write as _;

use model_core::Meaning;

use super::table::said;
use super::{Form, Made, Shown, Subject};
use crate::export::grid::{Axes, Grid, units, written};
use crate::refusal::Refusal;
use crate::source::Source;

pub const FORM: Form = Form {
    name: "iso230",
    what: "compensation of one axis after ISO 230-2: target, deviation, compensation",
    template: None,
    write,
    read,
};

fn axes(subject: &Subject) -> Result<Axes, Refusal> {
    let axes = Axes::of(subject, FORM.name, 1)?;
    let sided = axes.either.filter(|(id, _)| subject.chain.symbol(*id).meaning != Some(Meaning::Direction));
    match sided {
        None => Ok(axes),
        Some((id, _)) => {
            let name = &subject.chain.symbol(id).name;
            Err(Refusal::Input(format!(
                "`{name}` is a side, and the form `iso230` has none: write --form table"
            )))
        }
    }
}

fn write(subject: &Subject, _: Option<&Source>) -> Result<Made, Refusal> {
    let axes = axes(subject)?;
    let (grid, left) = axes.grid(subject)?;
    let [(joint, _)] = axes.joints.as_slice() else { unreachable!("there is one joint") };
    let symbol = subject.chain.symbol(*joint);
    let [(unit, size), (fine, small)] = units(symbol.quantity);
    let sense = "A deviation is the actual position minus the target.";
    let said = said(subject, &axes, &grid, &left, sense);
    let mut text: String = said.lines().map(|line| format!("# {line}\n")).collect();
    let columns = if grid.either.len() == 2 {
        format!(
            "deviation_up [{fine}],deviation_down [{fine}],reversal [{fine}],compensation_up [{fine}],compensation_down [{fine}]"
        )
    } else {
        format!("deviation [{fine}],compensation [{fine}]")
    };
    let _ = writeln!(text, "target [{unit}],{columns}");
    let deviation = |either: usize, node: usize| grid.corrections[either][node][0] / small;
    for (node, target) in grid.nodes[0].iter().enumerate() {
        let target = written(target / size);
        let first = deviation(0, node);
        if grid.either.len() == 2 {
            // The direction upwards is the larger one.
            let (down, up) = (first, deviation(1, node));
            let _ = writeln!(
                text,
                "{target},{up:.6},{down:.6},{:.6},{:.6},{:.6}",
                up - down,
                0.0 - up,
                0.0 - down
            );
        } else {
            let _ = writeln!(text, "{target},{first:.6},{:.6}", 0.0 - first);
        }
    }
    Ok(Made { text, said, lost: None })
}

fn read(subject: &Subject, text: &str, _: Option<&Source>) -> Result<Shown, Refusal> {
    let axes = axes(subject)?;
    let [(joint, _)] = axes.joints.as_slice() else { unreachable!("there is one joint") };
    let [(_, size), (_, small)] = units(subject.chain.symbol(*joint).quantity);
    let either = axes.either.map_or(vec![f64::NAN], |(_, values)| values.to_vec());
    let mut grid = Grid { nodes: vec![Vec::new()], corrections: vec![Vec::new(); either.len()], either };
    for line in text.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let cells: Vec<f64> = line.split(',').filter_map(|cell| cell.parse().ok()).collect();
        let deviations = match (cells.as_slice(), grid.either.len()) {
            (&[_, up, down, _, _, _], 2) => vec![down, up],
            (&[_, own, _], 1) => vec![own],
            _ => {
                return Err(Refusal::Input(format!(
                    "the file that was written has a line of another form: {line}"
                )));
            }
        };
        grid.nodes[0].push(cells[0] * size);
        for (own, deviation) in grid.corrections.iter_mut().zip(deviations) {
            own.push(vec![deviation * small]);
        }
    }
    grid.shown(subject, &axes)
}
