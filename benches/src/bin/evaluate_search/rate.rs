//! Rates, how well so many runs determine them, and one line of the table.

use std::time::Duration;

/// How often something happened.
#[derive(Debug, Clone, Copy, Default)]
pub struct Rate {
    pub hits: usize,
    pub runs: usize,
}

impl Rate {
    /// Counts what is true.
    pub fn of(outcomes: impl IntoIterator<Item = bool>) -> Self {
        outcomes.into_iter().fold(Self::default(), |rate, hit| Self {
            hits: rate.hits + usize::from(hit),
            runs: rate.runs + 1,
        })
    }

    /// The share.
    pub fn share(self) -> f64 {
        self.hits as f64 / self.runs.max(1) as f64
    }

    /// Half the width of the 95 % interval.
    ///
    /// Source: E. B. Wilson, Probable inference, the law of succession, and statistical inference, Journal of the
    /// American Statistical Association 22 (1927).
    pub fn half_width(self) -> f64 {
        let (n, p, z) = (self.runs.max(1) as f64, self.share(), 1.96_f64);
        z / (1.0 + z * z / n) * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt()
    }
}

impl std::fmt::Display for Rate {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.3} ± {:.3}", self.share(), self.half_width())
    }
}

/// What a figure must be.
#[derive(Debug, Clone, Copy)]
pub enum Target {
    AtLeast(f64),
    AtMost(f64),
    Within(f64, f64),
    /// Reported only.
    None,
}

impl Target {
    fn met(self, value: f64) -> Option<bool> {
        match self {
            Self::AtLeast(least) => Some(value >= least),
            Self::AtMost(most) => Some(value <= most),
            Self::Within(middle, either) => Some((value - middle).abs() <= either),
            Self::None => None,
        }
    }
}

impl std::fmt::Display for Target {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::AtLeast(least) => write!(f, "≥ {least}"),
            Self::AtMost(most) => write!(f, "≤ {most}"),
            Self::Within(middle, either) => write!(f, "{middle} ± {either}"),
            Self::None => Ok(()),
        }
    }
}

/// One line of the table.
#[derive(Debug, Clone)]
pub struct Line {
    pub what: String,
    /// `linear` or `whole`.
    pub through: &'static str,
    pub target: Target,
    pub value: f64,
    /// The value with its uncertainty.
    pub shown: String,
    pub runs: usize,
    pub seed: u64,
    /// Wall time of all runs of the case that the line comes from.
    pub took: Duration,
}

impl Line {
    /// `yes`, `no`, or nothing where there is no target.
    pub fn met(&self) -> &'static str {
        match self.target.met(self.value) {
            Some(true) => "yes",
            Some(false) => "**no**",
            None => "",
        }
    }
}
