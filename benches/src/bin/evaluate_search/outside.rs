//! Functions outside the catalogue: what the verdict, the place and the form make of them.

use std::f64::consts::{PI, TAU};

use calibration::calibrate::{Request, calibrate};
use calibration::diagnose::{Diagnosis, Verdict};
use model_core::SymbolId;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::time::Instant;

use crate::design::{Design, Failure, Poses, SIGMA_RAD, TEXT, rms};
use crate::noise::Noise;
use crate::rate::{Line, Rate, Target};

/// A name, and a function of a reading between −π and π.
type Named = (&'static str, fn(f64) -> f64);

const FUNCTIONS: [Named; 20] = [
    ("step at 0.7", |q| f64::from(u8::from(q > 0.7))),
    ("step at −1.9", |q| f64::from(u8::from(q > -1.9))),
    ("plateau", |q| f64::from(u8::from(q > 0.2 && q < 1.4))),
    ("ramp", |q| ((q + 1.0) / 1.5).clamp(0.0, 1.0)),
    ("tanh", |q| (2.0 * q).tanh()),
    ("hinge", |q| (q - 0.5).max(0.0)),
    ("|q|", f64::abs),
    ("|sin q|", |q| q.sin().abs()),
    ("sawtooth 1", |q| (q + PI).rem_euclid(TAU)),
    ("sawtooth 3", |q| (q + 0.4).rem_euclid(TAU / 3.0)),
    ("square wave 2", |q| (2.0 * q + 0.3).sin().signum()),
    ("triangle wave 4", |q| (4.0 * q + 0.3).sin().asin()),
    ("bump 3°", |q| (-0.5 * ((q - 1.1) / 0.026).powi(2)).exp()),
    ("bump 20°", |q| (-0.5 * ((q + 0.6) / 0.17).powi(2)).exp()),
    ("q²", |q| q * q),
    ("q³", |q| q * q * q),
    ("exp", |q| (q / 1.5).exp()),
    ("1/(q + 4)", |q| 1.0 / (q + 4.0)),
    ("√(q + π)", |q| (q + PI).max(0.0).sqrt()),
    ("q sin q", |q| q * q.sin()),
];

/// What one run came to.
struct Outcome {
    function: usize,
    alarm: bool,
    right_place: bool,
    falsely_explained: bool,
}

/// Each function in each joint that the observations see, at three sizes.
pub fn outside(runs: usize) -> Result<Vec<Line>, Failure> {
    let repeats = (runs / 100).max(1);
    let mut lines = Vec::new();
    for (snr, seed) in [(0.3, 1_200_000), (1.0, 1_210_000), (3.0, 1_220_000)] {
        let start = Instant::now();
        let design = Design::new(1000, Poses::Random(1.0), seed)?;
        let cases: Vec<(usize, &str, u64)> = (0..FUNCTIONS.len())
            .flat_map(|function| ["alpha", "beta"].map(|joint| (function, joint)))
            .flat_map(|(function, joint)| (0..repeats as u64).map(move |run| (function, joint, run)))
            .collect();
        let outcomes = cases
            .into_par_iter()
            .map(|(function, joint, run)| {
                let random = &mut ChaCha8Rng::seed_from_u64(seed + 100 * function as u64 + run);
                case(&design, function, joint, snr, random)
            })
            .collect::<Result<Vec<_>, _>>()?;
        let took = start.elapsed();
        let mut told = |what: String, target: Target, rate: Rate| {
            let (value, shown) = (rate.share(), rate.to_string());
            lines.push(Line { what, through: "whole", target, value, shown, runs: rate.runs, seed, took });
        };
        let outside = format!("function outside the catalogue, N = 1000, SNR {snr}");
        told(format!("{outside}: alarm"), Target::None, Rate::of(outcomes.iter().map(|o| o.alarm)));
        let place = Rate::of(outcomes.iter().map(|o| o.right_place));
        told(format!("{outside}: right place"), Target::None, place);
        let wrong = Rate::of(outcomes.iter().map(|o| o.falsely_explained));
        told(format!("{outside}: falsely explained"), Target::AtMost(0.1), wrong);
        let named: Vec<&str> = (0..FUNCTIONS.len())
            .filter(|&number| outcomes.iter().any(|o| o.function == number && o.falsely_explained))
            .map(|number| FUNCTIONS[number].0)
            .collect();
        if !named.is_empty() {
            told(format!("{outside}: … namely {}", named.join(", ")), Target::None, wrong);
        }
    }
    Ok(lines)
}

fn case(
    design: &Design,
    function: usize,
    joint: &str,
    snr: f64,
    random: &mut ChaCha8Rng,
) -> Result<Outcome, Failure> {
    let chain = &design.plan.chain;
    let id = chain.find_symbol(joint).ok_or("no such joint")?;
    let shape = FUNCTIONS[function].1;
    let mut height = SIGMA_RAD;
    let moved =
        |height: f64| move |other: SymbolId, q: f64| if other == id { q + height * shape(q) } else { q };
    // What the declared errors leave of a small one, by the linear problem.
    let seen = rms(&design.problem.project(&design.change(moved(height))));
    height *= if seen > 0.0 { snr / seen } else { 0.0 };
    let sampled = Noise::Even.sample(design.readings_of("beta"), random);
    let values = chain.nominal_values();
    let observations = design.observe(&design.readings, chain, values, &sampled, moved(height));
    let request = Request {
        text: TEXT,
        plan: &design.plan,
        observations: &observations,
        sample: None,
        second: None,
        when: "2026-11-21",
    };
    let found: Diagnosis = calibrate(request)?.diagnosis;
    let own = chain.bodies.iter().find_map(|body| {
        let factor = body.factors.iter().find(|factor| factor.amount.symbols().contains(&id))?;
        Some((body.name.as_str(), format!("R{}", ["x", "y", "z"][factor.axis.index()])))
    });
    let (body, dof) = own.ok_or("the joint moves nothing")?;
    let here = |effect: &calibration::diagnose::EffectFound| {
        effect.body == body && effect.dof == dof && effect.driver == joint
    };
    let left = found.remaining.as_ref().and_then(|left| left.place.as_ref());
    let placed = left.is_some_and(|place| place.driver == joint && place.dof == dof);
    let of_library = |effect: &calibration::diagnose::EffectFound| {
        effect.causes.first().is_some_and(|cause| cause.family == "shape")
    };
    let explained = matches!(found.verdict, Verdict::Explained | Verdict::Confounded);
    // A function of the library at the right place, named or among what competes with the name.
    let right = found.effects.iter().any(|effect| {
        here(effect)
            && (of_library(effect)
                || effect.told().any(|other| other.contains(&format!("of {joint} in {body}"))))
    });
    Ok(Outcome {
        function,
        alarm: found.verdict != Verdict::NothingDetectable,
        right_place: placed || (!found.effects.is_empty() && found.effects.iter().all(here)),
        falsely_explained: explained && !right,
    })
}
