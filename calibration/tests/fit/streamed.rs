//! Rows in chunks give what all rows at once give.

use calibration::data::{Observations, Series};
use calibration::fit::{FitError, FitOptions, FitResult, Next, Streamed, StreamedResult, fit};

use crate::simulated::Simulation;

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;

/// Runs all passes, the chunks in the order given.
fn streamed(
    simulation: &Simulation,
    sample: &Observations,
    chunks: &[Observations],
    options: &FitOptions,
) -> StreamedResult {
    let mut state = Streamed::from_sample(&simulation.chain, sample, options).unwrap();
    loop {
        let tallies: Vec<_> = chunks.iter().map(|chunk| state.pass.accumulate(chunk).unwrap()).collect();
        let whole = tallies.iter().fold(state.pass.empty(), |whole, part| whole.merge(part));
        match state.next(&whole) {
            Next::Pass(next) => state = *next,
            Next::Done(result) => return *result,
        }
    }
}

/// As good as equal, and as certain.
fn assert_same(parts: &StreamedResult, all: &FitResult) {
    assert!(parts.converged);
    assert_eq!(parts.rank, all.rank);
    assert_eq!(parts.rows[0], all.residuals.weight.len() as u64);
    assert_eq!(parts.separable, all.separable);
    for (at, &parameter) in all.parameters.iter().enumerate().filter(|(at, _)| all.separable[*at]) {
        let uncertainty = all.covariance[(at, at)].sqrt();
        let moved = parts.values[parameter.index()] - all.values[parameter.index()];
        assert!(moved.abs() < 0.01 * uncertainty, "{}", moved / uncertainty);
        let ratio = parts.covariance[(at, at)].sqrt() / uncertainty;
        assert!((ratio - 1.0).abs() < 0.03, "{ratio}");
    }
}

#[test]
fn chunks_give_what_all_rows_give() {
    let mut simulation = Simulation::lidar(6000, 3);
    simulation.draw_errors("d*", 100.0 * ARCSEC);
    let mut observations = simulation.directions("pointing", 2.0 * ARCSEC);
    for robust in [false, true] {
        // The second time with outliers.
        for row in (0..6000).step_by(17).filter(|_| robust) {
            observations.measured[row].swap(0, 1);
        }
        let mut options = FitOptions::for_chain(&simulation.chain);
        options.robust = robust;
        options.noise.variance = false;
        let all = fit(&simulation.chain, &observations, &options).unwrap();
        let rows: Vec<usize> = (0..6000).collect();
        let chunks: Vec<Observations> = rows.chunks(1700).map(|rows| observations.select(rows)).collect();
        let parts = streamed(&simulation, &chunks[0], &chunks, &options);
        assert_same(&parts, &all);
    }
}

/// Directions in the first 2,000 rows, positions in the next: most chunks hold one of the two alone.
#[test]
fn chunks_may_hold_a_part_of_the_series() {
    let mut simulation = Simulation::lidar(4000, 5);
    simulation.draw_errors("d*", 100.0 * ARCSEC);
    let mut observations = simulation.directions("pointing", 2.0 * ARCSEC);
    let points = simulation.points("position", 1e-5);
    observations.measured[2000..].copy_from_slice(&points.measured[2000..]);
    observations.series[0].rows = 0..2000;
    observations.series.push(Series { rows: 2000..4000, ..points.series[0].clone() });
    let mut options = FitOptions::for_chain(&simulation.chain);
    options.noise.variance = false;
    let all = fit(&simulation.chain, &observations, &options).unwrap();
    let rows: Vec<usize> = (0..4000).collect();
    let chunks: Vec<Observations> = rows.chunks(1300).map(|rows| observations.select(rows)).collect();
    let tenth: Vec<usize> = (0..4000).step_by(10).collect();
    assert_same(&streamed(&simulation, &observations.select(&tenth), &chunks, &options), &all);

    let refused = Streamed::from_sample(&simulation.chain, &chunks[0], &options).unwrap_err();
    assert_eq!(
        refused,
        FitError::WrongShape { why: "the sample has no rows of series 2 (simulated)".to_string() }
    );
}
