//! Shapes of functions of one reading that no catalogue has: steps, ramps, bumps, waves with corners, powers, and tables.

use std::f64::consts::TAU;

use faer::Mat;
use model_core::algebra::{AngleSum, Poly, Rational};
use model_core::{Chain, Quantity, SymbolId};

use observe::waves::waves;

/// Digits of a threshold, relative to the range of the readings.
const DIGITS: f64 = 4.0;

/// The share of either flank of a bump that must lie within the readings.
const FLANK: f64 = 0.25;

/// The share of the readings' range that must lie beyond either end of a plateau.
const END: f64 = 0.05;

/// A wave that repeats a whole number of times a turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wave {
    /// Up and down in jumps.
    Square,
    /// Up evenly, down in a jump.
    Sawtooth,
    /// Up and down evenly.
    Triangle,
}

/// A function of one reading, or several with a coefficient each. Thresholds are readings, SI.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Shape {
    /// A jump.
    Step { at: f64 },
    /// From one level to another; a hinge where one end is that of the readings.
    Ramp { from: f64, to: f64 },
    /// A triangle over its middle, so wide on either side.
    Bump { middle: f64, width: f64 },
    /// Up at one threshold, down at another.
    Plateau { from: f64, to: f64 },
    /// A wave of so many periods a turn that starts a period at a reading, over the readings' range.
    Periodic { wave: Wave, order: u32, start: f64, range: (f64, f64) },
    /// Powers from the first on.
    Powers { highest: u32 },
    /// A harmonic beyond those of the catalogue: cosine and sine of so many times a turn.
    Harmonic { order: u32 },
    /// Straight between knots, a coefficient for each stretch.
    Table { knots: Vec<f64> },
}

/// 0 before one threshold, 1 behind another, linear between.
fn ramp(x: f64, from: f64, to: f64) -> f64 {
    if from == to { f64::from(u8::from(x >= from)) } else { ((x - from) / (to - from)).clamp(0.0, 1.0) }
}

impl Shape {
    /// Thresholds that were chosen by the data.
    pub fn parameters(&self) -> usize {
        self.thresholds().len()
    }

    /// The thresholds that can be moved.
    pub fn thresholds(&self) -> Vec<f64> {
        match *self {
            Self::Step { at } => vec![at],
            Self::Ramp { from, to } | Self::Plateau { from, to } => vec![from, to],
            Self::Bump { middle, width } => vec![middle, width],
            Self::Periodic { start, .. } => vec![start],
            Self::Powers { .. } | Self::Harmonic { .. } | Self::Table { .. } => Vec::new(),
        }
    }

    /// The same with other thresholds, as many as [`Self::thresholds`] gives; `None` if they are in no order.
    pub fn moved(&self, to: &[f64]) -> Option<Self> {
        let moved = match (self, to) {
            (Self::Step { .. }, &[at]) => Self::Step { at },
            (Self::Ramp { .. }, &[from, to]) if from <= to => Self::Ramp { from, to },
            (Self::Plateau { .. }, &[from, to]) if from < to => Self::Plateau { from, to },
            (Self::Bump { .. }, &[middle, width]) if width > 0.0 => Self::Bump { middle, width },
            (&Self::Periodic { wave, order, range, .. }, &[start]) => {
                Self::Periodic { wave, order, start, range }
            }
            _ => return None,
        };
        Some(moved)
    }

    /// Whether readings between two show all of it: a bump of one side is a ramp, a plateau with one end a step.
    pub fn is_seen_between(&self, low: f64, high: f64) -> bool {
        let inside = |x: f64| (x - low).min(high - x);
        match *self {
            Self::Bump { middle, width } => inside(middle) >= FLANK * width,
            Self::Plateau { from, to } => inside(from).min(inside(to)) >= END * (high - low),
            _ => true,
        }
    }

    /// The sums of ramps that it is made of, one sum a function: sign, from, to. Nothing for powers and harmonics.
    fn ramps(&self) -> Vec<Vec<(f64, f64, f64)>> {
        match self {
            &Self::Step { at } => vec![vec![(1.0, at, at)]],
            &Self::Ramp { from, to } => vec![vec![(1.0, from, to)]],
            &Self::Bump { middle, width } => {
                vec![vec![(1.0, middle - width, middle), (-1.0, middle, middle + width)]]
            }
            &Self::Plateau { from, to } => vec![vec![(1.0, from, from), (-1.0, to, to)]],
            &Self::Periodic { wave, order, start, range } => vec![periods(wave, order, start, range)],
            Self::Powers { .. } | Self::Harmonic { .. } => Vec::new(),
            Self::Table { knots } => knots.windows(2).map(|pair| vec![(1.0, pair[0], pair[1])]).collect(),
        }
    }

    /// The functions at readings, one row a reading.
    pub fn values(&self, readings: &[f64]) -> Mat<f64> {
        if let Self::Powers { highest } = *self {
            return Mat::from_fn(readings.len(), highest as usize, |i, j| readings[i].powi(j as i32 + 1));
        }
        if let Self::Harmonic { order } = *self {
            let [sine, cosine] = waves(readings, f64::from(order));
            return Mat::from_fn(readings.len(), 2, |i, j| if j == 0 { cosine[i] } else { sine[i] });
        }
        let ramps = self.ramps();
        Mat::from_fn(readings.len(), ramps.len(), |i, j| {
            ramps[j].iter().map(|&(sign, from, to)| sign * ramp(readings[i], from, to)).sum()
        })
    }

    /// The functions as amounts of a chain, which gets the ramps that they need; `None` where it has no room for them.
    pub fn amounts(&self, chain: &mut Chain, driver: SymbolId) -> Option<Vec<Poly>> {
        if let Self::Powers { highest } = self {
            let x = Poly::symbol(driver);
            let powers = (1..=*highest).scan(Poly::one(), |power, _| {
                *power = &*power * &x;
                Some(power.clone())
            });
            return Some(powers.collect());
        }
        if let Self::Harmonic { order } = self {
            let angle = AngleSum::symbol(driver).times(*order).ok()?;
            return Some(vec![Poly::cos(&angle), Poly::sin(&angle)]);
        }
        let mut amounts = Vec::new();
        for ramps in self.ramps() {
            let mut sum = Poly::zero();
            for (sign, from, to) in ramps {
                let ramp = Poly::symbol(chain.add_ramp(driver, number(from)?, number(to)?)?);
                sum = if sign > 0.0 { &sum + &ramp } else { &sum - &ramp };
            }
            amounts.push(sum);
        }
        Some(amounts)
    }

    /// The same with thresholds of few digits, enough for readings that span so much.
    pub fn rounded(self, span: f64) -> Self {
        let digits = (DIGITS - span.log10()).round().clamp(0.0, 12.0) as i32;
        let unit = 10.0_f64.powi(digits);
        let round = |x: f64| (x * unit).round() / unit;
        match self {
            Self::Table { knots } => {
                let mut knots: Vec<f64> = knots.into_iter().map(round).collect();
                knots.dedup();
                Self::Table { knots }
            }
            other => {
                let rounded: Vec<f64> = other.thresholds().into_iter().map(round).collect();
                other.moved(&rounded).unwrap_or(other)
            }
        }
    }

    /// What it is, with its thresholds in degrees where they are angles: `step at 30.02 deg`.
    pub fn words(&self, of: Quantity) -> String {
        let kind = self.kind().words();
        let in_words = |x: f64| match of {
            Quantity::Angle => format!("{:.2} deg", x.to_degrees()),
            Quantity::Length => format!("{:.1} mm", 1e3 * x),
            Quantity::Number => format!("{x:.4}"),
        };
        match *self {
            Self::Step { at } => format!("{kind} at {}", in_words(at)),
            Self::Ramp { from, to } | Self::Plateau { from, to } => {
                format!("{kind} from {} to {}", in_words(from), in_words(to))
            }
            Self::Bump { middle, width } => {
                format!("{kind} at {}, {} wide on either side,", in_words(middle), in_words(width))
            }
            _ => format!("{kind},"),
        }
    }

    /// The kind, without thresholds: what two runs that found the same function agree upon.
    pub fn kind(&self) -> ShapeKind {
        match self {
            Self::Step { .. } => ShapeKind::Step,
            Self::Ramp { .. } => ShapeKind::Ramp,
            Self::Bump { .. } => ShapeKind::Bump,
            Self::Plateau { .. } => ShapeKind::Plateau,
            &Self::Periodic { wave, order, .. } => ShapeKind::Periodic(wave, order),
            Self::Powers { .. } => ShapeKind::Powers,
            &Self::Harmonic { order } => ShapeKind::Harmonic(order),
            Self::Table { .. } => ShapeKind::Table,
        }
    }
}

/// A kind of shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ShapeKind {
    Step,
    Ramp,
    Bump,
    Plateau,
    Periodic(Wave, u32),
    Powers,
    Harmonic(u32),
    Table,
}

impl ShapeKind {
    /// `step`, `unnamed function, tabulated`.
    pub fn words(self) -> String {
        match self {
            Self::Step => "step".to_owned(),
            Self::Ramp => "ramp".to_owned(),
            Self::Bump => "bump".to_owned(),
            Self::Plateau => "plateau".to_owned(),
            Self::Periodic(Wave::Square, order) => format!("square wave, {order} per turn"),
            Self::Periodic(Wave::Sawtooth, order) => format!("sawtooth, {order} per turn"),
            Self::Periodic(Wave::Triangle, order) => format!("triangle wave, {order} per turn"),
            Self::Powers => "powers".to_owned(),
            Self::Harmonic(order) => format!("harmonic, {order} per turn"),
            Self::Table => "unnamed function, tabulated".to_owned(),
        }
    }

    /// Stem of the names of its errors: `step`.
    pub fn stem(self) -> &'static str {
        match self {
            Self::Step => "step",
            Self::Ramp => "ramp",
            Self::Bump => "bump",
            Self::Plateau => "plateau",
            Self::Periodic(Wave::Square, _) => "square",
            Self::Periodic(Wave::Sawtooth, _) => "sawtooth",
            Self::Periodic(Wave::Triangle, _) => "triangle",
            Self::Powers => "power",
            Self::Harmonic(_) => "harmonic",
            Self::Table => "table",
        }
    }
}

/// The ramps of a wave over a range.
fn periods(wave: Wave, order: u32, start: f64, (low, high): (f64, f64)) -> Vec<(f64, f64, f64)> {
    let period = TAU / f64::from(order);
    let mut ramps = Vec::new();
    let mut at = start - ((start - low) / period).ceil() * period;
    while at < high {
        let (middle, end) = (at + period / 2.0, at + period);
        match wave {
            Wave::Square => ramps.extend([(1.0, at, at), (-1.0, middle, middle)]),
            Wave::Sawtooth => ramps.extend([(1.0, at, end), (-1.0, end, end)]),
            Wave::Triangle => ramps.extend([(1.0, at, middle), (-1.0, middle, end)]),
        }
        at = end;
    }
    ramps
}

/// A number as an amount.
fn number(value: f64) -> Option<Poly> {
    let text = format!("{:.12}", value.abs());
    let trimmed = text.trim_end_matches('0').trim_end_matches('.');
    let size = Poly::constant(Rational::parse_decimal(trimmed).ok()?);
    Some(if value < 0.0 { -&size } else { size })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_are_what_they_are_called() {
        let one = |shape: Shape, x: f64| shape.values(&[x])[(0, 0)];
        assert_eq!(one(Shape::Step { at: 1.0 }, 0.9), 0.0);
        assert_eq!(one(Shape::Step { at: 1.0 }, 1.0), 1.0);
        assert_eq!(one(Shape::Ramp { from: 1.0, to: 3.0 }, 2.5), 0.75);
        assert_eq!(one(Shape::Bump { middle: 1.0, width: 0.5 }, 1.25), 0.5);
        assert_eq!(one(Shape::Bump { middle: 1.0, width: 0.5 }, 2.0), 0.0);
        assert_eq!(one(Shape::Plateau { from: 1.0, to: 2.0 }, 1.5), 1.0);
        assert_eq!(one(Shape::Plateau { from: 1.0, to: 2.0 }, 2.5), 0.0);
        assert_eq!(Shape::Powers { highest: 3 }.values(&[2.0])[(0, 2)], 8.0);
        let harmonic = Shape::Harmonic { order: 17 }.values(&[TAU / 68.0]);
        assert!(harmonic[(0, 0)].abs() < 1e-12 && (harmonic[(0, 1)] - 1.0).abs() < 1e-12);
        let table = Shape::Table { knots: vec![0.0, 1.0, 3.0] }.values(&[2.0]);
        assert_eq!((table[(0, 0)], table[(0, 1)]), (1.0, 0.5));
    }

    #[test]
    fn waves_repeat() {
        let range = (-7.0, 7.0);
        for wave in [Wave::Square, Wave::Sawtooth, Wave::Triangle] {
            let shape = Shape::Periodic { wave, order: 3, start: 0.3, range };
            for i in 0..20 {
                let x = -3.1 + 0.21 * f64::from(i);
                let at = shape.values(&[x, x + TAU / 3.0]);
                assert!((at[(0, 0)] - at[(1, 0)]).abs() < 1e-9, "{wave:?} at {x}");
            }
        }
        let saw = Shape::Periodic { wave: Wave::Sawtooth, order: 1, start: 0.0, range: (0.0, TAU) };
        assert!((saw.values(&[TAU / 4.0])[(0, 0)] - 0.25).abs() < 1e-12);
    }
}
