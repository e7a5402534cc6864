//! How an effect follows what drives it.

use std::borrow::Cow;
use std::fmt;

use serde::{Serialize, Serializer};

/// How an effect follows its driver.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Dependence {
    /// Always the same.
    Constant,
    /// In proportion to the driver.
    Linear,
    /// So many periods a turn.
    Harmonic {
        /// Periods a turn.
        order: u32,
    },
    /// Another function, in a few words: `steps`.
    Described(Cow<'static, str>),
}

impl From<&'static str> for Dependence {
    fn from(words: &'static str) -> Self {
        Self::Described(Cow::Borrowed(words))
    }
}

impl From<String> for Dependence {
    fn from(words: String) -> Self {
        Self::Described(Cow::Owned(words))
    }
}

impl fmt::Display for Dependence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant => f.write_str("constant"),
            Self::Linear => f.write_str("linear"),
            Self::Harmonic { order } => write!(f, "harmonic {order}"),
            Self::Described(words) => f.write_str(words),
        }
    }
}

impl Serialize for Dependence {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
