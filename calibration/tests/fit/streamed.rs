//! Rows in chunks give what all rows at once give.

use calibration::fit::{FitOptions, Next, Streamed, StreamedResult, fit};
use calibration::observations::Observations;

use crate::simulated::Simulation;

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;

/// Runs all passes, the chunks in the order given.
fn streamed(simulation: &Simulation, chunks: &[Observations], options: &FitOptions) -> StreamedResult {
    let mut state = Streamed::from_sample(&simulation.chain, &chunks[0], options).unwrap();
    loop {
        let tallies: Vec<_> = chunks.iter().map(|chunk| state.pass.accumulate(chunk).unwrap()).collect();
        let whole = tallies.iter().fold(state.pass.empty(), |whole, part| whole.merge(part));
        match state.next(&whole) {
            Next::Pass(next) => state = *next,
            Next::Done(result) => return *result,
        }
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
        let parts = streamed(&simulation, &chunks, &options);
        assert!(parts.converged);
        assert_eq!(parts.rank, all.rank);
        assert_eq!(parts.rows[0], 6000);
        assert_eq!(parts.separable, all.separable);
        for (at, &parameter) in all.parameters.iter().enumerate().filter(|(at, _)| all.separable[*at]) {
            let uncertainty = all.covariance[(at, at)].sqrt();
            let moved = parts.values[parameter.index()] - all.values[parameter.index()];
            assert!(moved.abs() < 0.01 * uncertainty, "{robust} {}", moved / uncertainty);
            let ratio = parts.covariance[(at, at)].sqrt() / uncertainty;
            assert!((ratio - 1.0).abs() < 0.03, "{robust} {ratio}");
        }
    }
}
