//! Columns derived from rows in order of acquisition: direction of motion, rate, elapsed time.

use thiserror::Error;

/// A column that follows from others, as a study file writes it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Derived {
    /// `direction(joint)`: +1, −1, or 0 before the first motion; a joint at rest keeps its last direction.
    Direction {
        /// The joint's name.
        joint: String,
    },
    /// `rate(joint, time)`: change of the joint since the row before by the time that passed.
    Rate {
        /// The joint's name.
        joint: String,
        /// Name of the time column.
        time: String,
    },
    /// `elapsed(time)`: time since the first row.
    Elapsed {
        /// Name of the time column.
        time: String,
    },
}

/// Why a derived column could not be read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{text}` derives no column: write direction(joint), rate(joint, time) or elapsed(time)")]
pub struct DeriveError {
    /// What was written.
    pub text: String,
}

/// Reads `direction(beta)`, `rate(beta, time)` or `elapsed(time)`.
///
/// # Errors
/// Anything else.
pub fn parse_derived(text: &str) -> Result<Derived, DeriveError> {
    let refuse = || DeriveError { text: text.to_string() };
    let (function, rest) = text.split_once('(').ok_or_else(refuse)?;
    let inside = rest.trim_end().strip_suffix(')').ok_or_else(refuse)?;
    let arguments: Vec<&str> = inside.split(',').map(str::trim).collect();
    if arguments.iter().any(|argument| argument.is_empty()) {
        return Err(refuse());
    }
    match (function.trim(), arguments.as_slice()) {
        ("direction", [joint]) => Ok(Derived::Direction { joint: (*joint).to_string() }),
        ("rate", [joint, time]) => {
            Ok(Derived::Rate { joint: (*joint).to_string(), time: (*time).to_string() })
        }
        ("elapsed", [time]) => Ok(Derived::Elapsed { time: (*time).to_string() }),
        _ => Err(refuse()),
    }
}

/// The direction of motion at each row.
#[must_use]
pub fn direction(joint: &[f64]) -> Vec<f64> {
    let mut last = 0.0;
    let mut before = joint.first().copied();
    joint
        .iter()
        .map(|&now| {
            let change = before.map_or(0.0, |before| now - before);
            if change != 0.0 {
                last = change.signum();
            }
            before = Some(now);
            last
        })
        .collect()
}

/// The rate of change at each row: 0 at the first, and the rate before where no time passed.
#[must_use]
pub fn rate(joint: &[f64], time: &[f64]) -> Vec<f64> {
    let mut last = 0.0;
    let mut before: Option<(f64, f64)> = None;
    joint
        .iter()
        .zip(time)
        .map(|(&q, &t)| {
            if let Some((q_before, t_before)) = before
                && t != t_before
            {
                last = (q - q_before) / (t - t_before);
            }
            before = Some((q, t));
            last
        })
        .collect()
}

/// The time since the first row.
#[must_use]
pub fn elapsed(time: &[f64]) -> Vec<f64> {
    let first = time.first().copied().unwrap_or_default();
    time.iter().map(|t| t - first).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_three_functions_are_read() {
        assert_eq!(parse_derived("direction(beta)"), Ok(Derived::Direction { joint: "beta".into() }));
        assert_eq!(
            parse_derived(" rate( beta , time ) "),
            Ok(Derived::Rate { joint: "beta".into(), time: "time".into() })
        );
        assert_eq!(parse_derived("elapsed(t)"), Ok(Derived::Elapsed { time: "t".into() }));
    }

    #[test]
    fn anything_else_is_refused() {
        for text in ["", "direction", "direction()", "rate(beta)", "elapsed(t", "speed(beta)", "elapsed(a,b)"]
        {
            assert!(parse_derived(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_joint_at_rest_keeps_its_direction() {
        assert_eq!(direction(&[1.0, 1.0, 2.0, 2.0, 1.5]), [0.0, 0.0, 1.0, 1.0, -1.0]);
        assert!(direction(&[]).is_empty());
    }

    #[test]
    fn rate_is_change_by_time() {
        assert_eq!(rate(&[0.0, 1.0, 5.0, 4.0], &[0.0, 2.0, 2.0, 4.0]), [0.0, 0.5, 0.5, -0.5]);
        assert_eq!(elapsed(&[5.0, 7.0]), [0.0, 2.0]);
    }
}
