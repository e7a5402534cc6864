//! Every kind of observation, alone and together, with stated uncertainties: from a study and its files to estimates as
//! far from the truth as their covariance says.

use std::collections::BTreeMap;

use calibration::diagnose::precision;
use fit::{FitResult, Outcome, fit};
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF};
use study::Study;
use tables::formats::{DataError, Input};

use crate::simulated::Simulation;

/// Two links; a range from the ground does not see how the whole is turned.
const ARM: &str = "chain Arm {
    body upper on ground { motion: Rz(q1); motion_error: Rz(index1); }
    body fore on upper { position: Tx(0.6); position_error: Tx(length1); motion: Rz(q2); motion_error: Rz(index2); }
    body tool on fore { position: Tx(0.5); position_error: Tx(length2); }
    observe tip: point(0, 0, 0) of tool;
    observe sight: direction(1, 0, 0) of tool;
}";

const RANGES: &str = r#"
chain      = "arm.chain"
observable = "tip"
data       = "ranges.csv"
[observed]
kind  = "range"
range = { column = "distance_m" }
[search]
sequence = false
"#;

const POINTS: &str = r#"
[[also]]
observable = "tip"
data       = "points.csv"
[also.observed]
kind = "point"
"#;

const DIRECTIONS: &str = r#"
[[also]]
observable = "sight"
data       = "directions.csv"
[also.observed]
kind = "direction"
"#;

/// Whether a sum of squares is as large as so many normal numbers have it, but for one chance in ten thousand.
fn plausible(sum: f64, count: usize) -> bool {
    let distribution = ChiSquared::new(count as f64).unwrap();
    (5e-5..1.0 - 5e-5).contains(&distribution.cdf(sum))
}

/// A simulated arm, its files, and what the ranges' noise is multiplied by in each row.
fn files(seed: u64) -> (Simulation, BTreeMap<&'static str, String>) {
    let mut simulation = Simulation::new(ARM, seed);
    simulation.column("q1", 60, -3.0..3.0);
    simulation.column("q2", 60, 0.3..2.8);
    simulation.draw_errors("*", 1e-3);
    let joints = |simulation: &Simulation, row: usize| {
        format!("{},{}", simulation.columns[0].1[row], simulation.columns[1].1[row])
    };
    let mut texts = BTreeMap::new();
    let mut ranges = "q1,q2,distance_m,std_mm\n".to_string();
    for (row, tip) in simulation.truth("tip").into_iter().enumerate() {
        // Each row has its own noise, and says so.
        let sigma = 1e-4 * [0.2, 1.0, 5.0][row % 3];
        let distance = tip.norm() + sigma * simulation.normal();
        ranges += &format!("{},{distance},{}\n", joints(&simulation, row), 1e3 * sigma);
    }
    texts.insert("ranges.csv", ranges);
    for (file, observable, sigma) in [("points.csv", "tip", 2e-4), ("directions.csv", "sight", 3e-4)] {
        let mut text = format!("q1,q2,{observable}_x,{observable}_y,{observable}_z\n");
        let observations = match observable {
            "tip" => simulation.points(observable, sigma),
            _ => simulation.directions(observable, sigma),
        };
        for (row, measured) in observations.measured.iter().enumerate() {
            let vector = measured.vector().unwrap();
            let (x, y, z) = (vector.x, vector.y, vector.z);
            text += &format!("{},{x},{y},{z}\n", joints(&simulation, row));
        }
        texts.insert(file, text);
    }
    (simulation, texts)
}

fn fitted(simulation: &Simulation, study: &str, texts: &BTreeMap<&str, String>) -> FitResult {
    let plan = Study::from_text(study).unwrap().plan(&simulation.chain).unwrap();
    let mut open =
        |name: &str| -> Result<Input<'static>, DataError> { Ok(texts[name].clone().into_bytes().into()) };
    let observations = plan.load(&mut open).unwrap().observations;
    let result = fit(&plan.chain, &observations, &plan.fit).unwrap();
    assert!(matches!(result.outcome, Outcome::Converged { .. }), "{:?}", result.outcome);
    result
}

/// The squared distance of the estimates from the truth in the metric of their covariance, over what is separable.
fn distance(simulation: &Simulation, result: &FitResult) -> (f64, usize) {
    let kept: Vec<usize> = (0..result.parameters.len()).filter(|&at| result.separable[at]).collect();
    let error = DVector::from_iterator(
        kept.len(),
        kept.iter().map(|&at| {
            let id = result.parameters[at].index();
            result.values[id] - simulation.values[id]
        }),
    );
    let covariance = DMatrix::from_fn(kept.len(), kept.len(), |a, b| result.covariance[(kept[a], kept[b])]);
    let solved = covariance.cholesky().unwrap().solve(&error);
    (error.dot(&solved), kept.len())
}

/// Over many runs the estimates lie as far from the truth as the covariance says. The noise is estimated, which makes
/// the tails of a single run heavier than the normal's: by less than 4 % of the variance with 60 rows or more.
fn lie_as_far_as_said(study: &str, combinations: usize) -> Vec<FitResult> {
    let (mut sum, mut count) = (0.0, 0);
    let mut results = Vec::new();
    for seed in 0..60 {
        let (simulation, texts) = files(seed);
        let result = fitted(&simulation, study, &texts);
        assert_eq!(result.rank, combinations);
        let (squares, own) = distance(&simulation, &result);
        sum += squares;
        count += own;
        results.push(result);
    }
    assert!(plausible(sum, count), "{sum} for {count}");
    results
}

#[test]
fn ranges_determine_the_links() {
    let plain = format!("{RANGES}\n[fit]\nrobust = false\n");
    let results = lie_as_far_as_said(&plain, 3);
    // The turn of the whole is not seen, and nothing is to be told from it.
    assert!(results.iter().all(|result| result.separable == [false, true, true, true]));
    let (simulation, texts) = files(1);
    let plan = Study::from_text(&plain).unwrap().plan(&simulation.chain).unwrap();
    let mut open =
        |name: &str| -> Result<Input<'static>, DataError> { Ok(texts[name].clone().into_bytes().into()) };
    let observations = plan.load(&mut open).unwrap().observations;
    let said = precision(&simulation.chain, &observations, &results[1]);
    assert!(said.not_separable.is_empty(), "{:?}", said.not_separable);
    assert_eq!(said.rank, [3, 4]);
}

#[test]
fn stated_uncertainties_weigh_the_rows() {
    let stated = format!(
        "{RANGES}\n[fit]\nrobust = false\n[noise]\nsigma = {{ column = \"std_mm\", unit = \"mm\" }}\n"
    );
    let weighed = lie_as_far_as_said(&stated, 3);
    // What the data state is right up to a factor of one.
    let factors: Vec<f64> = weighed.iter().map(|result| result.noise.floor[0].powi(2) * 57.0).collect();
    assert!(plausible(factors.iter().sum(), 57 * factors.len()), "{factors:?}");
    // Good rows count for more: the uncertainties are much smaller than with all rows alike.
    let (simulation, texts) = files(0);
    let alike = fitted(&simulation, &format!("{RANGES}\n[fit]\nrobust = false\n"), &texts);
    for at in 1..4 {
        let ratio = weighed[0].covariance[(at, at)].sqrt() / alike.covariance[(at, at)].sqrt();
        assert!(ratio < 0.3, "{ratio}");
    }
}

#[test]
fn kinds_fit_together() {
    let together = format!("{RANGES}\n[fit]\nrobust = false\n{POINTS}{DIRECTIONS}");
    let results = lie_as_far_as_said(&together, 4);
    assert!(results.iter().all(|result| result.separable.iter().all(|&separable| separable)));
    // Each file has its own noise: of points and directions here, and those of ranges mixed.
    let mean = |kind: usize| {
        results.iter().map(|result| result.noise.floor[kind].powi(2)).sum::<f64>() / results.len() as f64
    };
    for (kind, sigma) in [(1, 2e-4), (2, 2e-4), (3, 2e-4), (4, 3e-4), (5, 3e-4)] {
        // 60 runs of 60 rows: the mean square scatters by 2.4 %.
        assert!((mean(kind).sqrt() / sigma - 1.0).abs() < 0.05, "{kind}: {}", mean(kind).sqrt());
    }
}
