//! How a fit ended, as the report has it.

use serde::Serialize;

use fit::{Outcome, Reason};

/// How a fit ended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(tag = "how")]
pub enum Ended {
    /// At a minimum.
    #[serde(rename = "converged")]
    Converged {
        /// Steps taken.
        steps: usize,
    },
    /// Short of a minimum.
    #[serde(rename = "not converged")]
    NotConverged {
        /// Steps taken.
        steps: usize,
    },
    /// At a minimum from which nothing is near what was measured: directions, or objects whose places nobody knows.
    #[serde(rename = "far off")]
    FarOff {
        /// Steps taken.
        steps: usize,
    },
    /// At a minimum where most rows lie so far from the rest that too few are left.
    #[serde(rename = "no rest")]
    NoRest {
        /// Steps taken.
        steps: usize,
    },
    /// With fewer residual components than it takes to determine what was asked for.
    #[serde(rename = "too few observations")]
    TooFewObservations {
        /// Residual components there are.
        components: usize,
        /// What was to be estimated.
        parameters: usize,
        /// Numbers of objects and stations that are estimated beside that.
        of_objects: usize,
    },
}

impl From<&Outcome> for Ended {
    fn from(outcome: &Outcome) -> Self {
        match *outcome {
            Outcome::Converged { iterations } => Self::Converged { steps: iterations },
            Outcome::NotConverged { iterations, reason: Reason::FarOff } => {
                Self::FarOff { steps: iterations }
            }
            Outcome::NotConverged { iterations, reason: Reason::NoRest } => {
                Self::NoRest { steps: iterations }
            }
            Outcome::NotConverged { iterations, .. } => Self::NotConverged { steps: iterations },
            Outcome::TooFewObservations { components, parameters, of_objects, .. } => {
                Self::TooFewObservations { components, parameters, of_objects }
            }
        }
    }
}
