//! What explains a residual: the catalogue's effects and open functions against set-ups, wandering and a memory of the noise, by one likelihood.
//!
//! A search that takes rows for independent finds effects in whatever hangs together along the rows: sessions that were levelled
//! anew, a slow drift. The contest of [`evidence`] weighs both. Where effects of the catalogue explain all that there is, it decides
//! which. Where it tells no cause, none is told.

mod problem;
mod recorded;

pub use recorded::Hypothesis;
use recorded::leader;

use evidence::families::{Family, Law};
use evidence::{Contenders, Outcome, Places, Policy, Problem, contest, contest_among};

use crate::search::SearchError;
use crate::search::context::{Context, Found};
use crate::search::fitted::Fitted;
use crate::search::round::Explains;
use effects::candidate::EffectId;
use problem::Asked;
use study::Undeclared;

/// Values that a contest reads at most: its time grows with them.
const MOST_VALUES: usize = 4_000;

/// What a contest tells.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Told {
    /// Causes that the catalogue has a name for.
    pub causes: Vec<Found>,
    /// Whether a function is told that the catalogue has no name for.
    pub is_open: bool,
    /// Whether more may be there than a contest takes up.
    pub is_full: bool,
    /// Whether rows remember the row before, or wander along their order.
    pub remembers: bool,
    /// Set-ups that the rows fall into; one where they show no more.
    pub setups: usize,
    /// A column that the study does not name, whose values say which rows belong together.
    pub column: Option<String>,
    /// The set-up of each row, where the rows show some that nobody declared.
    pub labels: Option<Vec<u32>>,
    /// Who competed.
    pub contest: Vec<Hypothesis>,
    /// Who competes again where the contest is repeated.
    pub again: Option<Contenders>,
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

    /// Whether it decides which causes there are: it tells none, or causes that the catalogue has a name for explain all that there is.
    pub fn decides(&self) -> bool {
        !self.is_open && !self.is_full && (self.causes.is_empty() || !self.hangs_together())
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

/// What a contest decides by where a study asks for a rate of false alarms.
pub(crate) fn policy(false_alarm: f64) -> Policy {
    let mut policy = Policy::default();
    // False alarms fall as odds rise, by as much at least.
    policy.name_margin += (policy.margin_at / false_alarm).ln().max(0.0);
    policy
}

/// A contest at a fit.
pub(crate) struct Contest {
    asked: Asked,
    policy: Policy,
}

impl Contest {
    /// At a fit of the declaration, or of the declaration with effects.
    pub fn at(whole: &Context<'_>, fitted: &Fitted) -> Result<Self, SearchError> {
        let policy = policy(whole.options.false_alarm);
        Ok(Self { asked: problem::asked(whole, fitted)?, policy })
    }

    /// What it tells; `None` where there is nothing to weigh: no residual, or no freedom.
    ///
    /// A column of the file that the study does not name may say which rows belong together. Where a cause is told, each is asked
    /// whether its values explain the rows better.
    pub fn told(&self, whole: &Context<'_>) -> Option<Told> {
        let own = self.of(&self.asked.problem)?;
        let read = self.read(&own);
        let is_alone = read.is_nothing() && !read.hangs_together();
        let labelled = if is_alone { Vec::new() } else { self.labelled(whole) };
        let price = (labelled.len() as f64).ln();
        let (mut odds, mut best, mut by) = (own.odds(), own, None);
        for (column, problem) in &labelled {
            if let Some(other) = self.of(problem).filter(|other| other.odds() - price > odds) {
                (odds, best, by) = (other.odds() - price, other, Some(column.clone()));
            }
        }
        let contest = recorded::recorded(&best, self.policy.even);
        let read = self.read(&best);
        let of_column = labelled.iter().find(|(column, _)| Some(column) == by.as_ref());
        let of_column = of_column.and_then(|(_, problem)| problem.rows.labels.as_ref());
        let labels = match of_column {
            Some(of_row) => Some(of_row.iter().map(|&label| label as u32).collect()),
            None => (read.setups > 1).then(|| of_setups(best.cuts(), self.asked.problem.rows.count)),
        };
        Some(Told { column: by, labels, contest, again: Some(best.contenders()), ..read })
    }

    /// The problem with rows labelled by each column that the study does not name; none where they have labels.
    fn labelled(&self, whole: &Context<'_>) -> Vec<(String, Problem)> {
        let sample = whole.request.sample.filter(|_| self.asked.problem.rows.labels.is_none());
        let undeclared = sample.map_or_else(Vec::new, |sample| sample.undeclared(whole.request.observations));
        let labelled = |Undeclared { column, of_row }| {
            let mut problem = self.asked.problem.clone();
            problem.rows.labels = Some(of_row);
            (column, problem)
        };
        undeclared.into_iter().map(labelled).collect()
    }

    fn of<'p>(&'p self, problem: &'p Problem) -> Option<Outcome<'p>> {
        contest(problem, &self.policy, None).ok()
    }

    /// What an outcome tells.
    fn read(&self, outcome: &Outcome<'_>) -> Told {
        let law = |family: usize| outcome.families()[family].law;
        let effect = |family: usize| match law(family) {
            Law::Offered(number) => Some(self.asked.effects[number]),
            _ => None,
        };
        let noise = outcome.noise();
        let is_stretched = noise.iter().any(|&family| matches!(law(family), Law::Setups(_)));
        let mut told = Told {
            is_full: outcome.active().len() as f64 >= self.policy.most_active,
            remembers: outcome.memory().is_some() || !noise.is_empty(),
            setups: if is_stretched { outcome.cuts().len() + 1 } else { 1 },
            ..Told::default()
        };
        for finding in outcome.findings().iter().filter(|finding| finding.named) {
            let leader = leader(outcome, finding, self.policy.even);
            let Some(first) = leader.and_then(effect) else {
                told.is_open = true;
                continue;
            };
            let p_value = (-finding.margin).exp().min(1.0);
            if told.causes.iter().all(|found| found.effect != first) {
                let shares = finding.set.iter().zip(&finding.shares);
                let shares =
                    shares.filter_map(|((family, _), share)| Some((effect(*family)?, *share))).collect();
                told.causes.push(Found { effect: first, p_value, alike: vec![first], shares });
            }
        }
        told
    }
}

/// The set-up of each row, by the first row of each but the first.
fn of_setups(cuts: &[usize], rows: usize) -> Vec<u32> {
    (0..rows).map(|row| cuts.partition_point(|&cut| cut <= row) as u32).collect()
}

/// A contest that is repeated on some of its rows, among those who gained something of all.
pub(crate) struct Repeated {
    pub contest: Contest,
    pub among: Contenders,
}

impl Explains for Repeated {
    fn of_rows(&self, stay: &[bool]) -> Vec<EffectId> {
        let Self { contest, among } = self;
        let some = contest.asked.problem.of_rows(stay);
        let lets = |family: &Family, places: &Places| among.has(family, places);
        let Ok(outcome) = contest_among(&some, &contest.policy, None, &lets) else { return Vec::new() };
        contest.read(&outcome).causes.iter().map(|found| found.effect).collect()
    }
}
