//! The reference's uncertainty is in the ± of estimates: their spread over simulated references is as large as they say.

use fit::{FitOptions, Reference, fit};
use model_core::Chain;
use testkit::mount::{ARCSEC, NAMES, Noise, Poses, SIGMA, measured};
use testkit::{Random, turned};

use super::{MOUNT, observations};

/// The standard uncertainty of the frame's rotation about each axis.
const ROTATION: f64 = 3.0 * ARCSEC;

/// References that are simulated: a spread of them is known to 5 %.
const RUNS: u64 = 200;

#[test]
fn a_turned_frame_moves_the_base_by_as_much_as_is_said() {
    let chain = Chain::from_text(MOUNT).unwrap();
    let plain = FitOptions::for_chain(&chain);
    let stated = FitOptions {
        reference: Some(Reference { rotation_rad: ROTATION, ..Reference::default() }),
        ..plain.clone()
    };
    let mut squares = [0.0; 6];
    let mut said = [0.0; 6];
    let mut without = [0.0; 6];
    for seed in 0..RUNS {
        let mut random = Random::new(53_000 + seed);
        let mut own = measured(60, Poses::Random, Noise::White, 60.0 * ARCSEC, 54_000 + seed);
        for axis in 0..3 {
            let angle = ROTATION * random.normal();
            own.direction.iter_mut().for_each(|sight| *sight = turned(axis, angle, *sight));
        }
        let rows = observations(&chain, &own, false);
        let [result, bare] = [&stated, &plain].map(|options| fit(&chain, &rows, options).unwrap());
        for (at, name) in NAMES.iter().enumerate() {
            let id = chain.find_symbol(name).unwrap();
            squares[at] += (result.values[id.index()] - own.truth[at]).powi(2) / RUNS as f64;
            said[at] += result.standard_uncertainty(id).unwrap().powi(2) / RUNS as f64;
            without[at] += bare.standard_uncertainty(id).unwrap().powi(2) / RUNS as f64;
        }
    }
    for (at, name) in NAMES.iter().enumerate() {
        let ratio = (squares[at] / said[at]).sqrt();
        println!("{name}: spread over ± {ratio:.3}, ± {:.2}″", said[at].sqrt() / ARCSEC);
        assert!((0.85..=1.15).contains(&ratio), "{name}: {ratio}");
    }
    // No data know a tilt, or an index of azimuth, better than the frame.
    for at in 0..3 {
        assert!(said[at] >= ROTATION * ROTATION && said[at] > 2.0 * without[at], "{}", NAMES[at]);
    }
    // The others do not follow the frame.
    assert!((said[5] / without[5] - 1.0).abs() < 0.05 && SIGMA > 0.0);
}
