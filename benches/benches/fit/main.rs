//! The fit: a million rows of 30 errors streamed, a thousand rows at once, and SciPy's `least_squares` on the same data.
//!
//! `cargo bench -p trueaxis-benches --bench fit`; with `TRUEAXIS_PYTHON` naming a Python that has SciPy, the comparison
//! runs too (`peer.py`). Times are the least of several runs.
#![allow(clippy::print_stdout, clippy::unwrap_used)]

use std::io::Write as _;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use calibration::fit::{FitOptions, Next, Streamed, StreamedResult, fit};
use calibration::observations::{Measure, Observations, Series, direction_from_offset};
use model_core::{Chain, SymbolId, SymbolKind, exact};
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
            direction_from_offset(&truth, 2.0 * ARCSEC * across, 2.0 * ARCSEC * along).into()
        })
        .collect();
    let source = "simulated".to_string();
    Observations {
        series: vec![Series { observable, measure: Measure::Direction, rows: 0..rows, source }],
        columns,
        measured,
        sigma: Vec::new(),
        groups: (0..).take(rows).collect(),
        in_sequence: false,
        row_numbers: (1..).take(rows).collect(),
    }
}

/// The least time of several runs.
fn least<T>(runs: usize, mut f: impl FnMut() -> T) -> (Duration, T) {
    let mut best: Option<(Duration, T)> = None;
    for _ in 0..runs {
        let start = Instant::now();
        let result = f();
        let time = start.elapsed();
        if best.as_ref().is_none_or(|(least, _)| time < *least) {
            best = Some((time, result));
        }
    }
    best.unwrap()
}

fn streamed(chain: &Chain, chunks: &[Observations], options: &FitOptions) -> StreamedResult {
    let mut state = Streamed::from_sample(chain, &chunks[0], options).unwrap();
    loop {
        let whole = chunks
            .iter()
            .fold(state.pass.empty(), |whole, chunk| whole.merge(&state.pass.accumulate(chunk).unwrap()));
        match state.next(&whole) {
            Next::Pass(next) => state = *next,
            Next::Done(result) => return *result,
        }
    }
}

/// SciPy on the same rows: seconds, estimates, and standard uncertainties.
fn scipy(python: &str, observations: &Observations) -> (f64, Vec<f64>) {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/fit/peer.py");
    let mut child =
        Command::new(python).arg(script).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let mut text = String::new();
    for (row, u) in observations.measured.iter().enumerate() {
        let q: Vec<f64> = observations.columns.iter().map(|(_, column)| column[row]).collect();
        text += &format!("{:e},{:e},{:e},{:e},{:e}\n", q[0], q[1], u[0], u[1], u[2]);
    }
    child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    let numbers: Vec<f64> = String::from_utf8_lossy(&output.stdout)
        .split_whitespace()
        .map(|word| word.parse().unwrap())
        .collect();
    (numbers[0], numbers[1..].to_vec())
}

fn main() {
    let lidar = Chain::from_text(LIDAR).unwrap();
    let joints = [("alpha", -3.1, 3.1), ("beta", -3.1, 3.1), ("gamma", -3.1, 3.1)];
    let few = simulate(&lidar, "pointing", &joints, 1000);
    let options = FitOptions::for_chain(&lidar);
    let (time, result) = least(10, || fit(&lidar, &few, &options).unwrap());
    println!("1,000 rows × 30 errors, robust, noise learned: {time:.1?} ({:?})", result.outcome);

    let many = simulate(&lidar, "pointing", &joints, 1_000_000);
    let rows: Vec<usize> = (0..1_000_000).collect();
    let chunks: Vec<Observations> = rows.chunks(20_000).map(|rows| many.select(rows)).collect();
    for robust in [false, true] {
        let options = FitOptions { robust, ..options.clone() };
        let (time, result) = least(3, || streamed(&lidar, &chunks, &options));
        println!(
            "1,000,000 rows × 30 errors, streamed, robust {robust}: {time:.2?} in {} passes",
            result.passes
        );
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
        let (time, result) = least(10, || fit(&mount, &observations, &options).unwrap());
        let (seconds, estimates) = scipy(&python, &observations);
        let worst = result.parameters.iter().zip(&estimates).enumerate().map(|(at, (parameter, theirs))| {
            (result.values[parameter.index()] - theirs).abs() / result.covariance[(at, at)].sqrt()
        });
        let names: Vec<&str> = result.parameters.iter().map(|&id| mount.symbol(id).name.as_str()).collect();
        println!(
            "{rows} rows × 6 errors: {time:.2?}; SciPy {:.2?}, {:.0} times as long; estimates of {} differ by at most {:.1e} \
             standard uncertainties",
            Duration::from_secs_f64(seconds),
            seconds / time.as_secs_f64(),
            names.join(", "),
            worst.fold(0.0, f64::max),
        );
    }
}
