//! The fit: a million rows of 30 errors streamed, a thousand rows at once, and SciPy's `least_squares` and Ceres on the
//! same data; and the sum of many rows of many columns beside a plain QR.
//!
//! `cargo bench -p trueaxis-benches --bench fit`; with `TRUEAXIS_PYTHON` naming a Python that has SciPy (and pyceres, for
//! Ceres), the comparison runs too (`peer.py`). Times are the least of several runs; processor time, which other
//! programs' turns do not lengthen, is the mean.
#![allow(clippy::print_stdout, clippy::unwrap_used)]

use std::io::Write as _;
use std::process::{Command, Stdio};
use std::time::Instant;

use faer::Mat;
use fit::{FitOptions, Next, Partial, Rows, Streamed, StreamedResult, fit};
use model_core::{Chain, SymbolId, SymbolKind, exact};
use observe::{Grouping, Measure, Measured, Observations, Origins, Poses, Series, direction_from_offset};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;
const LIDAR: &str = include_str!("../../../examples/mobile-lidar/mobile-lidar.chain");
const MOUNT: &str = include_str!("../../../examples/alt-azimuth/alt-azimuth.chain");

/// Directions of a chain with errors of 20″ at even poses, noise 2″.
fn simulate(chain: &Chain, observable: &str, joints: &[(&str, f64, f64)], rows: usize) -> Observations {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut values = chain.nominal_values();
    for id in chain.symbols_of(SymbolKind::Error) {
        let normal: f64 = StandardNormal.sample(&mut rng);
        values[id.index()] = 20.0 * ARCSEC * normal;
    }
    let mut columns: Vec<(SymbolId, Vec<f64>)> = joints
        .iter()
        .map(|&(name, low, high)| {
            let column = (0..rows).map(|_| rng.random_range(low..high)).collect();
            (chain.find_symbol(name).unwrap(), column)
        })
        .collect();
    columns.sort_by_key(|(id, _)| *id);
    let observable = chain.find_observable(observable).unwrap();
    let path = exact::Path::new(chain, observable);
    let measured = (0..rows)
        .map(|row| {
            for (id, column) in &columns {
                values[id.index()] = column[row];
            }
            let [across, along]: [f64; 2] =
                [StandardNormal.sample(&mut rng), StandardNormal.sample(&mut rng)];
            let truth = path.value(&values);
            Measured::Direction(direction_from_offset(&truth, 2.0 * ARCSEC * across, 2.0 * ARCSEC * along))
        })
        .collect();
    let source = "simulated".to_string();
    Observations {
        poses: Poses {
            series: vec![Series { observable, measure: Measure::Direction, rows: 0..rows, source }],
            columns,
        },
        measured,
        reading_sigma: Vec::new(),
        reading_correlation: Vec::new(),
        sigma: Vec::new(),
        groups: (0..).take(rows).collect(),
        together: Vec::new(),
        targets: Vec::new(),
        grouping: Grouping::Declared,
        converted: Default::default(),
        crossed: Vec::new(),
        in_sequence: false,
        row_numbers: (1..).take(rows).collect(),
        origins: Origins::default(),
        unknowns: None,
    }
}

/// Seconds that took.
struct Cost {
    wall: f64,
    processor: f64,
}

impl std::fmt::Display for Cost {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.2} ms ({:.2} ms of processors)", 1e3 * self.wall, 1e3 * self.processor)
    }
}

/// The least time of several runs, and the mean processor time of all threads.
fn least<T>(runs: u32, mut f: impl FnMut() -> T) -> (Cost, T) {
    let mut best: Option<(f64, T)> = None;
    let before = processor_s();
    for _ in 0..runs {
        let start = Instant::now();
        let result = f();
        let wall = start.elapsed().as_secs_f64();
        if best.as_ref().is_none_or(|(least, _)| wall < *least) {
            best = Some((wall, result));
        }
    }
    let (wall, result) = best.unwrap();
    (Cost { wall, processor: (processor_s() - before) / f64::from(runs) }, result)
}

/// Processor time of this process so far, to a hundredth of a second; 0 where the system does not say.
fn processor_s() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // After the name, which may hold spaces: the 12th and 13th fields, in hundredths.
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace().skip(11).take(2);
    fields.filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>() / 100.0
}

fn streamed(chain: &Chain, chunks: &[Observations], options: &FitOptions) -> StreamedResult {
    let mut state = Streamed::from_sample(chain, &chunks[0], options).unwrap();
    loop {
        let whole = chunks.iter().fold(state.pass.empty(), |whole, chunk| {
            whole.merge(&state.pass.accumulate(chunk).unwrap()).unwrap()
        });
        match state.next(&[whole]).unwrap() {
            Next::Pass(next) => state = *next,
            Next::Done(result) => return *result,
        }
    }
}

/// A peer on the same rows: its cost and its estimates; `None` if this Python does not have it.
fn peer(python: &str, name: &str, observations: &Observations) -> Option<(Cost, Vec<f64>)> {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/fit/peer.py");
    let mut child = Command::new(python)
        .args([script, name])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut text = String::new();
    for (row, measured) in observations.measured.iter().enumerate() {
        let u = measured.vector().unwrap();
        let q: Vec<f64> = observations.poses.columns.iter().map(|(_, column)| column[row]).collect();
        text += &format!("{:e},{:e},{:e},{:e},{:e}\n", q[0], q[1], u[0], u[1], u[2]);
    }
    child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    let numbers: Vec<f64> = String::from_utf8_lossy(&output.stdout)
        .split_whitespace()
        .map(|word| word.parse().unwrap())
        .collect();
    let (&[wall, processor], estimates) = numbers.split_first_chunk()?;
    Some((Cost { wall, processor }, estimates.to_vec()))
}

/// Rows of 150 columns into a packed factor, block by block, beside faer's QR of all rows at once; one thread each.
fn accumulate() {
    const ROWS: usize = 200_000;
    const COLUMNS: usize = 150;
    const BLOCK: usize = 1024;
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let rows = Mat::from_fn(ROWS, COLUMNS, |_, _| StandardNormal.sample(&mut rng));
    let blocks: Vec<Rows> = (0..ROWS)
        .step_by(BLOCK)
        .map(|start| {
            let part = rows.subrows(start, BLOCK.min(ROWS - start));
            let mut block = Rows::zeros(part.nrows(), COLUMNS);
            for (to, from) in block.columns_mut().zip(part.col_iter()) {
                to.iter_mut().zip(from.iter()).for_each(|(to, from)| *to = *from);
            }
            block
        })
        .collect();
    let sum = || blocks.iter().cloned().fold(Partial::new(COLUMNS - 1), Partial::with);
    let (ours, partial) = least(5, sum);
    let (theirs, factor) = least(5, || rows.qr().thin_R().to_owned());
    let ours_factor = partial.factor();
    let largest = (0..COLUMNS)
        .flat_map(|j| (0..=j).map(move |i| (i, j)))
        .map(|(i, j)| (ours_factor[(i, j)].abs() - factor[(i, j)].abs()).abs())
        .fold(0.0, f64::max);
    println!(
        "{ROWS} rows × {COLUMNS} columns accumulated: {ours}; a plain QR by faer: {theirs}, {:.2} times as long (factors differ by at \
         most {:.0e} of their largest)",
        theirs.wall / ours.wall,
        largest / factor.norm_max(),
    );
}

fn main() {
    accumulate();
    let lidar = Chain::from_text(LIDAR).unwrap();
    let joints = [("alpha", -3.1, 3.1), ("beta", -3.1, 3.1), ("gamma", -3.1, 3.1)];
    let few = simulate(&lidar, "pointing", &joints, 1000);
    let options = FitOptions::for_chain(&lidar);
    let (time, result) = least(50, || fit(&lidar, &few, &options).unwrap());
    println!("1,000 rows × 30 errors, robust, noise learned: {time} ({:?})", result.outcome);

    let many = simulate(&lidar, "pointing", &joints, 1_000_000);
    let (time, result) = least(3, || fit(&lidar, &many, &options).unwrap());
    println!(
        "1,000,000 rows × 30 errors, all in memory, robust, noise learned: {time} ({:?})",
        result.outcome
    );
    let rows: Vec<usize> = (0..1_000_000).collect();
    let chunks: Vec<Observations> = rows.chunks(20_000).map(|rows| many.select(rows)).collect();
    for robust in [false, true] {
        let options = FitOptions { robust, ..options.clone() };
        let (time, result) = least(3, || streamed(&lidar, &chunks, &options));
        println!("1,000,000 rows × 30 errors, streamed, robust {robust}: {time} in {} passes", result.passes);
    }

    let Some(python) = std::env::var("TRUEAXIS_PYTHON").ok() else {
        println!("SciPy: skipped; set TRUEAXIS_PYTHON to a Python that has it");
        return;
    };
    let mount = Chain::from_text(MOUNT).unwrap();
    for rows in [1000, 100_000] {
        let joints = [("azimuth", -3.1, 3.1), ("elevation", 0.2, 1.3)];
        let observations = simulate(&mount, "sight", &joints, rows);
        let mut options = FitOptions::for_chain(&mount);
        options.robust = false;
        options.noise.sigma = Some(2.0 * ARCSEC);
        let runs = if rows > 1000 { 20 } else { 500 };
        let (time, result) = least(runs, || fit(&mount, &observations, &options).unwrap());
        println!("{rows} rows × 6 errors: {time} ({:?})", result.outcome);
        for name in ["scipy", "ceres"] {
            let Some((theirs, estimates)) = peer(&python, name, &observations) else {
                println!("  {name}: not there");
                continue;
            };
            let worst =
                result.parameters.iter().zip(&estimates).enumerate().map(|(at, (parameter, theirs))| {
                    (result.values[parameter.index()] - theirs).abs() / result.covariance[(at, at)].sqrt()
                });
            println!(
                "  {name}: {theirs}, {:.0} times as long ({:.0} times the processors); estimates differ by at most {:.1e} \
                 standard uncertainties",
                theirs.wall / time.wall,
                theirs.processor / time.processor,
                worst.fold(0.0, f64::max),
            );
        }
    }
}
