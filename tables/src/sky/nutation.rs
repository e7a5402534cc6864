//! Nutation: the nodding of the Earth's axis, by its largest terms.
//!
//! Source: P. K. Seidelmann, 1980 IAU theory of nutation (1982), table I, the terms from 0.005″ on: with them the places of
//! `tests/sky/apparent.py` are within 0.1″.

use super::ARCSEC;

/// Multiples of l, l′, F, D and Ω, then the amplitudes in longitude (sine) and obliquity (cosine), 0.0001″.
const TERMS: &[([f64; 5], f64, f64)] = &[
    ([0.0, 0.0, 0.0, 0.0, 1.0], -171_996.0, 92_025.0),
    ([0.0, 0.0, 2.0, -2.0, 2.0], -13_187.0, 5_736.0),
    ([0.0, 0.0, 2.0, 0.0, 2.0], -2_274.0, 977.0),
    ([0.0, 0.0, 0.0, 0.0, 2.0], 2_062.0, -895.0),
    ([0.0, 1.0, 0.0, 0.0, 0.0], 1_426.0, 54.0),
    ([1.0, 0.0, 0.0, 0.0, 0.0], 712.0, -7.0),
    ([0.0, 1.0, 2.0, -2.0, 2.0], -517.0, 224.0),
    ([0.0, 0.0, 2.0, 0.0, 1.0], -386.0, 200.0),
    ([1.0, 0.0, 2.0, 0.0, 2.0], -301.0, 129.0),
    ([0.0, -1.0, 2.0, -2.0, 2.0], 217.0, -95.0),
    ([1.0, 0.0, 0.0, -2.0, 0.0], -158.0, -1.0),
    ([0.0, 0.0, 2.0, -2.0, 1.0], 129.0, -70.0),
    ([-1.0, 0.0, 2.0, 0.0, 2.0], 123.0, -53.0),
    ([1.0, 0.0, 0.0, 0.0, 1.0], 63.0, -33.0),
    ([0.0, 0.0, 0.0, 2.0, 0.0], 63.0, -2.0),
    ([-1.0, 0.0, 2.0, 2.0, 2.0], -59.0, 26.0),
    ([-1.0, 0.0, 0.0, 0.0, 1.0], -58.0, 32.0),
    ([1.0, 0.0, 2.0, 0.0, 1.0], -51.0, 27.0),
];

/// The fundamental arguments by powers of the centuries, degrees.
const ARGUMENTS: [[f64; 3]; 5] = [
    [134.962_98, 477_198.867_398, 0.008_697_2],
    [357.527_72, 35_999.050_34, -0.000_160_3],
    [93.271_91, 483_202.017_538, -0.003_682_5],
    [297.850_36, 445_267.111_48, -0.001_914_2],
    [125.044_52, -1_934.136_261, 0.002_070_8],
];

/// The nutation in longitude and in obliquity, rad.
pub(super) fn angles(centuries: f64) -> [f64; 2] {
    let arguments =
        ARGUMENTS.map(|[zero, one, two]| (zero + centuries * (one + centuries * two)).to_radians());
    let mut sums = [0.0; 2];
    for (at, (multiples, in_longitude, in_obliquity)) in TERMS.iter().enumerate() {
        let angle: f64 = multiples.iter().zip(arguments).map(|(times, argument)| times * argument).sum();
        // The largest term grows.
        let grown = if at == 0 { [-174.2 * centuries, 8.9 * centuries] } else { [0.0; 2] };
        sums[0] += (in_longitude + grown[0]) * angle.sin();
        sums[1] += (in_obliquity + grown[1]) * angle.cos();
    }
    sums.map(|sum| sum * 1e-4 * ARCSEC)
}
