//! Noise that remembers, along a slow path through the joints, in an order that nobody declared: it looks like smooth functions
//! of the joints, and is told as what it is.

use calibration::diagnose::{Diagnosis, EffectFound};
use model_core::Chain;
use observe::{Measure, Measured, direction_from_spherical, tangent_frame};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use study::Study;

use crate::data::root;
use crate::simulated::{lidar, observed_alone, pointing, search};

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;
const ROWS: usize = 300;

/// Where noise stands still: across and along the beam, or in space.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Axes {
    OfTheBeam,
    OfSpace,
}

/// What the search makes of the scanner along a path, `eccentric` off centre in beta, with noise of 2
/// arcsec: each value keeps `kept` of the one before, and a walk steps by `step`.
fn report(seed: u64, kept: f64, step: f64, eccentric: f64, axes: Axes) -> Diagnosis {
    let text = lidar();
    let chain = Chain::from_text(&text).unwrap();
    let study = "chain = \"c\"\nobservable = \"pointing\"\ndata = \"d\"\n[observed]\nkind = \"direction\"\n";
    let plan = Study::from_text(study).unwrap().plan(&chain).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = || -> f64 { random.sample(StandardNormal) };
    let names = ["alpha", "beta", "gamma"];
    let mut columns: Vec<_> =
        names.iter().map(|name| (chain.find_symbol(name).unwrap(), Vec::new())).collect();
    let (mut state, mut walk) = ([normal(), normal(), normal()], [0.0; 3]);
    let mut observed = Vec::new();
    for row in 0..ROWS {
        let turned =
            |turns: f64| 3.1 * (std::f64::consts::TAU * turns * row as f64 / ROWS as f64 + 0.4).sin();
        let readings = [turned(1.0), turned(1.7), turned(2.4)];
        columns.iter_mut().zip(readings).for_each(|((_, column), reading)| column.push(reading));
        let beta = readings[1] + eccentric * readings[1].cos();
        let aim = pointing(&chain, &[], [readings[0], beta, readings[2], 0.0, 0.0]);
        state = state.map(|value| kept * value + (1.0 - kept * kept).sqrt() * normal());
        walk = walk.map(|value| value + step * normal());
        let [across, along] = tangent_frame(&aim);
        let moved = [0, 1, 2].map(|at| 2.0 * ARCSEC * (state[at] + walk[at]));
        let moved = match axes {
            Axes::OfTheBeam => across * moved[0] + along * moved[1],
            Axes::OfSpace => moved.into(),
        };
        observed.push(Measured::Direction((aim + moved).normalize()));
    }
    let observations = observed_alone(&chain, "pointing", Measure::Direction, columns, observed);
    search(&text, &plan, &observations).diagnosis
}

/// Without regard to memory each of these was told an effect. How often one is told is for the evaluation command.
#[track_caller]
fn is_no_effect(axes: Axes) {
    for (kept, step) in [(0.9, 0.0), (0.0, 0.4)] {
        let report = report(1, kept, step, 0.0, axes);
        assert!(report.effects.is_empty(), "{kept} {step}: {:?}", report.effects);
    }
}

#[test]
fn memory_is_no_effect() {
    is_no_effect(Axes::OfTheBeam);
}

/// A drift of the ground turns across and along the beam as the beam turns.
#[test]
fn memory_of_the_ground_is_no_effect() {
    is_no_effect(Axes::OfSpace);
}

/// A beam that looks everywhere tells in whose axes rows remember.
#[test]
fn memory_is_told_in_its_own_axes() {
    for (axes, in_space) in [(Axes::OfTheBeam, false), (Axes::OfSpace, true)] {
        let report = report(5, 0.9, 0.0, 0.0, axes);
        let serial = report.noise.serial.unwrap_or_else(|| panic!("{axes:?}: {:?}", report.noise));
        assert_eq!(serial.in_space, in_space, "{axes:?}: {serial:?}");
    }
}

/// It is found, and that nobody declared the order.
#[test]
fn memory_is_found_in_an_order_that_nobody_declared() {
    let report = report(3, 0.9, 0.0, 0.0, Axes::OfTheBeam);
    assert!(report.noise.undeclared_order && report.noise.serial.is_some(), "{:?}", report.noise);
}

/// An effect well above the noise is no memory, though rows follow each other along a path.
#[test]
fn an_effect_is_no_memory() {
    let report = report(4, 0.0, 0.0, 8.0 * ARCSEC, Axes::OfTheBeam);
    // The cosine of beta alone is what gravity does too.
    let here = |effect: &EffectFound| effect.body == "middle" && effect.dof == "Rx";
    assert!(report.effects.iter().any(here), "{:?}", report.effects);
}

/// Of 25 rows along a path that remember, two of eight runs accept an effect at most; where memory was not looked for in so few,
/// nearly half did. Of those that remember nothing, none is told to.
#[test]
fn memory_of_few_rows_is_no_effect() {
    let text = std::fs::read_to_string(root().join("examples/alt-azimuth/alt-azimuth.chain")).unwrap();
    let chain = Chain::from_text(&text).unwrap();
    let study = "chain = \"c\"\ndata = \"d\"\n[observed]\nkind = \"direction\"\n";
    let plan = Study::from_text(study).unwrap().plan(&chain).unwrap();
    let ids = ["azimuth", "elevation"].map(|name| chain.find_symbol(name).unwrap());
    let report = |seed: u64, kept: f64| {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = || -> f64 { random.sample(StandardNormal) };
        let mut columns: Vec<_> = ids.iter().map(|&id| (id, Vec::new())).collect();
        let mut state = [normal(), normal()];
        let mut measured = Vec::new();
        for row in 0..25 {
            let turns = std::f64::consts::TAU * f64::from(row) / 25.0;
            let (azimuth, elevation) = (3.1 * (turns + 0.4).sin(), 0.8 + 0.6 * (1.7 * turns + 0.4).sin());
            columns.iter_mut().zip([azimuth, elevation]).for_each(|((_, column), value)| column.push(value));
            state = state.map(|value| kept * value + (1.0 - kept * kept).sqrt() * normal());
            let aim = direction_from_spherical(azimuth, elevation);
            let [across, along] = tangent_frame(&aim);
            let moved = (across * state[0] + along * state[1]) * (5.0 * ARCSEC);
            measured.push(Measured::Direction((aim + moved).normalize()));
        }
        let observations = observed_alone(&chain, "sight", Measure::Direction, columns, measured);
        search(&text, &plan, &observations).diagnosis
    };
    let accepted = (0..8).filter(|&seed| !report(seed, 0.9).effects.is_empty()).count();
    assert!(accepted <= 2, "{accepted} of 8");
    let remember = (0..8).filter(|&seed| report(seed, 0.0).noise.undeclared_order).count();
    assert_eq!(remember, 0);
}
