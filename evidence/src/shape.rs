//! Shapes over a joint that no cause of the catalogue has: steps, ramps, bumps, teeth.

use std::f64::consts::TAU;

/// The kind of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// 0 before the position, 1 behind.
    Step,
    /// A soft step from −1 to 1.
    Tanh,
    /// 0 before the position, rising behind.
    Ramp,
    /// Flat within the width about the position, rising beyond.
    Dead,
    /// Rising within the width, flat beyond.
    Clip,
    /// A bell.
    Bump,
    /// A saw of so many teeth a turn.
    Saw,
    /// A square wave of so many periods a turn.
    Square,
    /// A triangle of so many periods a turn.
    Triangle,
}

/// A shape with its position and width. For waves: phase as a part of a period, and periods a turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// The kind.
    pub kind: Kind,
    /// Position, in the joint's unit; for waves the phase.
    pub position: f64,
    /// Width, in the joint's unit; for waves periods a turn.
    pub width: f64,
}

/// Positions along the range at which each shape is tried.
const POSITIONS: usize = 40;
/// Most periods a turn of a wave, and phases of each.
const WAVES: (usize, usize) = (12, 24);

impl Shape {
    /// The value at one position of the joint.
    #[must_use]
    pub fn at(&self, joint: f64) -> f64 {
        let past = joint - self.position;
        match self.kind {
            Kind::Step => f64::from(past > 0.0),
            Kind::Tanh => (past / self.width).tanh(),
            Kind::Ramp => past.max(0.0),
            Kind::Dead => past.signum() * (past.abs() - self.width).max(0.0),
            Kind::Clip => past.clamp(-self.width, self.width),
            Kind::Bump => (-(past / self.width).powi(2)).exp(),
            Kind::Saw => 2.0 * self.phase(joint) - 1.0,
            Kind::Square => {
                if self.phase(joint) < 0.5 {
                    1.0
                } else {
                    -1.0
                }
            }
            Kind::Triangle => 2.0 * (2.0 * self.phase(joint) - 1.0).abs() - 1.0,
        }
    }

    fn phase(&self, joint: f64) -> f64 {
        (joint * self.width / TAU + self.position).rem_euclid(1.0)
    }

    /// Whether it repeats in a turn.
    #[must_use]
    pub fn is_wave(&self) -> bool {
        matches!(self.kind, Kind::Saw | Kind::Square | Kind::Triangle)
    }

    /// Whether it has a width.
    #[must_use]
    pub fn has_width(&self) -> bool {
        matches!(self.kind, Kind::Tanh | Kind::Dead | Kind::Clip | Kind::Bump)
    }

    /// Whether it jumps, so that its change by position is no function of its own.
    #[must_use]
    pub fn jumps(&self) -> bool {
        matches!(self.kind, Kind::Step | Kind::Square)
    }

    /// The same shape farther on.
    #[must_use]
    pub fn moved(&self, step: f64) -> Self {
        Self { position: self.position + step, ..*self }
    }

    /// The same shape, so many times as wide.
    #[must_use]
    pub fn widened(&self, times: f64) -> Self {
        Self { width: self.width * times, ..*self }
    }
}

/// The library over the values of a joint: every shape with its positions and widths.
#[must_use]
pub fn library(joint: &[f64]) -> Vec<Shape> {
    let (low, length) = range(joint);
    let mut shapes = Vec::new();
    for index in 1..=POSITIONS {
        let position = low + length * index as f64 / (POSITIONS + 1) as f64;
        let mut offer = |kind, widths: &[f64]| {
            shapes.extend(widths.iter().map(|part| Shape { kind, position, width: part * length }));
        };
        offer(Kind::Step, &[0.0]);
        offer(Kind::Ramp, &[0.0]);
        offer(Kind::Tanh, &[0.025, 0.06, 0.12]);
        offer(Kind::Bump, &[0.02, 0.035, 0.06, 0.12]);
        offer(Kind::Clip, &[0.08, 0.14, 0.22]);
        offer(Kind::Dead, &[0.1, 0.18, 0.26]);
    }
    // A wave is told from a slope where a good part of its turn is seen.
    if length > 2.0 {
        for periods in 1..=WAVES.0 {
            for phase in 0..WAVES.1 {
                let position = phase as f64 / WAVES.1 as f64;
                let wave = |kind| Shape { kind, position, width: periods as f64 };
                shapes.push(wave(Kind::Saw));
                // Half a period on, square and triangle are the same with the other sign.
                if 2 * phase < WAVES.1 {
                    shapes.extend([wave(Kind::Square), wave(Kind::Triangle)]);
                }
            }
        }
    }
    shapes
}

/// The neighbours of a shape of the library, between its positions and widths.
#[must_use]
pub fn finer(shape: &Shape, joint: &[f64]) -> Vec<Shape> {
    let (_, length) = range(joint);
    let step = length / (POSITIONS + 1) as f64;
    let moves = |count: usize, by: f64| {
        (0..count).map(move |index| by * (2.0 * index as f64 / (count - 1) as f64 - 1.0))
    };
    match shape.kind {
        Kind::Step => {
            // A step between two neighbouring rows is the same wherever it lies between them.
            let mut sorted = joint.to_vec();
            sorted.sort_by(f64::total_cmp);
            sorted
                .windows(2)
                .map(|pair| Shape { position: f64::midpoint(pair[0], pair[1]), ..*shape })
                .filter(|finer| (finer.position - shape.position).abs() < 1.5 * step)
                .collect()
        }
        _ if shape.is_wave() => moves(41, 1.0 / WAVES.1 as f64)
            .map(|by| Shape { position: (shape.position + by).rem_euclid(1.0), ..*shape })
            .collect(),
        _ => {
            let widths: &[f64] =
                if shape.has_width() { &[0.6, 0.8, 0.9, 1.0, 1.1, 1.25, 1.6] } else { &[1.0] };
            moves(9, step)
                .flat_map(|by| widths.iter().map(move |&times| shape.moved(by).widened(times)))
                .collect()
        }
    }
}

/// Half of the step by which a shape's change by its position is taken.
#[must_use]
pub fn half_step(shape: &Shape, joint: &[f64]) -> f64 {
    if shape.is_wave() { 0.5 / WAVES.1 as f64 } else { range(joint).1 / (2 * (POSITIONS + 1)) as f64 }
}

fn range(joint: &[f64]) -> (f64, f64) {
    let low = joint.iter().copied().fold(f64::INFINITY, f64::min);
    let high = joint.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (low, high - low)
}
