//! The vector sine and cosine against 200-bit arithmetic, on every path that this processor has, and its C twin
//! against it bit for bit. The full measurement, on 10⁷ points, is in `benches/accuracy`.

#![allow(clippy::unwrap_used, clippy::panic)]

mod c_twin;
mod single;

use codegen::vector::{Arithmetic, Path, ROWS, Waves, Work, path, run, sin_cos, sin_cos_rows};
use dashu_float::{FBig, round::mode::HalfEven};

type Wide = FBig<HalfEven, 2>;

/// Sines and cosines of slices of whole blocks.
struct Slices<'a> {
    x: &'a [f64],
    sine: &'a mut [f64],
    cosine: &'a mut [f64],
}

impl Work for Slices<'_> {
    #[inline(always)]
    fn run<A: Arithmetic>(self, arithmetic: A) {
        let x = self.x.as_chunks::<ROWS>().0;
        let sine = self.sine.as_chunks_mut::<ROWS>().0;
        let cosine = self.cosine.as_chunks_mut::<ROWS>().0;
        for ((x, sine), cosine) in x.iter().zip(sine).zip(cosine) {
            let mut waves = Waves::NEW;
            let (sines, cosines) = sin_cos_rows(arithmetic, x, &mut waves);
            sine.copy_from_slice(sines);
            cosine.copy_from_slice(cosines);
        }
    }
}

/// Sines and cosines of any number of angles on one path.
fn on(path: Path, x: &[f64]) -> Vec<(f64, f64)> {
    let mut padded = x.to_vec();
    padded.resize(x.len().next_multiple_of(ROWS), 0.0);
    let (mut sine, mut cosine) = (vec![f64::NAN; padded.len()], vec![f64::NAN; padded.len()]);
    run(path, Slices { x: &padded, sine: &mut sine, cosine: &mut cosine });
    sine.into_iter().zip(cosine).take(x.len()).collect()
}

/// The paths that this processor has.
fn paths() -> impl Iterator<Item = Path> {
    [Path::Portable, Path::V3, Path::V4].into_iter().filter(|&wanted| wanted <= path())
}

/// A stream of whole numbers by SplitMix64. Source: Steele, Lea, Flood, OOPSLA 2014.
fn stream(seed: u64) -> impl Iterator<Item = u64> {
    let mut state = seed;
    std::iter::repeat_with(move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    })
}

fn uniform(seed: u64, limit: f64, count: usize) -> Vec<f64> {
    let unit = |word: u64| (word >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
    stream(seed).take(count).map(|word| unit(word) * limit).collect()
}

/// The f64s nearest to multiples of π/2, and their neighbours: where the remainder is smallest.
fn quadrant_edges(seed: u64, count: usize) -> Vec<f64> {
    stream(seed)
        .take(count)
        .flat_map(|word| {
            let middle = (word % 636_619 + 1) as f64 * std::f64::consts::FRAC_PI_2;
            [middle.next_down(), middle, middle.next_up()]
        })
        .collect()
}

/// Any finite bit pattern beyond the fast reduction.
fn wide_angles(seed: u64, count: usize) -> Vec<f64> {
    stream(seed).map(f64::from_bits).filter(|x| x.is_finite() && x.abs() > 1e6).take(count).collect()
}

fn ulps_off(value: f64, reference: &Wide) -> f64 {
    let nearest = reference.to_f64().value();
    let unit = nearest.abs().next_up() - nearest.abs();
    let value = Wide::try_from(value).unwrap().with_precision(200).value();
    (value - reference).to_f64().value().abs() / unit
}

fn worst_ulps(x: &[f64], found: &[(f64, f64)]) -> f64 {
    let mut worst = 0.0_f64;
    for (&x, &(sine, cosine)) in x.iter().zip(found) {
        // Argument and result need room: the angle has up to 1024 bits before the point.
        let precision = 300 + x.abs().log2().max(0.0) as usize;
        let exact = Wide::try_from(x).unwrap().with_precision(precision).value();
        let (true_sine, true_cosine) = exact.sin_cos();
        worst = worst.max(ulps_off(sine, &true_sine)).max(ulps_off(cosine, &true_cosine));
    }
    worst
}

#[test]
fn validate_less_than_one_ulp_on_every_path() {
    let mut x = uniform(1, 1.0, 500);
    x.extend(uniform(2, 10.0, 1000));
    x.extend(uniform(3, 1e6, 1500));
    x.extend(quadrant_edges(4, 500));
    for path in paths() {
        let worst = worst_ulps(&x, &on(path, &x));
        assert!(worst < 0.9, "{path:?}: {worst} ulp");
    }
}

#[test]
fn validate_less_than_one_ulp_for_any_finite_angle() {
    let x = wide_angles(5, 300);
    for path in paths() {
        let worst = worst_ulps(&x, &on(path, &x));
        assert!(worst < 0.9, "{path:?}: {worst} ulp");
    }
}

#[test]
fn one_angle_is_the_portable_path() {
    let mut x = uniform(6, 100.0, 640);
    x.extend(wide_angles(7, 100));
    for (x, found) in x.iter().zip(on(Path::Portable, &x)) {
        assert_eq!(sin_cos(*x), found);
    }
}

#[test]
fn what_is_no_finite_number_stays_so_and_spoils_no_neighbour() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let x = [0.5, bad, 1e300, -2.0, bad];
        for path in paths() {
            let found = on(path, &x);
            for (x, (sine, cosine)) in x.iter().zip(found) {
                if x.is_finite() {
                    assert!(worst_ulps(&[*x], &[(sine, cosine)]) < 0.9);
                } else {
                    assert!(sine.is_nan() && cosine.is_nan());
                }
            }
        }
    }
}

#[test]
fn verify_signs_change_once_at_every_quadrant_edge() {
    // Around k·π/2 the sine or cosine falls or rises through zero; five steps on either side never go back.
    for word in stream(8).take(20_000) {
        let k = word % 636_619 + 1;
        let middle = k as f64 * std::f64::consts::FRAC_PI_2;
        let mut x = [middle; 11];
        for step in 0..5 {
            x[4 - step] = x[5 - step].next_down();
            x[6 + step] = x[5 + step].next_up();
        }
        for path in paths() {
            let found = on(path, &x);
            let through_zero: Vec<f64> =
                found.iter().map(|&(sine, cosine)| if k % 2 == 0 { sine } else { cosine }).collect();
            let rising = matches!(k % 4, 0 | 3);
            for pair in through_zero.windows(2) {
                let forward = if rising { pair[0] < pair[1] } else { pair[0] > pair[1] };
                assert!(forward, "{path:?}, near {middle}: {pair:?}");
            }
            assert!(through_zero[0] * through_zero[10] < 0.0, "{path:?}: no change near {middle}");
        }
    }
}
