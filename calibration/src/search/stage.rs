//! Where a calibration is, for those who wait for it.

use std::fmt;

/// What a calibration has begun.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// The fit of the declaration with so many effects.
    Fit {
        /// How many effects it has.
        effects: usize,
    },
    /// The columns of the search, of rows that are too many to hold.
    Columns {
        /// Rows seen.
        rows: usize,
        /// Rows there are.
        of: usize,
    },
    /// The search for effects.
    Search,
    /// The contest of causes with what hangs together along the rows.
    Weigh,
    /// The search without each fold, and what it leaves there.
    HeldOut {
        /// Folds that are done.
        done: usize,
        /// Folds there are.
        of: usize,
    },
    /// The look for structure that no effect explains.
    Remaining,
}

impl fmt::Display for Stage {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fit { effects: 0 } => write!(out, "fitting the declaration"),
            Self::Fit { effects: 1 } => write!(out, "fitting the declaration with one effect"),
            Self::Fit { effects } => write!(out, "fitting the declaration with {effects} effects"),
            Self::Columns { rows, of } => write!(out, "what effects would do: row {rows} of {of}"),
            Self::Search => write!(out, "searching for what the declaration lacks"),
            Self::Weigh => write!(out, "weighing causes against what hangs together along the rows"),
            Self::HeldOut { done: 0, .. } => write!(out, "repeating the search without each fold"),
            Self::HeldOut { done, of } => {
                write!(out, "repeating the search without each fold: {done} of {of}")
            }
            Self::Remaining => write!(out, "looking for structure that remains"),
        }
    }
}
