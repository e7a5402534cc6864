//! Measured orientations: residuals in the frame and of the sign that `derive` has, their derivatives, and fits of whole studies.

use std::collections::BTreeMap;

use fit::{FitOptions, FitResult, Model, Outcome, fit};
use model_core::{ObservableId, SymbolKind, exact};
use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, UnitQuaternion, Vector3};
use observe::{Measure, Measured, Observations, Series};
use statrs::distribution::{ChiSquared, ContinuousCDF};
use study::Study;
use tables::formats::{DataError, Input};

use crate::simulated::Simulation;

/// Constants that turn far, a joint that repeats, and the orientation in the frame of a body that moves too. The three axes are
/// observed as well, one by one.
const WRIST: &str = "chain Wrist {
    const mounted: angle = 2.4;
    const bent: angle = -1.3;
    body stand on ground { position: Rx(mounted); position_error: Ry(tilt); }
    body arm on stand { motion: Rz(a); motion_error: Rz(scale*a), Rx(wobble*cos(a)); }
    body hand on arm { position: Ry(bent), Tx(0.2); position_error: Rz(skew); motion: Rx(b + 2*a); motion_error: Ry(fold); }
    body table on ground { motion: Rz(c); motion_error: Rx(table_tilt); }
    observe turned: orientation of hand in table;
    observe ex: direction(1, 0, 0) of hand in table;
    observe ey: direction(0, 1, 0) of hand in table;
    observe ez: direction(0, 0, 1) of hand in table;
}";

fn wrist(rows: usize, seed: u64) -> Simulation {
    let mut simulation = Simulation::new(WRIST, seed);
    for joint in ["a", "b", "c"] {
        simulation.column(joint, rows, -3.0..3.0);
    }
    simulation
}

/// The orientation at each pose, from its three axes.
fn orientations(simulation: &Simulation) -> Vec<UnitQuaternion<f64>> {
    let [x, y, z] = ["ex", "ey", "ez"].map(|axis| simulation.truth(axis));
    let of = |row: usize| Matrix3::from_columns(&[x[row], y[row], z[row]]);
    let rotation = |matrix| UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(matrix));
    (0..simulation.rows()).map(|row| rotation(of(row))).collect()
}

fn observed(simulation: &Simulation, measured: Vec<UnitQuaternion<f64>>) -> Observations {
    let measured = measured.into_iter().map(Measured::Orientation).collect();
    simulation.observations("turned", Measure::Orientation, measured)
}

fn residuals(model: &Model, observations: &Observations, values: &[f64]) -> Vec<f64> {
    model.map_blocks(observations, values, |_, _, block| block.residual.clone()).unwrap().concat()
}

/// Without errors what is left of the orientation with them is the small rotation vector that `derive` and `eval` know.
#[test]
fn what_is_left_is_the_rotation_vector_of_the_declaration() {
    let mut simulation = wrist(40, 3);
    simulation.draw_errors("*", 0.3);
    let observations = observed(&simulation, orientations(&simulation));
    let errors: Vec<_> = simulation.chain.symbols_of(SymbolKind::Error).collect();
    let model = Model::new(&simulation.chain, &observations.poses, &errors).unwrap();
    let left = residuals(&model, &observations, &simulation.chain.nominal_values());
    let path = exact::Path::new(&simulation.chain, ObservableId(0));
    let mut values = simulation.values.clone();
    for row in 0..simulation.rows() {
        simulation.columns.iter().for_each(|(id, column)| values[id.index()] = column[row]);
        for (component, expected) in path.shown(&values).into_iter().enumerate() {
            let found = left[component * simulation.rows() + row];
            assert!((found - expected).abs() < 1e-13, "{row} {component}: {found} {expected}");
        }
    }
}

/// Derivatives by errors and constants, at errors that are not small, against differences of residuals: where the measured
/// orientation is near, and where it is nearly half a turn away.
#[test]
fn derivatives_are_those_of_residuals_at_the_estimates() {
    let mut simulation = wrist(60, 5);
    simulation.draw_errors("*", 0.2);
    let far = |row: usize| [1e-7, 0.02, 1.0, 2.0, 3.0][row % 5];
    let truth = orientations(&simulation);
    let mut measured = Vec::new();
    for (row, truth) in truth.into_iter().enumerate() {
        let axis = Vector3::new(simulation.normal(), simulation.normal(), simulation.normal()).normalize();
        measured.push(UnitQuaternion::new(axis * far(row)) * truth);
    }
    let observations = observed(&simulation, measured);
    let wrt: Vec<_> = [SymbolKind::Error, SymbolKind::Constant]
        .into_iter()
        .flat_map(|kind| simulation.chain.symbols_of(kind))
        .collect();
    let model = Model::new(&simulation.chain, &observations.poses, &wrt).unwrap();
    let columns: Vec<Vec<f64>> = model
        .map_blocks(&observations, &simulation.values, |_, _, block| {
            block.columns().map(<[f64]>::to_vec).collect::<Vec<_>>()
        })
        .unwrap()
        .concat();
    for (at, id) in wrt.iter().enumerate() {
        let step = 1e-5;
        let moved = |by: f64| {
            let mut values = simulation.values.clone();
            values[id.index()] += by;
            residuals(&model, &observations, &values)
        };
        let (behind, ahead) = (moved(-step), moved(step));
        let column = model.column_of()[at].map(|column| &columns[column]);
        for (place, (behind, ahead)) in behind.iter().zip(&ahead).enumerate() {
            let expected = (behind - ahead) / (2.0 * step);
            let found = column.map_or(0.0, |column| column[place]);
            let name = &simulation.chain.symbol(*id).name;
            // Near half a turn the logarithm bends: differences are right to the square of the step times its curvature.
            assert!((found - expected).abs() < 1e-6, "{name} {place}: {found} {expected}");
        }
    }
}

#[test]
fn poses_that_nobody_measured_leave_nothing_and_move_as_residuals_do() {
    let simulation = wrist(10, 6);
    let observations = observed(&simulation, orientations(&simulation));
    let errors: Vec<_> = simulation.chain.symbols_of(SymbolKind::Error).collect();
    let model = Model::new(&simulation.chain, &observations.poses, &errors).unwrap();
    let values = simulation.chain.nominal_values();
    let of =
        |block: &fit::Block| (block.residual.clone(), block.columns().flatten().copied().collect::<Vec<_>>());
    let poses = model.map_poses(&observations.poses, &values, |_, _, block| of(block)).unwrap();
    let rows = model.map_blocks(&observations, &values, |_, _, block| of(block)).unwrap();
    for ((nothing, own), (_, expected)) in poses.into_iter().zip(rows) {
        assert!(nothing.iter().all(|left| *left == 0.0));
        assert!(own.iter().zip(&expected).all(|(own, expected)| (own - expected).abs() < 1e-14));
    }
}

/// An orientation with normal noise about each axis.
fn noisy(simulation: &mut Simulation, sigma_rad: f64) -> Vec<UnitQuaternion<f64>> {
    let truth = orientations(simulation);
    let mut noise =
        || sigma_rad * Vector3::new(simulation.normal(), simulation.normal(), simulation.normal());
    truth.into_iter().map(|truth| UnitQuaternion::new(noise()) * truth).collect()
}

fn converged(simulation: &Simulation, observations: &Observations) -> FitResult {
    let result = fit(&simulation.chain, observations, &FitOptions::for_chain(&simulation.chain)).unwrap();
    assert!(matches!(result.outcome, Outcome::Converged { .. }), "{:?}", result.outcome);
    result
}

/// The worst error of what is separable, in standard uncertainties.
fn worst(simulation: &Simulation, result: &FitResult) -> f64 {
    let separable = result.parameters.iter().zip(&result.separable).filter(|(_, separable)| **separable);
    let off = |id: model_core::SymbolId| {
        (result.values[id.index()] - simulation.values[id.index()]) / result.standard_uncertainty(id).unwrap()
    };
    separable.map(|(&id, _)| off(id).abs()).fold(0.0, f64::max)
}

#[test]
fn rows_half_a_turn_off_are_set_aside() {
    let mut simulation = wrist(80, 11);
    simulation.draw_errors("*", 1e-3);
    let mut measured = noisy(&mut simulation, 1e-4);
    for (row, axis) in [(7, Vector3::x()), (31, Vector3::y()), (50, Vector3::z())] {
        measured[row] = UnitQuaternion::new(axis * std::f64::consts::PI) * measured[row];
    }
    // Less far, and still no noise.
    measured[66] = UnitQuaternion::new(Vector3::new(0.0, 2e-3, -1e-3)) * measured[66];
    let result = converged(&simulation, &observed(&simulation, measured));
    let mut aside: Vec<usize> = result.set_aside.iter().map(|aside| aside.row).collect();
    aside.sort_unstable();
    assert_eq!(aside, [7, 31, 50, 66]);
    assert!(result.separable.iter().all(|separable| *separable), "{:?}", result.separable);
    assert!(worst(&simulation, &result) < 4.5, "{}", worst(&simulation, &result));
}

#[test]
fn three_rows_and_a_chain_without_joints_are_fitted() {
    let mut simulation = wrist(3, 2);
    simulation.draw_errors("*", 1e-3);
    let measured = noisy(&mut simulation, 1e-6);
    let result = converged(&simulation, &observed(&simulation, measured));
    assert_eq!(result.rank, 6);

    let text = "chain Fixed { body plate on ground { position_error: Rx(rx), Ry(ry), Rz(rz); }
        observe turned: orientation of plate; }";
    let still = Simulation::new(text, 1);
    let identity = vec![Measured::Orientation(UnitQuaternion::identity()); 5];
    let result = converged(&still, &still.observations("turned", Measure::Orientation, identity));
    assert_eq!((result.rank, result.rms), (3, 0.0));
    let turn = Vector3::new(0.4, -0.3, 1.2);
    let turned = vec![Measured::Orientation(UnitQuaternion::new(turn)); 5];
    let result = converged(&still, &still.observations("turned", Measure::Orientation, turned));
    // Rx(rx) Ry(ry) Rz(rz), multiplied out.
    let [rx, ry, rz] = [0, 1, 2].map(|at| result.values[result.parameters[at].index()]);
    let product = [(Vector3::x(), rx), (Vector3::y(), ry), (Vector3::z(), rz)]
        .into_iter()
        .fold(Matrix3::identity(), |product, (axis, by)| product * (axis * by).cross_matrix().exp());
    assert!((product - turn.cross_matrix().exp()).amax() < 1e-9, "{product}");
}

/// A base that nobody knows is found from orientations alone, half a turn off and with outliers among the rows.
#[test]
fn a_base_turned_by_any_angle_is_found_from_orientations() {
    let text = WRIST.replace("Rx(mounted)", "Rx(mounted), Tx(0.3), Rz(-heading), Ry(pitch)").replace(
        "const mounted: angle = 2.4;",
        "const mounted: angle = 0; const heading: angle = 0; const pitch: angle = 0;",
    );
    let text = text.replace(" in table", "");
    let turns = [
        [0.0, 0.0, std::f64::consts::PI - 3e-6],
        [3.1, 0.4, -2.0],
        [-1.5, 3.0, 0.3],
        [0.0, 0.0, 0.0],
        [0.1, 1.5, -3.1],
    ];
    for (seed, turns) in turns.into_iter().enumerate() {
        let mut simulation = Simulation::new(&text, seed as u64);
        for joint in ["a", "b"] {
            simulation.column(joint, 90, -3.0..3.0);
        }
        simulation.draw_errors("*", 1e-3);
        let constants =
            ["mounted", "pitch", "heading"].map(|name| simulation.chain.find_symbol(name).unwrap());
        constants.iter().zip(turns).for_each(|(id, turn)| simulation.values[id.index()] = turn);
        let mut measured = noisy(&mut simulation, 1e-5);
        for row in (0..90).step_by(6) {
            let off = Vector3::new(simulation.normal(), simulation.normal(), simulation.normal());
            measured[row] = UnitQuaternion::new(off) * measured[row];
        }
        let mut options = FitOptions::for_chain(&simulation.chain);
        options.estimate.extend(constants);
        options.estimate.sort_unstable();
        let result = fit(&simulation.chain, &observed(&simulation, measured), &options).unwrap();
        assert!(matches!(result.outcome, Outcome::Converged { .. }), "{turns:?}: {:?}", result.outcome);
        assert_eq!(result.set_aside.iter().filter(|aside| aside.row % 6 == 0).count(), 15, "{turns:?}");
        let sigma = result.rms / 3f64.sqrt();
        assert!((0.8..1.15).contains(&(sigma / 1e-5)), "{turns:?}: {sigma}");
    }
}

/// A flat arm: its tool is turned about z by the sum of its angles, which is all that the orientation has to say.
const ARM: &str = "chain Arm {
    body upper on ground { motion: Rz(q1); motion_error: Rz(index1); }
    body fore on upper { position: Tx(0.6); position_error: Tx(length1); motion: Rz(q2); motion_error: Rz(index2); }
    body tool on fore { position: Tx(0.5); position_error: Tx(length2), Rx(roll), Ry(pitch); }
    observe tip: point(0, 0, 0) of tool;
    observe turned: orientation of tool;
}";

/// How the table writes the orientation, beside points, with a standard deviation of its own.
fn study(keys: &str) -> String {
    format!(
        "chain = 'arm.chain'\nobservable = 'tip'\ndata = 'poses.csv'\n[observed]\nkind = 'point'\n[fit]\nrobust = false\n\
         [[also]]\nobservable = 'turned'\ndata = 'poses.csv'\n[also.observed]\nkind = 'orientation'\n{keys}\n"
    )
}

const FORMS: [&str; 4] = [
    "",
    "w = 'qw'\nx = 'qx'\ny = 'qy'\nz = 'qz'",
    "rx = { column = 'rx', unit = 'deg' }\nry = { column = 'ry', unit = 'deg' }\nrz = { column = 'rz', unit = 'deg' }",
    "r11 = 'm11'\nr12 = 'm12'\nr13 = 'm13'\nr21 = 'm21'\nr22 = 'm22'\nr23 = 'm23'\nr31 = 'm31'\nr32 = 'm32'\nr33 = 'm33'",
];

/// One table with every form of the orientation.
fn table(seed: u64) -> (Simulation, String) {
    let mut simulation = Simulation::new(ARM, seed);
    simulation.column("q1", 50, -3.0..3.0);
    simulation.column("q2", 50, 0.3..2.8);
    simulation.draw_errors("*", 1e-3);
    let of = |name: &str| simulation.values[simulation.chain.find_symbol(name).unwrap().index()];
    let about = |axis: Vector3<f64>, by: f64| UnitQuaternion::new(axis * by);
    let tips = simulation.truth("tip");
    let own = about(Vector3::x(), of("roll")) * about(Vector3::y(), of("pitch"));
    let zero = of("index1") + of("index2");
    let mut text =
        "q1,q2,tip_x,tip_y,tip_z,turned_rotation_x,turned_rotation_y,turned_rotation_z,qw,qx,qy,qz,rx,ry,rz,\
                    m11,m12,m13,m21,m22,m23,m31,m32,m33\n"
            .to_owned();
    for (row, tip) in tips.into_iter().enumerate() {
        let (q1, q2) = (simulation.columns[0].1[row], simulation.columns[1].1[row]);
        let tip = tip + 2e-4 * Vector3::new(simulation.normal(), simulation.normal(), simulation.normal());
        let noise = 3e-4 * Vector3::new(simulation.normal(), simulation.normal(), simulation.normal());
        let turned = UnitQuaternion::new(noise) * about(Vector3::z(), q1 + q2 + zero) * own;
        let small = (turned * about(Vector3::z(), -q1 - q2)).scaled_axis();
        let sign = if row % 3 == 0 { -1.0 } else { 1.0 };
        let q = turned.coords * sign;
        let vector = turned.scaled_axis() * (180.0 / std::f64::consts::PI);
        let matrix = turned.to_rotation_matrix().into_inner().transpose();
        let numbers = [q1, q2].into_iter().chain(tip.iter().copied()).chain(small.iter().copied());
        let numbers = numbers.chain([q.w, q.x, q.y, q.z]).chain(vector.iter().copied());
        let numbers: Vec<String> =
            numbers.chain(matrix.iter().copied()).map(|number| number.to_string()).collect();
        text += &format!("{}\n", numbers.join(","));
    }
    (simulation, text)
}

fn fitted(study: &str, simulation: &Simulation, table: &str) -> FitResult {
    let plan = Study::from_text(study).unwrap().plan(&simulation.chain).unwrap();
    let mut open =
        |_: &str| -> Result<Input<'static>, DataError> { Ok(table.to_owned().into_bytes().into()) };
    let observations = plan.load(&mut open).unwrap().observations;
    let kinds: BTreeMap<&str, Measure> = observations
        .poses
        .series
        .iter()
        .map(|Series { source, measure, .. }| (source.as_str(), *measure))
        .collect();
    assert_eq!(kinds, BTreeMap::from([("poses.csv", Measure::Orientation)]));
    let result = fit(&plan.chain, &observations, &plan.fit).unwrap();
    assert!(matches!(result.outcome, Outcome::Converged { .. }), "{:?}", result.outcome);
    result
}

/// Points and orientations of one table: the same fit whichever way the table writes them.
#[test]
fn every_form_gives_the_same_fit() {
    let (simulation, text) = table(1);
    let results = FORMS.map(|form| fitted(&study(form), &simulation, &text));
    for result in &results {
        assert_eq!(result.rank, 6);
        for (id, value) in
            result.parameters.iter().zip(&result.parameters).map(|(id, at)| (id, result.values[at.index()]))
        {
            let first = results[0].values[id.index()];
            assert!((value - first).abs() < 1e-10, "{}: {value} {first}", simulation.chain.symbol(*id).name);
        }
    }
}

/// Over many runs the estimates lie as far from the truth as their covariance says.
#[test]
fn estimates_of_points_and_orientations_are_as_sure_as_they_say() {
    let (mut sum, mut count) = (0.0, 0.0);
    for seed in 0..60 {
        let (simulation, text) = table(seed);
        let result = fitted(&study(FORMS[1]), &simulation, &text);
        let n = result.parameters.len();
        let off = |id: &model_core::SymbolId| result.values[id.index()] - simulation.values[id.index()];
        let error = DVector::from_iterator(n, result.parameters.iter().map(off));
        let covariance = DMatrix::from_fn(n, n, |a, b| result.covariance[(a, b)]);
        sum += error.dot(&covariance.cholesky().unwrap().solve(&error));
        count += n as f64;
        for (kind, sigma) in [2e-4, 2e-4, 2e-4, 3e-4, 3e-4, 3e-4].into_iter().enumerate() {
            let ratio = result.noise.floor[kind] / sigma;
            assert!((0.6..1.5).contains(&ratio), "{seed} {kind}: {ratio}");
        }
    }
    let chance = ChiSquared::new(count).unwrap().cdf(sum);
    assert!((5e-5..1.0 - 5e-5).contains(&chance), "{sum} for {count}");
}
