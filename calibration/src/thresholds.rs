//! The numbers that decide what is told, each with its meaning and source.

use evidence::Policy;
use evidence::policy::Threshold;

use crate::contest::policy;
use crate::diagnose::Diagnosis;
use crate::misread::THRESHOLDS;

/// The thresholds of a contest, at the rate of false alarms that a study asks for unless it says so.
#[must_use]
pub fn of_contests() -> Vec<Threshold> {
    Policy::default().table()
}

/// The thresholds by which a column is called misread, or a value implausible.
#[must_use]
pub fn of_misread() -> &'static [Threshold] {
    THRESHOLDS
}

/// Those that decided what a diagnosis tells: of misread columns always, of a contest where one was held.
#[must_use]
pub fn decided(diagnosis: &Diagnosis) -> Vec<Threshold> {
    let searched = diagnosis.search.as_ref().filter(|_| !diagnosis.contest.is_empty());
    let contest = searched.map_or_else(Vec::new, |search| policy(search.false_alarm).table());
    THRESHOLDS.iter().copied().chain(contest).collect()
}
