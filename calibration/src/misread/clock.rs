//! Turns that a wrong clock makes: the sky turns by 15 degrees an hour.

use serde::Serialize;

use super::policy::CLOCK_RAD;
use super::prior::indexed;
use fit::FitResult;
use observe::Observations;
use study::Plan;

/// How far the sky turns in an hour, rad.
pub(super) const RAD_AN_HOUR: f64 = std::f64::consts::PI / 12.0;

/// The key of an hour angle in `[observed]`.
const HOUR_ANGLE: &str = "ha";

/// The whole hours in which the sky turns by an angle; `None` where there are none.
pub(super) fn whole_hours(angle_rad: f64) -> Option<u8> {
    let hours = (angle_rad.abs() / RAD_AN_HOUR).round();
    let is_whole = (1.0..=12.0).contains(&hours) && (angle_rad.abs() - hours * RAD_AN_HOUR).abs() < CLOCK_RAD;
    is_whole.then_some(hours as u8)
}

/// A zero of a joint that a clock explains as well: observed hour angles are those of another hour.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ByTheClock {
    /// The error that is the joint's zero.
    pub error: String,
    /// Its value, rad.
    pub value_rad: f64,
    /// The whole hours in which the sky turns by as much.
    pub hours: u8,
}

/// The first zero of a joint that whole hours explain, where hour angles were observed.
pub(crate) fn by_the_clock(plan: &Plan, observations: &Observations, fit: &FitResult) -> Option<ByTheClock> {
    let of_hours = |source: usize| plan.has_observed_key(source, HOUR_ANGLE);
    if !(0..plan.sources.len()).any(of_hours) {
        return None;
    }
    indexed(plan, observations).into_iter().find_map(|(_, index)| {
        let value_rad = fit.values[index.index()];
        let hours = whole_hours(value_rad)?;
        Some(ByTheClock { error: plan.chain.symbol(index).name.clone(), value_rad, hours })
    })
}
