//! The reference's uncertainty is in the ± of estimates, once: their spread over simulated references is as large as they say (Monte Carlo
//! of GUM supplement 1, JCGM 101:2008).

use fit::{FitError, FitOptions, Reference, Streamed, fit};
use model_core::Chain;
use observe::{Measure, Observations, Poses as Readings, Series};
use testkit::mount::{ARCSEC, NAMES, Noise, Poses, measured};
use testkit::{Random, turned};

use super::{MOUNT, observations};

const MACHINE: &str = include_str!("../../../examples/slides/machine.chain");

/// Spreads are known to 6 %.
const RUNS: u64 = 150;

#[test]
fn a_turned_frame_moves_the_base_by_as_much_as_is_said() {
    let chain = Chain::from_text(MOUNT).unwrap();
    let plain = FitOptions::for_chain(&chain);
    let rotation_rad = 3.0 * ARCSEC;
    let stated =
        FitOptions { reference: Some(Reference { rotation_rad, ..Reference::default() }), ..plain.clone() };
    let [mut squares, mut said, mut without] = [[0.0; 6]; 3];
    for seed in 0..RUNS {
        let mut random = Random::new(53_000 + seed);
        let mut own = measured(60, Poses::Random, Noise::White, 60.0 * ARCSEC, 54_000 + seed);
        for axis in 0..3 {
            let angle = rotation_rad * random.normal();
            own.direction.iter_mut().for_each(|sight| *sight = turned(axis, angle, *sight));
        }
        let rows = observations(&chain, &own, false);
        let [result, bare] = [&stated, &plain].map(|options| fit(&chain, &rows, options).unwrap());
        for (at, name) in NAMES.iter().enumerate() {
            let id = chain.find_symbol(name).unwrap();
            squares[at] += (result.values[id.index()] - own.truth[at]).powi(2) / RUNS as f64;
            said[at] += result.standard_uncertainty(id).unwrap().powi(2) / RUNS as f64;
            without[at] += bare.standard_uncertainty(id).unwrap().powi(2) / RUNS as f64;
        }
    }
    for (at, name) in NAMES.iter().enumerate() {
        let ratio = (squares[at] / said[at]).sqrt();
        println!("{name}: spread over ± {ratio:.3}, ± {:.2}″", said[at].sqrt() / ARCSEC);
        assert!((0.8..=1.2).contains(&ratio), "{name}: {ratio}");
    }
    // No data know a tilt, or an index of azimuth, better than the frame: its uncertainty comes on top of that of the rows.
    for at in 0..3 {
        let added = (said[at] - without[at]) / rotation_rad.powi(2);
        assert!((added - 1.0).abs() < 0.05, "{}: {added}", NAMES[at]);
    }
    // The collimation does not follow the frame.
    assert!((said[5] / without[5] - 1.0).abs() < 0.05);
}

/// A machine without errors that visits targets again and again; what is measured has the errors of the reference.
fn visited(chain: &Chain, of: &Reference, noise_m: f64, seed: u64) -> Observations {
    let (targets, visits) = (12, 6);
    let mut random = Random::new(seed);
    let mut columns = vec![Vec::new(), Vec::new(), Vec::new()];
    let (mut points, mut labels) = (Vec::new(), Vec::new());
    let scale = 1.0 + of.scale * random.normal();
    let shift = [(); 3].map(|()| of.shift_m * random.normal());
    let turn = [(); 3].map(|()| of.rotation_rad * random.normal());
    for target in 0..targets {
        let own = [(); 3].map(|()| of.targets_m * random.normal());
        let at = [(); 3].map(|()| 0.9 * random.even());
        for _ in 0..visits {
            let read = at.map(|at| at + 0.01 * random.even());
            columns.iter_mut().zip(read).for_each(|(column, read)| column.push(read));
            let tip = [read[0], read[1], read[2] - 0.12];
            let seen = [0, 1, 2].map(|k| scale * tip[k] + noise_m * random.normal() + own[k]);
            let seen = (0..3).fold(seen, |seen, axis| turned(axis, turn[axis], seen));
            points.push(observe::Measured::Point([0, 1, 2].map(|k| seen[k] + shift[k]).into()));
            labels.push(target);
        }
    }
    let rows = points.len();
    let mut columns: Vec<_> =
        ["x", "y", "z"].iter().map(|name| chain.find_symbol(name).unwrap()).zip(columns).collect();
    columns.sort_by_key(|(id, _)| *id);
    Observations {
        poses: Readings {
            series: vec![Series {
                observable: chain.find_observable("tip").unwrap(),
                measure: Measure::Point,
                rows: 0..rows,
                source: "simulated".to_owned(),
            }],
            columns,
        },
        measured: points,
        groups: (0..rows as u32).collect(),
        targets: labels,
        row_numbers: (1..=rows as u64).collect(),
        ..Observations::default()
    }
}

/// How large the spread is over the ±, all errors together; and the greatest and the least of one.
fn spread_over_said(reference: Reference, robust: bool, seeds: u64) -> [f64; 3] {
    let chain = Chain::from_text(MACHINE).unwrap();
    let plain = FitOptions::for_chain(&chain);
    let options = FitOptions { reference: Some(reference), robust, ..plain };
    let p = options.estimate.len();
    let (mut squares, mut said) = (vec![0.0; p], vec![0.0; p]);
    for seed in seeds..seeds + RUNS {
        let result = fit(&chain, &visited(&chain, &reference, 1e-5, seed), &options).unwrap();
        for (at, id) in result.parameters.iter().enumerate() {
            squares[at] += result.values[id.index()].powi(2);
            said[at] += result.covariance[(at, at)];
        }
    }
    let ratios: Vec<f64> =
        squares.iter().zip(&said).map(|(square, said): (&f64, &f64)| (square / said).sqrt()).collect();
    let mean = (ratios.iter().map(|ratio| ratio * ratio).sum::<f64>() / p as f64).sqrt();
    [mean, ratios.iter().copied().fold(0.0, f64::max), ratios.iter().copied().fold(f64::INFINITY, f64::min)]
}

#[test]
fn targets_and_scale_and_frame_count_once() {
    let none = Reference::default();
    for (name, reference) in [
        ("targets", Reference { targets_m: 3e-5, ..none }),
        ("scale", Reference { scale: 2e-5, ..none }),
        ("all", Reference { scale: 2e-5, targets_m: 1e-5, rotation_rad: 2e-5, shift_m: 2e-5 }),
    ] {
        let [mean, most, least] = spread_over_said(reference, true, 60_000);
        println!("{name}: spread over ± {mean:.3}, from {least:.3} to {most:.3}");
        assert!((0.9..=1.1).contains(&mean) && most < 1.3 && least > 0.7, "{name}: {mean}, {least}, {most}");
    }
}

#[test]
fn what_cannot_be_is_refused() {
    let chain = Chain::from_text(MACHINE).unwrap();
    let reference = Reference { targets_m: 1e-5, ..Reference::default() };
    let options = FitOptions { reference: Some(reference), ..FitOptions::for_chain(&chain) };
    let rows = visited(&chain, &reference, 1e-5, 1);
    assert_eq!(Streamed::from_sample(&chain, &rows, &options).unwrap_err(), FitError::ReferenceInChunks);
    let huge = Reference { targets_m: 1e300, ..reference };
    let options = FitOptions { reference: Some(huge), ..options };
    assert_eq!(fit(&chain, &rows, &options).unwrap_err(), FitError::ReferenceTooLarge);
}
