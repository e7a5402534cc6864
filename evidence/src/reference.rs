//! The likelihood against reference numbers from dense covariance matrices: `tests/reference/likelihood.py`.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;

use crate::bench::{Bench, State};
use crate::families::{Driver, Law, Where};
use crate::noise::{Memory, Noise};
use crate::policy::Policy;
use crate::problem::{Declared, Frame, Freedom, Joint, Place, Problem, Rows};
use crate::small::Small;

const REFERENCE: &str = include_str!("../tests/reference/likelihood.txt");

/// What dense and Gram arithmetic differ by: products over 48 values, factors of at most 60 columns.
const NUMERICS: f64 = 1e-8;

fn numbers() -> BTreeMap<&'static str, Vec<f64>> {
    let line = |line: &'static str| {
        let (name, values) = line.split_once(": ").unwrap();
        (name, values.split(' ').map(|value| value.parse().unwrap()).collect())
    };
    REFERENCE.lines().map(line).collect()
}

fn problem(numbers: &BTreeMap<&'static str, Vec<f64>>) -> Problem {
    let joint = |name: &str, from_horizon| Joint {
        name: name.into(),
        values: numbers[name].clone(),
        direction: None,
        from_horizon,
    };
    let place = |number: usize| Place {
        name: format!("place{number}"),
        frame: 0,
        freedom: Freedom::Rotation(0),
        own: [Some(0), Some(1), None, None][number],
        beside: Vec::new(),
        column: numbers[format!("place{number}").as_str()].clone(),
        nominal: None,
        gravity: None,
        loads: Vec::new(),
    };
    let declared = |number: usize| Declared {
        name: format!("declared{number}"),
        estimate: 0.0,
        column: numbers[format!("declared{number}").as_str()].clone(),
    };
    Problem {
        rows: Rows {
            count: numbers["azimuth"].len(),
            joints: vec![joint("azimuth", false), joint("elevation", true)],
            inputs: Vec::new(),
            labels: None,
            in_order: true,
            given: Vec::new(),
        },
        components: 2,
        residual: numbers["y"].clone(),
        sigma: None,
        declared: (0..3).map(declared).collect(),
        frames: vec![Frame { name: "frame".into(), tilts: Some([0, 1]), whirl: Some((0, [0, 1])) }],
        places: (0..4).map(place).collect(),
        offered: Vec::new(),
    }
}

/// The family that the reference names.
fn family(bench: &Bench, law: &str, place: &str, joint: &str) -> usize {
    let (place, joint): (usize, usize) = (place.parse().unwrap(), joint.parse().unwrap());
    let number = |prefix: &str| law.strip_prefix(prefix).and_then(|rest| rest.parse::<i32>().ok());
    let wanted = match law {
        "constant" => Law::Constant,
        "scale" => Law::Scale,
        "cot" => Law::Cot,
        "product" => Law::Product,
        "surface" => Law::Surface,
        "walk" => Law::Walk,
        _ => [("harmonic", 0), ("smooth", 1), ("whirl", 2)]
            .into_iter()
            .find_map(|(prefix, kind)| {
                let number = number(prefix)?;
                Some([Law::Harmonic(number as usize), Law::Smooth(number as usize), Law::Whirl(number)][kind])
            })
            .unwrap(),
    };
    let fits = |family: &crate::families::Family| {
        let driven = match family.driver {
            Driver::Joint(own) => own == joint,
            _ => true,
        };
        let placed = matches!(family.law, Law::Whirl(_)) || family.place == Where::Place(place);
        family.law == wanted && placed && driven
    };
    bench.dictionary.families.iter().position(fits).unwrap()
}

fn close(name: &str, ours: f64, reference: f64, scale: f64) {
    assert!(
        (ours - reference).abs() <= NUMERICS * scale,
        "{name}: {ours} where the reference has {reference}"
    );
}

#[test]
fn log_evidence_gains_and_estimates_are_those_of_dense_covariances() {
    let numbers = numbers();
    let (problem, policy) = (problem(&numbers), Policy::default());
    let mut bench = Bench::new(&problem, &policy, &|_, _| true).unwrap();
    let weights = numbers["weights"].clone();
    bench.noises.push(Noise { weights, ..Noise::even(48) });
    let memory = Memory { carried: numbers["memory"][0], part: numbers["memory"][1] };
    let even = State { noise: 0, memory: None, point: 0 };
    let states = [
        ("even", even),
        ("uneven", State { noise: 1, ..even }),
        ("memory", State { noise: 1, memory: Some(memory), point: 0 }),
    ];
    let sets = [
        Vec::new(),
        vec![(family(&bench, "harmonic2", "0", "0"), 3.0)],
        vec![(family(&bench, "smooth0", "1", "1"), 0.7), (family(&bench, "harmonic1", "2", "1"), 10.0)],
    ];
    let mut gains = 0;
    for (index, active) in sets.iter().enumerate() {
        for (name, state) in states {
            let key = |what: &str| format!("{what} {index} {name}");
            let view = bench.view(state);
            let evidence = view.log_evidence(active);
            close(&key("evidence"), evidence, numbers[key("evidence").as_str()][0], 1.0);
            let small = Small::of(&bench, active, 0);
            let noise = &bench.noises[state.noise];
            let alone = small.view(noise, state.memory).log_evidence(small.active());
            close(&key("evidence of the columns alone"), alone, evidence, 1.0);
            let posterior = view.posterior(active).unwrap();
            let (estimates, uncertainties) =
                (&numbers[key("estimates").as_str()], &numbers[key("uncertainties").as_str()]);
            for error in 0..3 {
                let combinations = &bench.scaling.combinations;
                let (mut mean, mut variance) = (0.0, 0.0);
                for a in 0..3 {
                    mean += bench.scaling.unit * combinations[(error, a)] * posterior.mean[a];
                    for b in 0..3 {
                        let product =
                            combinations[(error, a)] * posterior.shape[(a, b)] * combinations[(error, b)];
                        variance += product * posterior.variance * bench.scaling.unit.powi(2);
                    }
                }
                close(&key("estimate"), mean, estimates[error], uncertainties[error]);
                close(&key("uncertainty"), variance.sqrt(), uncertainties[error], uncertainties[error]);
            }
            for (line, values) in numbers.range(key("gain").as_str()..) {
                let Some(rest) = line.strip_prefix(&key("gain")) else { break };
                let words: Vec<&str> = rest.split_whitespace().collect();
                let own = family(&bench, words[0], words[1], words[2]);
                let gain = view.one(active, own);
                close(line, gain.nats, values[0], 1.0);
                close(line, gain.variance, values[1], values[1]);
                let scanned = view.scan(active, &|_| true)[own];
                close(line, scanned.nats, gain.nats, 1.0);
                gains += 1;
            }
        }
    }
    assert_eq!(gains, 5 * 14);
}

#[test]
fn a_gram_matrix_grows_as_if_it_had_been_made_at_once() {
    let numbers = numbers();
    let (problem, policy) = (problem(&numbers), Policy::default());
    let mut bench = Bench::new(&problem, &policy, &|_, _| true).unwrap();
    let memory = Some(Memory { carried: 0.9, part: 0.7 });
    let state = State { noise: 0, memory, point: 0 };
    let before = bench.view(state).gram.products.ncols();
    let added = bench.add_cuts(&vec![7, 15])[0];
    let grown = bench.view(state).gram;
    assert!(grown.products.ncols() > before);
    let fresh = crate::gram::Gram::of(&bench.table, &bench.points[0], 24, &bench.noises[0], memory);
    for row in 0..fresh.products.nrows() {
        for column in 0..fresh.products.ncols() {
            close("product", grown.products[(row, column)], fresh.products[(row, column)], 1e2);
        }
    }
    assert!(bench.view(state).one(&[], added).nats.is_finite());
}
