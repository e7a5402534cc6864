//! Sine and cosine in single precision, against the vector kernel in double precision, which the other tests hold to 200-bit
//! arithmetic. C is held to Rust's bits by the conformance tests.

use codegen::vector::single;

use super::sin_cos;

/// Units in the last place that a result may be off.
const ULPS: f64 = 0.9;

fn off(found: f32, expected: f64) -> f64 {
    let size = (expected.abs() as f32).max(f32::MIN_POSITIVE);
    (f64::from(found) - expected).abs() / f64::from(size.next_up() - size)
}

#[test]
fn validate_single_precision() {
    // Every so many of all bit patterns, and the neighbours of multiples of π/2.
    let patterns = (0..u32::MAX / 10_007).map(|index| f32::from_bits(index * 10_007));
    let edges = (1..20_000).flat_map(|quarters| {
        let middle = (f64::from(quarters) * std::f64::consts::FRAC_PI_2) as f32;
        [middle.next_down(), middle, middle.next_up()]
    });
    let mut worst = 0.0_f64;
    for x in patterns.chain(edges) {
        let (sine, cosine) = single::sin_cos(x);
        if x.is_finite() {
            let (expected_sine, expected_cosine) = sin_cos(f64::from(x));
            worst = worst.max(off(sine, expected_sine)).max(off(cosine, expected_cosine));
            assert!(worst <= ULPS, "{x:?}: {sine:?} and {cosine:?}, {worst} ulp off");
        } else {
            assert!(sine.is_nan() && cosine.is_nan(), "{x:?}: {sine:?} and {cosine:?}");
        }
    }
    assert!(worst > 0.5, "the comparison compares: {worst}");
}
