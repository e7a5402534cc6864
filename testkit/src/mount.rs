//! An alt-azimuth mount simulated without a line of what is tested: rotations, and noise of every kind on the tangent plane.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

use crate::turned;

/// One second of arc, rad.
pub const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;

/// Standard deviation of the noise of each component, rad.
pub const SIGMA: f64 = 2.0 * ARCSEC;

/// The errors of the mount in the order that the chain declares them.
pub const NAMES: [&str; 6] =
    ["tilt_east", "tilt_north", "azimuth_index", "nonperpendicularity", "elevation_index", "collimation"];

/// What the noise of rows has to do with that of others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Noise {
    /// Nothing.
    White,
    /// It remembers this share of the row before.
    Autoregressive(f64),
    /// White noise, and a random walk with steps of this share of it.
    RandomWalk(f64),
    /// So many sessions, each in its own band of azimuth, share an offset as large as so many times the noise of a row.
    Sessions(usize, f64),
}

/// Poses in the order of acquisition.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Poses {
    /// Anywhere.
    Random,
    /// Along a slow path.
    Trajectory,
}

/// What was measured.
#[derive(Debug, Clone)]
pub struct Measured {
    /// Readings, rad.
    pub azimuth: Vec<f64>,
    /// Readings, rad.
    pub elevation: Vec<f64>,
    /// Unit vectors.
    pub direction: Vec<[f64; 3]>,
    /// Of each row.
    pub session: Vec<u32>,
    /// The errors as they are, rad.
    pub truth: [f64; 6],
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

/// Where the mount points.
fn sight(errors: [f64; 6], azimuth: f64, elevation: f64) -> [f64; 3] {
    let [tilt_east, tilt_north, azimuth_index, nonperpendicularity, elevation_index, collimation] = errors;
    let (x, y, z) = (0, 1, 2);
    // From the sight back to the ground.
    [
        (z, collimation),
        (x, elevation_index),
        (x, elevation),
        (y, nonperpendicularity),
        (z, -azimuth_index),
        (z, -azimuth),
        (y, tilt_north),
        (x, tilt_east),
    ]
    .into_iter()
    .fold([0.0, 1.0, 0.0], |v, (axis, angle)| turned(axis, angle, v))
}

/// So many rows with errors of so many rad.
#[must_use]
pub fn measured(rows: usize, poses: Poses, noise: Noise, errors_rad: f64, seed: u64) -> Measured {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = move || -> f64 { random.sample(StandardNormal) };
    let truth = [(); 6].map(|()| errors_rad * normal());
    let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x5eed);
    let sessions = if let Noise::Sessions(count, _) = noise { count } else { rows };
    let phase: f64 = random.random_range(0.0..6.0);
    let mut out = Measured {
        azimuth: Vec::new(),
        elevation: Vec::new(),
        direction: Vec::new(),
        session: (0..rows).map(|row| (row * sessions / rows.max(1)) as u32).collect(),
        truth,
    };
    for row in 0..rows {
        let share = row as f64 / rows as f64;
        let (azimuth, elevation) = match (poses, noise) {
            (_, Noise::Sessions(count, _)) => {
                let band = 6.2 / count as f64;
                let own = f64::from(out.session[row]);
                (-3.1 + band * (own + random.random_range(0.0..1.0)), random.random_range(0.2..1.3))
            }
            (Poses::Random, _) => (random.random_range(-3.1..3.1), random.random_range(0.2..1.3)),
            (Poses::Trajectory, _) => {
                (3.0 * (5.0 * share + phase).sin(), 0.75 + 0.5 * (13.0 * share + 2.0 * phase).sin())
            }
        };
        out.azimuth.push(azimuth);
        out.elevation.push(elevation);
    }
    let offsets: Vec<[f64; 2]> = (0..sessions).map(|_| [normal(), normal()]).collect();
    let mut state = [normal(), normal()];
    if matches!(noise, Noise::RandomWalk(_)) {
        state = [0.0; 2];
    }
    for row in 0..rows {
        let fresh = [normal(), normal()];
        let own = match noise {
            Noise::White => fresh,
            Noise::Autoregressive(memory) => {
                state = [0, 1].map(|at| memory * state[at] + (1.0 - memory * memory).sqrt() * fresh[at]);
                state
            }
            Noise::RandomWalk(step) => {
                state = [0, 1].map(|at| state[at] + step * normal());
                [0, 1].map(|at| state[at] + fresh[at])
            }
            Noise::Sessions(_, size) => {
                let offset = offsets[out.session[row] as usize];
                [0, 1].map(|at| fresh[at] + size * offset[at])
            }
        };
        let u = sight(truth, out.azimuth[row], out.elevation[row]);
        let horizontal = u[0].hypot(u[1]);
        let across = [u[1] / horizontal, -u[0] / horizontal, 0.0];
        let along = [-u[0] * u[2] / horizontal, -u[1] * u[2] / horizontal, horizontal];
        let moved = [0, 1, 2].map(|k| u[k] + SIGMA * (own[0] * across[k] + own[1] * along[k]));
        out.direction.push(unit(moved));
    }
    out
}
