//! Data as they should not be: an outcome that names the trouble, never a panic, never a silent wrong answer.

use calibration::diagnose::{Caution, of_data, precision};
use fit::{FitOptions, FitResult, Outcome, Reason, Why, fit};
use nalgebra::{Rotation3, Vector3};
use observe::{Measured, Observations};
use rand::RngExt;

use crate::simulated::{Simulation, swapped};

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;

fn mount(rows: usize, seed: u64) -> Simulation {
    let text = include_str!("../../../examples/alt-azimuth/alt-azimuth.chain");
    let mut simulation = Simulation::new(text, seed);
    simulation.column("azimuth", rows, -3.1..3.1);
    simulation.column("elevation", rows, 0.2..1.3);
    simulation.draw_errors("*", 60.0 * ARCSEC);
    simulation
}

fn fitted(simulation: &Simulation, observations: &Observations) -> FitResult {
    fit(&simulation.chain, observations, &FitOptions::for_chain(&simulation.chain)).unwrap()
}

/// The greatest error of an estimate, in units of its standard uncertainty.
fn worst(simulation: &Simulation, result: &FitResult) -> f64 {
    let score = |(at, parameter): (usize, &model_core::SymbolId)| {
        let error = result.values[parameter.index()] - simulation.values[parameter.index()];
        error.abs() / result.covariance[(at, at)].sqrt()
    };
    result.parameters.iter().enumerate().map(score).fold(0.0, f64::max)
}

#[test]
fn forty_percent_outliers_are_set_aside() {
    let mut simulation = mount(300, 1);
    let mut observations = simulation.directions("sight", 2.0 * ARCSEC);
    for row in 0..120 {
        let to: f64 = simulation.rng().random_range(0.002..0.5);
        let aim = observations.measured[row].vector().unwrap();
        let moved = Vector3::new(aim.x + to, aim.y - to, aim.z).normalize();
        observations.measured[row] = Measured::Direction(moved);
    }
    let result = fitted(&simulation, &observations);
    assert!(matches!(result.outcome, Outcome::Converged { .. }), "{:?}", result.outcome);
    assert!((120..126).contains(&result.set_aside.len()), "{}", result.set_aside.len());
    assert!(result.set_aside.iter().filter(|aside| aside.row < 120).count() == 120);
    assert!(worst(&simulation, &result) < 4.0, "{}", worst(&simulation, &result));
}

#[test]
fn one_pose_repeated_determines_two_combinations() {
    let mut simulation = mount(50, 2);
    for (_, column) in &mut simulation.columns {
        let first = column[0];
        column.fill(first);
    }
    let observations = simulation.directions("sight", 2.0 * ARCSEC);
    let result = fitted(&simulation, &observations);
    assert_eq!(result.rank, 2);
    assert!(result.separable.iter().all(|separable| !separable));
    assert_eq!(result.null_space.ncols(), 4);
}

#[test]
fn all_rows_identical_have_no_spread_to_learn_from() {
    let mut simulation = mount(1, 3);
    let one = simulation.directions("sight", 2.0 * ARCSEC);
    let observations = one.select(&[0; 20]);
    let result = fitted(&simulation, &observations);
    assert_eq!(result.rank, 2);
    assert!(result.rms < 1e-12);
}

#[test]
fn fewer_rows_than_errors_are_named() {
    for rows in [0, 1, 2, 3] {
        let mut simulation = mount(rows, 4);
        let observations = simulation.directions("sight", 2.0 * ARCSEC);
        let result = fitted(&simulation, &observations);
        let few = Outcome::TooFewObservations {
            components: 2 * rows,
            parameters: 6,
            rank: 2 * rows,
            of_objects: 0,
        };
        assert_eq!(result.outcome, few, "{rows} rows");
        assert!(result.parameters.iter().all(|&id| result.standard_uncertainty(id).is_none()), "{rows} rows");
        assert!(result.values.iter().all(|value| value.is_finite()));
        assert!((0..6).all(|at| !(result.covariance[(at, at)] < 1e-6 && result.separable[at])));
    }
}

#[test]
fn errors_of_degrees_converge() {
    let mut simulation = mount(200, 5);
    simulation.draw_errors("*", 0.1);
    let observations = simulation.directions("sight", 2.0 * ARCSEC);
    let result = fitted(&simulation, &observations);
    assert!(matches!(result.outcome, Outcome::Converged { .. }), "{:?}", result.outcome);
    assert!(worst(&simulation, &result) < 4.0, "{}", worst(&simulation, &result));
}

/// Other starts help; an angle may still come back as another one that turns the beam alike (half a turn further, say).
#[test]
fn errors_of_half_a_radian_converge_from_zero() {
    for seed in 0..8 {
        let mut simulation = mount(200, seed);
        simulation.draw_errors("*", 0.5);
        let observations = simulation.directions("sight", 2.0 * ARCSEC);
        let result = fitted(&simulation, &observations);
        assert!(matches!(result.outcome, Outcome::Converged { .. }), "{seed}: {:?}", result.outcome);
        assert!((2.0..4.0).contains(&(result.rms / ARCSEC)), "{seed}: {}", result.rms / ARCSEC);
    }
}

/// Each row measured where another one was pointing: no start explains that.
#[test]
fn directions_of_other_rows_are_no_fit() {
    let mut simulation = mount(60, 3);
    let mut observations = simulation.directions("sight", 2.0 * ARCSEC);
    observations.measured.rotate_left(17);
    let result = fitted(&simulation, &observations);
    let Outcome::NotConverged { reason, .. } = result.outcome else { panic!("{:?}", result.outcome) };
    assert_eq!(reason, Reason::FarOff);
}

/// Directions in a plane: half of the components are zero and say nothing of the noise of the others.
#[test]
fn an_instrument_that_moves_in_a_plane_is_fitted() {
    let text = "chain Table { body top on ground { motion: Rz(angle); motion_error: Rz(zero); } \
                observe mark: direction(1, 0, 0) of top; }";
    for rows in [12, 40, 200] {
        let mut simulation = Simulation::new(text, 11);
        simulation.column("angle", rows, -3.1..3.1);
        let zero = simulation.chain.find_symbol("zero").unwrap();
        simulation.values[zero.index()] = 30.0 * ARCSEC;
        let mut observations = simulation.directions("mark", 0.0);
        for measured in &mut observations.measured {
            let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), ARCSEC * simulation.normal());
            *measured = Measured::Direction(turn * measured.vector().unwrap());
        }
        let result = fitted(&simulation, &observations);
        assert!(matches!(result.outcome, Outcome::Converged { .. }), "{rows}: {:?}", result.outcome);
        let uncertainty = result.standard_uncertainty(zero).unwrap();
        let expected = ARCSEC / f64::from(rows as u32).sqrt();
        assert!((0.5..2.0).contains(&(uncertainty / expected)), "{rows}: {}", uncertainty / expected);
        assert!((result.values[zero.index()] - 30.0 * ARCSEC).abs() < 4.0 * expected, "{rows}");
    }
}

#[test]
fn tiny_and_huge_scales_fit_alike() {
    // Errors of 1e-12 rad with noise of 1e-13, and a lever arm of a thousand kilometres.
    let mut simulation = mount(200, 6);
    simulation.draw_errors("*", 1e-12);
    let observations = simulation.directions("sight", 1e-13);
    let result = fitted(&simulation, &observations);
    assert!(matches!(result.outcome, Outcome::Converged { .. }), "{:?}", result.outcome);
    assert!(worst(&simulation, &result) < 4.0, "{}", worst(&simulation, &result));

    let text = "chain Far { body a on ground { position_error: Tx(x), Ty(y), Ry(tilt); motion: Rz(q); \
                motion_error: Rz(index); } observe mark: point(1000000, 0, 0) of a; }";
    let mut simulation = Simulation::new(text, 7);
    simulation.column("q", 200, -3.0..3.0);
    simulation.draw_errors("*", 1e-3);
    let observations = simulation.points("mark", 1e-3);
    let result = fitted(&simulation, &observations);
    assert!(matches!(result.outcome, Outcome::Converged { .. }), "{:?}", result.outcome);
    assert_eq!(result.rank, 4);
    assert!(worst(&simulation, &result) < 4.0, "{}", worst(&simulation, &result));
}

#[test]
fn perfect_data_are_no_trouble() {
    let mut simulation = mount(100, 8);
    let observations = simulation.directions("sight", 0.0);
    let result = fitted(&simulation, &observations);
    assert!(matches!(result.outcome, Outcome::Converged { .. }), "{:?}", result.outcome);
    assert!(result.rms < 1e-14, "{}", result.rms);
}

#[test]
fn where_the_chain_has_no_value_the_row_is_set_aside() {
    let text = "chain Cot { body a on ground { motion: Rx(q); motion_error: Rx(t*cot(q)); } \
                observe sight: direction(0, 1, 0) of a; }";
    let mut simulation = Simulation::new(text, 9);
    simulation.column("q", 50, 0.2..1.3);
    simulation.draw_errors("*", 1e-3);
    let mut observations = simulation.directions("sight", 1e-5);
    observations.poses.columns[0].1[7] = 0.0;
    let result = fitted(&simulation, &observations);
    let aside = result.set_aside.iter().find(|aside| aside.row == 7).unwrap();
    assert_eq!(aside.why, Why::NoValue);
    assert!(worst(&simulation, &result) < 4.0);
}

#[test]
fn duplicated_rows_change_no_estimate() {
    let mut simulation = mount(60, 10);
    let observations = simulation.directions("sight", 2.0 * ARCSEC);
    let once = fitted(&simulation, &observations);
    let rows: Vec<usize> = (0..60).chain(0..60).collect();
    let twice = fitted(&simulation, &observations.select(&rows));
    for &parameter in &once.parameters {
        let uncertainty = once.standard_uncertainty(parameter).unwrap();
        let moved = once.values[parameter.index()] - twice.values[parameter.index()];
        assert!(moved.abs() < 0.05 * uncertainty, "{}", moved / uncertainty);
    }
}

#[test]
fn a_gap_between_poses_is_no_trouble() {
    let mut simulation = mount(120, 11);
    for (_, column) in &mut simulation.columns {
        // Nothing in the middle of the range.
        column.iter_mut().filter(|value| (0.4..1.1).contains(*value)).for_each(|value| *value += 0.75);
    }
    let observations = simulation.directions("sight", 2.0 * ARCSEC);
    let result = fitted(&simulation, &observations);
    assert!(matches!(result.outcome, Outcome::Converged { .. }), "{:?}", result.outcome);
    assert_eq!(result.rank, 6);
    assert!(worst(&simulation, &result) < 4.0, "{}", worst(&simulation, &result));
}

/// What a user reads of each trouble: the outcome in words, and the sets that the data leave open.
#[test]
fn trouble_has_words() {
    let said = |rows: usize, seed: u64, change: &dyn Fn(&mut Simulation) -> Observations| {
        let mut simulation = mount(rows, seed);
        let observations = change(&mut simulation);
        let result = fitted(&simulation, &observations);
        (precision(&simulation.chain, &observations, &result), result)
    };
    let measured = |simulation: &mut Simulation| simulation.directions("sight", 2.0 * ARCSEC);

    let (_, few) = said(2, 12, &measured);
    assert_eq!(
        few.outcome,
        Outcome::TooFewObservations { components: 4, parameters: 6, rank: 4, of_objects: 0 }
    );

    let (repeated, _) = said(50, 13, &|simulation| {
        simulation.columns.iter_mut().for_each(|(_, column)| column.fill(0.7));
        simulation.directions("sight", 2.0 * ARCSEC)
    });
    assert_eq!(repeated.rank, [2, 6]);
    assert!(repeated.determined.is_empty());
    assert!(repeated.not_separable.iter().all(|set| !set.structural), "{:?}", repeated.not_separable);
    let named: usize = repeated.not_separable.iter().map(|set| set.names.len()).sum();
    assert_eq!(named, 6);

    let (identical, _) = said(1, 14, &|simulation| measured(simulation).select(&[0; 20]));
    assert_eq!(identical.rank, [2, 6]);
    assert!(identical.determined.is_empty());

    let (_, outliers) = said(100, 15, &|simulation| {
        let mut observations = measured(simulation);
        observations.measured[3] = swapped(observations.measured[3], 0, 1);
        observations
    });
    let why = &outliers.set_aside.iter().find(|aside| aside.row == 3).unwrap().why;
    assert!(why.to_string().ends_with("standard deviations"), "{why}");
}

#[test]
fn millimetres_taken_for_metres_are_hinted_at() {
    let text = "chain Arm { body upper on ground { motion: Rz(q1); motion_error: Rz(index1); } \
                body fore on upper { position: Tx(0.6); position_error: Tx(length1); motion: Ry(q2); motion_error: Ry(index2); } \
                observe tip: point(0.5, 0, 0) of fore; }";
    for (factor, hinted) in [(1.0, false), (1e3, true), (-1.0, true)] {
        let mut simulation = Simulation::new(text, 16);
        simulation.column("q1", 80, -3.0..3.0);
        simulation.column("q2", 80, -1.0..1.0);
        simulation.draw_errors("*", 1e-3);
        let mut observations = simulation.points("tip", 1e-4);
        for measured in &mut observations.measured {
            let mut point = *measured.vector().unwrap();
            point.z *= factor;
            *measured = Measured::Point(point);
        }
        let result = fitted(&simulation, &observations);
        let cautions = of_data(&simulation.chain, &observations, &result);
        let out_of_place =
            |caution: &Caution| matches!(caution, Caution::OutOfPlace { measured_m: Some(_), .. });
        assert_eq!(cautions.iter().any(out_of_place), hinted, "{factor}: {cautions:?}");
    }
}
