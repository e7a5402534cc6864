//! An arm one of whose joints counts from a quarter turn away, by a simulator of its own.

use fit::{FitOptions, Outcome, fit};
use nalgebra::Vector3;
use observe::{Measure, Measured};
use testkit::{Random, turned};

use super::simulated::Simulation;

const NOISE_M: f64 = 50e-6;

/// Of each link: offset and length with twist of the declaration, m and rad.
const LINKS: [[f64; 3]; 6] = [
    [0.1273, 0.0, std::f64::consts::FRAC_PI_2],
    [0.0, -0.612, 0.0],
    [0.0, -0.5723, 0.0],
    [0.163941, 0.0, std::f64::consts::FRAC_PI_2],
    [0.1157, 0.0, -std::f64::consts::FRAC_PI_2],
    [0.0922, 0.0, 0.0],
];

/// The true value of an error by its name, m or rad.
fn truth(name: &str, home: usize) -> f64 {
    let sum: usize = name.bytes().map(usize::from).sum();
    let small = (sum % 9) as f64 - 4.0;
    if name == format!("index{home}") {
        std::f64::consts::FRAC_PI_2
    } else if name.starts_with("index") || name.starts_with("twist") {
        small * 5e-5
    } else {
        small * 5e-5 + 2e-5
    }
}

/// The reflector at joints of these angles, rad.
fn tip(angles: &[f64; 6], home: usize) -> [f64; 3] {
    let error = |name: &str| truth(name, home);
    let mut point = ["mount_x", "mount_y", "mount_z"].map(error);
    for link in (1..=6).rev() {
        let [offset, length, twist] = LINKS[link - 1];
        // From the tip backwards: twist by design, twist, length and offset, index, joint.
        let is_upper = link == 2 || link == 3;
        if !is_upper {
            point = turned(0, twist, point);
        }
        point = turned(0, error(&format!("twist{link}")), point);
        point[0] += length + error(&format!("length{link}"));
        point[2] += offset + error(&format!("offset{link}"));
        point = turned(2, angles[link - 1] + error(&format!("index{link}")), point);
    }
    point
}

/// Where the fifth joint counts from elsewhere, lengths beyond it could take up what the turn does, and what the data show there is not
/// what they show at zero.
#[test]
fn an_arm_comes_out_whichever_joint_counts_from_a_quarter_turn_away() {
    let text = include_str!("../../../examples/six-joint-arm/six-joint-arm.chain");
    for home in [2, 3, 5] {
        let mut simulation = Simulation::new(text, 31 + home as u64);
        for joint in 1..=6 {
            simulation.column(&format!("q{joint}"), 100, -2.1..2.1);
        }
        let mut random = Random::new(41 + home as u64);
        let mut noise = || NOISE_M * random.normal();
        let measured = (0..100)
            .map(|row| {
                let angle = |joint: usize| {
                    let id = simulation.chain.find_symbol(&format!("q{joint}")).unwrap();
                    simulation.columns.iter().find(|(own, _)| *own == id).unwrap().1[row]
                };
                let point = tip(&[1, 2, 3, 4, 5, 6].map(angle), home);
                Measured::Point(Vector3::from(point.map(|value| value + noise())))
            })
            .collect();
        let observations = simulation.observations("tip", Measure::Point, measured);
        let result =
            fit(&simulation.chain, &observations, &FitOptions::for_chain(&simulation.chain)).unwrap();
        assert!(matches!(result.outcome, Outcome::Converged { .. }), "{home}: {:?}", result.outcome);
        let sigma_m = result.rms / 3f64.sqrt();
        assert!((0.7..1.05).contains(&(sigma_m / NOISE_M)), "{home}: {sigma_m}");
        let mut judged = 0;
        for (&parameter, &separable) in result.parameters.iter().zip(&result.separable) {
            let name = &simulation.chain.symbol(parameter).name;
            if !separable {
                continue;
            }
            let off = result.values[parameter.index()] - truth(name, home);
            let uncertainty = result.standard_uncertainty(parameter).unwrap();
            assert!(off.abs() < 4.5 * uncertainty, "{home}, {name}: {off} against {uncertainty}");
            assert!(uncertainty < 2e-4, "{home}, {name}: {uncertainty}");
            judged += 1;
        }
        assert!(judged >= 12, "{home}: {judged}");
    }
}
