//! Cases in the whitened linear problem: independent noise of unknown size, columns that do not change between runs.

use std::time::{Duration, Instant};

use calibration::search::{AS_GOOD, Options, SetId, competing_models, select};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

use crate::design::{Design, Failure, Poses};
use crate::rate::{Line, Rate, Target};

/// What one search made of one simulated residual.
struct Outcome {
    /// Something was found, or would have been but for the held-out folds.
    alarm: bool,
    accepted: usize,
    /// The first effect is of the planted set.
    right: bool,
    /// Every planted set is among the accepted ones.
    all: bool,
    /// The planted set is the first or one of its competing models, and how many those are.
    covered: bool,
    competing: usize,
}

/// Searches a residual with effects of these ratios planted, all of different confounded sets.
fn search(design: &Design, ratios: &[f64], seed: u64) -> Result<Outcome, Failure> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let n = design.problem.rows().nrows();
    let mut residual: Vec<f64> = (0..n).map(|_| StandardNormal.sample(&mut random)).collect();
    let mut planted: Vec<SetId> = Vec::new();
    while planted.len() < ratios.len() {
        let (set, member) = design.draw(&mut random);
        if planted.contains(&set) {
            continue;
        }
        let (_, effect) = design.amplitudes(member, ratios[planted.len()], &mut random);
        residual.iter_mut().zip(&effect).for_each(|(r, e)| *r += e);
        planted.push(set);
    }
    let problem = design.problem.with_residual(&residual)?;
    let options = Options { seed: random.random(), ..Options::default() };
    let found = select(&problem, &design.sets, &[], |_| true, &options);
    let accepted: Vec<SetId> = found.accepted.iter().map(|a| a.set).collect();
    let near = competing_models(&problem, &design.sets, &accepted, &found.state, AS_GOOD);
    let first = accepted.first().copied();
    let near: Vec<SetId> = near.first().into_iter().flatten().map(|other| other.set).collect();
    let either: Vec<SetId> = first.into_iter().chain(near).collect();
    Ok(Outcome {
        alarm: found.remaining_p <= options.false_alarm || !accepted.is_empty(),
        accepted: accepted.len(),
        right: first.is_some() && first == planted.first().copied(),
        all: planted.iter().all(|set| accepted.contains(set)),
        covered: planted.first().is_some_and(|set| either.contains(set)),
        competing: either.len(),
    })
}

fn searches(
    design: &Design,
    ratios: &[f64],
    runs: usize,
    seed: u64,
) -> Result<(Vec<Outcome>, Duration), Failure> {
    let start = Instant::now();
    let outcomes = (0..runs as u64)
        .into_par_iter()
        .map(|run| search(design, ratios, seed + run))
        .collect::<Result<Vec<_>, _>>()?;
    Ok((outcomes, start.elapsed()))
}

fn line(what: String, target: Target, rate: Rate, seed: u64, took: Duration) -> Line {
    let (value, shown) = (rate.share(), rate.to_string());
    Line { what, through: "linear", target, value, shown, runs: rate.runs, seed, took }
}

/// Nothing planted.
pub fn false_positives(runs: usize) -> Result<Vec<Line>, Failure> {
    let mut lines = Vec::new();
    for (rows, seed) in [(200, 100_000), (1000, 200_000), (5000, 300_000)] {
        let design = Design::new(rows, Poses::Random(1.0), seed)?;
        let (outcomes, took) = searches(&design, &[], runs, seed)?;
        let alarm = Rate::of(outcomes.iter().map(|o| o.alarm));
        let found = Rate::of(outcomes.iter().map(|o| o.accepted > 0));
        let what = format!("false alarms of the test, nothing planted, N = {rows}");
        lines.push(line(what, Target::Within(0.05, 0.015), alarm, seed, took));
        let what = format!("effects accepted (test and held-out folds), nothing planted, N = {rows}");
        lines.push(line(what, Target::AtMost(0.065), found, seed, took));
    }
    Ok(lines)
}

/// One effect planted; the sets of competing models over all of these cases together.
pub fn one_effect(runs: usize) -> Result<Vec<Line>, Failure> {
    let mut lines = Vec::new();
    let (mut covered, mut sizes, mut all_took) = (Vec::new(), Vec::new(), Duration::ZERO);
    for (rows, snr, least, seed) in [
        (200, 0.2, 0.55, 400_000),
        (200, 0.3, 0.87, 410_000),
        (200, 0.5, 0.94, 420_000),
        (1000, 0.1, 0.65, 430_000),
        (1000, 0.2, 0.93, 440_000),
        (5000, 1.0, 0.99, 450_000),
    ] {
        let design = Design::new(rows, Poses::Random(1.0), seed)?;
        let (outcomes, took) = searches(&design, &[snr], runs, seed)?;
        let right = Rate::of(outcomes.iter().map(|o| o.right));
        lines.push(line(
            format!("right set, one effect, N = {rows}, SNR {snr}"),
            Target::AtLeast(least),
            right,
            seed,
            took,
        ));
        let alone = Rate::of(outcomes.iter().map(|o| o.right && o.accepted == 1));
        lines.push(line(
            format!("… and nothing beside it, N = {rows}, SNR {snr}"),
            Target::None,
            alone,
            seed,
            took,
        ));
        let found = outcomes.iter().filter(|o| o.accepted > 0);
        found.for_each(|o| {
            covered.push(o.covered);
            sizes.push(o.competing as f64);
        });
        all_took += took;
    }
    let rate = Rate::of(covered);
    let what = "the set of competing models covers the truth, where anything was found".to_owned();
    lines.push(line(what, Target::AtLeast(0.95), rate, 400_000, all_took));
    let mean = sizes.iter().sum::<f64>() / sizes.len().max(1) as f64;
    lines.push(Line {
        what: "mean size of the set of competing models, sets".to_owned(),
        through: "linear",
        target: Target::AtMost(2.0),
        value: mean,
        shown: format!("{mean:.2}"),
        runs: sizes.len(),
        seed: 400_000,
        took: all_took,
    });
    Ok(lines)
}

/// Two effects at once.
pub fn two_effects(runs: usize) -> Result<Vec<Line>, Failure> {
    let seed = 500_000;
    let design = Design::new(300, Poses::Random(1.0), seed)?;
    let (outcomes, took) = searches(&design, &[1.0, 0.2], runs, seed)?;
    let both = Rate::of(outcomes.iter().map(|o| o.all));
    let what = "both of two effects, SNR 1 and 0.2, N = 300".to_owned();
    Ok(vec![line(what, Target::AtLeast(0.75), both, seed, took)])
}

/// The time of one search, one effect to find, the least of several.
pub fn time(runs: usize) -> Result<Vec<Line>, Failure> {
    let seed = 600_000;
    let design = Design::new(5000, Poses::Random(1.0), seed)?;
    let start = Instant::now();
    let mut least = f64::INFINITY;
    for run in 0..runs as u64 {
        let mut random = ChaCha8Rng::seed_from_u64(seed + run);
        let n = design.problem.rows().nrows();
        let mut residual: Vec<f64> = (0..n).map(|_| StandardNormal.sample(&mut random)).collect();
        let (_, member) = design.draw(&mut random);
        let (_, effect) = design.amplitudes(member, 0.1, &mut random);
        residual.iter_mut().zip(&effect).for_each(|(r, e)| *r += e);
        let problem = design.problem.with_residual(&residual)?;
        let begun = Instant::now();
        std::hint::black_box(select(&problem, &design.sets, &[], |_| true, &Options::default()));
        least = least.min(begun.elapsed().as_secs_f64());
    }
    Ok(vec![Line {
        what: format!(
            "seconds for one search, {} candidates, N = 5000, 999 flips",
            design.problem.candidates().len()
        ),
        through: "linear",
        target: Target::AtMost(0.1),
        value: least,
        shown: format!("{least:.3}"),
        runs,
        seed,
        took: start.elapsed(),
    }])
}
