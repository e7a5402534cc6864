//! The date of today, for the evidence in an amended declaration.

use std::time::{SystemTime, UNIX_EPOCH};

use chrono::{DateTime, NaiveDate};

/// Today in universal time, as `2026-11-21`; the variable `SOURCE_DATE_EPOCH` (seconds since 1970) overrides the
/// clock, so that a run can be repeated to the byte.
#[must_use]
pub fn today() -> String {
    let stated = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|seconds| seconds.parse().ok());
    let by_clock =
        || SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs().cast_signed());
    let date = |seconds| Some(DateTime::from_timestamp(seconds, 0)?.date_naive().to_string());
    // A year that the calendar does not have is no statement.
    stated.and_then(date).or_else(|| date(by_clock())).unwrap_or_default()
}

/// A day as an argument names it.
///
/// # Errors
/// It is none.
pub fn day(text: &str) -> Result<String, String> {
    let day = NaiveDate::parse_from_str(text, "%Y-%m-%d");
    let day = day.ok().map(|day| day.to_string()).filter(|day| day.len() == "2027-06-30".len());
    day.ok_or_else(|| "write a day, as 2027-06-30".to_owned())
}
