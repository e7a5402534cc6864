//! Why the declaration cannot be fitted to the data, or the residual not be searched.

use super::ProblemError;
use fit::FitError;

/// Why there is no search.
#[derive(Debug, thiserror::Error)]
pub enum SearchError {
    /// The study asks for something that cannot be fitted.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// An effect that the study allows is none of the catalogue's; reading the study should have said so.
    #[error("internal error: the catalogue has no effect `{name}`, which the study allows")]
    NoSuchEffect {
        /// Its name.
        name: String,
    },
    /// The data lead to numbers that cannot be searched.
    #[error(transparent)]
    Problem(#[from] ProblemError),
}
