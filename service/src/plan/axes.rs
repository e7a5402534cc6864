//! What can be set: a joint or an input within its limits, in steps that a person can set.

use model_core::unit::Unit;
use model_core::{Chain, Quantity, SymbolId};

/// Steps that a range has at least.
const STEPS: f64 = 20.0;

/// How far beyond its ends a range is looked at: poses there go to the ends, where much is seen.
const BEYOND: f64 = 0.1;

/// The smallest step, as a power of ten of the unit.
const FINEST: i32 = -9;

/// A joint or an input that can be set.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The joint or input.
    pub symbol: SymbolId,
    /// The smallest and the largest value, SI.
    pub limits: [f64; 2],
    /// The unit in which it is set; none for a plain number.
    pub unit: Option<Unit>,
    /// Whether it goes round, so that both ends are one pose.
    pub turns: bool,
    /// The step, as a power of ten of the unit.
    power: i32,
    /// The first and the last whole number of steps within the limits.
    steps: [i64; 2],
}

impl Axis {
    /// With steps of whole units, or of a tenth of one and so on where the range is short.
    #[must_use]
    pub fn new(chain: &Chain, symbol: SymbolId, limits: [f64; 2], unit: Option<Unit>, turns: bool) -> Self {
        let is_angle = chain.symbol(symbol).quantity == Quantity::Angle;
        let in_units = limits.map(|si| si / unit.map_or(1.0, Unit::in_si));
        let width = in_units[1] - in_units[0];
        let largest = if is_angle { 0 } else { 9 };
        let power =
            (FINEST..=largest).rev().find(|&power| width >= STEPS * 10_f64.powi(power)).unwrap_or(FINEST);
        let step = 10_f64.powi(power);
        // Limits are far below 2^53 steps; what is beyond saturates.
        #[allow(clippy::cast_possible_truncation)]
        let steps =
            [((in_units[0] / step) - 1e-6).ceil() as i64, ((in_units[1] / step) + 1e-6).floor() as i64];
        Self { symbol, limits, unit, turns, power, steps }
    }

    /// Whether it has one value only.
    #[must_use]
    pub fn is_fixed(&self) -> bool {
        self.steps[0] >= self.steps[1] || self.limits[0] == self.limits[1]
    }

    /// The whole number of steps at a fraction of the range; a part of the fractions stands at either end.
    pub(super) fn step_at(&self, fraction: f64) -> i64 {
        if self.is_fixed() {
            return self.steps[0];
        }
        let [first, last] = self.steps;
        let count = (last - first) as f64;
        let at =
            if self.turns { fraction } else { (fraction * (1.0 + 2.0 * BEYOND) - BEYOND).clamp(0.0, 1.0) };
        // Between zero and the number of steps.
        #[allow(clippy::cast_possible_truncation)]
        let step = if self.turns { (at * count).floor() as i64 } else { (at * count).round() as i64 };
        first + step
    }

    /// The value at a whole number of steps, SI.
    pub(super) fn value(&self, step: i64) -> f64 {
        if self.is_fixed() {
            return self.limits[0];
        }
        let value = step as f64 * 10_f64.powi(self.power) * self.unit.map_or(1.0, Unit::in_si);
        value.clamp(self.limits[0], self.limits[1])
    }

    /// A value as it is set, in the unit.
    #[must_use]
    pub fn written(&self, si: f64) -> String {
        let value = si / self.unit.map_or(1.0, Unit::in_si);
        if self.is_fixed() {
            let text = format!("{value:.12}");
            return text.trim_end_matches('0').trim_end_matches('.').to_owned();
        }
        let digits = usize::try_from(-self.power).unwrap_or(0);
        let text = format!("{value:.digits$}");
        if text.trim_start_matches('-').chars().all(|letter| "0.".contains(letter)) {
            text.trim_start_matches('-').to_owned()
        } else {
            text
        }
    }

    /// The heading of its column.
    #[must_use]
    pub fn heading(&self, chain: &Chain) -> String {
        let name = &chain.symbol(self.symbol).name;
        self.unit.map_or_else(|| name.clone(), |unit| format!("{name} [{}]", unit.name()))
    }
}
