//! What the study asks to measure next.

use super::caution::Caution;
use crate::design::places::propose_places;
use crate::design::{Criterion, PlaceProposal, Proposal, propose};
use crate::search::Request;
use crate::search::context::Context;
use crate::search::fitted::Fitted;
use fit::FitError;
use network::{Visible, identify};

/// What was asked for, and why it is missing where it cannot be computed.
#[derive(Default)]
pub(super) struct Next {
    pub poses: Vec<Proposal>,
    pub places: Vec<PlaceProposal>,
    pub missing: Option<Caution>,
}

/// Everything that the study asks for; nothing if it asks for nothing.
pub(super) fn next(whole: &Context<'_>, last: &Fitted) -> Next {
    let (poses, places) = (next_poses(whole, last), next_places(whole, last));
    let why = poses.as_ref().err().or(places.as_ref().err()).map(ToString::to_string);
    let (poses, places) = (poses.unwrap_or_default(), places.unwrap_or_default());
    let why = why.or_else(|| nothing_is_seen(whole, &places));
    Next { poses, places, missing: why.map(|why| Caution::NothingProposed { why }) }
}

/// Why nothing comes of a question for places, where none of them is seen.
fn nothing_is_seen(whole: &Context<'_>, places: &[PlaceProposal]) -> Option<String> {
    let Request { observations, plan, .. } = whole.request;
    let wanted = plan.next.as_ref()?.places.as_ref()?;
    let is_asked = wanted.stations > 0 || wanted.objects.iter().any(|own| own.count > 0);
    let is_missing = is_asked && observations.unknowns.is_some() && places.is_empty();
    is_missing
        .then(|| "no place is seen within the ranges of the readings: widen `range` under [next]".to_owned())
}

fn next_poses(whole: &Context<'_>, last: &Fitted) -> Result<Vec<Proposal>, FitError> {
    let Request { observations, plan, .. } = whole.request;
    let Some((next, count)) = plan.next.as_ref().and_then(|next| Some((next, next.count?))) else {
        return Ok(Vec::new());
    };
    if observations.unknowns.is_some() {
        // A pose says nothing where no object stands.
        return Ok(Vec::new());
    }
    let of = |criterion| propose(&last.chain, observations, &last.fit, count, &next.ranges, criterion);
    [Criterion::D, Criterion::A].into_iter().map(of).collect()
}

fn next_places(whole: &Context<'_>, last: &Fitted) -> Result<Vec<PlaceProposal>, FitError> {
    let Request { observations, plan, .. } = whole.request;
    let mut proposals = propose_places(&last.chain, observations, &last.fit, plan)?;
    if proposals.iter().all(|proposal| proposal.never.is_empty()) {
        return Ok(proposals);
    }
    let set_up = identify(&plan.chain, observations, &plan.fit)?;
    for proposal in &mut proposals {
        let shown = |seen: &Visible| {
            let names = seen.alone.iter().map(|id| plan.chain.symbol(*id).name.clone());
            names.filter(|name| proposal.never.contains(name)).collect::<Vec<String>>()
        };
        let all = set_up.remedies.iter().map(|(remedy, seen)| (*remedy, shown(seen)));
        proposal.remedies = all.filter(|(_, names)| !names.is_empty()).collect();
    }
    Ok(proposals)
}
