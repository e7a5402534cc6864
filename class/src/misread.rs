//! How a column can be other than its heading says, and how it is read rightly.

use crate::instrument::Instrument;
use crate::readings::{Pose, rounded};

/// How the columns of a file are to be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// As their headings say.
    AsLabelled,
    /// The first angle counts the other way.
    FirstReversed,
    /// The second angle counts from the other end of a quarter turn.
    SecondFromOtherEnd,
    /// The first angle is in gon.
    FirstInGon,
    /// The second angle is in gon.
    SecondInGon,
    /// x and y of what was measured are exchanged.
    Exchanged,
}

/// A row of a file: the readings, and the measured x, y and z.
pub type Row = (Pose, [f64; 3]);

impl Reading {
    /// Every reading, in the order of a sheet.
    pub const ALL: [Self; 6] = [
        Self::AsLabelled,
        Self::FirstReversed,
        Self::SecondFromOtherEnd,
        Self::FirstInGon,
        Self::SecondInGon,
        Self::Exchanged,
    ];

    /// The word that an answer names it by.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::AsLabelled => "as_labelled",
            Self::FirstReversed => "first_reversed",
            Self::SecondFromOtherEnd => "second_from_other_end",
            Self::FirstInGon => "first_in_gon",
            Self::SecondInGon => "second_in_gon",
            Self::Exchanged => "x_y_exchanged",
        }
    }

    /// The reading of a word.
    #[must_use]
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|reading| reading.word() == word)
    }

    /// What it means, for an instrument.
    #[must_use]
    pub fn words(self, instrument: &Instrument) -> String {
        let [first, second] = instrument.joints();
        match self {
            Self::AsLabelled => "every column is what its heading says".to_owned(),
            Self::FirstReversed => format!("`{first}` counts the other way"),
            Self::SecondFromOtherEnd => format!("`{second}` counts from the other end: 90° less the angle"),
            Self::FirstInGon => format!("`{first}` is in gon, 400 to a turn"),
            Self::SecondInGon => format!("`{second}` is in gon, 400 to a turn"),
            Self::Exchanged => "the columns `x` and `y` are exchanged".to_owned(),
        }
    }

    /// A row as it is written into a file that must be read in this way.
    #[must_use]
    pub fn written(self, (pose, [x, y, z]): Row) -> Row {
        let [first, second] = pose.joints_deg;
        let angles = |first: f64, second: f64| {
            (Pose { joints_deg: [rounded(first, 6), rounded(second, 6)], ..pose }, [x, y, z])
        };
        match self {
            Self::AsLabelled => (pose, [x, y, z]),
            Self::FirstReversed => angles(360.0 - first, second),
            Self::SecondFromOtherEnd => angles(first, 90.0 - second),
            Self::FirstInGon => angles(first / 0.9, second),
            Self::SecondInGon => angles(first, second / 0.9),
            Self::Exchanged => (pose, [y, x, z]),
        }
    }

    /// A row of a file as somebody takes it who reads the file in this way.
    #[must_use]
    pub fn read(self, (pose, measured): Row) -> Row {
        let [first, second] = pose.joints_deg;
        match self {
            Self::FirstInGon => (Pose { joints_deg: [first * 0.9, second], ..pose }, measured),
            Self::SecondInGon => (Pose { joints_deg: [first, second * 0.9], ..pose }, measured),
            // The others undo themselves.
            _ => self.written((pose, measured)),
        }
    }
}
