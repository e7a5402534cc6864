//! Corrections of readings on a grid, with straight lines between its nodes.
//!
//! A correction is what is added to a reading, so that the instrument without errors shows for the sum what the instrument shows. Where the
//! joints cannot show all of it, the sum comes nearest.

use model_core::{Meaning, Quantity, SymbolId, SymbolKind};

use super::subject::{Difference, Shown, Subject};
use crate::apply::{Search, Solver};
use crate::refusal::Refusal;

/// Steps of a grid of one axis and of two: each try has twice as many as the one before.
const STEPS: [[usize; 5]; 2] = [[12, 24, 48, 96, 192], [6, 12, 24, 36, 48]];
/// A grid is fine enough where straight lines leave less than this part of the correction.
const FINE: f64 = 0.001;
/// A finer grid that leaves more than this part of what a coarser one left is of no use.
const NO_BETTER: f64 = 0.8;

/// What a grid is over.
pub struct Axes {
    /// The joints, one or two, with the ranges that were measured.
    pub joints: Vec<(SymbolId, [f64; 2])>,
    /// The input of which there is a grid for each value: a side, or a direction of motion.
    pub either: Option<(SymbolId, [f64; 2])>,
    /// Other inputs, each held at the middle of its range.
    pub held: Vec<(SymbolId, f64)>,
}

/// Corrections at nodes.
pub struct Grid {
    /// The places of the nodes along each joint.
    pub nodes: Vec<Vec<f64>>,
    /// The value of the input of which there is a grid for each; one that says nothing where there is none.
    pub either: Vec<f64>,
    /// For each value of that input, node after node with those of the last joint running fastest, the correction of each joint.
    pub corrections: Vec<Vec<Vec<f64>>>,
}

impl Axes {
    /// What a grid over an instrument is over.
    ///
    /// # Errors
    /// No joint, or more than `most`.
    pub fn of(subject: &Subject, form: &str, most: usize) -> Result<Self, Refusal> {
        let chain = &subject.chain;
        let (mut joints, mut either, mut held) = (Vec::new(), None, Vec::new());
        for (id, column) in &subject.poses.readings {
            let symbol = chain.symbol(*id);
            let [low, high] = subject.range(*id);
            if symbol.kind == SymbolKind::Joint {
                joints.push((*id, [low, high]));
            } else if matches!(symbol.meaning, Some(Meaning::Side | Meaning::Direction))
                && low < high
                && either.is_none()
            {
                either = Some((*id, [low, high]));
            } else if !column.is_empty() {
                held.push((*id, 0.5 * (low + high)));
            }
        }
        if joints.is_empty() || joints.len() > most {
            let name = &chain.observable(subject.observable).name;
            let number = if most == 1 { "one joint" } else { "one or two joints" };
            return Err(Refusal::Input(format!(
                "`{name}` depends on {} joints, and the form `{form}` has {number}: name another observable with --observable",
                joints.len()
            )));
        }
        if let Some((joint, _)) = joints.iter().find(|(_, [low, high])| low == high) {
            let name = &chain.symbol(*joint).name;
            return Err(Refusal::Input(format!(
                "`{name}` was measured at one place alone: give its range in [found-over]"
            )));
        }
        Ok(Self { joints, either, held })
    }

    /// The coarsest grid that is fine enough, or the finest, and what straight lines leave of the correction.
    ///
    /// # Errors
    /// A reading is missing.
    pub fn grid(&self, subject: &Subject) -> Result<(Grid, Difference), Refusal> {
        let whole = subject.difference(&subject.shown(&subject.without_errors())?)?;
        let mut best: Option<(Grid, Difference)> = None;
        for steps in STEPS[self.joints.len() - 1] {
            let grid = self.with_steps(subject, steps)?;
            let left = subject.difference(&grid.shown(subject, self)?)?;
            let is_no_better = best.as_ref().is_some_and(|(_, before)| left.rms >= NO_BETTER * before.rms);
            if is_no_better {
                break;
            }
            let is_fine = left.rms <= FINE * whole.rms;
            best = Some((grid, left));
            if is_fine {
                break;
            }
        }
        Ok(best.unwrap_or_else(|| unreachable!("the first grid has none before it")))
    }

    fn with_steps(&self, subject: &Subject, steps: usize) -> Result<Grid, Refusal> {
        let nodes: Vec<Vec<f64>> = self
            .joints
            .iter()
            .map(|(_, [low, high])| {
                (0..=steps).map(|at| low + (high - low) * at as f64 / steps as f64).collect()
            })
            .collect();
        let either = self.either.map_or(vec![f64::NAN], |(_, values)| values.to_vec());
        let corrections =
            either.iter().map(|value| self.corrections(subject, &nodes, *value)).collect::<Result<_, _>>()?;
        Ok(Grid { nodes, either, corrections })
    }

    /// The corrections at all nodes.
    fn corrections(
        &self,
        subject: &Subject,
        nodes: &[Vec<f64>],
        either: f64,
    ) -> Result<Vec<Vec<f64>>, Refusal> {
        let places = nodes.iter().fold(vec![Vec::new()], |places: Vec<Vec<f64>>, own| {
            places
                .iter()
                .flat_map(|place| own.iter().map(move |node| [place.as_slice(), &[*node]].concat()))
                .collect()
        });
        let column = |value: f64| vec![value; places.len()];
        let joints = self
            .joints
            .iter()
            .enumerate()
            .map(|(at, (id, _))| (*id, places.iter().map(|place| place[at]).collect()));
        let mut readings: Vec<(SymbolId, Vec<f64>)> = joints.collect();
        readings.extend(self.held.iter().map(|(id, value)| (*id, column(*value))));
        readings.extend(self.either.map(|(id, _)| (id, column(either))));
        readings.sort_by_key(|(id, _)| *id);
        let wanted = subject.shown_at(&readings, places.len(), &subject.values)?;
        let mut solver = Solver::new(
            &subject.chain,
            subject.observable,
            Search { values: &subject.without_errors(), found: &[], limits: &[], has_starts: true },
        )?;
        let solved = solver.solve(&readings, wanted.as_flattened())?;
        let order: Vec<usize> =
            self.joints.iter().filter_map(|(id, _)| solver.joints.iter().position(|own| own == id)).collect();
        let correction = |(node, place): (usize, &Vec<f64>)| {
            order.iter().zip(place).map(|(joint, reading)| solved.joints[*joint][node] - reading).collect()
        };
        Ok(places.iter().enumerate().map(correction).collect())
    }
}

impl Grid {
    /// The correction of each joint between the nodes.
    fn at(&self, either: usize, place: &[f64]) -> Vec<f64> {
        let mut corners = vec![(0_usize, 1.0_f64)];
        for (nodes, reading) in self.nodes.iter().zip(place) {
            let above = nodes.partition_point(|node| node <= reading).clamp(1, nodes.len() - 1);
            let share = (reading - nodes[above - 1]) / (nodes[above] - nodes[above - 1]);
            corners = corners
                .iter()
                .flat_map(|(at, weight)| {
                    let at = at * nodes.len();
                    [(at + above - 1, weight * (1.0 - share)), (at + above, weight * share)]
                })
                .collect();
        }
        let joints = 0..self.nodes.len();
        let own = &self.corrections[either];
        joints.map(|joint| corners.iter().map(|(at, weight)| weight * own[*at][joint]).sum()).collect()
    }

    /// What the instrument without errors shows for corrected readings, at every pose.
    pub fn shown(&self, subject: &Subject, axes: &Axes) -> Result<Shown, Refusal> {
        let column = |id: SymbolId| {
            subject.poses.readings.iter().find(|(own, _)| *own == id).map(|(_, column)| column)
        };
        let mut readings = subject.poses.readings.clone();
        for pose in 0..subject.poses.count {
            let place: Vec<f64> = axes.joints.iter().filter_map(|(id, _)| Some(column(*id)?[pose])).collect();
            let either = axes.either.and_then(|(id, _)| {
                let value = column(id)?[pose];
                self.either.iter().position(|own| *own == value)
            });
            for ((id, _), correction) in axes.joints.iter().zip(self.at(either.unwrap_or(0), &place)) {
                if let Some((_, column)) = readings.iter_mut().find(|(own, _)| own == id) {
                    column[pose] += correction;
                }
            }
        }
        subject.shown_at(&readings, subject.poses.count, &subject.without_errors())
    }
}

/// A number as a table writes it, without the digits that its unit brought.
pub fn written(number: f64) -> f64 {
    (number * 1e9).round() / 1e9
}

/// The unit of a reading and of its correction in a table, each with its size in SI.
pub fn units(quantity: Quantity) -> [(&'static str, f64); 2] {
    const DEGREE: f64 = std::f64::consts::PI / 180.0;
    match quantity {
        Quantity::Angle => [("deg", DEGREE), ("arcsec", DEGREE / 3600.0)],
        Quantity::Length => [("mm", 1e-3), ("µm", 1e-6)],
        Quantity::Number => [("1", 1.0), ("1", 1.0)],
    }
}
