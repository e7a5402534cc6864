//! How often the contest is right, on simulated alt-azimuth directions: one line of JSON a case, appended to a file.
//!
//! `evaluate FILE NOISE EFFECTS SNR ROWS FROM TO [slow] [dump=DIR] [NAME=VALUE …]`: noise is `white`, `t3`, `uneven`,
//! `outliers`, `walk`, `ar0.9`, `bands` or `bands-label`; effects are `none` or names with `+` (`any` and `out` are drawn
//! inside and outside the catalogue); the seeds run from FROM to TO; NAME=VALUE sets a threshold. A case that
//! stands in the file is not run again.

mod cases;
mod chain;

use std::fmt::Write as _;
use std::fs::{OpenOptions, read_to_string};
use std::io::Write as _;
use std::time::Instant;

use evidence::{NewRows, Outcome, Policy, contest};

use cases::{Case, Cell, SIGMA, case};
use chain::{new_rows, problem};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, noise, effects, snr, rows, from, to, rest @ ..] = arguments.as_slice() else {
        return Err("evaluate FILE NOISE EFFECTS SNR ROWS FROM TO [slow] [dump=DIR] [NAME=VALUE …]".into());
    };
    let mut policy = Policy::default();
    let mut dump = None;
    for word in rest {
        match word.split_once('=') {
            Some(("dump", folder)) => dump = Some(folder.to_owned()),
            Some((name, value)) if policy.set(name, value.parse()?) => {}
            None if word == "slow" => {}
            _ => return Err(format!("`{word}` is no threshold").into()),
        }
    }
    let cell = Cell {
        noise: noise.clone(),
        effects: effects.split('+').filter(|name| *name != "none").map(str::to_owned).collect(),
        snr: snr.parse()?,
        rows: rows.parse()?,
        slow: rest.iter().any(|word| word == "slow"),
    };
    let done = read_to_string(file).unwrap_or_default();
    let mut out = OpenOptions::new().create(true).append(true).open(file)?;
    for seed in from.parse::<u64>()?..to.parse()? {
        let id = format!("\"id\":\"{}#{seed}\"", cell.name());
        if done.contains(&id) {
            continue;
        }
        let case = case(&cell, seed);
        if let Some(folder) = &dump {
            write_case(folder, &cell, seed, &case)?;
        }
        let problem = problem(&case.data);
        let started = Instant::now();
        let outcome = contest(&problem, &policy, Some(&case.data))?;
        let seconds = started.elapsed().as_secs_f64();
        writeln!(out, "{{{id},{}}}", scored(&case, &outcome, seconds))?;
        out.flush()?;
    }
    Ok(())
}

/// Everything that is counted of a case, as members of a JSON object.
fn scored(case: &Case, outcome: &Outcome, seconds: f64) -> String {
    let families = outcome.families();
    let mut text = String::new();
    let named: Vec<_> = outcome.findings().iter().filter(|found| found.named).collect();
    let findings: Vec<String> = outcome
        .findings()
        .iter()
        .map(|found| {
            let set: Vec<String> = found
                .set
                .iter()
                .zip(&found.shares)
                .map(|(&(family, _), share)| format!("[\"{}\",{share:.3}]", outcome.name(family)))
                .collect();
            format!("{{\"margin\":{:.2},\"set\":[{}]}}", found.margin, set.join(","))
        })
        .collect();
    let noise: Vec<String> =
        outcome.noise().iter().map(|&family| format!("\"{}\"", outcome.name(family))).collect();
    // Writing to a string does not fail.
    let _ = write!(
        text,
        "\"seconds\":{seconds:.3},\"findings\":[{}],\"noise\":[{}],\"odds\":{:.3},\"lead\":{:.2},\"memory\":{},\"tails\":{},\"cuts\":{:?},\"named\":{}",
        findings.join(","),
        noise.join(","),
        outcome.odds(),
        outcome.lead_over_none(),
        outcome.memory().map_or("null".into(), |memory| format!("[{},{}]", memory.carried, memory.part)),
        if outcome.tails().is_finite() { outcome.tails().to_string() } else { "null".into() },
        outcome.cuts(),
        named.len(),
    );
    let (mut first, mut inset, mut placed, mut spurious) = (Vec::new(), Vec::new(), Vec::new(), 0);
    let site = |family: usize, effect: &cases::Effect| {
        let same_place = effect.terms.iter().any(|(place, _)| outcome.members(family).contains(place))
            || (effect.terms.len() > 1 && outcome.members(family).is_empty());
        same_place && families[family].driver == effect.driver
    };
    for effect in &case.effects {
        let own = |family: usize| effect.is(families[family].law) && site(family, effect);
        first.push(named.iter().any(|found| own(found.family)));
        inset.push(named.iter().any(|found| found.set.iter().any(|&(family, _)| own(family))));
        placed.push(named.iter().any(|found| site(found.family, effect)));
    }
    for found in &named {
        let fits = |family: usize| case.effects.iter().any(|effect| site(family, effect));
        spurious += usize::from(!found.set.iter().any(|&(family, _)| fits(family)));
    }
    let names: Vec<String> = case.effects.iter().map(|effect| format!("\"{}\"", effect.name)).collect();
    let inside: Vec<bool> = case.effects.iter().map(|effect| effect.inside).collect();
    let sizes: Vec<usize> = named.iter().map(|found| found.set.len()).collect();
    let _ = write!(
        text,
        ",\"effects\":[{}],\"inside\":{inside:?},\"first\":{first:?},\"inset\":{inset:?},\"placed\":{placed:?},\"spurious\":{spurious},\"sizes\":{sizes:?}",
        names.join(",")
    );
    for (name, estimates) in [("z", outcome.declared()), ("z_alone", outcome.declared_alone())] {
        let z: Vec<String> = estimates
            .unwrap_or_default()
            .iter()
            .zip(&case.errors)
            .filter(|(estimate, _)| estimate.determined)
            .map(|(estimate, truth)| format!("{:.3}", (estimate.value - truth) / estimate.uncertainty))
            .collect();
        let _ = write!(text, ",\"{name}\":[{}]", z.join(","));
    }
    let _ = write!(text, ",\"quantile\":{:.4}", outcome.quantile());
    for (index, fresh) in case.fresh.iter().enumerate() {
        let (new, residual): (NewRows, Vec<f64>) =
            new_rows(fresh, outcome.estimates(), &|rows, places| outcome.effects(rows, places));
        let name = ["near", "else"][index];
        let Some(prediction) = outcome.predict(&new) else { continue };
        let errors: Vec<f64> = residual.iter().zip(&prediction.mean).map(|(r, mean)| r - mean).collect();
        let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt() / SIGMA;
        let covered =
            errors.iter().zip(&prediction.uncertainty).filter(|(e, u)| e.abs() < outcome.quantile() * *u);
        let covered = covered.count() as f64 / errors.len() as f64;
        let _ = write!(
            text,
            ",\"{name}\":{{\"before\":{:.4},\"rms\":{rms:.4},\"oracle\":{:.4},\"cover\":{covered:.4}}}",
            case.before[index], case.oracle[index]
        );
    }
    text
}

/// Writes a case for another program: a line a row with azimuth, elevation, direction, label.
fn write_case(folder: &str, cell: &Cell, seed: u64, case: &Case) -> Result<(), std::io::Error> {
    let name = format!("{folder}/{}#{seed}.txt", cell.name().replace('/', "_"));
    let mut text = format!("# {}\n", case.errors.iter().map(f64::to_string).collect::<Vec<_>>().join(" "));
    for (row, (pose, d)) in case.data.poses.iter().zip(&case.data.observed).enumerate() {
        let label = case.data.labels.as_ref().map_or(-1.0, |labels| labels[row] as f64);
        let values = [pose.azimuth, pose.elevation, d[0], d[1], d[2], label];
        text.push_str(&values.map(|value| format!("{value:e}")).join(" "));
        text.push('\n');
    }
    std::fs::write(name, text)
}
