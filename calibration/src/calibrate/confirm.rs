//! Confirmation: effects that do not help on rows which their search did not see are left out again.
//!
//! A search takes one effect by chance in about one of twenty residuals without any. Repeated without each fold, it takes
//! another one each time, or none, and predicts the rows left out worse than the declaration does.

use super::held_out;
use crate::diagnose::Caution;
use crate::diagnose::rms::{BeforeAfter, Worse, worse};
use crate::fit::FitResult;
use crate::search::context::Context;
use crate::search::fitted::Fitted;
use crate::search::round::Round;
use crate::search::{HeldOut, SearchError, Stage, nested};

/// The round that the report is about, judged on held-out rows.
pub(super) struct Judged<'a> {
    pub round: Round<'a>,
    pub held_out: HeldOut,
    /// One for each unit of residuals.
    pub rms: Vec<BeforeAfter>,
    /// The effects that were left out again, if any.
    pub refused: Option<Caution>,
}

/// Repeats the search without each fold; if it predicts the rows left out worse with effects than without, the declaration
/// stands as it was. A second file of the study judges and does not choose.
pub(super) fn judged<'a>(
    whole: &Context<'a>,
    before: &FitResult,
    round: Round<'a>,
) -> Result<Judged<'a>, SearchError> {
    (whole.tell)(Stage::HeldOut);
    let of = |round: &Round<'a>| {
        let held_out = nested(&round.search.problem, &round.sets, &whole.options);
        held_out::rms(whole, before, round, &held_out).map(|rms| (held_out, rms))
    };
    let (held_out, rms) = of(&round)?;
    let Some(refused) = refused(whole, &round, &rms) else {
        return Ok(Judged { round, held_out, rms, refused: None });
    };
    let round = Round::at(whole, Fitted::with(whole, Vec::new(), &round.fitted)?)?;
    let (held_out, rms) = of(&round)?;
    Ok(Judged { round, held_out, rms, refused: Some(refused) })
}

/// What is told of effects that the held-out rows speak against.
fn refused(whole: &Context<'_>, round: &Round<'_>, rms: &[BeforeAfter]) -> Option<Caution> {
    if round.fitted.found.is_empty() || whole.request.second.is_some() {
        return None;
    }
    // Gross outliers make a figure over every row a matter of chance.
    let Worse { unit, before, after } = worse(rms, |rms| rms.held_out_rms_kept)?;
    Some(Caution::NotConfirmed {
        effects: round.fitted.found.iter().map(|found| whole.catalogue[found.effect].name.clone()).collect(),
        p_value: round.fitted.found.iter().map(|found| found.p_value).fold(1.0, f64::min),
        before,
        after,
        unit,
    })
}
