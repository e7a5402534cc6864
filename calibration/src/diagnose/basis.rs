//! Smooth functions of one reading: a Fourier series of a joint that turns all around, cosines over the range of
//! anything else; and bumps.

use std::f64::consts::{PI, TAU};

use model_core::{Chain, Quantity, SymbolId, SymbolKind};

use observe::Poses;

/// The order of either series.
const ORDER: u32 = 8;

/// The lowest order of a series that is told as a function.
const LOWEST: u32 = 3;

/// Bumps: how many centres, and their widths (of a Gaussian, as shares of the whole).
const CENTRES: u32 = 36;
const WIDTHS: [f64; 3] = [0.015, 0.03, 0.06];

/// Different readings that a smooth function must be seen at.
const DIFFERENT: usize = 24;

/// The largest gap, as a share of a turn, that a joint which turns all around leaves in its readings.
const GAP: f64 = 1.0 / 12.0;

/// The functions of one driver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Basis {
    /// The smallest and the largest reading.
    pub low: f64,
    pub high: f64,
    turns: bool,
}

impl Basis {
    /// For a joint or input; `None` without readings, or where there are too few different ones to be a function of.
    pub fn of(chain: &Chain, poses: &Poses, driver: SymbolId) -> Option<Self> {
        let mut sorted = poses.column(driver)?.to_vec();
        sorted.sort_by(f64::total_cmp);
        sorted.dedup();
        let (&low, &high) = (sorted.first()?, sorted.last()?);
        if sorted.len() < DIFFERENT {
            return None;
        }
        let symbol = chain.symbol(driver);
        let angle = symbol.kind == SymbolKind::Joint && symbol.quantity == Quantity::Angle;
        let mut around: Vec<f64> = sorted.iter().map(|q| q.rem_euclid(TAU)).collect();
        around.sort_by(f64::total_cmp);
        let seam = around.first().zip(around.last()).map_or(TAU, |(first, last)| first + TAU - last);
        let gap = around.windows(2).map(|pair| pair[1] - pair[0]).fold(seam, f64::max);
        Some(Self { low, high, turns: angle && gap < GAP * TAU })
    }

    /// The series at a reading, lowest order first.
    pub fn series(self, q: f64) -> Vec<f64> {
        if self.turns {
            let wave = |order: u32| [(f64::from(order) * q).cos(), (f64::from(order) * q).sin()];
            return (1..=ORDER).flat_map(wave).collect();
        }
        let share = (q - self.low) / (self.high - self.low).max(f64::MIN_POSITIVE);
        (1..=ORDER).map(|order| (f64::from(order) * PI * share).cos()).collect()
    }

    /// The orders of the series that are functions of their own, and no single effect of a catalogue, each with the
    /// functions that it has.
    pub fn orders(self) -> impl Iterator<Item = (u32, usize)> {
        (LOWEST..=ORDER).map(move |order| (order, order as usize * if self.turns { 2 } else { 1 }))
    }

    /// Centre and width of each bump.
    pub fn bumps(self) -> Vec<(f64, f64)> {
        let (start, length) = if self.turns { (-PI, TAU) } else { (self.low, self.high - self.low) };
        let centres = (0..CENTRES).map(|at| start + length * (at as f64 + 0.5) / CENTRES as f64);
        centres.flat_map(|centre| WIDTHS.map(|width| (centre, width * length))).collect()
    }

    /// A bump at a reading.
    pub fn bump(self, (centre, width): (f64, f64), q: f64) -> f64 {
        let mut from = q - centre;
        if self.turns {
            from -= TAU * (from / TAU).round();
        }
        (-0.5 * (from / width).powi(2)).exp()
    }

    /// Whether the driver turns all around.
    pub fn turns(self) -> bool {
        self.turns
    }
}
