//! Cases through the whole calibration: fit on the exact form, noise model, search, and what remains.

use std::f64::consts::PI;
use std::time::{Duration, Instant};

use calibration::calibrate::{Request, calibrate};
use calibration::diagnose::{Diagnosis, EffectFound, Verdict};
use effects::candidate::Effect;
use model_core::{Chain, Role, SymbolId, TransformKind};
use observe::Observations;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use study::NextPoses;

use crate::design::{Design, Failure, Poses, SIGMA_RAD, TEXT, rms};
use crate::noise::Noise;
use crate::rate::{Line, Rate, Target};

/// Standard deviation of the declared errors, in σ of the noise.
const DECLARED: f64 = 10.0;

fn calibrated(design: &Design, observations: &Observations) -> Result<Diagnosis, Failure> {
    let request = Request {
        text: TEXT,
        plan: &design.plan,
        observations,
        sample: None,
        second: None,
        when: "2026-11-21",
    };
    Ok(calibrate(request)?.diagnosis)
}

/// Values of a chain's symbols with the declared errors drawn.
fn declared(design: &Design, chain: &Chain, random: &mut ChaCha8Rng) -> Vec<f64> {
    let mut values = chain.nominal_values();
    for &id in &design.plan.fit.estimate {
        let drawn: f64 = StandardNormal.sample(random);
        values[id.index()] = DECLARED * SIGMA_RAD * drawn;
    }
    values
}

/// A line whose runs took so long.
fn line(what: String, target: Target, rate: Rate, seed: u64, took: Duration) -> Line {
    let (value, shown) = (rate.share(), rate.to_string());
    Line { what, through: "whole", target, value, shown, runs: rate.runs, seed, took }
}

/// Runs a case over seeds, in parallel.
fn runs<T: Send>(
    count: usize,
    seed: u64,
    case: impl Fn(&mut ChaCha8Rng) -> Result<T, Failure> + Sync,
) -> Result<(Vec<T>, Duration), Failure> {
    let start = Instant::now();
    let outcomes = (0..count as u64)
        .into_par_iter()
        .map(|run| case(&mut ChaCha8Rng::seed_from_u64(seed + run)))
        .collect::<Result<Vec<_>, _>>()?;
    Ok((outcomes, start.elapsed()))
}

/// Nothing planted, under noise of all kinds.
pub fn false_positives(count: usize) -> Result<Vec<Line>, Failure> {
    let mut lines = Vec::new();
    let kinds = [
        Noise::Even,
        Noise::Uneven,
        Noise::HeavyTails,
        Noise::Outliers,
        Noise::Autoregressive,
        Noise::RandomWalk,
    ];
    for (noise, seed) in kinds.into_iter().zip((700_000..).step_by(10_000)) {
        let poses = if noise.remembers() { Poses::Trajectory } else { Poses::Random(1.0) };
        let design = Design::new(1000, poses, seed)?;
        let (reports, took) = runs(count, seed, |random| {
            let sampled = noise.sample(design.readings_of("beta"), random);
            let values = declared(&design, &design.plan.chain, random);
            calibrated(
                &design,
                &design.observe(&design.readings, &design.plan.chain, values, &sampled, |_, q| q),
            )
        })?;
        let effects = Rate::of(reports.iter().map(|report| !report.effects.is_empty()));
        let anything = Rate::of(reports.iter().map(|report| report.verdict != Verdict::NothingDetectable));
        let words = noise.words();
        let what = format!("effects accepted, nothing planted, {words}, N = 1000");
        lines.push(line(what, Target::AtMost(0.08), effects, seed, took));
        let what = format!("any verdict but \"nothing detectable\", nothing planted, {words}, N = 1000");
        lines.push(line(what, Target::None, anything, seed, took));
    }
    Ok(lines)
}

/// Whether an effect goes by a name, its own or that of one confounded with it.
fn called(effect: &EffectFound, name: &str) -> bool {
    effect.names.iter().chain(&effect.confounded_with).any(|known| known == name)
}

/// An effect drawn from the catalogue in a random direction of its coefficients: itself, the chain with it, and the value of
/// every symbol.
fn planted<'a>(
    design: &'a Design,
    snr: f64,
    random: &mut ChaCha8Rng,
) -> Result<(&'a Effect, Chain, Vec<f64>), Failure> {
    let (_, member) = design.draw(random);
    let effect = &design.catalogue[member];
    let (coefficients, _) = design.amplitudes(member, snr, random);
    let (chain, errors) = effect.add_to(&design.plan.chain).ok_or("no room for the effect")?;
    let mut values = declared(design, &chain, random);
    for (error, coefficient) in errors.iter().zip(coefficients) {
        values[error.index()] = coefficient;
    }
    Ok((effect, chain, values))
}

/// One effect of the catalogue among outliers.
pub fn outliers(count: usize) -> Result<Vec<Line>, Failure> {
    let (seed, rows, snr) = (800_000, 300, 0.3);
    let design = Design::new(rows, Poses::Random(1.0), seed)?;
    let (right, took) = runs(count, seed, |random| {
        let (effect, chain, values) = planted(&design, snr, random)?;
        let sampled = Noise::Outliers.sample(design.readings_of("beta"), random);
        let report =
            calibrated(&design, &design.observe(&design.readings, &chain, values, &sampled, |_, q| q))?;
        Ok(report.effects.first().is_some_and(|found| called(found, &effect.name)))
    })?;
    let what = format!("right set, one effect, 5 % outliers, N = {rows}, SNR {snr}");
    Ok(vec![line(what, Target::AtLeast(0.88), Rate::of(right), seed, took)])
}

/// The poses that a report proposes are measured: one set is left.
pub fn next_poses(count: usize) -> Result<Vec<Line>, Failure> {
    let (seed, rows, snr, share) = (1_000_000, 300, 1.0, 0.2);
    let mut design = Design::new(rows, Poses::Random(share), seed)?;
    let chain = &design.plan.chain;
    let ranges = ["alpha", "beta", "gamma"].map(|name| (chain.find_symbol(name), -PI..PI));
    let ranges = ranges.into_iter().filter_map(|(id, range)| Some((id?, range))).collect();
    design.plan.next = Some(NextPoses { count: Some(12), ranges, places: None });
    let (left, took) = runs(count, seed, |random| {
        let (effect, chain, values) = planted(&design, snr, random)?;
        let mut sampled = Noise::Even.sample(design.readings_of("beta"), random);
        let first = design.observe(&design.readings, &chain, values.clone(), &sampled, |_, q| q);
        let report = calibrated(&design, &first)?;
        let Some(proposed) = report.separating.first().filter(|next| !next.poses.is_empty()) else {
            return Ok(None);
        };
        sampled.extend(Noise::Even.sample(&vec![0.0; proposed.poses.len()], random));
        let readings = design.and(&proposed.joints, &proposed.poses);
        let report = calibrated(&design, &design.observe(&readings, &chain, values, &sampled, |_, q| q))?;
        let one =
            report.effects.first().is_some_and(|f| called(f, &effect.name) && f.competing_with.is_empty());
        Ok(Some(one))
    })?;
    let left: Vec<bool> = left.into_iter().flatten().collect();
    let what = format!(
        "12 proposed poses leave one set, the true one; data within {:.0}°, N = {rows}, SNR {snr}, of {count} those \
         that had something to separate",
        180.0 * share
    );
    Ok(vec![line(what, Target::AtLeast(0.97), Rate::of(left), seed, took)])
}

/// The time of a whole calibration, the least of several.
pub fn time(count: usize) -> Result<Vec<Line>, Failure> {
    let seed = 1_100_000;
    let design = Design::new(5000, Poses::Random(1.0), seed)?;
    let start = Instant::now();
    let mut least = f64::INFINITY;
    for run in 0..count as u64 {
        let random = &mut ChaCha8Rng::seed_from_u64(seed + run);
        let (_, chain, values) = planted(&design, 0.2, random)?;
        let sampled = Noise::Even.sample(design.readings_of("beta"), random);
        let observations = design.observe(&design.readings, &chain, values, &sampled, |_, q| q);
        let begun = Instant::now();
        std::hint::black_box(calibrated(&design, &observations)?);
        least = least.min(begun.elapsed().as_secs_f64());
    }
    Ok(vec![Line {
        what: "seconds for a whole calibration, 10 nested folds, N = 5000".to_owned(),
        through: "whole",
        target: Target::AtMost(3.0),
        value: least,
        shown: format!("{least:.2}"),
        runs: count,
        seed,
        took: start.elapsed(),
    }])
}

/// A bump in a joint, in no catalogue: alarm, place, and false explanations.
pub fn local_defect(count: usize) -> Result<Vec<Line>, Failure> {
    let mut lines = Vec::new();
    for (snr, seed) in [(0.3, 900_000), (1.0, 910_000)] {
        let design = Design::new(1000, Poses::Random(1.0), seed)?;
        let (outcomes, took) = runs(count, seed, |random| {
            let bump = Bump::draw(&design, snr, random);
            let sampled = Noise::Even.sample(design.readings_of("beta"), random);
            let values = declared(&design, &design.plan.chain, random);
            let bent = |id: SymbolId, q: f64| if id == bump.joint { q + bump.at(q) } else { q };
            let report = calibrated(
                &design,
                &design.observe(&design.readings, &design.plan.chain, values, &sampled, bent),
            )?;
            let alarm = report.verdict != Verdict::NothingDetectable;
            let place = report.remaining.as_ref().and_then(|left| left.place.as_ref());
            let here = |driver: &str, dof: &str| (driver, dof) == (bump.driver.as_str(), bump.dof.as_str());
            let right = place.is_some_and(|place| here(&place.driver, &place.dof))
                || report.effects.iter().any(|effect| here(&effect.driver, &effect.dof));
            let explained = matches!(report.verdict, Verdict::Explained | Verdict::Confounded);
            // A bell is told as a bump, by name or among what competes with the name.
            let named = report.effects.iter().any(|effect| {
                here(&effect.driver, &effect.dof) && effect.told().any(|name| name.starts_with("bump "))
            });
            Ok((alarm, right, explained && !named))
        })?;
        let local = format!("local defect in a joint, N = 1000, SNR {snr}");
        let alarm = Rate::of(outcomes.iter().map(|o| o.0));
        let right = Rate::of(outcomes.iter().map(|o| o.1));
        let explained = Rate::of(outcomes.iter().map(|o| o.2));
        let at_most = if snr >= 1.0 { Target::AtMost(0.15) } else { Target::None };
        lines.push(line(format!("{local}: alarm"), Target::AtLeast(0.97), alarm, seed, took));
        lines.push(line(format!("{local}: right place"), Target::AtLeast(0.92), right, seed, took));
        lines.push(line(format!("{local}: falsely explained"), at_most, explained, seed, took));
    }
    Ok(lines)
}

/// A bump in what one joint reads.
struct Bump {
    joint: SymbolId,
    driver: String,
    dof: String,
    middle_rad: f64,
    width_rad: f64,
    height_rad: f64,
}

impl Bump {
    fn draw(design: &Design, snr: f64, random: &mut ChaCha8Rng) -> Self {
        // The innermost joint turns about the line of sight: pointing does not see its own errors.
        let name = ["alpha", "beta"][random.random_range(0..2)];
        let chain = &design.plan.chain;
        let own = chain.bodies.iter().flat_map(|body| &body.factors).find(|factor| {
            factor.role == Role::Motion
                && factor.kind == TransformKind::Rotation
                && factor.amount.symbols().iter().any(|&id| chain.symbol(id).name == name)
        });
        let mut bump = Self {
            joint: chain.find_symbol(name).unwrap_or(SymbolId(0)),
            driver: name.to_owned(),
            dof: own.map_or_else(String::new, |factor| format!("R{}", ["x", "y", "z"][factor.axis.index()])),
            middle_rad: random.random_range(-2.5..2.5),
            width_rad: random.random_range(0.15..0.35),
            height_rad: 1.0,
        };
        // What the declared errors leave of a small one, by the linear problem.
        bump.height_rad = SIGMA_RAD;
        let bent = |id: SymbolId, q: f64| if id == bump.joint { q + bump.at(q) } else { q };
        let rms = rms(&design.problem.project(&design.change(bent)));
        bump.height_rad *= if rms > 0.0 { snr / rms } else { 0.0 };
        bump
    }

    fn at(&self, q: f64) -> f64 {
        let from = (q - self.middle_rad) / self.width_rad;
        self.height_rad * (-0.5 * from * from).exp()
    }
}
