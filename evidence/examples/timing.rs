//! How long a contest takes: `timing JOINTS ROWS AMPLITUDE REPEATS` on a chain with random columns.
//!
//! Two joints give the dictionary of a short chain, six that of an arm. The amplitude is that of one harmonic, in units
//! of the noise. Prints the number of families and the seconds of each contest.
#![allow(clippy::print_stdout)]

use std::time::Instant;

use evidence::problem::{Declared, Frame, Freedom, Joint, Load, Place, Problem, Rows};
use evidence::{Policy, contest};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let numbers: Vec<f64> = std::env::args().skip(1).map(|word| word.parse()).collect::<Result<_, _>>()?;
    let [joints, rows, amplitude, repeats] = numbers.as_slice() else {
        return Err("timing JOINTS ROWS AMPLITUDE REPEATS".into());
    };
    let policy = Policy::default();
    for seed in 0..*repeats as u64 {
        let problem = problem(*joints as usize, *rows as usize, *amplitude, seed);
        let started = Instant::now();
        let outcome = contest(&problem, &policy, None)?;
        let named: Vec<String> = outcome
            .findings()
            .iter()
            .filter(|found| found.named)
            .map(|found| outcome.name(found.family))
            .collect();
        println!(
            "{} families, {:.3} s, {named:?}",
            outcome.families().len(),
            started.elapsed().as_secs_f64()
        );
    }
    Ok(())
}

fn problem(joints: usize, rows: usize, amplitude: f64, seed: u64) -> Problem {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let arm = joints > 3;
    let components = if arm { 3 } else { 2 };
    let angles: Vec<Vec<f64>> =
        (0..joints).map(|_| (0..rows).map(|_| random.random_range(-2.0..2.0)).collect()).collect();
    let mut normals =
        |count: usize| -> Vec<f64> { (0..count).map(|_| StandardNormal.sample(&mut random)).collect() };
    // Columns that change slowly with the joints, as those of a chain do.
    let mut column = || -> Vec<f64> {
        let parts = normals(2 * joints * components);
        (0..rows * components)
            .map(|at| {
                let (row, own) = (at / components, at % components);
                let waves = angles.iter().enumerate().map(|(joint, angles)| {
                    let part = 2 * (joint * components + own);
                    parts[part] * angles[row].cos() + parts[part + 1] * angles[row].sin()
                });
                waves.sum()
            })
            .collect()
    };
    let mut places = Vec::new();
    for frame in 0..if arm { joints } else { 2 * joints } {
        let joint = if arm { frame } else { frame / 2 };
        for axis in 0..if arm { 6u8 } else { 3 } {
            let turns = axis < 3;
            places.push(Place {
                name: format!("frame{frame}.{axis}"),
                frame,
                freedom: if turns { Freedom::Rotation(axis) } else { Freedom::Shift(axis - 3) },
                own: (axis == 2 && (arm || frame % 2 == 0)).then_some(joint),
                beside: if arm && joint > 0 { vec![joint, joint - 1] } else { vec![joint] },
                column: column(),
                nominal: None,
                gravity: (arm && turns).then(|| [0, 1, 2].map(|_| column()[..rows].to_vec())),
                loads: if arm && axis == 2 {
                    (frame..joints)
                        .map(|body| Load { body: format!("body{body}"), torque: column()[..rows].to_vec() })
                        .collect()
                } else {
                    Vec::new()
                },
            });
        }
    }
    let frames = (0..if arm { joints } else { 2 * joints }).map(|frame| {
        let first = frame * if arm { 6 } else { 3 };
        Frame {
            name: format!("frame{frame}"),
            tilts: Some([first, first + 1]),
            whirl: Some((frame * joints / (2 * joints), [first, first + 1])),
        }
    });
    let declared = (0..if arm { 21 } else { 6 }).map(|number| Declared {
        name: format!("error{number}"),
        estimate: 0.0,
        column: column(),
    });
    let (frames, declared): (Vec<Frame>, Vec<Declared>) = (frames.collect(), declared.collect());
    let noise = normals(rows * components);
    let size = (places[2].column.iter().map(|value| value * value).sum::<f64>() / noise.len() as f64).sqrt();
    let residual = noise
        .iter()
        .enumerate()
        .map(|(at, noise)| {
            noise + amplitude * places[2].column[at] / size * (3.0 * angles[0][at / components]).cos()
        })
        .collect();
    let joint = |(number, values): (usize, &Vec<f64>)| Joint {
        name: format!("q{number}"),
        values: values.clone(),
        direction: None,
        from_horizon: false,
    };
    Problem {
        rows: Rows {
            count: rows,
            joints: angles.iter().enumerate().map(joint).collect(),
            inputs: Vec::new(),
            labels: None,
            in_order: true,
            given: Vec::new(),
        },
        components,
        residual,
        sigma: None,
        declared,
        frames,
        places,
        offered: Vec::new(),
    }
}
