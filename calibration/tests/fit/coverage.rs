//! What is said of the uncertainty is so: intervals hold the truth as often as they claim.

use fit::{FitOptions, Outcome, fit};
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::simulated::Simulation;

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;
/// The share of runs in which the interval of 95 % holds the truth, parameter by parameter.
fn coverage(runs: u64, rows: usize, memory: f64) -> Vec<f64> {
    let text = include_str!("../../../examples/alt-azimuth/alt-azimuth.chain");
    let mut hits = Vec::new();
    for seed in 0..runs {
        let mut simulation = Simulation::new(text, seed);
        simulation.column("azimuth", rows, -3.1..3.1);
        simulation.column("elevation", rows, 0.2..1.3);
        simulation.draw_errors("*", 60.0 * ARCSEC);
        let mut observations = simulation.directions_with("sight", 2.0 * ARCSEC, memory);
        observations.in_sequence = memory > 0.0;
        let result =
            fit(&simulation.chain, &observations, &FitOptions::for_chain(&simulation.chain)).unwrap();
        assert!(matches!(result.outcome, Outcome::Converged { .. }), "seed {seed}: {:?}", result.outcome);
        hits.resize(result.parameters.len(), 0.0);
        let reach = StudentsT::new(0.0, 1.0, result.degrees_of_freedom).unwrap().inverse_cdf(0.975);
        for (hit, &parameter) in hits.iter_mut().zip(&result.parameters) {
            let error = result.values[parameter.index()] - simulation.values[parameter.index()];
            let inside = error.abs() <= reach * result.standard_uncertainty(parameter).unwrap();
            *hit += f64::from(u8::from(inside)) / runs as f64;
        }
    }
    hits
}

#[test]
fn intervals_of_95_percent_hold_the_truth_in_95_percent() {
    let coverage = coverage(2000, 80, 0.0);
    for share in &coverage {
        assert!((share - 0.95).abs() <= 0.015, "{coverage:?}");
    }
}

/// Fewer runs of more rows: the memory has itself to be estimated.
#[test]
fn intervals_know_of_serial_correlation() {
    let coverage = coverage(500, 250, 0.7);
    for share in &coverage {
        assert!((share - 0.95).abs() <= 0.03, "{coverage:?}");
    }
}
