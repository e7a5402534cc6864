//! Misread columns: units, packed notation, signs, zeros, exchanged columns and shifted rows compete with the study's own reading of the data,
//! before any effect does.
//!
//! Each hypothesis (`hypotheses`, one file a kind) reads some rows otherwise. All are compared by one likelihood of the numbers as the
//! file has them (`score`), with a prior on the errors of the declaration (`prior`). One that wins by the margin of `policy` is told.

mod clock;
mod frame;
mod hypotheses;
mod policy;
mod prior;
mod scaled;
mod score;
mod size;
mod states;
mod stations;
mod trial;

use model_core::SymbolId;
use serde::Serialize;

use observe::SiUnit;
use study::{Plan, Sample};

pub use clock::ByTheClock;
pub(crate) use clock::by_the_clock;
use hypotheses::Written;
pub use hypotheses::{Heading, Line, Reading, StatedPlaces};
pub use policy::THRESHOLDS;
use policy::{
    CLEARED, MARGIN, MOST_RESIDUAL_SHARE, ONE_OF, RATIO, RATIO_ROWS, ROUGH_SHARE, SAME, STATES_MARGIN,
    STATES_RATIO, STATES_RATIO_FEW, STATES_ROWS,
};
pub use prior::{Implausible, implausible};
use score::Score;
pub use stations::Strayed;
pub(crate) use stations::strayed;
use trial::{Trial, Tried};

/// A column that is not what the study says.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Misread {
    /// What explains the data: the best first; of several, these data do not say which.
    pub readings: Vec<Suspect>,
    /// RMS of the residual as the study reads the data, SI.
    pub before: f64,
    /// The same with the first reading, SI.
    pub after: f64,
    /// Their unit.
    pub unit: SiUnit,
    /// What is implausible of the study's own reading, where that leaves as small a residual.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub needs: Option<Implausible>,
    /// Logarithm of how much better the first explains the data, prices and priors counted.
    pub margin: f64,
}

/// A reading that explains the data.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Suspect {
    /// What is read otherwise.
    pub reading: Reading,
    /// What to write into the study.
    pub lines: Vec<Line>,
    /// Headings of the file that state a unit in which their columns are not: no study can state another.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub headings: Vec<Heading>,
    /// Its score against that of the study's own reading.
    pub score: f64,
}

/// What the rows of a study say of how they are read.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Judgement {
    /// The misread columns; none where the study's own reading is not beaten.
    pub misread: Option<Misread>,
    /// Errors from which the study's own reading fits clearly better than from where the study starts.
    pub start: Option<Vec<f64>>,
}

/// How the columns of a study are read, judged on some of its rows, and the places that it states of objects and stations.
#[must_use]
pub fn judged(plan: &Plan, sample: &Sample) -> Judgement {
    judgement(plan, sample).unwrap_or_default()
}

fn judgement(plan: &Plan, sample: &Sample) -> Option<Judgement> {
    let trial = Trial::new(plan, sample)?;
    let mut as_read = trial.as_read()?;
    // Where objects take up what is misread, a fit shows it: the others cost too much to be asked of every file.
    if trial.own.unknowns.is_some() && !as_read.is_off(ROUGH_SHARE) {
        return None;
    }
    let mut readings = trial.others(&as_read);
    let best = readings.first()?;
    let mut start = None;
    if best.score.total - as_read.total >= MARGIN {
        let elsewhere = trial.as_read_elsewhere(best, &as_read).filter(|other| other.total > as_read.total);
        if let Some(other) = elsewhere {
            let errors = &other.values[..plan.chain.symbols.len()];
            start = (other.total - as_read.total >= MARGIN).then(|| errors.to_vec());
            as_read = other;
        }
    }
    let margin = best.score.total - as_read.total;
    let top = best.score.total;
    readings.retain(|tried| explains(&trial, tried, &as_read));
    // A scale that is off is an effect, and no misread column.
    let is_no_scale = |_: &Misread| scaled::total(&trial).is_none_or(|scaled| top - scaled >= MARGIN);
    let misread = told(&trial, readings, &as_read, margin).filter(is_no_scale);
    Some(Judgement { start: start.filter(|_| misread.is_none()), misread })
}

/// The readings that explain the data as well as the best of them; none where none does.
fn told(trial: &Trial<'_>, mut readings: Vec<Tried>, as_read: &Score, margin: f64) -> Option<Misread> {
    let top = readings.first()?.score.total;
    readings.retain(|tried| top - tried.score.total <= ONE_OF);
    let after = readings.first()?.score.rms;
    let needs = (after > RATIO * as_read.rms).then(|| trial.beyond(as_read)).flatten();
    let suspects = readings.into_iter().map(|Tried { hypothesis, score, .. }| Suspect {
        reading: hypothesis.reading,
        lines: hypothesis.lines.iter().map(Written::line).collect(),
        headings: hypothesis.headings,
        score: score.total - as_read.total,
    });
    Some(Misread {
        readings: suspects.collect(),
        before: as_read.rms,
        after,
        needs,
        unit: trial.own.poses.series.first()?.measure.unit(),
        margin,
    })
}

/// Whether a reading explains what another, the study's own or a simpler one, does not. What only rounding leaves there is nothing to
/// explain of.
fn explains(trial: &Trial<'_>, tried: &Tried, as_read: &Score) -> bool {
    let rounding = trial.rounding;
    let Tried { hypothesis, score, .. } = tried;
    let mut ratio = if as_read.rms > rounding { score.scale / as_read.scale } else { 1.0 };
    if trial.own.unknowns.is_some() {
        // Unknown objects take up rows until a robust scale shows nothing.
        ratio = ratio.min(score.relative() / as_read.relative());
    }
    let is_gross = match &hypothesis.reading {
        Reading::Shifted { .. } => ratio <= RATIO_ROWS,
        Reading::Packed { .. } => ratio <= SAME && hypothesis.digits > 0.0,
        Reading::TwoStates { .. } => {
            let most = if (trial.own.rows() as f64) < STATES_ROWS { STATES_RATIO_FEW } else { STATES_RATIO };
            as_read.rms > rounding && ratio.min(score.rms / as_read.rms) <= most
        }
        // A robust scale hides a minority of rows.
        Reading::FromRow { .. } => as_read.rms > rounding && ratio.min(score.rms / as_read.rms) <= RATIO,
        _ => {
            let is_cleared = as_read.penalty - score.penalty > CLEARED && ratio <= SAME;
            // A smaller unit of joints and of what was observed makes every error smaller, and explains nothing.
            let [any, all] = trial.changes_joints(hypothesis);
            ratio <= RATIO || (is_cleared && (all || !any))
        }
    };
    let margin = if matches!(hypothesis.reading, Reading::TwoStates { .. }) { STATES_MARGIN } else { MARGIN };
    // What needs too large an error or leaves too large a residual explains nothing, unless the study's own reading does so too and the
    // residual is halved as it stands, in one unit. A turn of everything takes something off any residual.
    let may_be_rough = !matches!(hypothesis.reading, Reading::Frame { .. })
        && as_read.is_off(MOST_RESIDUAL_SHARE)
        && score.rms <= RATIO * as_read.rms;
    let is_plausible = may_be_rough || !score.is_off(MOST_RESIDUAL_SHARE);
    score.total - as_read.total >= margin && is_gross && is_plausible
}

/// The errors of a plan that are estimated.
fn estimated(plan: &Plan) -> impl Iterator<Item = SymbolId> + '_ {
    plan.fit.estimate.iter().copied()
}
