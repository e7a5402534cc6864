//! The rubric: what is graded, how many points each item has, and where its limits are.

use serde::Serialize;

/// What is graded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Item {
    /// Body and axis of each thing that is missing, or a declaration that does the same; and the reading of the columns.
    Place,
    /// The cause of each, or every cause that the data allow.
    Cause,
    /// The size of the largest effect, within its ±.
    Size,
    /// A declared error, within its ±.
    Error,
    /// A prediction at one pose, within its ±.
    Prediction,
    /// The amended declaration, fitted to the student's data, at poses that only the teacher has.
    Unseen,
    /// The sentence on what the data show and do not show.
    Honesty,
}

/// Every item with its points, in the order of a table.
pub const RUBRIC: [(Item, f64); 7] = [
    (Item::Place, 5.0),
    (Item::Cause, 4.0),
    (Item::Size, 2.0),
    (Item::Error, 2.0),
    (Item::Prediction, 1.0),
    (Item::Unseen, 3.0),
    (Item::Honesty, 3.0),
];

/// A number is right within so many of its own standard uncertainties: 95 % of right answers are.
pub const RIGHT_WITHIN: f64 = 2.0;

/// A ± of at most so many times what the data allow earns the whole number.
pub const TIGHT: f64 = 4.0;

/// A ± of at most so many times what the data allow earns half of it; a wider one says nothing.
pub const LOOSE: f64 = 12.0;

/// A value within so many standard uncertainties of the data earns half, though its own ± is too small.
pub const NEAR: f64 = 4.0;

/// A declaration predicts well with an RMS of at most so many times what the noise makes of the true one.
pub const PREDICTS_WELL: f64 = 2.0;

/// It predicts better than the declaration as it was handed out with at most this share of that one's error.
pub const PREDICTS_BETTER: f64 = 0.5;

impl Item {
    /// As the head of a column.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Place => "place",
            Self::Cause => "cause",
            Self::Size => "size",
            Self::Error => "error",
            Self::Prediction => "prediction",
            Self::Unseen => "unseen",
            Self::Honesty => "honesty",
        }
    }
}

/// The points of everything together.
#[must_use]
pub fn full() -> f64 {
    RUBRIC.iter().map(|(_, points)| points).sum()
}
