//! How often intervals of 95 % hold the truth, over many simulated calibrations and every kind of noise.
//!
//! `cargo run --release -p trueaxis-benches --bin evaluate_fit -- [PART…] [--runs N]`: the parts are `few`, `memory`, `sessions`
//! and `left-open`; N the runs of each case (default 400). The mount is simulated by the independent program of the tests.
#![allow(clippy::print_stdout)]

#[path = "../evaluate_search/rate.rs"]
#[allow(dead_code)]
mod rate;
mod scanner;

use fit::{FitOptions, fit};
use model_core::Chain;
use observe::{Measure, Observations, Series};
use rate::Rate;
use rayon::prelude::*;
use testkit::mount::{ARCSEC, Measured, NAMES, Noise, Poses, SIGMA, measured};

/// Why there is no figure.
pub type Failure = Box<dyn std::error::Error + Send + Sync>;

const MOUNT: &str = include_str!("../../../../examples/alt-azimuth/alt-azimuth.chain");

/// Errors of the mount, rad.
const ERRORS: f64 = 60.0 * ARCSEC;

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let (mut named, mut runs) = (Vec::new(), 400);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--runs" => runs = arguments.next().ok_or("--runs needs a number")?.parse()?,
            _ => named.push(argument),
        }
    }
    println!("| case | coverage of 95 % intervals (of all estimates) | fits that failed | runs |");
    println!("|---|---|---|---|");
    let wanted = |part: &str| named.is_empty() || named.iter().any(|own| own == part);
    if wanted("few") {
        for rows in [5, 6, 8, 10, 15, 30, 80] {
            case(&format!("alt-azimuth, {rows} rows"), runs, false, None, &|seed| {
                measured(rows, Poses::Random, Noise::White, ERRORS, seed)
            })?;
        }
        for rows in [4, 6] {
            case(&format!("alt-azimuth, {rows} rows, noise stated"), runs, false, Some(SIGMA), &|seed| {
                measured(rows, Poses::Random, Noise::White, ERRORS, seed)
            })?;
        }
    }
    if wanted("memory") {
        for noise in [
            Noise::White,
            Noise::Autoregressive(0.5),
            Noise::Autoregressive(0.9),
            Noise::RandomWalk(0.1),
            Noise::RandomWalk(1.0),
        ] {
            for declared in [false, true] {
                let order = if declared { "order declared" } else { "undeclared" };
                case(
                    &format!("trajectory of 250 rows, {noise:?}, {order}"),
                    runs,
                    declared,
                    None,
                    &|seed| measured(250, Poses::Trajectory, noise, ERRORS, seed),
                )?;
            }
        }
    }
    if wanted("sessions") {
        for (sessions, size) in [(6, 1.0), (8, 1.0), (12, 1.0), (30, 1.0), (60, 1.0), (12, 0.0)] {
            let noise = Noise::Sessions(sessions, size);
            case(
                &format!("{sessions} sessions of 20 rows, offsets of {size} σ"),
                runs,
                true,
                None,
                &|seed| measured(20 * sessions, Poses::Random, noise, ERRORS, seed),
            )?;
        }
    }
    if wanted("left-open") {
        for (observable, errors) in
            [("pointing", 20.0), ("pointing", 100.0), ("pointing", 400.0), ("position", 400.0)]
        {
            let rate = scanner::coverage(observable, errors * ARCSEC, runs / 4)?;
            println!(
                "| scanner, {observable}, errors of {errors}″, combinations | {rate} | | {} |",
                runs / 4
            );
        }
    }
    Ok(())
}

/// Prints the figure of one case.
fn case(
    words: &str,
    runs: usize,
    declared: bool,
    stated: Option<f64>,
    simulate: &(dyn Fn(u64) -> Measured + Sync),
) -> Result<(), Failure> {
    let chain = Chain::from_text(MOUNT).map_err(|mistakes| mistakes.render("mount", MOUNT))?;
    let mut options = FitOptions::for_chain(&chain);
    options.noise.stated = stated;
    let one = |seed: u64| -> Result<Vec<Option<bool>>, Failure> {
        let measured = simulate(seed);
        let result = fit(&chain, &observations(&chain, &measured, declared)?, &options)?;
        let hits = NAMES.iter().zip(measured.truth).map(|(name, truth)| {
            let id = chain.find_symbol(name)?;
            let usable = result.outcome.is_usable();
            let reach = result.half_width(id, 0.95).filter(|_| usable)?;
            Some((result.values[id.index()] - truth).abs() <= reach)
        });
        Ok(hits.collect())
    };
    let hits = (0..runs as u64).into_par_iter().map(one).collect::<Result<Vec<_>, _>>()?.concat();
    let failed = Rate::of(hits.iter().map(Option::is_none));
    // Six intervals of a run hang together: the interval is that of the runs.
    let held = Rate::of(hits.iter().flatten().copied());
    let by_runs = Rate { hits: (held.share() * runs as f64) as usize, runs };
    println!(
        "| {words} | {:.3} ± {:.3} | {:.3} | {runs} |",
        held.share(),
        by_runs.half_width(),
        failed.share()
    );
    Ok(())
}

fn observations(chain: &Chain, measured: &Measured, declared: bool) -> Result<Observations, Failure> {
    let rows = measured.direction.len();
    let mut columns = vec![
        (chain.find_symbol("azimuth").ok_or("no azimuth")?, measured.azimuth.clone()),
        (chain.find_symbol("elevation").ok_or("no elevation")?, measured.elevation.clone()),
    ];
    columns.sort_by_key(|(id, _)| *id);
    let sessions = measured.session.last().map_or(0, |last| *last as usize + 1);
    Ok(Observations {
        poses: observe::Poses {
            series: vec![Series {
                observable: chain.find_observable("sight").ok_or("no sight")?,
                measure: Measure::Direction,
                rows: 0..rows,
                source: "simulated".to_owned(),
            }],
            columns,
        },
        measured: measured.direction.iter().map(|u| observe::Measured::Direction((*u).into())).collect(),
        groups: if declared { measured.session.clone() } else { (0..rows as u32).collect() },
        in_sequence: declared && sessions == rows,
        row_numbers: (1..=rows as u64).collect(),
        ..Observations::default()
    })
}
