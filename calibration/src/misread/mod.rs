//! Misread columns: units, packed notation, signs, exchanged columns and shifted rows compete with the study's own reading of the data,
//! before any effect does.
//!
//! Each hypothesis (`hypotheses`, one file a kind) reads some rows otherwise. All are compared by one likelihood of the numbers as the
//! file has them (`score`), with a prior on the errors of the declaration (`prior`). One that wins by the margin of `policy` is told.

mod hypotheses;
mod policy;
mod prior;
mod score;

use model_core::SymbolId;
use serde::Serialize;

use fit::FitOptions;
use fit::noise::NoiseOptions;
use observe::{Observations, SiUnit};
use study::{Changed, Plan, Sample};

use hypotheses::Hypothesis;
pub use hypotheses::{Line, Reading};
pub use policy::THRESHOLDS;
use policy::{CLEARED, FITTED, MARGIN, ONE_OF, RATIO, RATIO_ROWS, SAME, SCREENED_STEPS};
use prior::Priors;
pub use prior::{Implausible, implausible};
use score::{Score, score};

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
    /// Its score against that of the study's own reading.
    pub score: f64,
}

/// The misread columns of a study, judged on some of its rows; `None` where the study's own reading is not beaten.
///
/// Rows that observe unknown objects are not judged here: where a fit of those is far off, `diagnose` tries readings of theirs.
pub(crate) fn misread(plan: &Plan, sample: &Sample) -> Option<Misread> {
    let columns = sample.columns();
    // A score asks for no uncertainties: which rows belong together is of no account.
    let read = |changes: &[Changed]| {
        let observations = sample.observations(plan, changes).ok()?;
        Some(Observations { groups: Vec::new(), crossed: Vec::new(), ..observations })
    };
    let own = read(&[])?;
    if own.unknowns.is_some() || own.rows() == 0 {
        return None;
    }
    let priors = Priors::of(plan, &own);
    let options = options(plan);
    // Most other readings are wrong and end far off: only the study's own is worth other starts.
    let fitted =
        |observations: &Observations, start: &[f64], steps: usize, hypothesis: Option<&Hypothesis>| {
            let options = FitOptions {
                start: start.to_vec(),
                max_iterations: steps,
                other_starts: hypothesis.is_none(),
                ..options.clone()
            };
            score(plan, observations, &options, &priors, &columns, hypothesis)
        };
    let start = &plan.fit.start;
    let as_read = fitted(&own, start, plan.fit.max_iterations, None)?;

    let all = hypotheses::all(plan, &columns);
    let mut screened: Vec<(usize, Observations, Score)> = Vec::new();
    for (number, hypothesis) in all.iter().enumerate() {
        let Some(observations) = read(&hypothesis.changes) else { continue };
        let from = |start| fitted(&observations, start, SCREENED_STEPS, Some(hypothesis));
        // The errors found so far are a start as good as none.
        let scores = [from(start.as_slice()), from(&as_read.values)];
        let best = scores.into_iter().flatten().max_by(|a, b| a.total.total_cmp(&b.total));
        screened.extend(best.map(|score| (number, observations, score)));
    }
    screened.sort_by(|a, b| b.2.total.total_cmp(&a.2.total));
    screened.truncate(FITTED);
    let mut finalists: Vec<(usize, Score)> = Vec::new();
    for (number, observations, score) in &screened {
        let full = fitted(observations, &score.values, plan.fit.max_iterations, Some(&all[*number]));
        finalists.extend(full.map(|full| (*number, full)));
    }
    finalists.sort_by(|a, b| b.1.total.total_cmp(&a.1.total));
    let best = &finalists.first()?.1;
    // A wrong minimum of the study's own reading is no misread column: it starts once more from the best rival's errors.
    let again = fitted(&own, &best.values, plan.fit.max_iterations, None);
    let as_read =
        again.into_iter().fold(as_read, |one, other| if other.total > one.total { other } else { one });

    let explains = |number: usize, score: &Score| {
        let ratio = score.scale / as_read.scale;
        let gross = match &all[number].reading {
            Reading::Shifted { .. } => ratio <= RATIO_ROWS,
            Reading::Packed { .. } => ratio <= SAME && all[number].digits > 0.0,
            _ => ratio <= RATIO || (as_read.penalty - score.penalty > CLEARED && ratio <= SAME),
        };
        score.total - as_read.total >= MARGIN && gross
    };
    let margin = finalists.first().map(|(_, score)| score.total - as_read.total)?;
    finalists.retain(|(number, score)| explains(*number, score));
    let top = finalists.first()?.1.total;
    finalists.retain(|(_, score)| top - score.total <= ONE_OF);
    let after = finalists.first()?.1.rms;
    let suspects = finalists.iter().map(|(number, score)| Suspect {
        reading: all[*number].reading.clone(),
        lines: all[*number].lines.clone(),
        score: score.total - as_read.total,
    });
    Some(Misread {
        readings: suspects.collect(),
        before: as_read.rms,
        after,
        unit: own.poses.series.first()?.measure.unit(),
        margin,
    })
}

/// Few steps, and no model of the noise.
fn options(plan: &Plan) -> FitOptions {
    let noise = NoiseOptions { variance: false, serial: false, ..plan.fit.noise.by_residuals() };
    FitOptions { noise, ..plan.fit.clone() }
}

/// The errors of a plan that are estimated.
fn estimated(plan: &Plan) -> impl Iterator<Item = SymbolId> + '_ {
    plan.fit.estimate.iter().copied()
}
