//! What it takes to ask whether columns are misread: `calibrate` of the examples with that question and without it.
//!
//! `cargo bench -p trueaxis-benches --bench misread`. At most 30 % more is asked for.
#![allow(clippy::print_stdout, clippy::unwrap_used, missing_docs)]

use std::path::Path;
use std::time::Instant;

use calibration::calibrate::{Request, calibrate};
use model_core::Chain;
use study::Study;

/// Studies of the examples: two mounts, a scanner, and two of unknown objects.
const STUDIES: [&str; 5] = [
    "course/study.toml",
    "equatorial/equatorial-a.toml",
    "mobile-lidar/study.toml",
    "objects/walls.toml",
    "objects/bars.toml",
];

/// Runs of each, of which the fastest counts.
const RUNS: usize = 3;

fn main() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    println!("| study | without | with | more |\n|---|---|---|---|");
    for name in STUDIES {
        let path = examples.join(name);
        let folder = path.parent().unwrap();
        let study = Study::from_text(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let text = std::fs::read_to_string(folder.join(study.chain.get_ref())).unwrap();
        let chain = Chain::from_text(&text).unwrap();
        let plan = study.plan(&chain).unwrap();
        let loaded = plan.load(&mut |file| Ok(std::fs::read(folder.join(file)).unwrap().into())).unwrap();
        let fastest = |sample| {
            let request = Request {
                text: &text,
                plan: &plan,
                observations: &loaded.observations,
                sample,
                second: loaded.held_out.as_ref(),
                when: "2026-11-29",
            };
            let run = |_| {
                let began = Instant::now();
                let _ = calibrate(request);
                began.elapsed().as_secs_f64()
            };
            (0..RUNS).map(run).fold(f64::INFINITY, f64::min)
        };
        let (without, with) = (fastest(None), fastest(Some(&loaded.sample)));
        println!("| {name} | {without:.2} s | {with:.2} s | {:.0} % |", 100.0 * (with / without - 1.0));
    }
}
