//! Scales beside unknown objects: a residual in metres is as many times as large as the room that a scale of ranges makes of the
//! readings, or as the arm that turns them into places.
//!
//! A fit that makes residuals small would make the room, or the arm, small: with N components, and a scale that is known to σ, by N·σ². So
//! residuals are divided by the scale: they are as large as the readings' noise makes them where ranges, or turns of joints, are what was
//! read.
//!
//! Source: W. A. Fuller, Measurement Error Models (1987), section 1.3: the variance of a residual hangs on what is estimated.

use model_core::{Chain, Quantity, SymbolId, SymbolKind, exact};
use nalgebra::Vector3;

use super::beam::range_of;
use super::block::Block;
use observe::golden;
use observe::kinds::GrowsWith;
use observe::{Poses, Series};

/// Poses at which a symbol has to move the point as a scale does.
const POSES: usize = 5;

/// By how much symbols are moved to see what they do, relative to one; and what is left of it where they are such a scale.
const STEP: f64 = 1e-4;
const ROUNDING: f64 = 1e-6;

/// Poses at which it is told how long an arm is.
const POSES_OF_ARMS: usize = 24;

/// How far its joints turn there, rad.
const TURN: f64 = 1e-3;

/// What makes the residuals of a series larger.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scales {
    each: Vec<Scale>,
    /// How many times larger than with nominal values residuals are where they are taken as they are, in metres.
    taken: f64,
}

/// A symbol that makes residuals larger.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Scale {
    symbol: SymbolId,
    /// Its column, where it is estimated.
    column: Option<usize>,
    nominal: f64,
    /// How much larger, as a share, it makes them for each unit, SI.
    factor: f64,
}

/// The scales of each series, with nominal values; none where its residuals are no places of unknown objects.
pub(super) fn of_series(
    chain: &Chain,
    poses: &Poses,
    parameters: &[SymbolId],
    column_of: &[Option<usize>],
) -> Vec<Scales> {
    let nominal = chain.nominal_values();
    let of = |series: &Series| {
        let factors = match (series.measure.kind().grows_with, range_of(chain, series.observable)) {
            _ if series.rows.is_empty() => Vec::new(),
            (GrowsWith::RangeOrArm, Some(range)) => of_ranges(chain, poses, series, range),
            (GrowsWith::RangeOrArm | GrowsWith::Arm, None) => of_arm(chain, poses, series),
            (GrowsWith::Arm, Some(_)) | (GrowsWith::Nothing, _) => Vec::new(),
        };
        let each = factors.into_iter().map(|(symbol, factor)| {
            let at = parameters.iter().position(|own| *own == symbol);
            let column = at.and_then(|at| column_of.get(at).copied().flatten());
            Scale { symbol, column, nominal: nominal[symbol.index()], factor }
        });
        Scales { each: each.collect(), taken: 1.0 }
    };
    poses.series.iter().map(of).collect()
}

/// The errors that multiply ranges.
fn of_ranges(chain: &Chain, poses: &Poses, series: &Series, range: SymbolId) -> Vec<(SymbolId, f64)> {
    let is_number = |id: &SymbolId| chain.symbol(*id).quantity == Quantity::Number;
    let numbers: Vec<SymbolId> = chain.symbols_of(SymbolKind::Error).filter(is_number).collect();
    if numbers.is_empty() {
        return Vec::new();
    }
    let path = exact::Path::new(chain, series.observable);
    let factor = |symbol: SymbolId| Some((symbol, factor(&path, chain, poses, series, range, symbol)?));
    numbers.into_iter().filter_map(factor).collect()
}

/// What makes an arm longer, and how much for each unit: by how far, root mean square, the point goes as joints turn.
fn of_arm(chain: &Chain, poses: &Poses, series: &Series) -> Vec<(SymbolId, f64)> {
    let is_joint = |id: SymbolId| {
        let symbol = chain.symbol(id);
        symbol.kind == SymbolKind::Joint && symbol.quantity == Quantity::Angle
    };
    let path = exact::Path::new(chain, series.observable);
    let nominal = chain.nominal_values();
    // Of all joints some turn forward and some back: one difference tells of all.
    let turned = (0..POSES_OF_ARMS).map(|at| {
        let row = series.rows.start + (golden::share(at) * series.rows.len() as f64) as usize;
        let mut of_pose = [nominal.clone(), nominal.clone()];
        for (number, (id, readings)) in poses.columns.iter().enumerate() {
            let forward = golden::share(at * (number + 2) + number) < 0.5;
            let turn = if !is_joint(*id) {
                0.0
            } else if forward {
                TURN
            } else {
                -TURN
            };
            of_pose[0][id.index()] = readings[row] + turn;
            of_pose[1][id.index()] = readings[row] - turn;
        }
        of_pose
    });
    let mut turned: Vec<[Vec<f64>; 2]> = turned.collect();
    let mut squares = |id: SymbolId, by: f64| -> f64 {
        let of_pose = turned.iter_mut().map(|[one, other]| {
            let own = one[id.index()];
            (one[id.index()], other[id.index()]) = (own + by, own + by);
            let way = path.value(one) - path.value(other);
            (one[id.index()], other[id.index()]) = (own, own);
            way.norm_squared()
        });
        of_pose.sum()
    };
    let moves = |id: &SymbolId| matches!(chain.symbol(*id).kind, SymbolKind::Error | SymbolKind::Constant);
    let factors = path.symbols().into_iter().filter(moves).map(|id| {
        let [longer, shorter] = [STEP, -STEP].map(|by| squares(id, by));
        (id, (longer - shorter) / (longer + shorter) / (2.0 * STEP))
    });
    factors.filter(|(_, factor)| factor.is_finite() && *factor != 0.0).collect()
}

/// How much larger ranges are where a symbol is one; `None` where it does anything else.
fn factor(
    path: &exact::Path,
    chain: &Chain,
    poses: &Poses,
    series: &Series,
    range: SymbolId,
    symbol: SymbolId,
) -> Option<f64> {
    let mut known: Option<f64> = None;
    for at in 0..POSES {
        let row = series.rows.start + at * (series.rows.len() - 1) / (POSES - 1);
        let mut values = chain.nominal_values();
        poses.columns.iter().for_each(|(id, readings)| values[id.index()] = readings[row]);
        let reading = values[range.index()];
        let mut moved = |id: SymbolId, by: f64| -> Vector3<f64> {
            let own = values[id.index()];
            values[id.index()] = own + by;
            let there = path.value(&values);
            values[id.index()] = own;
            there
        };
        let by_symbol = (moved(symbol, STEP) - moved(symbol, -STEP)) / (2.0 * STEP);
        let by_range = (moved(range, STEP) - moved(range, -STEP)) / (2.0 * STEP) * reading;
        let factor = by_symbol.dot(&by_range) / by_range.norm_squared();
        let is_scale = (by_symbol - by_range * factor).norm() <= ROUNDING * by_range.norm()
            && factor.abs() > ROUNDING
            && known.is_none_or(|known| (factor - known).abs() <= ROUNDING * known.abs());
        if !is_scale {
            return None;
        }
        known = Some(factor);
    }
    known
}

impl Scales {
    /// How many times larger than with nominal values residuals are with these.
    fn larger(&self, values: &[f64]) -> f64 {
        let by = |own: &Scale| own.factor * (values[own.symbol.index()] - own.nominal);
        1.0 + self.each.iter().map(by).sum::<f64>()
    }

    /// Takes residuals in metres as they are with these values, by how much larger or smaller, as a share, they were taken before.
    pub(super) fn take_as_they_are(&mut self, values: &[f64]) -> f64 {
        let larger = self.larger(values);
        let before = std::mem::replace(&mut self.taken, larger);
        (before / larger - 1.0).abs()
    }
}

impl Block {
    /// Makes what is of places as large as it would be if these scales were where residuals are taken as they are, so that a step knows
    /// of it.
    pub(super) fn shrink(&mut self, scales: &Scales, values: &[f64]) {
        let larger = scales.larger(values);
        let share = scales.taken / larger;
        if scales.each.is_empty() || !(larger > 0.0 && share > 0.0 && share.is_finite()) {
            return;
        }
        self.residual.iter_mut().for_each(|value| *value *= share);
        self.jacobian.iter_mut().for_each(|value| *value *= share);
        self.unknown.iter_mut().flatten().for_each(|value| *value *= share);
        let count = self.residual.len().max(1);
        for (column, own) in self.jacobian.chunks_exact_mut(count).enumerate() {
            // Those of one column move everything alike.
            if let Some(scale) = scales.each.iter().find(|scale| scale.column == Some(column)) {
                let factor = scale.factor / larger;
                own.iter_mut().zip(&self.residual).for_each(|(own, left)| *own += factor * left);
            }
        }
    }
}
