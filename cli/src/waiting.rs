//! What a calibration says while somebody waits for it: where it is, and how long many rows still take there.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use calibration::calibrate::Stage;

/// When the stage began that goes through the rows.
#[derive(Debug, Default)]
pub struct Waiting {
    began: Mutex<Option<Instant>>,
}

impl Waiting {
    /// What to say at a stage.
    pub fn told(&self, stage: Stage) -> String {
        let mut began = self.began.lock().unwrap_or_else(PoisonError::into_inner);
        match stage {
            Stage::Columns { rows: 0, .. } => *began = Some(Instant::now()),
            Stage::Columns { .. } => {}
            _ => *began = None,
        }
        so_far(stage, began.map(|began| began.elapsed()))
    }
}

/// A stage that has taken so long, with what it will still take.
fn so_far(stage: Stage, elapsed: Option<Duration>) -> String {
    match (stage, elapsed) {
        (Stage::Columns { rows, of }, Some(elapsed)) if rows > 0 => {
            let left = elapsed.as_secs_f64() * of.saturating_sub(rows) as f64 / rows as f64;
            format!("{stage}, about {left:.0} s left of this")
        }
        _ => stage.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_are_left_take_as_long_as_those_before() {
        let told = |rows| so_far(Stage::Columns { rows, of: 1_000_000 }, Some(Duration::from_secs(3)));
        assert_eq!(told(250_000), "what effects would do: row 250000 of 1000000, about 9 s left of this");
        assert_eq!(told(1_000_000), "what effects would do: row 1000000 of 1000000, about 0 s left of this");
        assert_eq!(told(0), "what effects would do: row 0 of 1000000");
        assert_eq!(so_far(Stage::Search, None), Stage::Search.to_string());
        let waiting = Waiting::default();
        // Nobody said when it began.
        let columns = Stage::Columns { rows: 5, of: 9 };
        assert_eq!(waiting.told(columns), columns.to_string());
        waiting.told(Stage::Columns { rows: 0, of: 9 });
        assert!(waiting.told(columns).ends_with("s left of this"));
        waiting.told(Stage::HeldOut);
        assert_eq!(waiting.told(columns), columns.to_string());
    }
}
