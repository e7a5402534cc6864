//! Rows that were set aside together: outliers, or the very rows that show what is missing?
//!
//! A few rows far from all others decide which of two effects is right, and while the wrong one is in the model they look
//! like outliers: their weight is zero, and nothing that they say is heard. The same happens where a variance that depends
//! on the joints takes them for noise. So the search is made once more with every row at its full weight and even noise;
//! what it finds is fitted and searched on as always. Of the two models the likelier one stays, at its own noise and with
//! outliers allowed, if it leaves fewer rows unexplained: real outliers are explained by no effect.
//!
//! Source of the price of a choice: J. Chen and Z. Chen, "Extended Bayesian information criteria for model selection with
//! large model spaces", Biometrika 95 (2008).

use super::rounds::{names, rounds};
use crate::search::Request;
use crate::search::SearchError;
use crate::search::contest::ln_choices;
use crate::search::context::{Context, Found};
use crate::search::fitted::Fitted;
use crate::search::round::Round;
use fit::robust;
use observe::Observations;
use study::Plan;

/// Rows from which on some are asked before all are.
const MANY: usize = 50_000;

/// So many, about.
const SAMPLE: usize = 20_000;

/// How many rows must be set aside before they are looked at together: two, or one in a thousand of many rows, of which
/// some are set aside by chance.
fn fewest(round: &Round<'_>) -> usize {
    (round.fitted.fit.residuals.weight.len() / 1000).max(2)
}

/// The last round, or another one in its stead that explains the rows which it set aside.
pub(super) fn reconsidered<'a>(whole: &Context<'a>, last: Round<'a>) -> Result<Round<'a>, SearchError> {
    let plan = whole.request.plan;
    if !plan.fit.robust || doubts(&last) < fewest(&last) {
        return Ok(last);
    }
    let trusting = trusting(plan);
    let is_the_same = |found: &[Found]| names(found) == names(&last.fitted.found);
    let observations = whole.request.observations;
    // Where every row says the same from the start, none was overheard. Of very many rows some say it, and sooner.
    if observations.rows() >= MANY {
        let sample = observations.sample(SAMPLE);
        let some = with(whole, &trusting, &sample);
        if first(&some)?.is_some_and(|round| is_the_same(&round.search(&some))) {
            return Ok(last);
        }
    }
    let trusting = with(whole, &trusting, observations);
    let Some(round) = first(&trusting)? else { return Ok(last) };
    if is_the_same(&round.search(&trusting)) {
        return Ok(last);
    }
    let found = rounds(&trusting, round)?.fitted;
    if is_the_same(&found.found) {
        return Ok(last);
    }
    let other = Fitted::with(whole, found.found.clone(), &found)?;
    let other = rounds(whole, Round::at(whole, other)?)?;
    Ok(if explains((whole, &other), (whole, &last)) { other } else { last })
}

/// The same with another study and some of its rows.
fn with<'a>(whole: &Context<'a>, plan: &'a Plan, observations: &'a Observations) -> Context<'a> {
    Context { request: Request { plan, observations, ..whole.request }, ..whole.clone() }
}

/// The round at the declaration as it is; none where no usable fit comes of it.
fn first<'a>(whole: &Context<'a>) -> Result<Option<Round<'a>>, SearchError> {
    let first = Fitted::first(whole)?;
    first.fit.outcome.is_usable().then(|| Round::at(whole, first)).transpose()
}

/// Whether a round with its study leaves fewer rows unexplained than another one, and is the likelier model.
pub(super) fn explains(
    (study, round): (&Context<'_>, &Round<'_>),
    (of_last, last): (&Context<'_>, &Round<'_>),
) -> bool {
    round.fitted.fit.outcome.is_usable()
        && doubts(round) < doubts(last)
        && criterion(study, round) > criterion(of_last, last)
}

/// The study with every row at its full weight and even noise.
pub(super) fn trusting(plan: &Plan) -> Plan {
    let mut trusting = plan.clone();
    trusting.fit.robust = false;
    trusting.fit.noise.variance = false;
    trusting
}

/// Rows that a round's model does not explain: those set aside, and as many as uneven noise could hide.
fn doubts(round: &Round<'_>) -> usize {
    let fit = &round.fitted.fit;
    fit.set_aside.len() + if !fit.noise.variance.is_empty() { fewest(round) } else { 0 }
}

/// Penalised log-likelihood of a round's model at its noise, where the robust loss bounds what a row far from the rest costs.
fn criterion(whole: &Context<'_>, round: &Round<'_>) -> f64 {
    let observations = whole.request.observations;
    let noise = round.fitted.fit.noise.without_memory();
    let mut white = round.fitted.fit.residuals.raw.clone();
    noise.whiten(&mut white);
    let loss: f64 = round
        .fitted
        .layout
        .norms(&white)
        .zip(observations.poses.measures())
        .filter(|(norm, _)| norm.is_finite())
        .map(|(norm, measure)| robust::loss(norm, measure.components()))
        .sum();
    let spread: f64 = noise.sigma.iter().map(|sigma| sigma.ln()).sum();
    let terms: usize = noise.variance.iter().map(|model| model.terms.len()).sum();
    let parameters = (round.fitted.fit.rank + terms) as f64;
    let choice = ln_choices(round.sets.len(), round.fitted.found.len());
    -spread - loss / 2.0 - parameters / 2.0 * (white.len() as f64).ln() - choice
}
