//! A robust fit never ends above where it starts, and one that failed says so.

use fit::{FitOptions, Outcome, fit};
use model_core::Chain;

use crate::{MOUNT, observations};
use testkit::mount::{ARCSEC, Noise, Poses, SIGMA, measured};

/// From starts far away and with a third of gross errors: the same bottom as from nothing, the same rows aside.
#[test]
fn the_start_does_not_decide() {
    let chain = Chain::from_text(MOUNT).unwrap();
    let mut data = measured(120, Poses::Random, Noise::White, 60.0 * ARCSEC, 61);
    for row in (0..120).step_by(3) {
        data.direction[row].rotate_left(1);
    }
    let observations = observations(&chain, &data, false);
    let mut options = FitOptions::for_chain(&chain);
    // A third of gross errors is also a noise that depends on the joints.
    options.noise.variance = false;
    let first = fit(&chain, &observations, &options).unwrap();
    assert!(first.outcome.is_usable(), "{:?}", first.outcome);
    assert_eq!(first.set_aside.iter().filter(|aside| aside.row % 3 == 0).count(), 40);
    assert!(first.rms < 3.5 * SIGMA, "{}", first.rms / ARCSEC);
    // Errors are small; from 0.8 rad the fit still ends far away, which the changelog says.
    for far in [0.05, -0.3] {
        let mut options = options.clone();
        for (at, id) in options.estimate.iter().enumerate() {
            options.start[id.index()] = if at % 2 == 0 { far } else { -0.7 * far };
        }
        let other = fit(&chain, &observations, &options).unwrap();
        assert!(other.outcome.is_usable(), "{far}: {:?}", other.outcome);
        assert!((other.rms / first.rms - 1.0).abs() < 1e-3, "{far}: {} {}", other.rms, first.rms);
    }
}

/// Three points on circles about one axis, and a robust start two millimetres away: least squares from there reaches the noise,
/// and so does the robust fit.
#[test]
fn points_near_the_truth_stay_near() {
    let text = "chain Arm { body a on ground { position_error: Tx(x), Ty(y), Tz(z), Rx(tilt_x), Ry(tilt_y); \
                motion: Rz(q); motion_error: Rz(index); } \
                body b on a { position: Tx(0.7); position_error: Tx(length), Rx(twist); motion: Ry(s); \
                motion_error: Ry(second); } \
                observe tip: point(0.4, 0.1, 0.2) of b; }";
    let chain = Chain::from_text(text).unwrap();
    // Coordinates by hand: two turns and two shifts.
    let at = |q: f64, s: f64| {
        let (x, y, z) = (0.4 * s.cos() + 0.2 * s.sin() + 0.7, 0.1, 0.2 * s.cos() - 0.4 * s.sin());
        [q.cos() * x - q.sin() * y, q.sin() * x + q.cos() * y, z]
    };
    let turn = |row: usize, step: f64| (row as f64 * step).fract();
    let q: Vec<f64> = (0..60).map(|row| 6.0 * turn(row, 0.754_877_666) - 3.0).collect();
    let s: Vec<f64> = (0..60).map(|row| 2.0 * turn(row, 0.569_840_291) - 1.0).collect();
    let mut points: Vec<[f64; 3]> = q.iter().zip(&s).map(|(&q, &s)| at(q, s)).collect();
    for (row, point) in points.iter_mut().enumerate() {
        point
            .iter_mut()
            .enumerate()
            .for_each(|(k, value)| *value += 1e-4 * (turn(row + 7 * k, 0.618_033_99) - 0.5));
        if row % 10 == 4 {
            point[0] += 5.0;
        }
    }
    let mut data = observations(
        &Chain::from_text(MOUNT).unwrap(),
        &measured(60, Poses::Random, Noise::White, 0.0, 1),
        false,
    );
    data.poses.series[0].observable = chain.find_observable("tip").unwrap();
    data.poses.series[0].measure = observe::Measure::Point;
    data.poses.columns = vec![(chain.find_symbol("q").unwrap(), q), (chain.find_symbol("s").unwrap(), s)];
    data.poses.columns.sort_by_key(|(id, _)| *id);
    data.measured = points.into_iter().map(|point| observe::Measured::Point(point.into())).collect();
    for off in [0.0, 2e-3, 0.5, -2.0] {
        let mut options = FitOptions::for_chain(&chain);
        options.estimate.iter().for_each(|id| options.start[id.index()] = off);
        let result = fit(&chain, &data, &options).unwrap();
        assert!(matches!(result.outcome, Outcome::Converged { .. }), "{off}: {:?}", result.outcome);
        assert_eq!(result.set_aside.len(), 6, "{off}");
        assert!(result.rms < 1e-4, "{off}: {}", result.rms);
    }
}
