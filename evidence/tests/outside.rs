//! The rule outside the measured region, on rungs whose errors are known.
#![allow(clippy::unwrap_used)]

use evidence::outside::{Predicted, Rungs, Side, stack};
use evidence::{Error, Policy};

/// Truth is `bend * x²` of the first of two joints; the declared chain says 0, the second rung the truth with a
/// scale, the third departs as the fourth power far outside.
struct Bent {
    poses: Vec<Vec<f64>>,
    runaway: f64,
    broken: bool,
}

impl Bent {
    fn new(runaway: f64) -> Self {
        let pose = |row: usize| vec![(row % 10) as f64 / 10.0, (row / 10) as f64 / 10.0];
        Self { poses: (0..100).map(pose).collect(), runaway, broken: false }
    }

    fn rungs(&self, poses: &[Vec<f64>]) -> Vec<Predicted> {
        let rung = |value: &dyn Fn(f64) -> f64| {
            let mean: Vec<f64> = poses.iter().flat_map(|pose| [value(pose[0]), 0.0]).collect();
            let count = mean.len();
            Predicted { mean, uncertainty: vec![0.01; count], noise: vec![0.1; count] }
        };
        vec![
            rung(&|_| 0.0),
            rung(&|x| 2.0 * x * x),
            rung(&|x| 2.0 * x * x + self.runaway * (x - 0.9).max(0.0).powi(4)),
        ]
    }
}

impl Rungs for Bent {
    fn names(&self) -> Vec<String> {
        ["declared", "laws", "full"].map(String::from).to_vec()
    }

    fn poses(&self) -> &[Vec<f64>] {
        &self.poses
    }

    fn components(&self) -> usize {
        2
    }

    fn measured(&self, rows: &[usize]) -> Vec<f64> {
        // Noise of a tenth, plus and minus by turns.
        let noise = |row: usize| if row.is_multiple_of(2) { 0.1 } else { -0.1 };
        rows.iter().flat_map(|&row| [2.0 * self.poses[row][0].powi(2) + noise(row), noise(row + 1)]).collect()
    }

    fn limits(&self) -> Vec<Option<(f64, f64)>> {
        vec![Some((0.0, 1.5)), None]
    }

    fn refitted(&self, _: &[usize], asked: &[usize]) -> Result<Vec<Predicted>, String> {
        if self.broken {
            return Err("the fit of `laws` failed".into());
        }
        Ok(self.rungs(&asked.iter().map(|&row| self.poses[row].clone()).collect::<Vec<_>>()))
    }

    fn predicted(&self, poses: &[Vec<f64>]) -> Result<Vec<Predicted>, String> {
        Ok(self.rungs(poses))
    }
}

fn answer(bent: &Bent, pose: [f64; 2]) -> evidence::outside::Answer {
    let stack = stack(bent, &Policy::default()).unwrap();
    stack.at(&pose, &bent.rungs(&[pose.to_vec()]))
}

#[test]
fn inside_the_full_mixture_answers_and_outside_the_rungs_that_held() {
    let bent = Bent::new(0.0);
    let inside = answer(&bent, [0.45, 0.45]);
    assert!(inside.inside && inside.half_width.is_none());
    assert_eq!(inside.weights, [0.0, 0.0, 1.0]);
    let outside = answer(&bent, [1.3, 0.5]);
    assert!(!outside.inside);
    assert!(outside.weights[0] < 1e-3, "{:?}", outside.weights);
    assert!((outside.mean[0] - 2.0 * 1.3 * 1.3).abs() < 0.02, "{:?}", outside.mean);
    // Four regions: the t quantile of four degrees times the noise of a reading.
    let width = outside.half_width.unwrap()[1];
    assert!((width / (2.776 * (0.1f64.powi(2) + 0.01f64.powi(2)).sqrt()) - 1.0).abs() < 0.01, "{width}");
}

#[test]
fn weights_are_those_of_the_specification() {
    // Squares of 4 for the declared chain and 1 for another, two components, four regions: 256 of 257.
    struct Fixed(Bent);
    impl Rungs for Fixed {
        fn names(&self) -> Vec<String> {
            ["declared", "full"].map(String::from).to_vec()
        }
        fn poses(&self) -> &[Vec<f64>] {
            self.0.poses()
        }
        fn components(&self) -> usize {
            2
        }
        fn measured(&self, rows: &[usize]) -> Vec<f64> {
            vec![0.0; 2 * rows.len()]
        }
        fn limits(&self) -> Vec<Option<(f64, f64)>> {
            vec![None, None]
        }
        fn refitted(&self, _: &[usize], asked: &[usize]) -> Result<Vec<Predicted>, String> {
            self.predicted(&vec![Vec::new(); asked.len()])
        }
        fn predicted(&self, poses: &[Vec<f64>]) -> Result<Vec<Predicted>, String> {
            let rung = |value: f64| Predicted {
                mean: vec![value; 2 * poses.len()],
                uncertainty: vec![1.0; 2 * poses.len()],
                noise: vec![1.0; 2 * poses.len()],
            };
            Ok(vec![rung(2f64.sqrt()), rung(0.5f64.sqrt())])
        }
    }
    let stack = stack(&Fixed(Bent::new(0.0)), &Policy::default()).unwrap();
    assert_eq!(stack.regions.len(), 4);
    for set in &stack.sets {
        assert!((set.weights[1] - 256.0 / 257.0).abs() < 1e-12, "{set:?}");
    }
}

#[test]
fn a_rung_that_runs_away_is_struck_where_it_does_and_only_there() {
    let bent = Bent::new(1e4);
    let stack = stack(&bent, &Policy::default()).unwrap();
    let high = stack.sets.iter().find(|set| set.end == Some((0, Side::High))).unwrap();
    assert_eq!(high.struck.iter().map(|struck| struck.rung).collect::<Vec<_>>(), [2]);
    assert!(high.struck[0].departs > high.struck[0].tried);
    let side = stack.sets.iter().find(|set| set.end == Some((1, Side::High))).unwrap();
    assert!(side.struck.is_empty());
    let far = stack.at(&[1.4, 0.5], &bent.rungs(&[vec![1.4, 0.5]]));
    assert!(far.weights[2] == 0.0 && (far.mean[0] - 2.0 * 1.4 * 1.4).abs() < 0.02, "{far:?}");
    // In a corner of both ends the veto holds.
    assert!(stack.at(&[1.4, 1.3], &bent.rungs(&[vec![1.4, 1.3]])).weights[2] == 0.0);
}

#[test]
fn what_cannot_be_fitted_is_refused_in_words() {
    let broken = Bent { broken: true, ..Bent::new(0.0) };
    let refused = stack(&broken, &Policy::default()).unwrap_err();
    assert_eq!(refused, Error::Linearise { reason: "the fit of `laws` failed".into() });
    let few = Bent { poses: vec![vec![0.0, 0.0]; 3], ..Bent::new(0.0) };
    let stack = stack(&few, &Policy::default()).unwrap();
    assert!(stack.regions.is_empty());
    // Nothing was left out, so that nothing was tried: the declared chain alone acts outside.
    let answer = stack.at(&[1.0, 1.0], &few.rungs(&[vec![1.0, 1.0]]));
    assert_eq!(answer.weights, [1.0, 0.0, 0.0]);
}
