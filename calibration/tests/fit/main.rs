//! The fit against simulated instruments whose errors are known.
#![allow(clippy::unwrap_used)]

mod align;
mod coverage;
mod homes;
mod kinds;
mod nasty;
mod orientations;
mod poses;
mod precision;
mod simulated;
mod streamed;
mod undetermined;

use fit::{FitOptions, Outcome, fit};
use simulated::Simulation;

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;

#[test]
fn directions_of_the_lidar_give_back_what_they_can() {
    let mut simulation = Simulation::lidar(1000, 7);
    simulation.draw_errors("d*", 20.0 * ARCSEC);
    let observations = simulation.directions("pointing", 2.0 * ARCSEC);
    let result = fit(&simulation.chain, &observations, &FitOptions::for_chain(&simulation.chain)).unwrap();
    assert!(matches!(result.outcome, Outcome::Converged { .. }), "{:?}", result.outcome);
    // Eight combinations of rotations; shifts do not move a direction.
    assert_eq!(result.rank, 8, "{:?}", result.separable);
    for (&parameter, &separable) in result.parameters.iter().zip(&result.separable) {
        let truth = simulation.values[parameter.index()];
        let uncertainty = result.standard_uncertainty(parameter).unwrap();
        if separable {
            let error = result.values[parameter.index()] - truth;
            assert!(error.abs() < 4.0 * uncertainty, "{parameter:?}: {error} against {uncertainty}");
            assert!(uncertainty < 0.5 * ARCSEC);
        }
    }
    let sigma = result.rms / std::f64::consts::SQRT_2;
    assert!((sigma / (2.0 * ARCSEC) - 1.0).abs() < 0.05, "{}", sigma / ARCSEC);
}
