//! How often misread columns are told, and how often something is told of files in which nothing is wrong.
//!
//! `cargo run --release -p trueaxis-benches --bin evaluate_misread -- [--runs N] [--clean N] [--seed S] [--page FILE] [--kept FILE] [TRAP…]`: N runs
//! of each trap, instrument and number of rows (default 4), of clean files (default 3000); the seed of the first run (default 1; seeds
//! below 1,000,000 were used while the readings were made); FILE the page of the book, and where answers are kept, so that a run that was
//! stopped goes on; traps by a part of their names.
#![allow(clippy::print_stdout)]

mod data;
mod instruments;
mod judge;
mod kept;
mod traps;

use std::fmt::Write as _;

use rayon::prelude::*;
use testkit::Random;

use data::{Data, HABITS, Habit};
use instruments::INSTRUMENTS;
use judge::{Answer, Failure, of_clean, of_spoiled};
use kept::Kept;
use traps::TRAPS;

const ROWS: [usize; 3] = [12, 50, 300];

/// Rows of clean files: few as well.
const CLEAN_ROWS: [usize; 4] = [8, 12, 50, 300];

/// The answer of a clean file whose correction is withheld.
const WITHHELD: &str = "withheld";

struct Asked {
    runs: usize,
    clean: usize,
    seed: u64,
    page: Option<String>,
    kept: Option<String>,
    traps: Vec<String>,
}

fn main() -> Result<(), Failure> {
    let mut asked = Asked { runs: 4, clean: 3000, seed: 1, page: None, kept: None, traps: Vec::new() };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
        match argument.as_str() {
            "--runs" => asked.runs = value()?.parse()?,
            "--clean" => asked.clean = value()?.parse()?,
            "--seed" => asked.seed = value()?.parse()?,
            "--kept" => asked.kept = Some(value()?),
            "--page" => asked.page = Some(value()?),
            _ => asked.traps.push(argument),
        }
    }
    let kept = Kept::read(asked.kept.as_deref())?;
    let mut text = spoiled(&asked, &kept)?;
    text += &clean(&asked, &kept)?;
    if let Some(file) = &asked.page {
        std::fs::write(file, page(&asked, &text))?;
    }
    Ok(())
}

/// Numbers that belong to one run of one case.
fn numbers(seed: u64, case: usize, run: usize) -> Random {
    let mut random = Random::new(
        seed.wrapping_add(run as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ ((case as u64) << 40),
    );
    (0..8).for_each(|_| {
        random.even();
    });
    random
}

fn spoiled(asked: &Asked, kept: &Kept) -> Result<String, Failure> {
    let rows = ROWS.map(|rows| format!(" {rows} rows |")).concat();
    let mut table = format!("| mistake | instrument |{rows}\n|---|---|{}\n", "---|".repeat(ROWS.len()));
    let mut sums = [0_usize; 8];
    for (case, trap) in TRAPS.iter().enumerate() {
        let is_asked =
            asked.traps.is_empty() || asked.traps.iter().any(|part| trap.name.contains(part.as_str()));
        for instrument in INSTRUMENTS.iter().filter(|own| is_asked && (trap.on)(own)) {
            let mut line = format!("| {} | {} |", trap.name, instrument.name);
            for rows in ROWS {
                let run = |run: usize| {
                    let name = format!("{}/{}/{}/{rows}/{run}", asked.seed, trap.name, instrument.name);
                    kept.or_new(&name, || {
                        let random = &mut numbers(asked.seed, case * 1000 + rows, run);
                        let clean = Data::simulated(instrument, rows, HABITS[0].0, random);
                        let mut data = clean.clone();
                        let right = (trap.spoil)(&mut data, random);
                        let (answer, said) = of_spoiled(&data, &clean, &right)?;
                        if matches!(answer, Answer::Other | Answer::Silent) {
                            println!("  {answer:?}: {name}: {said:?} for {:?}", right.first());
                        }
                        Ok(format!("{answer:?}"))
                    })
                };
                let answers: Vec<_> =
                    (0..asked.runs).into_par_iter().map(run).collect::<Result<_, Failure>>()?;
                let of = |kind: &Answer| answers.iter().filter(|own| **own == format!("{kind:?}")).count();
                let counts = Answer::ALL.each_ref().map(of);
                sums.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
                let told = Answer::ALL.iter().zip(counts).filter(|(_, count)| *count > 0);
                let cell: Vec<String> = told
                    .map(|(answer, count)| match asked.runs {
                        1 => answer.words().to_owned(),
                        _ => format!("{count} {}", answer.words()),
                    })
                    .collect();
                let _ = write!(line, " {} |", cell.join(", "));
            }
            println!("{line}");
            let _ = writeln!(table, "{line}");
        }
    }
    let all: usize = sums.iter().sum();
    let mut text = "| answer | files | share |\n|---|---|---|\n".to_owned();
    for (answer, sum) in Answer::ALL.iter().zip(sums) {
        let share = 100.0 * sum as f64 / all.max(1) as f64;
        let _ = writeln!(text, "| {} | {sum} | {share:.1} % |", answer.words());
    }
    println!("{text}");
    Ok(format!("## Mistakes\n\n{text}\n{table}"))
}

fn clean(asked: &Asked, kept: &Kept) -> Result<String, Failure> {
    let mut text =
        "\n## Files in which nothing is wrong\n\n| what is unusual | files | something named | withheld |\n|---|---|---|---|\n".to_owned();
    for (case, (habit, words)) in HABITS.iter().enumerate() {
        let runs = asked.clean / HABITS.len();
        let run = |run: usize| {
            let random = &mut numbers(asked.seed, 100_000 + case, run);
            // A home that no declared index takes up is a mistake.
            let may_be: Vec<_> =
                INSTRUMENTS.iter().filter(|own| *habit != Habit::Home || own.indexed).collect();
            let instrument = may_be[run % may_be.len()];
            let rows = CLEAN_ROWS[run / may_be.len() % CLEAN_ROWS.len()];
            let name = format!("{}/{words}/{}/{rows}/{run}", asked.seed, instrument.name);
            kept.or_new(&name, || {
                let (mut named, withheld) = of_clean(&Data::simulated(instrument, rows, *habit, random))?;
                // A play that rests on either side makes two kinds of rows in truth.
                named.retain(|name| *habit != Habit::Backlash || !name.starts_with("two kinds"));
                if !named.is_empty() {
                    println!("  named: {name}: {named:?}");
                }
                let answer = if named.is_empty() { "nothing" } else { "named" };
                Ok(if withheld { WITHHELD } else { answer }.to_owned())
            })
        };
        let answers: Vec<_> = (0..runs).into_par_iter().map(run).collect::<Result<_, Failure>>()?;
        let of = |kind: &str| answers.iter().filter(|own| *own == kind).count();
        let (named, withheld) = (of("named"), of(WITHHELD));
        let line = format!("| {words} | {runs} | {named} | {withheld} |");
        println!("{line}");
        let _ = writeln!(text, "{line}");
    }
    Ok(text)
}

fn page(asked: &Asked, text: &str) -> String {
    let Asked { runs, clean, seed, .. } = asked;
    format!(include_str!("page.md"), runs = runs, clean = clean, seed = seed, text = text)
}
