//! Spoiled inputs, as many as time allows: `fuzz TARGET [SECONDS] [SEED]`, or every target without one.
//!
//! Inputs are those of `corpus/TARGET`, changed in a few places. None may panic, take more than [`SLOW`], or make the process
//! larger than [`LARGEST_KIB`]. It needs nothing but a stable compiler; the same seed tries the same inputs.

mod change;
mod intruders;
mod targets;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};
use std::{env, fs};

use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;

/// An input that takes longer is a finding: of the processors, where the system tells, as others may have them.
const SLOW: Duration = Duration::from_secs(10);
/// A process that was ever larger is a finding: the memory budget of the readers, and room for the rest.
const LARGEST_KIB: u64 = 3 << 20;
/// How long each target is tried unless said otherwise, in seconds.
const SECONDS: u64 = 30;

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let number = |at: usize, default: u64| match arguments.get(at).map(|text| text.parse()) {
        None => Ok(default),
        Some(number) => number,
    };
    let (Ok(seconds), Ok(seed)) = (number(1, SECONDS), number(2, 1)) else {
        return usage();
    };
    let wanted = arguments.first().map(String::as_str);
    let chosen: Vec<_> =
        targets::TARGETS.iter().filter(|(name, _)| wanted.is_none_or(|w| w == *name)).collect();
    if chosen.is_empty() {
        return usage();
    }
    let found = chosen.iter().filter(|(name, target)| {
        !run(name, *target, Duration::from_secs(seconds), &mut ChaCha8Rng::seed_from_u64(seed))
    });
    if found.count() == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

#[allow(clippy::print_stderr, reason = "a program of its own")]
fn usage() -> ExitCode {
    let names: Vec<&str> = targets::TARGETS.iter().map(|(name, _)| *name).collect();
    eprintln!("fuzz [TARGET [SECONDS [SEED]]]; the targets are {}", names.join(", "));
    ExitCode::from(2)
}

/// Tries a target; whether nothing was found.
#[allow(clippy::print_stderr, reason = "a program of its own")]
fn run(name: &str, target: targets::Target, time: Duration, chance: &mut ChaCha8Rng) -> bool {
    let corpus = match corpus(name) {
        Ok(corpus) if !corpus.is_empty() => corpus,
        _ => {
            eprintln!("{name}: no corpus in {}", folder(name).display());
            return false;
        }
    };
    let start = Instant::now();
    let (mut tried, mut slowest) = (0_u64, Duration::ZERO);
    while start.elapsed() < time {
        let input = match corpus.get(usize::try_from(tried).unwrap_or(usize::MAX)) {
            // The corpus itself comes first.
            Some(whole) => whole.clone(),
            None => change::changed(&corpus, chance),
        };
        let (begun, used) = (Instant::now(), processor_time());
        let panicked = catch_unwind(AssertUnwindSafe(|| target(&input))).is_err();
        let took = processor_time()
            .zip(used)
            .map_or_else(|| begun.elapsed(), |(after, before)| after.saturating_sub(before));
        slowest = slowest.max(took);
        tried += 1;
        let large = largest_kib().is_some_and(|largest| largest > LARGEST_KIB);
        if panicked || large || took > SLOW {
            let what = if panicked {
                "panics"
            } else if large {
                "takes too much memory"
            } else {
                "takes too long"
            };
            let kept = PathBuf::from(format!("{name}.found"));
            let written = fs::write(&kept, &input).is_ok();
            let place = if written { kept.display().to_string() } else { "nowhere".to_owned() };
            eprintln!("{name}: input {tried} {what}; it is kept in {place}");
            return false;
        }
    }
    eprintln!(
        "{name}: {tried} inputs in {} s, the slowest took {:.2} s, nothing found",
        start.elapsed().as_secs(),
        slowest.as_secs_f64()
    );
    true
}

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(name)
}

/// The files of a corpus, in the order of their names.
fn corpus(name: &str) -> std::io::Result<Vec<Vec<u8>>> {
    let mut files = fs::read_dir(folder(name))?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<Vec<_>, _>>()?;
    files.sort();
    files.iter().map(fs::read).collect()
}

/// What the process has had of all processors, where the system tells.
fn processor_time() -> Option<Duration> {
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // Behind the name, which may hold anything, in hundredths of a second: the 12th and 13th field.
    let mut fields = stat.rsplit_once(')')?.1.split_whitespace().skip(11);
    let mut hundredths = || fields.next()?.parse::<u64>().ok();
    Some(Duration::from_millis(10 * (hundredths()? + hundredths()?)))
}

/// The most memory that the process ever had, where the system tells.
fn largest_kib() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse().ok()
}
