//! A two-axis instrument whose columns are written down, with one effect and some noise.

use evidence::Problem;
use evidence::problem::{Declared, Frame, Freedom, Joint, Place, Rows};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// What is simulated, in units of the noise.
#[derive(Debug, Clone, Copy)]
pub struct Plan {
    pub rows: usize,
    pub seed: u64,
    /// Size of a harmonic of azimuth about the azimuth axis.
    pub amplitude: f64,
    pub order: f64,
    /// Part of the rows that are thirty times as far off.
    pub outliers: f64,
    /// Tilt of the base from the middle of the rows on.
    pub moved: f64,
}

impl Default for Plan {
    fn default() -> Self {
        Self { rows: 80, seed: 1, amplitude: 0.0, order: 1.0, outliers: 0.0, moved: 0.0 }
    }
}

/// Sideways and upward change of a direction by a rotation about x, y or z of the base or of the tube.
fn column(azimuth: &[f64], elevation: &[f64], place: usize) -> Vec<f64> {
    azimuth
        .iter()
        .zip(elevation)
        .flat_map(|(a, e)| match place {
            0 => [-a.sin() * e.sin(), a.cos()],
            1 => [a.cos() * e.sin(), a.sin()],
            2 => [e.cos(), 0.0],
            3 => [0.0, 1.0],
            4 => [e.sin(), 0.0],
            _ => [1.0, 0.0],
        })
        .collect()
}

/// The problem of a plan.
pub fn problem(plan: &Plan) -> Problem {
    let mut random = ChaCha8Rng::seed_from_u64(plan.seed);
    let azimuth: Vec<f64> = (0..plan.rows).map(|_| random.random_range(-3.1..3.1)).collect();
    let elevation: Vec<f64> = (0..plan.rows).map(|_| random.random_range(0.2..1.3)).collect();
    let columns: Vec<Vec<f64>> = (0..6).map(|place| column(&azimuth, &elevation, place)).collect();
    let mut residual = vec![0.0; 2 * plan.rows];
    for (row, angle) in azimuth.iter().enumerate() {
        let far = if random.random::<f64>() < plan.outliers { 30.0 } else { 1.0 };
        let effect = plan.amplitude * (plan.order * angle + 0.7).cos();
        let tilt = if 2 * row >= plan.rows { plan.moved } else { 0.0 };
        for at in 2 * row..2 * row + 2 {
            let noise: f64 = StandardNormal.sample(&mut random);
            residual[at] = columns[2][at] * effect + columns[0][at] * tilt + far * noise;
        }
    }
    let names = ["base.Rx", "base.Ry", "base.Rz", "tube.Rx", "tube.Ry", "tube.Rz"];
    let places = names.iter().zip(&columns).enumerate().map(|(number, (name, column))| Place {
        name: (*name).into(),
        frame: number / 3,
        freedom: Freedom::Rotation((number % 3) as u8),
        own: [None, None, Some(0), Some(1), None, None][number],
        beside: vec![number / 3],
        column: column.clone(),
        nominal: None,
        gravity: None,
        loads: Vec::new(),
    });
    let joint = |name: &str, values: &[f64], from_horizon| Joint {
        name: name.into(),
        values: values.to_vec(),
        direction: None,
        from_horizon,
    };
    Problem {
        rows: Rows {
            count: plan.rows,
            joints: vec![joint("azimuth", &azimuth, false), joint("elevation", &elevation, true)],
            inputs: Vec::new(),
            labels: None,
            in_order: true,
            given: Vec::new(),
        },
        components: 2,
        residual,
        sigma: None,
        declared: [("azimuth_index", 2), ("elevation_index", 3), ("tilt_x", 0), ("tilt_y", 1)]
            .map(|(name, at)| Declared { name: name.into(), estimate: 0.0, column: columns[at].clone() })
            .to_vec(),
        frames: vec![
            Frame { name: "base".into(), tilts: Some([0, 1]), whirl: Some((0, [0, 1])) },
            Frame { name: "tube".into(), tilts: Some([3, 4]), whirl: None },
        ],
        places: places.collect(),
        offered: Vec::new(),
    }
}
