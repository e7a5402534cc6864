//! The numbers by which a check decides, each with its source.

/// Poses over the region at which changes are looked at, and what counts as observed: as in a comparison.
pub use crate::sensitivity::{OBSERVED, POSES};

/// The share of checks of an unchanged instrument that end with RECALIBRATE, unless somebody asks for another.
///
/// Source: convention; R. A. Fisher, Statistical Methods for Research Workers (1925), section 12.
pub const FALSE_ALARM: f64 = 0.05;

/// The chance with which rows must show a change as large as the goal, so that their silence means something.
///
/// Source: J. Cohen, Statistical Power Analysis for the Behavioral Sciences, 2nd ed. (1988), section 2.4.
pub const POWER: f64 = 0.8;

/// A change is below the goal where its one-sided limit of this chance is.
///
/// Source: the same convention as [`FALSE_ALARM`], as a test of equivalence: D. J. Schuirmann, Journal of Pharmacokinetics and
/// Biopharmaceutics 15 (1987) 657–680.
pub const BELOW_GOAL: f64 = 0.95;

/// Residuals so many times the goal are those of a misread column, not of an instrument that moved.
///
/// Source: a wrong unit, sign or offset of a column makes residuals of degrees. Hundreds of times any goal in arc seconds; a clamp that slips
/// makes minutes.
pub const MISREAD: f64 = 100.0;

/// An error explains rows as well as the best one where its gain is less by no more than this.
///
/// Source: a likelihood ratio of e², as in A. W. F. Edwards, Likelihood (1972), section 5.4: two units of support.
pub const AS_WELL: f64 = 4.0;

/// Poses of the region that are tried as rows to add.
///
/// Source: half of [`POSES`]: a finer grid moves the proposed rows by less than a twelfth of each range.
pub const CANDIDATES: usize = 256;

/// Rows that are proposed at most.
///
/// Source: twice the ten rows that a check is made of; who needs more had better calibrate.
pub const MOST_ADDED: usize = 20;
