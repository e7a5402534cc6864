//! Whether anything is told at all: the catalogue's effects and open functions against set-ups, wandering and a memory of the noise, by one likelihood.
//!
//! A search that takes rows for independent finds effects in whatever hangs together along the rows: sessions that were levelled
//! anew, a slow drift. The contest of [`evidence`] weighs both. Where it tells no cause, none is told. Where the search found
//! nothing, since the noise took what an effect does, the causes that the contest tells are taken up.

mod problem;

use evidence::families::Law;
use evidence::{Policy, contest};

use crate::search::SearchError;
use crate::search::context::{Context, Found};
use crate::search::fitted::Fitted;
use problem::Asked;
use study::Undeclared;

/// Values that a contest reads at most: its time grows with them.
const MOST_VALUES: usize = 4_000;

/// Log odds below which two causes are one to the data.
const EVEN: f64 = 0.05;

/// What a contest tells.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Told {
    /// Causes that the catalogue has a name for.
    pub causes: Vec<Found>,
    /// Whether a function is told that the catalogue has no name for.
    pub is_open: bool,
    /// Whether rows remember the row before, or wander along their order.
    pub remembers: bool,
    /// Set-ups that the rows fall into; one where they show no more.
    pub setups: usize,
    /// A column that the study does not name, whose values say which rows belong together.
    pub column: Option<String>,
}

impl Told {
    /// Whether no cause is told.
    pub fn is_nothing(&self) -> bool {
        self.causes.is_empty() && !self.is_open
    }

    /// Whether rows hang together along their order, or by a column.
    pub fn hangs_together(&self) -> bool {
        self.remembers || self.setups > 1 || self.column.is_some()
    }
}

/// Whether a contest is asked: rows of one kind at exact readings, with nothing unknown behind them.
pub(crate) fn is_asked(whole: &Context<'_>) -> bool {
    let (observations, plan) = (whole.request.observations, whole.request.plan);
    observations.unknowns.is_none()
        && observations.poses.series.len() == 1
        && observations.reading_sigma.is_empty()
        && observations.poses.components() <= MOST_VALUES
        && !plan.fit.anchored
        && plan.search.only.is_empty()
}

/// What a contest at a fit tells; `None` where there is nothing to weigh: no residual, or no freedom.
///
/// A column of the file that the study does not name may say which rows belong together. Where a cause is told, each is asked
/// whether its values explain the rows better.
pub(crate) fn told(whole: &Context<'_>, fitted: &Fitted) -> Result<Option<Told>, SearchError> {
    let mut asked = problem::asked(whole, fitted)?;
    let Some((mut odds, mut best)) = of(&asked) else { return Ok(None) };
    if best.is_nothing() {
        return Ok(Some(best));
    }
    let sample = whole.request.sample;
    let undeclared = sample.map_or_else(Vec::new, |sample| sample.undeclared(whole.request.observations));
    let price = (undeclared.len() as f64).ln();
    for Undeclared { column, of_row } in undeclared {
        asked.problem.rows.labels = Some(of_row);
        if let Some((other, told)) = of(&asked).filter(|(other, _)| other - price > odds) {
            odds = other - price;
            best = Told { column: Some(column), ..told };
        }
    }
    Ok(Some(best))
}

/// What one contest tells, and its log odds.
fn of(asked: &Asked) -> Option<(f64, Told)> {
    let policy = Policy::default();
    let outcome = contest(&asked.problem, &policy, None).ok()?;
    let effect = |family: usize| match outcome.families()[family].law {
        Law::Offered(number) => Some(asked.effects[number]),
        _ => None,
    };
    let named = outcome.findings().iter().filter(|finding| finding.named);
    let mut told = Told {
        remembers: outcome.memory().is_some() || !outcome.noise().is_empty(),
        setups: outcome.cuts().len() + 1,
        ..Told::default()
    };
    for finding in named {
        let offered = || finding.set.iter().filter_map(|&(family, score)| Some((effect(family)?, score)));
        let best = offered().map(|(_, score)| score).fold(f64::NEG_INFINITY, f64::max);
        // Of causes that are one to the data the first of the catalogue stands for all.
        let even = offered().filter(|(_, score)| *score >= best - EVEN);
        let Some(first) = even.map(|(effect, _)| effect).min() else {
            told.is_open = true;
            continue;
        };
        let p_value = (-finding.margin).exp().min(1.0);
        if told.causes.iter().all(|found| found.effect != first) {
            told.causes.push(Found { effect: first, p_value, alike: vec![first] });
        }
    }
    Some((outcome.odds(), told))
}
