//! What can be wrong with a problem, with its place and what to give instead.

/// Why a contest cannot begin or go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// There are no rows or no components.
    #[error("the problem has no rows with components; give at least one")]
    Empty,
    /// A list has another length than the rows ask for.
    #[error("{what} has {found} values where {wanted} are needed; give one for each row (and component)")]
    Length {
        /// The list.
        what: String,
        /// Its length.
        found: usize,
        /// The length that it must have.
        wanted: usize,
    },
    /// A value is not a finite number.
    #[error("{what} has the value {value} at position {at}; leave this row out or mend the value")]
    NotFinite {
        /// The list.
        what: String,
        /// Counted from zero.
        at: usize,
        /// The value.
        value: f64,
    },
    /// A stated uncertainty is not positive.
    #[error("the stated uncertainty at position {at} is {value}; it must be greater than zero")]
    Sigma {
        /// Counted from zero.
        at: usize,
        /// The value.
        value: f64,
    },
    /// A reference to a joint, frame or place that there is not.
    #[error("{what} refers to number {index} of {of}, and there are only {count}; name one that is listed")]
    Reference {
        /// What refers.
        what: String,
        /// The number that it refers to.
        index: usize,
        /// The kind of list.
        of: &'static str,
        /// Length of the list.
        count: usize,
    },
    /// The declared errors leave no degree of freedom.
    #[error(
        "{values} measured values and {rank} estimable errors leave nothing to judge by; measure more rows"
    )]
    NoFreedom {
        /// Measured values.
        values: usize,
        /// Estimable combinations of declared errors.
        rank: usize,
    },
    /// The residual is zero in every row.
    #[error("every residual is zero, so that there is no noise to compare with; give measured values")]
    NoNoise,
    /// The caller could not evaluate the chain at a point that the contest asked for.
    #[error("the chain could not be evaluated at the estimates: {reason}")]
    Linearise {
        /// The caller's reason.
        reason: String,
    },
}
