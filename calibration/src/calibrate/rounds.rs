//! Rounds of fit and search, from a first one until one changes nothing.

use crate::search::SearchError;
use crate::search::Stage;
use crate::search::context::{Context, Found};
use crate::search::fitted::Fitted;
use crate::search::round::Round;
use effects::candidate::EffectId;

/// Rounds of fit and search at most.
const ROUNDS: usize = 8;

/// Rounds of search and fit from a first one, until one changes nothing.
pub(crate) fn rounds<'a>(whole: &Context<'a>, mut round: Round<'a>) -> Result<Round<'a>, SearchError> {
    let mut visited: Vec<Vec<EffectId>> = vec![names(&round.fitted.found)];
    for _ in 0..ROUNDS {
        (whole.tell)(Stage::Search);
        let found = round.search(whole);
        let names = names(&found);
        if visited.contains(&names) {
            break;
        }
        visited.push(names);
        let Some(next) = taken_up(whole, found, &round)? else { break };
        round = next;
    }
    Ok(round)
}

/// The numbers of some effects, sorted.
pub(crate) fn names(found: &[Found]) -> Vec<EffectId> {
    let mut names: Vec<EffectId> = found.iter().map(|found| found.effect).collect();
    names.sort_unstable();
    names
}

/// The next round; with the later half of the effects left out, again and again, while the exact form cannot hold what
/// the linear search likes. `None` if it can hold nothing new.
pub(super) fn taken_up<'a>(
    whole: &Context<'a>,
    mut found: Vec<Found>,
    last: &Round<'a>,
) -> Result<Option<Round<'a>>, SearchError> {
    while found.len() > last.fitted.found.len() {
        let next = Fitted::with(whole, found.clone(), &last.fitted)?;
        if next.fit.outcome.is_usable() {
            return Round::at(whole, next).map(Some);
        }
        found.truncate(found.len().div_ceil(2).min(found.len() - 1));
    }
    if found.is_empty() {
        return Ok(None);
    }
    let next = Fitted::with(whole, found, &last.fitted)?;
    if next.fit.outcome.is_usable() { Round::at(whole, next).map(Some) } else { Ok(None) }
}
