//! Simulated cases: poses, true errors, effects at a stated SNR, and the kinds of noise.

use std::f64::consts::{PI, TAU};

use evidence::Kind;
use evidence::families::{Driver, Law};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal, StudentT};

use crate::chain::{Data, Pose, across, columns, least_squares, sight, wrapped};

const ARCSEC: f64 = PI / 180.0 / 3600.0;
/// Noise of a reading, a component.
pub const SIGMA: f64 = 2.0 * ARCSEC;
/// Size of true declared errors.
const ERROR: f64 = 60.0 * ARCSEC;

/// An effect with the names under which it counts as told.
#[derive(Clone)]
pub struct Effect {
    pub name: &'static str,
    pub inside: bool,
    /// Place `3 * frame + axis` and function, one or two terms.
    pub terms: Vec<(usize, Term)>,
    pub driver: Driver,
}

/// A function of a pose and the sense of motion in azimuth.
#[derive(Clone, Copy)]
pub enum Term {
    Az(f64, f64),
    El(f64, f64),
    Cot,
    Sense,
    Linear,
    One,
    Product(f64, f64),
    Tanh(f64),
    Bump(f64),
    Clip(f64),
    Dead(f64),
    Exp,
    Rough(u64),
}

impl Term {
    fn at(self, pose: Pose, sense: f64) -> f64 {
        let (a, e) = (pose.azimuth, pose.elevation);
        match self {
            Self::Az(n, phase) => (n * a + phase).cos(),
            Self::El(n, phase) => (n * e + phase).cos(),
            Self::Cot => e.tan().recip(),
            Self::Sense => sense,
            Self::Linear => a,
            Self::One => 1.0,
            Self::Product(p, q) => (a + p).cos() * (e + q).cos(),
            Self::Tanh(at) => ((a - at) / 0.2).tanh(),
            Self::Bump(at) => (-((a - at) / 0.3).powi(2)).exp(),
            Self::Clip(at) => (a - at).clamp(-0.6, 0.6),
            Self::Dead(at) => (a - at).signum() * ((a - at).abs() - 0.7).max(0.0),
            Self::Exp => (-(e - 0.3) / 0.15).exp(),
            Self::Rough(seed) => {
                let mut random = ChaCha8Rng::seed_from_u64(seed);
                (0..200)
                    .map(|_| {
                        let frequency: f64 = StandardNormal.sample(&mut random);
                        (a * frequency / 0.35 + random.random_range(0.0..TAU)).cos() * 0.1
                    })
                    .sum()
            }
        }
    }
}

pub const INSIDE: [&str; 12] = [
    "ecc1",
    "ell2",
    "per5",
    "gear",
    "ecc1_el",
    "sag",
    "backlash",
    "refraction",
    "scale",
    "wobble2",
    "couple",
    "product",
];
pub const OUTSIDE: [&str; 6] = ["tanh", "bump", "clip", "dead", "exp", "rough"];

fn effect(name: &str, random: &mut ChaCha8Rng) -> Effect {
    let phase = random.random_range(0.0..TAU);
    let at = random.random_range(-1.2..1.2);
    let seed = random.random::<u64>();
    let gear = [9.0, 11.0, 13.0, 16.0, 17.0, 19.0, 23.0, 24.0, 29.0][random.random_range(0..9)];
    let (az, el) = (Driver::Joint(0), Driver::Joint(1));
    let one = |place, term, driver, inside, name| Effect { name, inside, terms: vec![(place, term)], driver };
    match name {
        "ecc1" => one(2, Term::Az(1.0, phase), az, true, "ecc1"),
        "ell2" => one(2, Term::Az(2.0, phase), az, true, "ell2"),
        "per5" => one(2, Term::Az(5.0, phase), az, true, "per5"),
        "gear" => one(2, Term::Az(gear, phase), az, true, "gear"),
        "ecc1_el" => one(9, Term::El(1.0, phase), el, true, "ecc1_el"),
        "sag" => one(9, Term::El(1.0, 0.0), el, true, "sag"),
        "backlash" => one(2, Term::Sense, az, true, "backlash"),
        "refraction" => one(9, Term::Cot, el, true, "refraction"),
        "scale" => one(2, Term::Linear, az, true, "scale"),
        "wobble2" => Effect {
            name: "wobble2",
            inside: true,
            terms: vec![(3, Term::Az(2.0, phase)), (4, Term::Az(2.0, phase - PI / 2.0))],
            driver: az,
        },
        "couple" => one(5, Term::El(2.0, phase), el, true, "couple"),
        "product" => one(2, Term::Product(phase, at), Driver::Joints(0, 1), true, "product"),
        "tanh" => one(3, Term::Tanh(at), az, false, "tanh"),
        "bump" => one(3, Term::Bump(at), az, false, "bump"),
        "clip" => one(2, Term::Clip(at), az, false, "clip"),
        "dead" => one(3, Term::Dead(at), az, false, "dead"),
        "exp" => one(9, Term::Exp, el, false, "exp"),
        "rough" => one(3, Term::Rough(seed), az, false, "rough"),
        _ => one(2, Term::One, Driver::Nothing, true, "constant"),
    }
}

impl Effect {
    /// Whether a law is this effect's own.
    pub fn is(&self, law: Law) -> bool {
        let order = match self.terms[0].1 {
            Term::Az(n, _) | Term::El(n, _) => n as usize,
            _ => 0,
        };
        match (self.name, law) {
            ("backlash", Law::Direction) | ("scale", Law::Scale) | ("product", Law::Product) => true,
            ("refraction", Law::Cot | Law::Tan) | ("wobble2", Law::Whirl(2 | -2)) => true,
            ("ecc1" | "ell2" | "per5" | "gear" | "ecc1_el" | "sag" | "couple", Law::Harmonic(n)) => {
                n == order
            }
            ("tanh", Law::Shape(shape)) => shape.kind == Kind::Tanh,
            ("bump", Law::Shape(shape)) => shape.kind == Kind::Bump,
            ("clip", Law::Shape(shape)) => shape.kind == Kind::Clip,
            ("dead", Law::Shape(shape)) => shape.kind == Kind::Dead,
            _ => false,
        }
    }
}

/// What is to be simulated.
#[derive(Debug, Clone)]
pub struct Cell {
    pub noise: String,
    pub effects: Vec<String>,
    pub snr: f64,
    pub rows: usize,
    /// Rows along a slow motion over the sky.
    pub slow: bool,
}

/// A simulated case.
pub struct Case {
    pub data: Data,
    pub errors: Vec<f64>,
    pub effects: Vec<Effect>,
    /// New rows without noise: inside the region of the data and outside.
    pub fresh: [Data; 2],
    /// RMS on the new rows over the noise, of the declared chain alone and of an oracle.
    pub before: [f64; 2],
    pub oracle: [f64; 2],
}

impl Cell {
    pub fn name(&self) -> String {
        let effects = if self.effects.is_empty() { "none".to_owned() } else { self.effects.join("+") };
        format!("{}/{effects}/{}/{}{}", self.noise, self.snr, self.rows, if self.slow { "/slow" } else { "" })
    }
}

pub fn case(cell: &Cell, seed: u64) -> Case {
    let name =
        cell.name().bytes().fold(0u64, |hash, byte| hash.wrapping_mul(131).wrapping_add(u64::from(byte)));
    let mut random = ChaCha8Rng::seed_from_u64(name.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ seed);
    let normal = |random: &mut ChaCha8Rng| -> f64 { StandardNormal.sample(random) };
    let count = cell.rows;
    let errors: Vec<f64> = (0..6).map(|_| ERROR * normal(&mut random)).collect();
    let wide = cell.effects.is_empty();
    let mut poses = poses(cell, wide, &mut random);
    let sessions = cell.noise.starts_with("bands").then(|| session_tilts(&mut poses, &mut random));
    let effects: Vec<Effect> = cell
        .effects
        .iter()
        .map(|name| {
            let name = match name.as_str() {
                "any" => INSIDE[random.random_range(0..INSIDE.len())],
                "out" => OUTSIDE[random.random_range(0..OUTSIDE.len())],
                other => other,
            };
            effect(name, &mut random)
        })
        .collect();
    let directions = effects.iter().any(|effect| effect.name == "backlash");
    let place = |poses: &[Pose]| Data {
        poses: poses.to_vec(),
        observed: vec![[0.0; 3]; poses.len()],
        labels: None,
        directions,
    };
    let mut data = place(&poses);
    // Amplitudes: RMS of what the declared errors do not absorb is the SNR.
    let amplitudes: Vec<f64> =
        effects.iter().map(|effect| amplitude(&data, &errors, effect, cell.snr)).collect();
    let all = |data: &Data| -> Vec<[f64; 12]> {
        let mut extra = vec![[0.0; 12]; data.poses.len()];
        for (effect, amplitude) in effects.iter().zip(&amplitudes) {
            for (place, values) in values(data, effect) {
                extra.iter_mut().zip(values).for_each(|(row, value)| row[place] += amplitude * value);
            }
        }
        extra
    };
    let truth = |data: &Data, tilts: Option<&Vec<[f64; 2]>>| -> Vec<[f64; 3]> {
        let extra = all(data);
        (0..data.poses.len())
            .map(|row| {
                let mut extra = extra[row];
                if let Some(tilts) = tilts {
                    extra[0] += tilts[row][0];
                    extra[1] += tilts[row][1];
                }
                sight(data.poses[row], &errors, &extra)
            })
            .collect()
    };
    let clean = truth(&data, sessions.as_ref().map(|(tilts, _)| tilts));
    let noise = noise(&cell.noise, &poses, &mut random);
    data.observed = clean
        .iter()
        .zip(noise.chunks_exact(2))
        .map(|(d, noise)| {
            let [u, v] = across(*d);
            let moved: [f64; 3] = std::array::from_fn(|i| d[i] + SIGMA * (noise[0] * u[i] + noise[1] * v[i]));
            let length = moved.iter().map(|x| x * x).sum::<f64>().sqrt();
            moved.map(|x| x / length)
        })
        .collect();
    if cell.noise == "bands-label" {
        data.labels = sessions.map(|(_, labels)| labels);
    }
    let fresh = [false, true].map(|outside| {
        let poses = fresh_poses(outside, count.min(300), &mut random);
        let mut fresh = place(&poses);
        fresh.observed = truth(&fresh, None);
        fresh
    });
    let (before, oracle) = judged(&data, &errors, &effects, &fresh);
    Case { data, errors, effects, fresh, before, oracle }
}

fn poses(cell: &Cell, wide: bool, random: &mut ChaCha8Rng) -> Vec<Pose> {
    let reach = if wide { [PI, 0.26, 1.45] } else { [2.0, 0.3, 1.1] };
    let slow = cell.slow || cell.noise.starts_with("ar") || cell.noise == "walk";
    let (start, other) = (random.random_range(0.0..1.0), random.random_range(0.0..1.0));
    (0..cell.rows)
        .map(|row| {
            let wave = |period: f64, start: f64| (2.0 * ((row as f64 / period + start) % 1.0) - 1.0).abs();
            let (a, e) = if slow {
                (2.0 * wave(97.0, start) - 1.0, wave(31.0, other))
            } else {
                (random.random_range(-1.0..1.0), random.random_range(0.0..1.0))
            };
            Pose { azimuth: reach[0] * a, elevation: reach[1] + (reach[2] - reach[1]) * e }
        })
        .collect()
}

fn fresh_poses(outside: bool, count: usize, random: &mut ChaCha8Rng) -> Vec<Pose> {
    (0..count)
        .map(|_| {
            if outside {
                let side = if random.random::<bool>() { 1.0 } else { -1.0 };
                let azimuth = side * random.random_range(2.0..2.7);
                Pose { azimuth, elevation: random.random_range(1.1..1.35) }
            } else {
                let azimuth = random.random_range(-2.0..2.0);
                Pose { azimuth, elevation: random.random_range(0.3..1.1) }
            }
        })
        .collect()
}

/// Six sessions, each in its own band of azimuth and levelled anew: tilts of each row, and labels.
fn session_tilts(poses: &mut [Pose], random: &mut ChaCha8Rng) -> (Vec<[f64; 2]>, Vec<usize>) {
    let count = poses.len();
    let start = random.random_range(0.0..TAU);
    let size = SIGMA * random.random_range(2.0..8.0);
    let tilts: Vec<[f64; 2]> =
        (0..6).map(|_| [0, 1].map(|_| size * Distribution::<f64>::sample(&StandardNormal, random))).collect();
    let labels: Vec<usize> = (0..count).map(|row| 6 * row / count).collect();
    for (pose, &label) in poses.iter_mut().zip(&labels) {
        pose.azimuth = wrapped(start + TAU / 6.0 * (label as f64 + random.random_range(0.0..1.0)));
    }
    (labels.iter().map(|&label| tilts[label]).collect(), labels)
}

fn noise(kind: &str, poses: &[Pose], random: &mut ChaCha8Rng) -> Vec<f64> {
    let count = poses.len();
    let mut z: Vec<f64> = (0..2 * count).map(|_| StandardNormal.sample(random)).collect();
    match kind {
        "t3" => {
            let t = StudentT::new(3.0).unwrap_or_else(|_| unreachable!("three degrees are positive"));
            z.iter_mut().for_each(|z| *z = t.sample(random));
        }
        "uneven" => {
            for (row, pose) in poses.iter().enumerate() {
                let size = (0.8 * (2.0 * pose.elevation).cos()).exp();
                z[2 * row] *= 1.5 * size;
                z[2 * row + 1] *= 0.7 * size;
            }
        }
        "outliers" => {
            for row in 0..count {
                if random.random::<f64>() < 0.05 {
                    z[2 * row] *= 30.0;
                    z[2 * row + 1] *= 30.0;
                }
            }
        }
        "walk" => {
            let mut at = [0.0; 2];
            for row in 0..count {
                for side in 0..2 {
                    at[side] += 0.3 * Distribution::<f64>::sample(&StandardNormal, random);
                    z[2 * row + side] += at[side];
                }
            }
        }
        _ if kind.starts_with("ar") => {
            let carried: f64 = kind[2..].parse().unwrap_or(0.9);
            for at in 2..2 * count {
                z[at] = carried * z[at - 2] + (1.0 - carried * carried).sqrt() * z[at];
            }
        }
        _ => {}
    }
    z
}

/// The place and the unit function of each term of an effect.
fn values(data: &Data, effect: &Effect) -> Vec<(usize, Vec<f64>)> {
    let mut before = data.poses[0].azimuth - 1.0;
    let senses: Vec<f64> = data
        .poses
        .iter()
        .map(|pose| {
            let sense = (pose.azimuth - before).signum();
            before = pose.azimuth;
            sense
        })
        .collect();
    let over =
        |term: Term| data.poses.iter().zip(&senses).map(|(&pose, &sense)| term.at(pose, sense)).collect();
    effect.terms.iter().map(|&(place, term)| (place, over(term))).collect()
}

fn column(data: &Data, errors: &[f64], effect: &Effect) -> (Vec<Vec<f64>>, Vec<f64>) {
    let given = columns(data, errors, &vec![[0.0; 12]; data.poses.len()]);
    let mut sum = vec![0.0; 2 * data.poses.len()];
    for (place, values) in values(data, effect) {
        for (at, into) in sum.iter_mut().enumerate() {
            *into += given.places[place][at] * values[at / 2];
        }
    }
    (given.declared, sum)
}

fn amplitude(data: &Data, errors: &[f64], effect: &Effect, snr: f64) -> f64 {
    let (declared, column) = column(data, errors, effect);
    let absorbed = least_squares(&declared, &column);
    let left: f64 = (0..column.len())
        .map(|at| {
            let fit: f64 = absorbed.iter().zip(&declared).map(|(part, declared)| part * declared[at]).sum();
            (column[at] - fit).powi(2)
        })
        .sum();
    snr * SIGMA / (left / column.len() as f64).sqrt()
}

/// RMS on new rows over the noise: of the declared chain alone, and with the true effects' columns beside it.
fn judged(data: &Data, errors: &[f64], effects: &[Effect], fresh: &[Data; 2]) -> ([f64; 2], [f64; 2]) {
    let none = |data: &Data| vec![[0.0; 12]; data.poses.len()];
    let of = |data: &Data| {
        let given = columns(data, errors, &none(data));
        let mut all = given.declared.clone();
        all.extend(effects.iter().flat_map(|effect| {
            // A wave's sine and cosine are free.
            let turned = |by: f64| {
                let terms = effect.terms.iter().map(|&(place, term)| {
                    let term = match term {
                        Term::Az(n, phase) => Term::Az(n, phase + by),
                        Term::El(n, phase) if effect.name != "sag" => Term::El(n, phase + by),
                        other => other,
                    };
                    (place, term)
                });
                column(data, errors, &Effect { terms: terms.collect(), ..effect.clone() }).1
            };
            [turned(0.0), turned(PI / 2.0)]
        }));
        (given.residual, given.declared, all)
    };
    let (residual, declared, all) = of(data);
    let (alone, with) = (least_squares(&declared, &residual), least_squares(&all, &residual));
    let rms = |fresh: &Data, coefficients: &[f64]| {
        let (residual, _, all) = of(fresh);
        let sum: f64 = (0..residual.len())
            .map(|at| {
                let fit: f64 = coefficients.iter().zip(&all).map(|(part, column)| part * column[at]).sum();
                (residual[at] - fit).powi(2)
            })
            .sum();
        (sum / residual.len() as f64).sqrt() / SIGMA
    };
    ([rms(&fresh[0], &alone), rms(&fresh[1], &alone)], [rms(&fresh[0], &with), rms(&fresh[1], &with)])
}
