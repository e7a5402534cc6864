//! What a command will take, said before it starts where that is long.

use model_core::{Chain, SymbolKind};

use crate::terminal::{self, Progress};

/// What is done with a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Work {
    /// `derive`: forms have terms by products of so many errors, and are merged as many times as there are errors.
    Derive {
        /// The order in the errors.
        order: u32,
    },
    /// `bound`: the search has a limit of its own, and evaluates the whole way.
    Bound,
    /// `budget`: each error is evaluated at every pose, and climbs along each joint.
    Budget,
    /// `generate`: the program grows as the errors.
    Generate,
}

/// Seconds that nobody needs to be told of.
const SHORT_S: f64 = 5.0;

/// Says what a command will take, where that is more than a few seconds. A line then says how long it has taken so far, where a
/// person looks: drop it before anything is printed.
///
/// The times are those of `benches/growth/costs.py` on one processor, see the page "What it costs".
#[must_use]
pub fn announce(chain: &Chain, work: Work) -> Option<Progress> {
    let errors = chain.symbols_of(SymbolKind::Error).count();
    let joints = chain.symbols_of(SymbolKind::Joint).count();
    let seconds = seconds(work, errors as f64, joints as f64);
    if seconds <= SHORT_S {
        return None;
    }
    let expected = in_words(seconds);
    terminal::note(format_args!(
        "{errors} errors and {joints} joints: this takes some {expected} on one processor"
    ));
    Some(terminal::progress().with_elapsed(&expected))
}

fn seconds(work: Work, errors: f64, joints: f64) -> f64 {
    let thousands = errors / 1000.0;
    match work {
        Work::Derive { order: 0 | 1 } => 0.012 * thousands.powi(2),
        Work::Derive { order: 2 } => 120.0 * thousands.powi(4),
        Work::Derive { .. } => 2e5 * thousands.powi(5),
        Work::Bound => thousands.min(1.0),
        Work::Budget => 3.5 * thousands * (joints / 3.0).max(1.0),
        Work::Generate => 0.13 * thousands,
    }
}

fn in_words(seconds: f64) -> String {
    match seconds {
        long if long > 5400.0 => format!("{:.0} hours", long / 3600.0),
        minutes if minutes > 90.0 => format!("{:.0} minutes", minutes / 60.0),
        short => format!("{short:.0} seconds"),
    }
}

#[cfg(test)]
mod tests {
    use super::{Work, in_words, seconds};

    #[test]
    fn small_chains_are_not_announced_and_large_ones_are() {
        assert!(seconds(Work::Budget, 84.0, 14.0) < 5.0);
        assert!(seconds(Work::Budget, 5000.0, 3.0) > 5.0);
        assert!(seconds(Work::Derive { order: 1 }, 10_000.0, 3.0) < 5.0);
        assert!(seconds(Work::Derive { order: 2 }, 1000.0, 3.0) > 5.0);
        assert_eq!(in_words(30.0), "30 seconds");
        assert_eq!(in_words(600.0), "10 minutes");
        assert_eq!(in_words(7200.0), "2 hours");
    }
}
