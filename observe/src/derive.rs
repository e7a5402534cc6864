//! Columns derived from others: direction of motion, rate, elapsed time, turns, face, and functions of a range.

use std::f64::consts::{FRAC_PI_2, TAU};

use model_core::Quantity;
use thiserror::Error;

use tables::units;

/// A column that follows from others, as a study file writes it.
#[derive(Debug, Clone, PartialEq)]
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
    /// `turns(joint)`: how many whole turns the reading lies above zero.
    Turns {
        /// The joint's name.
        joint: String,
    },
    /// `face(joint)`: +1 where the joint is within a quarter turn of zero, −1 where it has been turned through.
    Face {
        /// The joint's name.
        joint: String,
    },
    /// `is(column, number)`: 1 in the rows that hold the number, 0 in the others; for sessions.
    Is {
        /// The column's name.
        column: String,
        /// The number.
        number: f64,
    },
    /// `phase(range, 0.6 m)`: an angle that turns once over the distance.
    Phase {
        /// Name of the range.
        range: String,
        /// The distance, m.
        wavelength_m: f64,
    },
    /// `inverse(range)`: one over it.
    Inverse {
        /// Name of the range.
        range: String,
    },
}

/// Why a derived column could not be read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "`{text}` derives no column: write direction(joint), rate(joint, time), elapsed(time), turns(joint), face(joint), \
     is(column, number), phase(range, distance) or inverse(range)"
)]
pub struct DeriveError {
    /// What was written.
    pub text: String,
}

/// Reads `direction(beta)`, `rate(beta, time)` and the like.
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
    let own = |name: &str| name.to_string();
    match (function.trim(), arguments.as_slice()) {
        ("direction", [joint]) => Ok(Derived::Direction { joint: own(joint) }),
        ("rate", [joint, time]) => Ok(Derived::Rate { joint: own(joint), time: own(time) }),
        ("elapsed", [time]) => Ok(Derived::Elapsed { time: own(time) }),
        ("turns", [joint]) => Ok(Derived::Turns { joint: own(joint) }),
        ("face", [joint]) => Ok(Derived::Face { joint: own(joint) }),
        ("is", [column, number]) => {
            let number = number.parse().ok().filter(|number: &f64| number.is_finite()).ok_or_else(refuse)?;
            Ok(Derived::Is { column: own(column), number })
        }
        ("phase", [range, distance]) => {
            let wavelength_m = units::parse(distance, Quantity::Length).map_err(|_| refuse())?;
            let positive = wavelength_m > 0.0;
            positive.then(|| Derived::Phase { range: own(range), wavelength_m }).ok_or_else(refuse)
        }
        ("inverse", [range]) => Ok(Derived::Inverse { range: own(range) }),
        _ => Err(refuse()),
    }
}

impl Derived {
    /// The columns that it follows from.
    #[must_use]
    pub fn columns(&self) -> Vec<&str> {
        match self {
            Self::Direction { joint } | Self::Turns { joint } | Self::Face { joint } => vec![joint],
            Self::Rate { joint, time } => vec![joint, time],
            Self::Elapsed { time } => vec![time],
            Self::Is { column, .. } => vec![column],
            Self::Phase { range, .. } | Self::Inverse { range } => vec![range],
        }
    }

    /// The one among them that says when a row was taken.
    #[must_use]
    pub fn time(&self) -> Option<&str> {
        match self {
            Self::Rate { time, .. } | Self::Elapsed { time } => Some(time),
            _ => None,
        }
    }

    /// Whether its value in a row depends on the rows before.
    #[must_use]
    pub fn follows_rows(&self) -> bool {
        matches!(self, Self::Direction { .. } | Self::Rate { .. } | Self::Elapsed { .. })
    }

    /// What it measures.
    #[must_use]
    pub fn quantity(&self) -> Quantity {
        if matches!(self, Self::Phase { .. }) { Quantity::Angle } else { Quantity::Number }
    }

    /// Its value at each row, SI; `None` if a column that it follows from is not there.
    pub fn values(&self, column: impl Fn(&str) -> Option<Vec<f64>>) -> Option<Vec<f64>> {
        let each = |name: &str, f: &dyn Fn(f64) -> f64| Some(column(name)?.into_iter().map(f).collect());
        match self {
            Self::Direction { joint } => Some(direction(&column(joint)?)),
            Self::Rate { joint, time } => Some(rate(&column(joint)?, &column(time)?)),
            Self::Elapsed { time } => Some(elapsed(&column(time)?)),
            Self::Turns { joint } => each(joint, &|q| (q / TAU).floor()),
            Self::Face { joint } => {
                each(joint, &|q| if (q - TAU * (q / TAU).round()).abs() <= FRAC_PI_2 { 1.0 } else { -1.0 })
            }
            Self::Is { column, number } => each(column, &|value| if value == *number { 1.0 } else { 0.0 }),
            Self::Phase { range, wavelength_m } => each(range, &|r| TAU * (r / wavelength_m).fract()),
            Self::Inverse { range } => each(range, &|r| 1.0 / r),
        }
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
#[allow(clippy::expect_used)]
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
    fn functions_of_one_column_are_read_and_evaluated() {
        let column = |name: &str| (name == "q").then(|| vec![-0.1, 1.0, 2.0, 6.4]);
        let values = |text: &str| parse_derived(text).ok().and_then(|derived| derived.values(column));
        assert_eq!(values("turns(q)"), Some(vec![-1.0, 0.0, 0.0, 1.0]));
        assert_eq!(values("face(q)"), Some(vec![1.0, 1.0, -1.0, 1.0]));
        assert_eq!(values("is(q, 2)"), Some(vec![0.0, 0.0, 1.0, 0.0]));
        assert_eq!(values("inverse(q)"), Some(vec![-10.0, 1.0, 0.5, 1.0 / 6.4]));
        let phase = values("phase(q, 4 m)").expect("a column");
        assert!((phase[1] - FRAC_PI_2).abs() < 1e-15, "{phase:?}");
        assert_eq!(values("turns(p)"), None);
    }

    #[test]
    fn anything_else_is_refused() {
        for text in [
            "",
            "direction",
            "direction()",
            "rate(beta)",
            "elapsed(t",
            "speed(beta)",
            "elapsed(a,b)",
            "is(a, b)",
            "phase(r)",
            "phase(r, 3 deg)",
            "phase(r, -1 m)",
        ] {
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
