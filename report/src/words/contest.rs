//! The contest in words: why a suspected cause is, or is not, reported.

use super::numbers;
use calibration::diagnose::{Diagnosis, Hypothesis};

/// The hypotheses whose names hold all words of a text, in the order of the contest.
#[must_use]
pub fn called<'a>(diagnosis: &'a Diagnosis, text: &str) -> Vec<&'a Hypothesis> {
    let words: Vec<String> = text.split_whitespace().map(str::to_lowercase).collect();
    let holds = |own: &&Hypothesis| {
        let name = own.name.to_lowercase();
        words.iter().all(|word| name.contains(word.as_str()))
    };
    diagnosis.contest.iter().filter(holds).collect()
}

/// Why a hypothesis is, or is not, reported, in sentences that begin with its name.
#[must_use]
pub fn why(own: &Hypothesis, diagnosis: &Diagnosis) -> String {
    format!("{}: {}", own.name, reason(own, diagnosis))
}

/// The same without its name.
#[must_use]
pub fn reason(own: &Hypothesis, diagnosis: &Diagnosis) -> String {
    let price = nats(own.price);
    let size = |value: f64| numbers::short(value, diagnosis.unit);
    if let (Some(leader), Some(behind)) = (&own.instead_of, own.behind) {
        let share = percent(own.share);
        return if own.is_one_with_it() {
            format!("these data cannot separate this from {leader}. Its share is {share}.")
        } else {
            format!("{} behind {leader}, which explains the same error. Its share is {share}.", nats(behind))
        };
    }
    if own.told {
        let gain = own.gain.map_or_else(String::new, |gain| {
            format!(" It gains {} and costs {price}, the price of choosing among its rivals.", nats(gain))
        });
        let share =
            if own.share > 0.0 { format!(" Its share is {}.", percent(own.share)) } else { String::new() };
        return format!("reported.{gain}{share}");
    }
    let left = own
        .left
        .as_ref()
        .map_or_else(String::new, |left| format!(" It was accepted first, then removed ({left})."));
    match own.needs {
        None => format!("the reported effects can imitate this completely. These data cannot show it.{left}"),
        Some(needs) => format!(
            "it shows {1} beside the reported effects, and would need {0} to be reported.{left}",
            size(needs),
            size(own.shows)
        ),
    }
}

/// What the figures of a contest mean.
pub const MEANING: &str = "Evidence is counted in nats. One nat means odds of 2.7 to 1, three nats 20 to 1. Sizes are RMS \
                           over these data.";

/// Why no contest was held.
pub const NONE_HELD: &str = "No contest was held. A contest needs one kind of observation of known objects, exact readings, and at most \
                             4,000 measured values.";

/// `2.1 nats`
fn nats(value: f64) -> String {
    format!("{value:.1} nats").replace('-', "−")
}

/// `18 %`
#[must_use]
pub fn percent(share: f64) -> String {
    match 100.0 * share {
        small if small < 1.0 => "under 1 %".to_owned(),
        large => format!("{large:.0} %"),
    }
}
