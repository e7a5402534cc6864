//! The rates at which the search is right and wrong, over many simulated instruments.
//!
//! `cargo run --release -p trueaxis-benches --bin evaluate_search -- [PART…] [--runs N] [--page FILE]`: the parts are
//! those of [`PARTS`] (all unless some are named), N the runs of each case (default 200; the cheap linear cases
//! run ten times as often when nothing, and twice as often when one effect is planted), FILE the page of the book
//! that the table goes to.
#![allow(clippy::print_stdout)]

mod design;
mod linear;
mod noise;
mod outside;
mod page;
mod rate;
mod real;
mod whole;

use std::time::Instant;

use design::Failure;
use rate::Line;

/// A part of the evaluation: its name, and what makes its lines from the number of runs.
type Part = (&'static str, fn(usize) -> Result<Vec<Line>, Failure>);

const PARTS: &[Part] = &[
    ("nothing", |runs| linear::false_positives(10 * runs)),
    ("noise", whole::false_positives),
    ("one", |runs| linear::one_effect(2 * runs)),
    ("two", |runs| linear::two_effects(2 * runs)),
    ("outliers", whole::outliers),
    ("local", whole::local_defect),
    ("outside", outside::outside),
    ("poses", whole::next_poses),
    ("time", |_| linear::time(9)),
    ("calibrate", |_| whole::time(3)),
    ("telescopes", |_| real::telescopes()),
    ("arm", |_| real::arm()),
];

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let (mut named, mut runs, mut file) = (Vec::new(), 200, None);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--runs" => runs = arguments.next().ok_or("--runs needs a number")?.parse()?,
            "--page" => file = Some(arguments.next().ok_or("--page needs a file")?),
            _ => named.push(argument),
        }
    }
    if let Some(unknown) = named.iter().find(|name| PARTS.iter().all(|(known, _)| known != name)) {
        let known: Vec<&str> = PARTS.iter().map(|(name, _)| *name).collect();
        return Err(format!("no part is called `{unknown}`; there are {}", known.join(", ")).into());
    }
    let start = Instant::now();
    let mut lines = Vec::new();
    for (name, part) in PARTS {
        if !named.is_empty() && !named.iter().any(|wanted| wanted == name) {
            continue;
        }
        for line in part(runs)? {
            println!("{}", page::row(&line));
            lines.push(line);
        }
    }
    if let Some(file) = file {
        std::fs::write(file, page::page(&lines, start.elapsed())?)?;
    }
    Ok(())
}
