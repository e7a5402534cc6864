//! A chain whose products of small quantities are not small: explanations are judged at their own point.
#![allow(clippy::unwrap_used)]

use evidence::problem::{Declared, Frame, Freedom, Joint, Place, Problem, Rows};
use evidence::{Amount, Error, Linearisation, Linearise, Policy, contest};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

const SIGMA: f64 = 1e-5;

/// Two arms of unit length in a plane, of which the first has an index error; the point at the end is measured.
struct Arms {
    joints: [Vec<f64>; 2],
    observed: Vec<f64>,
}

impl Arms {
    /// The point with an index error and small turns of each arm.
    fn point(&self, row: usize, index: f64, turns: [f64; 2]) -> [f64; 2] {
        let first = self.joints[0][row] + index + turns[0];
        let second = first + self.joints[1][row] + turns[1];
        [first.cos() + second.cos(), first.sin() + second.sin()]
    }

    fn simulated(amplitude: f64, index: f64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let joints = [0, 1].map(|_| (0..100).map(|_| random.random_range(-2.0..2.0)).collect::<Vec<f64>>());
        let mut arms = Self { joints, observed: Vec::new() };
        for row in 0..100 {
            let turn = amplitude * (2.0 * arms.joints[0][row] + 0.4).cos();
            for value in arms.point(row, index, [turn, 0.0]) {
                let noise: f64 = StandardNormal.sample(&mut random);
                arms.observed.push(value + SIGMA * noise);
            }
        }
        arms
    }

    fn problem(&self) -> Problem {
        let given = self.at(&[0.0], &[]).unwrap();
        let joint = |number: usize| Joint {
            name: format!("q{number}"),
            values: self.joints[number].clone(),
            direction: None,
            from_horizon: false,
        };
        let place = |number: usize| Place {
            name: format!("arm{number}.Rz"),
            frame: 0,
            freedom: Freedom::Rotation(2),
            own: Some(number),
            beside: vec![number],
            column: given.places[number].clone(),
            nominal: None,
            gravity: None,
            loads: Vec::new(),
        };
        Problem {
            rows: Rows { count: 100, joints: vec![joint(0), joint(1)], in_order: true, ..Rows::default() },
            components: 2,
            residual: given.residual.clone(),
            sigma: None,
            declared: vec![Declared {
                name: "index".into(),
                estimate: 0.0,
                column: given.declared[0].clone(),
            }],
            frames: vec![Frame { name: "base".into(), ..Frame::default() }],
            places: vec![place(0), place(1)],
            offered: Vec::new(),
        }
    }
}

impl Linearise for Arms {
    fn at(&self, declared: &[f64], effects: &[Amount]) -> Result<Linearisation, String> {
        if declared[0].abs() > 1.0 {
            return Err("an index of more than a radian".into());
        }
        let mut given =
            Linearisation { residual: Vec::new(), declared: vec![Vec::new()], places: vec![Vec::new(); 2] };
        for row in 0..100 {
            let mut turns = [0.0; 2];
            for effect in effects {
                turns[effect.place] += effect.amount[row];
            }
            let [x, y] = self.point(row, declared[0], turns);
            given.residual.extend([self.observed[2 * row] - x, self.observed[2 * row + 1] - y]);
            let first = self.joints[0][row] + declared[0] + turns[0];
            let second = first + self.joints[1][row] + turns[1];
            let [whole, upper] = [[-y, x], [-second.sin(), second.cos()]];
            given.declared[0].extend(whole);
            given.places[0].extend(whole);
            given.places[1].extend(upper);
        }
        Ok(given)
    }
}

#[test]
fn a_large_effect_is_named_alone_at_its_own_point_and_the_declared_error_is_right() {
    let arms = Arms::simulated(0.03, 0.02);
    let (problem, policy) = (arms.problem(), Policy::default());
    let outcome = contest(&problem, &policy, Some(&arms)).unwrap();
    let told: Vec<String> = outcome
        .findings()
        .iter()
        .filter(|found| found.named)
        .map(|found| outcome.name(found.family))
        .collect();
    assert_eq!(told, ["harmonic 2|q0|arm0.Rz"]);
    let estimate = &outcome.declared().unwrap()[0];
    assert!((estimate.value - 0.02).abs() < 4.0 * estimate.uncertainty, "{estimate:?}");
    // The same in first order: what the square of the effect leaves is 40 standard deviations of the noise.
    let straight = contest(&problem, &policy, None).unwrap();
    assert!(straight.odds() < outcome.odds() - 100.0, "{} {}", straight.odds(), outcome.odds());
}

#[test]
fn a_chain_that_cannot_be_evaluated_is_refused_in_its_own_words() {
    struct Broken;
    impl Linearise for Broken {
        fn at(&self, _: &[f64], _: &[Amount]) -> Result<Linearisation, String> {
            Err("the joint limits are exceeded".into())
        }
    }
    struct Short;
    impl Linearise for Short {
        fn at(&self, _: &[f64], _: &[Amount]) -> Result<Linearisation, String> {
            Ok(Linearisation { residual: vec![0.0], declared: Vec::new(), places: Vec::new() })
        }
    }
    let problem = Arms::simulated(0.03, 0.02).problem();
    let policy = Policy::default();
    let refused = contest(&problem, &policy, Some(&Broken)).err().unwrap();
    assert_eq!(refused, Error::Linearise { reason: "the joint limits are exceeded".into() });
    assert!(matches!(contest(&problem, &policy, Some(&Short)), Err(Error::Length { .. })));
}
