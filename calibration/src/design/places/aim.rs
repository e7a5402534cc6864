//! Readings at which the chain points at something: Newton's method from many readings spread over what can be read.

use std::f64::consts::PI;
use std::ops::Range;

use model_core::{Chain, ObservableId, Quantity, SymbolId, SymbolKind, exact};
use nalgebra::{DMatrix, DVector, Vector3};

use crate::design::{joints, spread};
use observe::Poses;

/// Readings nearest to what is aimed at that are tried, at least.
const TRIED: usize = 48;

/// Steps of one attempt at most.
const STEPS: usize = 25;

/// How near is there, as a share of the distance.
const THERE: f64 = 1e-7;

/// Two ways of pointing differ by so much of the range of some reading at least.
const DIFFERENT: f64 = 1e-3;

/// Something to aim at, in the chain's frame.
#[derive(Debug, Clone, Copy)]
pub(super) enum Goal {
    /// The point.
    Point(Vector3<f64>),
    /// Anywhere on a plane with this normal, no further from here than that.
    Board(Vector3<f64>, Vector3<f64>, f64),
    /// Anywhere on a circle about the point, with this axis and radius.
    Circle(Vector3<f64>, Vector3<f64>, f64),
    /// Anywhere so far from the point.
    Sphere(Vector3<f64>, f64),
    /// The way to the point.
    Way(Vector3<f64>),
    /// Whatever comes.
    Anything,
}

impl Goal {
    /// What is left of the way from a point to the goal; nothing once it is there.
    fn left(self, point: &Vector3<f64>) -> DVector<f64> {
        match self {
            Self::Point(there) => DVector::from_iterator(3, (there - point).iter().copied()),
            Self::Board(there, normal, _) => DVector::from_element(1, normal.dot(&(there - point))),
            Self::Circle(centre, axis, radius) => {
                let from = point - centre;
                let off = axis.dot(&from);
                DVector::from_column_slice(&[off, (from - axis * off).norm() - radius])
            }
            Self::Sphere(centre, radius) => DVector::from_element(1, (point - centre).norm() - radius),
            Self::Way(there) => {
                DVector::from_iterator(3, (there.normalize() - point.normalize()).iter().copied())
            }
            Self::Anything => DVector::zeros(1),
        }
    }

    /// How far a point is away, by which the readings to start from are chosen.
    fn away(self, point: &Vector3<f64>) -> f64 {
        match self {
            Self::Board(there, ..) => (point - there).norm(),
            _ => self.left(point).norm(),
        }
    }

    /// How near is there.
    fn near(self) -> f64 {
        match self {
            Self::Point(there)
            | Self::Board(there, ..)
            | Self::Circle(there, ..)
            | Self::Sphere(there, _) => THERE * there.norm().max(1.0),
            Self::Way(_) | Self::Anything => THERE,
        }
    }
}

/// What an instrument can read while it observes one thing.
pub(super) struct Aim {
    path: exact::Path,
    values: Vec<f64>,
    /// Readings to start from, all of a row together.
    starts: Vec<Vec<f64>>,
    points: Vec<Vector3<f64>>,
    /// The symbol of each reading, and where it may go if it is the instrument's to choose.
    readings: Vec<(SymbolId, Option<Free>)>,
}

/// Where a reading may go.
#[derive(Debug, Clone)]
struct Free {
    range: Range<f64>,
    turns: bool,
}

/// The inputs that say how far along its beam an instrument measures: the one of length that moves what is observed of an
/// instrument without errors, and those of which the study says where they may be.
pub(super) fn ranges_of(chain: &Chain, poses: &Poses, stated: &[(SymbolId, Range<f64>)]) -> Vec<SymbolId> {
    let is_error = |id| chain.symbol(id).kind == SymbolKind::Error;
    let moves = |id: &SymbolId| {
        poses.series.iter().any(|series| {
            let way = chain.way(series.observable);
            let amounts = way.iter().map(|passed| &passed.factor.amount);
            let mut amounts = amounts.chain(&chain.observable(series.observable).components);
            amounts.any(|amount| chain.symbols_in(&amount.graded_part(is_error, 0)).contains(id))
        })
    };
    let lengths: Vec<SymbolId> = poses
        .columns
        .iter()
        .map(|(id, _)| *id)
        .filter(|id| {
            let symbol = chain.symbol(*id);
            symbol.kind == SymbolKind::Input && symbol.quantity == Quantity::Length && moves(id)
        })
        .collect();
    let stated = |id: &SymbolId| stated.iter().any(|(known, _)| known == id);
    if lengths.len() == 1 { lengths } else { lengths.into_iter().filter(|id| stated(id)).collect() }
}

impl Aim {
    /// `stated` are ranges of joints and inputs; others stay within those of the data.
    pub fn new(
        chain: &Chain,
        observable: ObservableId,
        poses: &Poses,
        stated: &[(SymbolId, Range<f64>)],
        values: &[f64],
    ) -> Self {
        let spread = spread(chain, &poses.bare(), stated);
        let (joints, lengths) = (joints(chain, poses), ranges_of(chain, poses, stated));
        let count = spread.columns.first().map_or(0, |(_, column)| column.len());
        let columns: Vec<Vec<f64>> = poses
            .columns
            .iter()
            .map(|(id, measured)| match spread.column(*id) {
                Some(column) if joints.contains(id) => column.to_vec(),
                // What is no joint comes from one row together.
                _ => (0..count).map(|start| measured[start * 7 % measured.len()]).collect(),
            })
            .collect();
        let readings = poses.columns.iter().map(|(id, measured)| {
            let is_free = joints.contains(id) || lengths.contains(id);
            let least = measured.iter().copied().fold(f64::INFINITY, f64::min);
            let most = measured.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let range =
                stated.iter().find(|(known, _)| known == id).map_or(least..most, |(_, own)| own.clone());
            let turns = joints.contains(id) && chain.symbol(*id).quantity == Quantity::Angle;
            (*id, is_free.then_some(Free { range, turns }))
        });
        let starts: Vec<Vec<f64>> =
            (0..count).map(|start| columns.iter().map(|column| column[start]).collect()).collect();
        let mut aim = Self {
            path: exact::Path::new(chain, observable),
            values: values[..chain.symbols.len()].to_vec(),
            readings: readings.collect(),
            points: Vec::new(),
            starts: Vec::new(),
        };
        aim.points = starts.iter().map(|start| aim.point(start)).collect();
        aim.starts = starts;
        aim
    }

    /// The point or direction that the chain shows.
    fn point(&self, readings: &[f64]) -> Vector3<f64> {
        let mut values = self.values.clone();
        for ((id, _), value) in self.readings.iter().zip(readings) {
            values[id.index()] = *value;
        }
        self.path.value(&values)
    }

    /// Different ways of pointing at something, at most so many.
    pub fn at(&self, goal: Goal, most: usize) -> Vec<Vec<f64>> {
        let points = self.points.iter().enumerate();
        let mut order: Vec<(f64, usize)> = points.map(|(at, point)| (goal.away(point), at)).collect();
        order.retain(|(away, _)| away.is_finite());
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut found: Vec<Vec<f64>> = Vec::new();
        for &(_, start) in order.iter().take(TRIED.max(4 * most)) {
            if found.len() >= most {
                break;
            }
            let Some(readings) = self.reached(goal, &self.starts[start]) else { continue };
            if found.iter().all(|known| self.differ(known, &readings)) {
                found.push(readings);
            }
        }
        found
    }

    fn differ(&self, one: &[f64], other: &[f64]) -> bool {
        one.iter().zip(other).zip(&self.readings).any(|((a, b), (_, free))| {
            free.as_ref().is_some_and(|free| {
                let away = (a - b).abs();
                let away = if free.turns { away.min((away - 2.0 * PI).abs()) } else { away };
                away > DIFFERENT * (free.range.end - free.range.start)
            })
        })
    }

    /// From one start.
    fn reached(&self, goal: Goal, start: &[f64]) -> Option<Vec<f64>> {
        let free: Vec<(usize, &Free, f64)> = self
            .readings
            .iter()
            .enumerate()
            .filter_map(|(at, (_, free))| {
                let free = free.as_ref()?;
                Some((at, free, free.range.end - free.range.start))
            })
            .filter(|(.., span)| *span > 0.0)
            .collect();
        let left = |readings: &[f64]| goal.left(&self.point(readings));
        let near = goal.near();
        let mut readings = start.to_vec();
        let mut now = left(&readings);
        for _ in 0..STEPS {
            if now.norm() <= near {
                break;
            }
            let mut columns = DMatrix::zeros(now.len(), free.len());
            for (column, &(at, _, span)) in free.iter().enumerate() {
                let step = 1e-6 * span;
                let before = readings[at];
                readings[at] = before + step;
                columns.set_column(column, &((&now - left(&readings)) / 1e-6));
                readings[at] = before;
            }
            let change = columns.svd(true, true).solve(&now, 1e-9).ok()?;
            for (&(at, _, span), change) in free.iter().zip(change.iter()) {
                // A step longer than a third of the range leads anywhere.
                readings[at] += span * change.clamp(-0.3, 0.3);
            }
            now = left(&readings);
        }
        let is_there = now.norm() <= near
            && match goal {
                Goal::Board(there, _, radius) => (self.point(&readings) - there).norm() <= radius,
                _ => true,
            };
        for &(at, Free { range, turns }, span) in &free {
            let slack = 1e-9 * span;
            if *turns {
                let turns = ((readings[at] - range.start + slack) / (2.0 * PI)).floor();
                readings[at] -= turns * 2.0 * PI;
            }
            if !(range.start - slack..=range.end + slack).contains(&readings[at]) {
                return None;
            }
        }
        is_there.then_some(readings)
    }
}
