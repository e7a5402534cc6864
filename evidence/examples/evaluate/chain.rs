//! An alt-azimuth mount, exact, with effects at any of its places: the simulated instrument.

use std::f64::consts::TAU;

use evidence::problem::{Declared, Frame, Freedom, Joint, Place, Problem, Rows};
use evidence::{Amount, Linearisation, Linearise, NewRows};

pub type Vector = [f64; 3];

pub const ERRORS: [&str; 6] =
    ["tilt_east", "tilt_north", "azimuth_index", "nonperpendicularity", "elevation_index", "collimation"];
const FRAMES: [&str; 4] = ["ground", "fork", "fork_end", "tube"];
const STEP_RAD: f64 = 1e-5;

/// Angles of one row.
#[derive(Debug, Clone, Copy)]
pub struct Pose {
    pub azimuth: f64,
    pub elevation: f64,
}

fn turn(axis: usize, angle: f64, v: Vector) -> Vector {
    let (sin, cos) = angle.sin_cos();
    let (i, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut out = v;
    out[i] = cos * v[i] - sin * v[k];
    out[k] = sin * v[i] + cos * v[k];
    out
}

/// Where the line of sight points. `extra[place]` is a small rotation at place `3 * frame + axis`.
pub fn sight(pose: Pose, e: &[f64], extra: &[f64; 12]) -> Vector {
    let mut v = [0.0, 1.0, 0.0];
    let place =
        |frame: usize, v: Vector| (0..3).rev().fold(v, |v, axis| turn(axis, extra[3 * frame + axis], v));
    v = turn(2, e[5], v);
    v = turn(0, e[4], v);
    v = place(3, v);
    v = turn(0, pose.elevation, v);
    v = place(2, v);
    v = turn(1, e[3], v);
    v = turn(2, -e[2], v);
    v = place(1, v);
    v = turn(2, -pose.azimuth, v);
    v = place(0, v);
    v = turn(1, e[1], v);
    turn(0, e[0], v)
}

/// Two unit vectors across a direction.
pub fn across(d: Vector) -> [Vector; 2] {
    let length = d[0].hypot(d[1]);
    let u = [-d[1] / length, d[0] / length, 0.0];
    [u, [d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2], d[0] * u[1] - d[1] * u[0]]]
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn less(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Rows with their observed directions.
#[derive(Debug, Clone)]
pub struct Data {
    pub poses: Vec<Pose>,
    pub observed: Vec<Vector>,
    pub labels: Option<Vec<usize>>,
    pub directions: bool,
}

/// Residual and columns of rows at estimates, with amounts of effects in the exact chain.
pub fn columns(data: &Data, e: &[f64], extra: &[[f64; 12]]) -> Linearisation {
    let mut given =
        Linearisation { residual: Vec::new(), declared: vec![Vec::new(); 6], places: vec![Vec::new(); 12] };
    for ((&pose, &observed), extra) in data.poses.iter().zip(&data.observed).zip(extra) {
        let d = sight(pose, e, extra);
        let basis = across(d);
        let push = |into: &mut Vec<f64>, change: Vector, by: f64| {
            into.extend(basis.map(|axis| dot(axis, change) / by));
        };
        push(&mut given.residual, less(observed, d), 1.0);
        for error in 0..6 {
            let (mut ahead, mut behind) = (e.to_vec(), e.to_vec());
            ahead[error] += STEP_RAD;
            behind[error] -= STEP_RAD;
            let change = less(sight(pose, &ahead, extra), sight(pose, &behind, extra));
            push(&mut given.declared[error], change, 2.0 * STEP_RAD);
        }
        for place in 0..12 {
            let (mut ahead, mut behind) = (*extra, *extra);
            ahead[place] += STEP_RAD;
            behind[place] -= STEP_RAD;
            let change = less(sight(pose, e, &ahead), sight(pose, e, &behind));
            push(&mut given.places[place], change, 2.0 * STEP_RAD);
        }
    }
    given
}

fn rows(data: &Data) -> Rows {
    let joint = |name: &str, from_horizon: bool, value: &dyn Fn(&Pose) -> f64| {
        let values: Vec<f64> = data.poses.iter().map(value).collect();
        let before = std::iter::once(values[0] - 1.0).chain(values.iter().copied());
        let senses = values.iter().zip(before).map(|(now, before)| (now - before).signum()).collect();
        let direction = data.directions.then_some(senses);
        Joint { name: name.into(), values, direction, from_horizon }
    };
    Rows {
        count: data.poses.len(),
        joints: vec![
            joint("azimuth", false, &|pose| pose.azimuth),
            joint("elevation", true, &|pose| pose.elevation),
        ],
        inputs: Vec::new(),
        labels: data.labels.clone(),
        in_order: true,
        given: Vec::new(),
    }
}

fn places(given: &Linearisation, nominal: Option<&Linearisation>) -> Vec<Place> {
    let place = |(number, column): (usize, &Vec<f64>)| {
        let (frame, axis) = (number / 3, number % 3);
        Place {
            name: format!("{}.R{}", FRAMES[frame], ["x", "y", "z"][axis]),
            frame,
            freedom: Freedom::Rotation(axis as u8),
            own: match (frame / 2, axis) {
                (0, 2) => Some(0),
                (1, 0) => Some(1),
                _ => None,
            },
            beside: vec![frame / 2],
            column: column.clone(),
            nominal: nominal.map(|nominal| nominal.places[number].clone()),
            gravity: None,
            loads: Vec::new(),
        }
    };
    given.places.iter().enumerate().map(place).collect()
}

/// The declared errors by Gauss-Newton on the exact chain.
pub fn fitted(data: &Data) -> Vec<f64> {
    let mut e = vec![0.0; 6];
    let none = vec![[0.0; 12]; data.poses.len()];
    for _ in 0..2 {
        let given = columns(data, &e, &none);
        let step = least_squares(&given.declared, &given.residual);
        e.iter_mut().zip(step).for_each(|(e, step)| *e += step);
    }
    e
}

/// The problem of a contest at the fitted declared errors.
pub fn problem(data: &Data) -> Problem {
    let e = fitted(data);
    let given = columns(data, &e, &vec![[0.0; 12]; data.poses.len()]);
    let frames = FRAMES.iter().enumerate().map(|(frame, name)| Frame {
        name: (*name).into(),
        tilts: Some([3 * frame, 3 * frame + 1]),
        whirl: match frame {
            1 => Some((0, [3, 4])),
            3 => Some((1, [10, 11])),
            _ => None,
        },
    });
    let declared = ERRORS.iter().zip(&e).zip(&given.declared);
    Problem {
        rows: rows(data),
        components: 2,
        residual: given.residual.clone(),
        sigma: None,
        declared: declared
            .map(|((name, &estimate), column)| Declared {
                name: (*name).into(),
                estimate,
                column: column.clone(),
            })
            .collect(),
        frames: frames.collect(),
        places: places(&given, Some(&columns(data, &[0.0; 6], &vec![[0.0; 12]; data.poses.len()]))),
        offered: Vec::new(),
    }
}

/// New rows for a prediction, and the exact chain's residual there.
pub fn new_rows(
    data: &Data,
    e: &[f64],
    effects: &dyn Fn(&Rows, &[Place]) -> Vec<Amount>,
) -> (NewRows, Vec<f64>) {
    let count = data.poses.len();
    let bare = columns(data, e, &vec![[0.0; 12]; count]);
    let extra = spread(&effects(&rows(data), &places(&bare, None)), count);
    let given = columns(data, e, &extra);
    let places = places(&given, None);
    (NewRows { rows: rows(data), declared: given.declared, places }, given.residual)
}

fn spread(effects: &[Amount], count: usize) -> Vec<[f64; 12]> {
    let mut extra = vec![[0.0; 12]; count];
    for effect in effects {
        for (row, amount) in extra.iter_mut().zip(&effect.amount) {
            row[effect.place] += amount;
        }
    }
    extra
}

impl Linearise for Data {
    fn at(&self, declared: &[f64], effects: &[Amount]) -> Result<Linearisation, String> {
        Ok(columns(self, declared, &spread(effects, self.poses.len())))
    }
}

/// Least squares by the normal equations with a tiny ridge, for a handful of columns.
pub fn least_squares(columns: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let size = columns.len();
    let lengths: Vec<f64> = columns.iter().map(|column| product(column, column).sqrt().max(1e-300)).collect();
    let mut a: Vec<Vec<f64>> = (0..size)
        .map(|i| (0..size).map(|j| product(&columns[i], &columns[j]) / lengths[i] / lengths[j]).collect())
        .collect();
    let mut b: Vec<f64> = (0..size).map(|i| product(&columns[i], right) / lengths[i]).collect();
    for (i, row) in a.iter_mut().enumerate() {
        row[i] += 1e-12;
    }
    for i in 0..size {
        let pivot = a[i].clone();
        for k in i + 1..size {
            let factor = a[k][i] / pivot[i];
            a[k].iter_mut().zip(&pivot).for_each(|(into, from)| *into -= factor * from);
            b[k] -= factor * b[i];
        }
    }
    for i in (0..size).rev() {
        for j in i + 1..size {
            b[i] -= a[i][j] * b[j];
        }
        b[i] /= a[i][i];
    }
    b.iter().zip(&lengths).map(|(value, length)| value / length).collect()
}

/// An angle in −π to π.
pub fn wrapped(angle: f64) -> f64 {
    (angle + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0
}
