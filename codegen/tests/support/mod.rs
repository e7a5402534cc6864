//! The chains of the tests, and poses at random.

use model_core::{Chain, SymbolId, SymbolKind};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Thirteen chains: every feature of the language, every kind of amount.
pub const CHAINS: [(&str, &str); 13] = [
    ("mobile_lidar", include_str!("../../../examples/mobile-lidar/mobile-lidar.chain")),
    ("alt_azimuth", include_str!("../../../examples/alt-azimuth/alt-azimuth.chain")),
    ("equatorial", include_str!("../chains/equatorial.chain")),
    ("total_station", include_str!("../chains/total_station.chain")),
    ("turntable", include_str!("../chains/turntable.chain")),
    ("gimbal", include_str!("../chains/gimbal.chain")),
    ("tree", include_str!("../chains/tree.chain")),
    ("arm", include_str!("../chains/arm.chain")),
    ("tracker", include_str!("../chains/tracker.chain")),
    ("higher_order", include_str!("../chains/higher_order.chain")),
    ("hysteresis", include_str!("../chains/hysteresis.chain")),
    ("ramps", include_str!("../chains/ramps.chain")),
    ("words", include_str!("../chains/words.chain")),
];

/// Angles, ranges and other frames: what is shown beside vectors in double precision alone.
#[allow(dead_code, reason = "not every suite needs it")]
pub const READINGS: (&str, &str) = ("readings", include_str!("../chains/readings.chain"));

/// Lines of sight, in double precision alone.
#[allow(dead_code, reason = "not every suite needs it")]
pub const SIGHT: (&str, &str) = ("sight", include_str!("../chains/sight.chain"));

pub fn read(name: &str, text: &str) -> Chain {
    Chain::from_text(text).unwrap_or_else(|mistakes| panic!("{}", mistakes.render(name, text)))
}

/// Values of every symbol: errors up to `size`, constants as declared, angles over the circle and away from the
/// zeros of their sines, so that cotangents stay moderate.
pub fn pose(chain: &Chain, random: &mut ChaCha8Rng, size: f64) -> Vec<f64> {
    let mut values: Vec<f64> = chain
        .symbols
        .iter()
        .map(|symbol| match symbol.kind {
            SymbolKind::Pi => std::f64::consts::PI,
            SymbolKind::Constant => symbol.value.unwrap(),
            SymbolKind::Error => size * random.random_range(-1.0..1.0),
            SymbolKind::Joint => random.random_range(0.2..1.3) + 1.5 * f64::from(random.random_range(-2..2)),
            SymbolKind::Input => random.random_range(-3.0..3.0),
            SymbolKind::Ramp | SymbolKind::SightAngle => f64::NAN,
        })
        .collect();
    chain.set_derived(&mut values);
    values
}

pub fn random(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

pub fn errors(chain: &Chain) -> Vec<SymbolId> {
    chain.symbols_of(SymbolKind::Error).collect()
}
