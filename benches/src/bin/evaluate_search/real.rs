//! Real instruments: what an amended chain is worth at poses where nothing was measured.
//!
//! Each joint's range is cut in three; the calibration sees two thirds, the outer third is what it must foretell.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::Instant;

use calibration::calibrate::{Request, calibrate};
use calibration::search::columns::Columns;
use model_core::{Chain, SymbolId};
use observe::{Measure, Observations};
use study::{Plan, Study};
use tables::formats::{DataError, Input};

use crate::design::Failure;
use crate::rate::{Line, Target};

/// Studies, and the joints whose range is cut.
const STUDIES: &[(&str, &[&str])] = &[
    ("examples/ur10/ur10.toml", &["q1"]),
    ("examples/auxtel/auxtel-2022-04.toml", &["azimuth", "elevation"]),
    ("examples/auxtel/auxtel-2020-03.toml", &["azimuth", "elevation"]),
    ("examples/iram30m/iram30m-2013-04.toml", &["azimuth", "elevation"]),
    ("examples/iram30m/iram30m-2013-10.toml", &["azimuth", "elevation"]),
    ("examples/equatorial/equatorial-a.toml", &["ha", "dec"]),
    ("examples/equatorial/equatorial-b.toml", &["ha", "dec"]),
];

/// Rows whose declared residual is this many times the median are gross outliers.
const GROSS: f64 = 10.0;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The arm.
pub fn arm() -> Result<Vec<Line>, Failure> {
    elsewhere(&STUDIES[..1])
}

/// The telescopes and mounts.
pub fn telescopes() -> Result<Vec<Line>, Failure> {
    elsewhere(&STUDIES[1..])
}

/// Studies whose data are at hand.
fn elsewhere(studies: &[(&str, &[&str])]) -> Result<Vec<Line>, Failure> {
    let mut lines = Vec::new();
    for (path, joints) in studies {
        let folder = root().join(path).parent().unwrap_or(Path::new(".")).to_owned();
        let study = Study::from_text(&std::fs::read_to_string(root().join(path))?)?;
        let text = std::fs::read_to_string(folder.join(study.chain.get_ref()))?;
        let chain = Chain::from_text(&text).map_err(|mistakes| mistakes.to_string())?;
        let plan = study.plan(&chain)?;
        let data = study.data.get_ref().0.iter().map(|file| folder.join(file));
        if !data.clone().all(|file| file.exists()) {
            continue;
        }
        let mut files = data.map(File::open).collect::<Result<Vec<_>, _>>()?.into_iter();
        let mut open = |_: &str| -> Result<Input<'static>, DataError> {
            Ok(files.next().map_or_else(|| Vec::new().into(), |file| Input::Stream(Box::new(file))))
        };
        let all = plan.load(&mut open)?.observations;
        for joint in *joints {
            let joint = plan.chain.find_symbol(joint).ok_or(format!("{path}: no {joint}"))?;
            for upper in [false, true] {
                lines.extend(foretold(path, &text, &plan, &all, joint, upper)?);
            }
        }
    }
    Ok(lines)
}

fn foretold(
    path: &str,
    text: &str,
    plan: &Plan,
    all: &Observations,
    joint: SymbolId,
    upper: bool,
) -> Result<Vec<Line>, Failure> {
    let start = Instant::now();
    let readings = all.poses.column(joint).ok_or("no readings")?;
    let mut order: Vec<usize> = (0..readings.len()).collect();
    order.sort_by(|&a, &b| readings[a].total_cmp(&readings[b]));
    let third = order.len() / 3;
    let (mut held, mut seen): (Vec<usize>, Vec<usize>) = if upper {
        (order[order.len() - third..].to_vec(), order[..order.len() - third].to_vec())
    } else {
        (order[..third].to_vec(), order[third..].to_vec())
    };
    held.sort_unstable();
    seen.sort_unstable();
    let (held, seen) = (all.select(&held), all.select(&seen));
    let made = calibrate(Request {
        text,
        plan,
        observations: &seen,
        sample: None,
        second: None,
        when: "2026-11-21",
    })?;
    let residual = |chain: &Chain, values: &[f64]| -> Result<Vec<f64>, Failure> {
        let columns = Columns::at(chain, &held, &plan.fit.estimate, values, &[])?;
        let mut squares = vec![0.0; held.rows()];
        for (value, &row) in columns.residual.iter().zip(&columns.row) {
            squares[row as usize] += value * value;
        }
        Ok(squares.into_iter().map(f64::sqrt).collect())
    };
    let before = residual(&plan.chain, &made.before.values)?;
    let after = residual(&made.chain, &made.after.values)?;
    let mut sorted = before.clone();
    sorted.sort_by(f64::total_cmp);
    let gross = GROSS * sorted[sorted.len() / 2];
    let counted: Vec<usize> = (0..before.len()).filter(|&row| before[row] <= gross).collect();
    let rms = |of: &[f64]| {
        (counted.iter().map(|&row| of[row] * of[row]).sum::<f64>() / counted.len().max(1) as f64).sqrt()
    };
    let shown = |rms: f64| match held.poses.series.first().map(|series| series.measure) {
        Some(Measure::Point | Measure::Range) => format!("{:.3} mm", 1e3 * rms),
        _ => format!("{:.2}″", rms.to_degrees() * 3600.0),
    };
    let side = if upper { "upper" } else { "lower" };
    let name = Path::new(path).file_stem().map_or(path.into(), |stem| stem.to_string_lossy());
    let names: Vec<&str> =
        made.diagnosis.effects.iter().filter_map(|effect| effect.names.first()).map(String::as_str).collect();
    Ok(vec![Line {
        what: format!(
            "elsewhere: {name}, {side} third of {} foretold, declared → amended ({})",
            plan.chain.symbol(joint).name,
            names.join("; ")
        ),
        through: "whole",
        target: Target::AtMost(1.05),
        value: rms(&after) / rms(&before),
        shown: format!("{} → {}", shown(rms(&before)), shown(rms(&after))),
        runs: 1,
        seed: 0,
        took: start.elapsed(),
    }])
}
