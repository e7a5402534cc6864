//! The numbers that decide what is told, each with its meaning and source.

use evidence::Policy;
use evidence::policy::Threshold;

use crate::contest::policy;
use crate::diagnose::Diagnosis;
use crate::{limits, misread};

/// The thresholds of a contest, at the rate of false alarms that a study asks for unless it says so.
#[must_use]
pub fn of_contests() -> Vec<Threshold> {
    Policy::default().table()
}

/// The thresholds by which a column is called misread, or a value implausible.
#[must_use]
pub fn of_misread() -> &'static [Threshold] {
    misread::THRESHOLDS
}

/// The thresholds by which held-out rows judge a model.
#[must_use]
pub fn of_held_out() -> &'static [Threshold] {
    limits::THRESHOLDS
}

/// Those that decided what a diagnosis tells: of misread columns always, of held-out rows after a search, of a contest where one was held.
#[must_use]
pub fn decided(diagnosis: &Diagnosis) -> Vec<Threshold> {
    let searched = diagnosis.search.as_ref();
    let held_out: &[Threshold] = if searched.is_some() { of_held_out() } else { &[] };
    let contest = searched.filter(|_| !diagnosis.contest.is_empty());
    let contest = contest.map_or_else(Vec::new, |search| policy(search.false_alarm).table());
    [of_misread(), held_out].concat().into_iter().chain(contest).collect()
}
