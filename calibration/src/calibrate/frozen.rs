//! A frozen model: the study's terms are fitted, and nothing is looked for. What one term more or less would do is tried on held-out rows.

use std::sync::Arc;

use super::confirm::{Judged, figures};
use super::held_out::Judgement;
use super::trials::Trials;
use crate::diagnose::{FrozenModel, OtherTerm, TermFitted};
use crate::search::context::{Context, Found};
use crate::search::fitted::Fitted;
use crate::search::round::{Explains, Round};
use crate::search::state::State;
use crate::search::tail::Tails;
use crate::search::{SearchError, SetColumns, SetId};
use ::effects::candidate::EffectId;
use ::effects::catalogue::Term;
use fit::FitResult;
use study::Frozen;

/// Effects beside the terms that are tried.
const TRIED: usize = 5;

/// Effects that are given, whatever the rows.
struct Given(Vec<EffectId>);

impl Explains for Given {
    fn of_rows(&self, _: &[bool]) -> Vec<EffectId> {
        self.0.clone()
    }

    fn is_given(&self) -> bool {
        true
    }
}

/// The declaration with the terms that it lacks, fitted.
pub(super) fn fitted(whole: &Context<'_>, frozen: &Frozen, first: &Fitted) -> Result<Fitted, SearchError> {
    let found =
        effects(frozen).map(|effect| Found { effect, p_value: 1.0, alike: vec![effect], shares: Vec::new() });
    Fitted::with(whole, found.collect(), first)
}

/// The effects among the terms.
fn effects(frozen: &Frozen) -> impl Iterator<Item = EffectId> {
    frozen.terms.iter().filter_map(|own| match own.term {
        Term::Effect(effect) => Some(effect),
        Term::Error(_) => None,
    })
}

/// The round of that fit, judged on held-out rows, and what the terms come to.
pub(super) fn judged<'a>(
    whole: &Context<'a>,
    before: &FitResult,
    frozen: &Frozen,
    fitted: Fitted,
) -> Result<(Judged<'a>, FrozenModel), SearchError> {
    let given = Given(effects(frozen).collect());
    let mut round = Round::at(whole, fitted)?.explained_by(Arc::new(given));
    let mut state = State::declared(&round.search.problem, |_| true);
    for found in &round.fitted.found {
        state.add(&round.search.problem.columns(found.effect));
    }
    for at in 0..round.fitted.found.len() {
        let (gain, rank) = state.loss(&round.search.problem.columns(round.fitted.found[at].effect));
        let tails = Tails::new([rank], state.df() + rank as f64);
        round.fitted.found[at].p_value = tails.ln_p(rank, gain, state.rss() + gain).exp();
    }
    let held_out = round.held_out(whole);
    let Judgement { rms, left } = figures(whole, before, &round, &held_out)?;
    let model = model(whole, frozen, &round, &state)?;
    Ok((Judged { round, held_out, rms, left, left_out: Vec::new() }, model))
}

/// What the terms, and the best of what is none, come to.
fn model(
    whole: &Context<'_>,
    frozen: &Frozen,
    round: &Round<'_>,
    state: &State,
) -> Result<FrozenModel, SearchError> {
    let best = best(round, state);
    let firsts: Vec<EffectId> = best.iter().map(|&set| round.sets[set].members[0]).collect();
    let trials = Trials::of(whole, round, &firsts)?;
    let selection = round.selection(whole);
    let chain = &round.fitted.chain;
    let name = |id: &model_core::SymbolId| chain.symbol(*id).name.clone();
    let term = |own: &study::FrozenTerm| {
        let (read_as, errors, without) = match own.term {
            Term::Error(error) => (
                name(&error),
                Vec::new(),
                trials.as_ref().and_then(|trials| trials.without_error(whole, error)),
            ),
            Term::Effect(effect) => {
                let at = round.fitted.found.iter().position(|found| found.effect == effect);
                let errors =
                    at.map_or_else(Vec::new, |at| round.fitted.errors[at].iter().map(name).collect());
                let without = at.zip(trials.as_ref()).and_then(|(at, trials)| trials.without_effect(at));
                (whole.catalogue[effect].name.clone(), errors, without)
            }
        };
        let declared = matches!(own.term, Term::Error(_));
        TermFitted { term: own.written.clone(), read_as, declared, errors, held_out_rms_without: without }
    };
    let other = |(at, &set): (usize, &SetId)| {
        let members = &round.sets[set].members;
        OtherTerm {
            effect: whole.catalogue[members[0]].name.clone(),
            published: whole.names[members[0].0].iter().map(ToString::to_string).collect(),
            alike: members.len() - 1,
            accepted: selection.accepted.iter().any(|accepted| accepted.set == set),
            held_out_rms_with: trials.as_ref().and_then(|trials| trials.with(at)),
        }
    };
    Ok(FrozenModel {
        terms: frozen.terms.iter().map(term).collect(),
        held_at_zero: frozen.held.iter().map(name).collect(),
        held_out_rms: trials.as_ref().and_then(Trials::as_it_is),
        unit: whole.request.observations.poses.units().first().copied().unwrap_or(observe::SiUnit::RAD),
        rows: trials.as_ref().map_or(0, Trials::rows),
        others: best.iter().enumerate().map(other).collect(),
    })
}

/// The sets that gain most beside the terms.
fn best(round: &Round<'_>, state: &State) -> Vec<SetId> {
    let blocks = SetColumns::of(&round.search.problem, &round.sets);
    let terms = round.accepted_sets();
    let others = blocks.ids().filter(|set| !terms.contains(set));
    let mut others: Vec<(f64, SetId)> = others
        .filter_map(|set| {
            let (gain, rank) = state.gain(&blocks[set]);
            (rank > 0).then(|| (state.criterion(gain, rank), set))
        })
        .collect();
    others.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    others.into_iter().take(TRIED).map(|(_, set)| set).collect()
}
