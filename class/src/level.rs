//! How difficult a data set is.

use crate::policy::{Difficulty, LEVELS};

/// How difficult a data set is: 1 to 4.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(try_from = "u8", into = "u8")]
pub struct Level(u8);

/// A level that there is not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "there is no level {0}: choose 1 (one effect), 2 (two), 3 (three, one confounded) or 4 (a misread column or a changed set-up too)"
)]
pub struct NoLevel(u8);

impl TryFrom<u8> for Level {
    type Error = NoLevel;

    fn try_from(number: u8) -> Result<Self, NoLevel> {
        if (1..=4).contains(&number) { Ok(Self(number)) } else { Err(NoLevel(number)) }
    }
}

impl From<Level> for u8 {
    fn from(level: Level) -> Self {
        level.0
    }
}

impl Level {
    /// What it asks.
    #[must_use]
    pub fn difficulty(self) -> Difficulty {
        LEVELS[usize::from(self.0) - 1]
    }
}
