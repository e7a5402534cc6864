//! What a calibration says while somebody waits for it: where it is, and how long what is counted still takes.

use std::mem::discriminant;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use calibration::calibrate::Stage;

/// The stage that is counted, and when it began.
#[derive(Debug, Default)]
pub struct Waiting {
    began: Mutex<Option<(Stage, Instant)>>,
}

impl Waiting {
    /// What to say at a stage.
    pub fn told(&self, stage: Stage) -> String {
        let mut began = self.began.lock().unwrap_or_else(PoisonError::into_inner);
        match counted(stage) {
            Some((0, _)) => *began = Some((stage, Instant::now())),
            Some(_) => {}
            None => *began = None,
        }
        let since = began.filter(|(of, _)| discriminant(of) == discriminant(&stage));
        so_far(stage, since.map(|(_, since)| since.elapsed()))
    }
}

/// How much of a stage is done, and how much there is, where it is counted.
fn counted(stage: Stage) -> Option<(usize, usize)> {
    match stage {
        Stage::Columns { rows, of } => Some((rows, of)),
        Stage::HeldOut { done, of } => Some((done, of)),
        Stage::Fit { .. } | Stage::Search | Stage::Weigh | Stage::Remaining => None,
    }
}

/// A stage that has taken so long, with what it will still take.
fn so_far(stage: Stage, elapsed: Option<Duration>) -> String {
    match (counted(stage), elapsed) {
        (Some((done, of)), Some(elapsed)) if done > 0 => {
            let left = elapsed.as_secs_f64() * of.saturating_sub(done) as f64 / done as f64;
            format!("{stage}, about {left:.0} s left of this")
        }
        _ => stage.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_takes_as_long_as_what_is_done() {
        let told = |rows| so_far(Stage::Columns { rows, of: 1_000_000 }, Some(Duration::from_secs(3)));
        assert_eq!(told(250_000), "what effects would do: row 250000 of 1000000, about 9 s left of this");
        assert_eq!(told(1_000_000), "what effects would do: row 1000000 of 1000000, about 0 s left of this");
        assert_eq!(told(0), "what effects would do: row 0 of 1000000");
        let folds = so_far(Stage::HeldOut { done: 3, of: 10 }, Some(Duration::from_secs(9)));
        assert_eq!(folds, "repeating the search without each fold: 3 of 10, about 21 s left of this");
        assert_eq!(so_far(Stage::Search, None), Stage::Search.to_string());
        let waiting = Waiting::default();
        // Nobody said when it began.
        let columns = Stage::Columns { rows: 5, of: 9 };
        assert_eq!(waiting.told(columns), columns.to_string());
        waiting.told(Stage::Columns { rows: 0, of: 9 });
        assert!(waiting.told(columns).ends_with("s left of this"));
        // Another stage has a beginning of its own.
        let folds = Stage::HeldOut { done: 2, of: 10 };
        assert_eq!(waiting.told(folds), folds.to_string());
        waiting.told(Stage::HeldOut { done: 0, of: 10 });
        assert!(waiting.told(folds).ends_with("s left of this"));
        waiting.told(Stage::Search);
        assert_eq!(waiting.told(columns), columns.to_string());
    }
}
