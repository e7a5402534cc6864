//! What the encoders and the thermometer said, row by row.

use std::f64::consts::TAU;

use model_core::{Chain, SymbolId, SymbolKind};
use rand::{Rng, RngExt as _};

use crate::instrument::Instrument;

/// The readings of one row, rounded as a file writes them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Of the first and the second joint, degrees.
    pub joints_deg: [f64; 2],
    /// Degrees Celsius.
    pub temperature: f64,
    /// 1 or 2.
    pub set_up: u8,
}

impl Pose {
    /// 1 in the second set-up, 0 in the first.
    #[must_use]
    pub fn second(&self) -> f64 {
        f64::from(u8::from(self.set_up == 2))
    }
}

/// Readings of chance within the ranges of an instrument: in two set-ups, while the temperature rises and falls once.
#[must_use]
pub fn drawn(instrument: &Instrument, rows: usize, random: &mut impl Rng) -> Vec<Pose> {
    let phase = random.random_range(0.0..TAU);
    let change = (rows as f64 * random.random_range(0.4..0.6)) as usize;
    let axes = [instrument.first, instrument.second];
    let pose = |row: usize| {
        let joints_deg = axes.map(|axis| {
            let [low, high] = axis.range_deg;
            rounded(random.random_range(low..high), 4)
        });
        let share = row as f64 / rows as f64;
        let temperature = 15.0 + 8.0 * (TAU * share + phase).sin() + random.random_range(-2.0..2.0);
        Pose { joints_deg, temperature: rounded(temperature, 1), set_up: if row < change { 1 } else { 2 } }
    };
    (0..rows).map(pose).collect()
}

/// Columns of readings as a chain of the instrument takes them, SI, in the order of its symbols; those that it does not name are left
/// out.
#[must_use]
pub fn columns(poses: &[Pose], instrument: &Instrument, chain: &Chain) -> Vec<(SymbolId, Vec<f64>)> {
    let [first, second] = instrument.joints();
    let of = |name: &str, value: &dyn Fn(&Pose) -> f64| {
        let id = chain.find_symbol(name)?;
        // Somebody may have given the name to an error or a constant.
        let is_read = matches!(chain.symbol(id).kind, SymbolKind::Joint | SymbolKind::Input);
        is_read.then(|| (id, poses.iter().map(value).collect()))
    };
    let mut columns: Vec<_> = [
        of(first, &|pose| pose.joints_deg[0].to_radians()),
        of(second, &|pose| pose.joints_deg[1].to_radians()),
        of("temperature", &|pose| pose.temperature),
        of("second", &Pose::second),
    ]
    .into_iter()
    .flatten()
    .collect();
    columns.sort_by_key(|(id, _)| *id);
    columns
}

/// A number with so many digits behind the point.
#[must_use]
pub fn rounded(number: f64, digits: i32) -> f64 {
    let scale = 10_f64.powi(digits);
    (number * scale).round() / scale
}
