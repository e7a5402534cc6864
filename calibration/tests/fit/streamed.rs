//! Rows in chunks give what all rows at once give.

use fit::{FitError, FitOptions, FitResult, Next, PartialError, Pass, Streamed, StreamedResult, Tally, fit};
use observe::{Observations, Series};

use crate::simulated::{Simulation, swapped};

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
        match state.next(&tallies).unwrap() {
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
            observations.measured[row] = swapped(observations.measured[row], 0, 1);
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

/// All passes over these chunks, whose tallies travel as bytes and merge pairwise in an order drawn at random.
fn merged_at_random(
    simulation: &Simulation,
    chunks: &[Observations],
    options: &FitOptions,
    mut draw: impl FnMut(usize) -> usize,
) -> StreamedResult {
    let mut state = Streamed::from_sample(&simulation.chain, &chunks[0], options).unwrap();
    loop {
        let mut tallies: Vec<Tally> = chunks
            .iter()
            .map(|chunk| Tally::from_bytes(&state.pass.accumulate(chunk).unwrap().to_bytes()).unwrap())
            .collect();
        while tallies.len() > 1 {
            let one = tallies.swap_remove(draw(tallies.len()));
            let other = tallies.swap_remove(draw(tallies.len()));
            tallies.push(one.merge(&other).unwrap());
        }
        match state.next(&tallies).unwrap() {
            Next::Pass(next) => state = *next,
            Next::Done(result) => return *result,
        }
    }
}

proptest::proptest! {
    #![proptest_config(proptest::test_runner::Config::with_cases(12))]

    /// However the rows are split and the tallies merged, the answer is the same to rounding.
    #[test]
    fn any_split_and_any_order_give_one_answer(
        cuts in proptest::collection::vec(400_usize..2000, 0..6),
        order in proptest::collection::vec(0_usize..1000, 64),
        robust in proptest::bool::ANY,
    ) {
        let mut simulation = Simulation::lidar(2000, 11);
        simulation.draw_errors("d*", 100.0 * ARCSEC);
        let observations = simulation.directions("pointing", 2.0 * ARCSEC);
        let mut options = FitOptions::for_chain(&simulation.chain);
        options.robust = robust;
        options.noise.variance = false;
        // The first chunk is the sample, and so the same in every split.
        let mut ends = [cuts, vec![400, 2000]].concat();
        ends.sort_unstable();
        let starts = [0].into_iter().chain(ends.iter().copied());
        let part = |(start, &end)| observations.select(&(start..end).collect::<Vec<_>>());
        let chunks: Vec<Observations> = starts.zip(&ends).map(part).collect();
        let whole: Vec<Observations> =
            [0..400, 400..2000].map(|rows| observations.select(&rows.collect::<Vec<_>>())).to_vec();
        let expected = streamed(&simulation, &whole[0], &whole, &options);
        let mut order = order.into_iter().cycle();
        let found = merged_at_random(&simulation, &chunks, &options, |most| order.next().unwrap_or(0) % most);
        assert_eq!((found.rows, found.rank, found.passes), (expected.rows, expected.rank, expected.passes));
        for (at, &parameter) in expected.parameters.iter().enumerate() {
            let uncertainty = expected.covariance[(at, at)].sqrt();
            let moved = found.values[parameter.index()] - expected.values[parameter.index()];
            assert!(moved.abs() <= 1e-9 * uncertainty, "{at}: {}", moved / uncertainty);
        }
    }
}

#[test]
fn tallies_of_different_passes_do_not_belong_together() {
    let mut simulation = Simulation::lidar(500, 3);
    let observations = simulation.directions("pointing", 2.0 * ARCSEC);
    let options = FitOptions::for_chain(&simulation.chain);
    let state = Streamed::from_sample(&simulation.chain, &observations, &options).unwrap();
    let first = state.pass.accumulate(&observations).unwrap();
    let Ok(Next::Pass(next)) = state.next(std::slice::from_ref(&first)) else {
        panic!("one pass never is enough")
    };
    let second = next.pass.accumulate(&observations).unwrap();
    assert_eq!(first.clone().merge(&second), Err(PartialError::Passes));
    assert!(matches!(next.next(&[second, first]), Err(PartialError::Passes)));
}

/// A process that has the declaration alone makes the same tally of the bytes of a pass; other bytes are refused.
#[test]
fn a_pass_goes_through_bytes() {
    let mut simulation = Simulation::lidar(500, 3);
    let observations = simulation.directions("pointing", 2.0 * ARCSEC);
    let options = FitOptions::for_chain(&simulation.chain);
    let state = Streamed::from_sample(&simulation.chain, &observations, &options).unwrap();
    let first = state.pass.accumulate(&observations).unwrap();
    let Ok(Next::Pass(state)) = state.next(&[first]) else { panic!("one pass never is enough") };
    let bytes = state.pass.to_bytes();
    let read = |bytes: &[u8]| Pass::from_bytes(bytes, &simulation.chain, &observations, &options);
    let there = read(&bytes).unwrap();
    assert_eq!(there.accumulate(&observations), state.pass.accumulate(&observations));
    let mut other = bytes.clone();
    other[7] += 1;
    let mut unknown = bytes.clone();
    unknown[8] = 9;
    let mut fewer = bytes.clone();
    fewer[16] -= 1;
    for (bytes, words) in [
        (&other[..], "run the same version everywhere"),
        (&unknown, "run the same version everywhere"),
        (&bytes[..bytes.len() - 1], "run the same version everywhere"),
        (&[], "run the same version everywhere"),
        (&fewer, "give every process the same declaration"),
    ] {
        let error = read(bytes).map(|_| ()).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
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
    observations.poses.series[0].rows = 0..2000;
    observations.poses.series.push(Series { rows: 2000..4000, ..points.poses.series[0].clone() });
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

/// Twelve files, in each of which the base has tilted by as much as a direction is uncertain: the mean of twelve tilts is what the
/// estimate can be no better than.
#[test]
fn rows_of_a_file_may_share_errors() {
    let (mut off, mut seen) = ([0.0; 2], 0);
    for seed in 0..20 {
        for shares in [false, true] {
            let mut files = Vec::new();
            let mut simulation = Simulation::lidar(300, seed);
            simulation.draw_errors("d*", 100.0 * ARCSEC);
            let base = simulation.chain.find_symbol("dtheta_y1").unwrap();
            let truth = simulation.values[base.index()];
            for file in 0..12 {
                let mut own = Simulation::lidar(300, 100 * seed + file);
                own.values.clone_from(&simulation.values);
                let tilt = 2.0 * ARCSEC * own.normal();
                own.values[base.index()] += if shares { tilt } else { 0.0 };
                files.push(own.directions("pointing", 2.0 * ARCSEC));
            }
            let mut options = FitOptions::for_chain(&simulation.chain);
            options.noise.variance = false;
            let result = streamed(&simulation, &files[0], &files, &options);
            assert_eq!(result.shared.is_some(), shares, "{:?}", result.shared);
            let at = result.parameters.iter().position(|&id| id == base).unwrap();
            let uncertainty = result.standard_uncertainty(&[(at, 1.0)]);
            let error = (result.values[base.index()] - truth) / uncertainty;
            off[usize::from(shares)] += error * error;
            // Independent rows would make it a tenth of what it is.
            let independent = result.covariance[(at, at)].sqrt();
            seen += usize::from(uncertainty > if shares { 5.0 } else { 1.0 } * independent);
        }
    }
    // Sums of twenty squares of what is normal, but for the few files: chi-squared lies between 7 and 40 in 99 of 100 cases.
    assert!(off.iter().all(|off| (7.0..45.0).contains(off)), "{off:?}");
    assert_eq!(seen, 20);
}
