//! Why a page gets no answer, in the words of the command.

use init::NotBegun;
use report::NotJson;
use service::Refusal;
use tables::formats::DataError;

use crate::message::Broken;

/// What is wrong, where, and what to write instead.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Refused(pub String);

macro_rules! in_its_words {
    ($($error:ty),*) => { $(impl From<$error> for Refused {
        fn from(error: $error) -> Self {
            Self(error.to_string())
        }
    })* };
}

in_its_words!(Broken, DataError, NotBegun, NotJson, Refusal, std::io::Error);
