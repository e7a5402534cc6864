//! Where the shapes of one driver start from: thresholds on a grid over its readings.

use std::f64::consts::TAU;

use model_core::{Chain, Quantity, SymbolId, SymbolKind};

use super::shape::{Shape, Wave};
use observe::Poses;

/// Different readings that a function must be seen at.
const DIFFERENT: usize = 8;

/// Different readings for each coefficient of a table.
const FOR_A_KNOT: usize = 4;

/// Steps over the range.
const STEPS: usize = 36;

/// Middles of bumps, and their widths as shares of the range: down to 3° of a turn.
const BUMPS: usize = 60;
const WIDTHS: [f64; 4] = [0.0085, 0.02, 0.05, 0.12];

/// Ends of ramps and of plateaus over the range.
const ENDS: usize = 12;

/// Periods a turn of waves with corners, and phases of each.
const PERIODS: std::ops::RangeInclusive<u32> = 1..=8;
const PHASES: u32 = 8;

/// Stretches of tables.
const STRETCHES: [usize; 4] = [4, 8, 16, 24];

/// The readings of a joint or input that shapes may be functions of.
#[derive(Debug, Clone)]
pub(crate) struct Driver {
    pub symbol: SymbolId,
    pub low: f64,
    pub high: f64,
    /// Different readings.
    different: usize,
    /// Whether it is a joint that turns.
    turns: bool,
}

impl Driver {
    /// `None` without readings, or where there are too few different ones to be a function of.
    pub fn of(chain: &Chain, poses: &Poses, symbol: SymbolId) -> Option<Self> {
        let own = chain.symbol(symbol);
        let turns = own.kind == SymbolKind::Joint && own.quantity == Quantity::Angle;
        Self::of_readings(symbol, poses.column(symbol)?, turns)
    }

    /// Of these readings.
    pub fn of_readings(symbol: SymbolId, readings: &[f64], turns: bool) -> Option<Self> {
        let mut sorted = readings.to_vec();
        sorted.retain(|reading| reading.is_finite());
        sorted.sort_by(f64::total_cmp);
        sorted.dedup();
        let (&low, &high) = (sorted.first()?, sorted.last()?);
        (sorted.len() >= DIFFERENT).then_some(Self { symbol, low, high, different: sorted.len(), turns })
    }

    /// The width of the readings.
    pub fn span(&self) -> f64 {
        self.high - self.low
    }

    /// Whether the readings are enough for a table of so many stretches.
    pub fn resolves(&self, stretches: usize) -> bool {
        self.different >= FOR_A_KNOT * stretches
    }

    /// Shapes of one function each, with their thresholds on the grid.
    pub fn single(&self) -> Vec<Shape> {
        let at = |share: f64| self.low + share * self.span();
        let mut shapes: Vec<Shape> =
            (0..STEPS).map(|i| Shape::Step { at: at((i as f64 + 0.5) / STEPS as f64) }).collect();
        for i in 0..=ENDS {
            for j in i + 1..=ENDS {
                let (from, to) = (at(i as f64 / ENDS as f64), at(j as f64 / ENDS as f64));
                shapes.push(Shape::Ramp { from, to });
                if i > 0 && j < ENDS {
                    shapes.push(Shape::Plateau { from, to });
                }
            }
        }
        for i in 0..BUMPS {
            let middle = at((i as f64 + 0.5) / BUMPS as f64);
            shapes.extend(WIDTHS.map(|width| Shape::Bump { middle, width: width * self.span() }));
        }
        if self.turns {
            let range = (self.low, self.high);
            for order in PERIODS.filter(|&order| TAU / f64::from(order) <= self.span()) {
                for (phase, wave) in (0..PHASES).flat_map(|phase| {
                    [Wave::Square, Wave::Sawtooth, Wave::Triangle].map(move |wave| (phase, wave))
                }) {
                    let start = TAU / f64::from(order) * f64::from(phase) / f64::from(PHASES);
                    shapes.push(Shape::Periodic { wave, order, start, range });
                }
            }
        }
        shapes
    }

    /// Shapes of several functions each.
    pub fn several(&self) -> Vec<Shape> {
        let tables = STRETCHES.into_iter().filter(|&stretches| self.resolves(stretches));
        let knots = |stretches: usize| {
            let at = |i: usize| self.low + self.span() * i as f64 / stretches as f64;
            Shape::Table { knots: (0..=stretches).map(at).collect() }
        };
        // Powers grow beyond the readings, and a joint that turns comes round.
        let powers = [2, 3].map(|highest| Shape::Powers { highest }).into_iter().filter(|_| !self.turns);
        powers.chain(tables.map(knots)).collect()
    }
}
