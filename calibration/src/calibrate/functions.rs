//! Functions taken up: what the library found in place of effects, or beside them, becomes an effect itself, and the rounds
//! go on with it. Nothing is left for the user to paste.

use std::cell::OnceCell;

use super::rounds::rounds;
use crate::search::Request;
use crate::search::SearchError;
use crate::search::context::{Context, Found};
use crate::search::fitted::Fitted;
use crate::search::library::{AsGood, Shape, ShapeKind, Taken, contest};
use crate::search::round::Round;
use effects::candidate::{Dependence, Effect, EffectId, Function, Place};
use effects::families::{HIGH_HARMONIC, SHAPE};
use fit::Outcome;
use model_core::SymbolId;
use study::Plan;

/// Functions that one calibration takes up at most.
pub(super) const MOST: usize = 4;

/// What the rounds end with once the library has spoken.
pub(super) struct Settled<'a> {
    pub whole: Context<'a>,
    pub round: Round<'a>,
    /// Functions that explain the data about as well as accepted effects.
    pub as_good: Vec<AsGood>,
    /// The function that won, and was not taken up.
    pub winner: Option<Winner>,
}

/// A function that won, and was not taken up.
#[derive(Debug, Clone, Copy)]
pub(super) struct Winner {
    /// What it leaves of these data over what was accepted, root mean square.
    pub leaves: f64,
    /// Of how many accepted effects it takes the place.
    pub stands_for: usize,
}

impl<'a> Settled<'a> {
    /// Where the library was not asked.
    pub fn unasked(whole: Context<'a>, round: Round<'a>) -> Self {
        Self { whole, round, as_good: Vec::new(), winner: None }
    }
}

/// Lets the library compete with the last round until it has nothing to add; `plans` is where studies with such effects live, one
/// for each function that may be taken up.
pub(super) fn settled<'a>(
    whole: &Context<'a>,
    plans: &'a [OnceCell<Plan>],
    round: Round<'a>,
) -> Result<Settled<'a>, SearchError> {
    let mut settled = Settled::unasked(whole.clone(), round);
    // A study that allows certain effects alone allows no others.
    let search = &whole.request.plan.search;
    if !search.only.is_empty() {
        return Ok(settled);
    }
    // Once no more may be taken up, the library still says what else would explain the data as well.
    for place in plans.iter().map(Some).chain([None]) {
        if !settled.round.tells_structure() {
            break;
        }
        let contest = contest(&settled.whole, &settled.round)?;
        settled.as_good = contest.as_good;
        let Some(taken) = contest.taken else { break };
        let Some(place) = place else {
            let stands_for = settled.round.fitted.found.len() - taken.kept.len();
            settled.winner = Some(Winner { leaves: taken.leaves, stands_for });
            break;
        };
        let Some((plan, name)) = with_function(settled.whole.request.plan, &taken) else { break };
        let plan = place.get_or_init(|| plan);
        let last = &settled.whole;
        let request = Request { plan, ..last.request };
        let next = Context { tell: last.tell, ..Context::new(request, last.setting.observables, last.held)? };
        let kept = taken.kept.iter().map(|&kept| &settled.round.fitted.found[kept]);
        let mut found = numbered(kept, last, &next);
        let Some(own) = next.catalogue.iter().position(|effect| effect.name == name) else { break };
        let effect = EffectId(own);
        found.push(Found { effect, p_value: taken.p_value, alike: vec![effect], shares: Vec::new() });
        let fitted = Fitted::with(&next, found, &settled.round.fitted)?;
        if matches!(fitted.fit.outcome, Outcome::NotConverged { .. }) {
            break;
        }
        let round = rounds(&next, Round::at(&next, fitted)?)?;
        settled = Settled::unasked(next, round);
    }
    Ok(settled)
}

/// Effects that were found, by their numbers in another catalogue; those that it does not have stay out.
pub(super) fn numbered<'f>(
    found: impl Iterator<Item = &'f Found>,
    last: &Context<'_>,
    next: &Context<'_>,
) -> Vec<Found> {
    let numbered = |effect: EffectId| {
        let Effect { name, place, .. } = &last.catalogue[effect];
        next.catalogue.iter().position(|other| (&other.name, &other.place) == (name, place)).map(EffectId)
    };
    let of = |Found { effect, p_value, alike, .. }: &Found| {
        let alike = alike.iter().filter_map(|&effect| numbered(effect)).collect();
        Some(Found { effect: numbered(*effect)?, p_value: *p_value, alike, shares: Vec::new() })
    };
    found.filter_map(of).collect()
}

/// The study with a function as an effect of its own, and the effect's name; `None` where the chain has no room for it.
fn with_function(plan: &Plan, taken: &Taken) -> Option<(Plan, String)> {
    let mut plan = plan.clone();
    let name = add_function(&mut plan, taken.place, taken.driver, &taken.shape)?;
    Some((plan, name))
}

/// Makes a function an effect of the study's own, and gives the effect's name; `None` where the chain has no room for it.
pub(super) fn add_function(plan: &mut Plan, place: Place, driver: SymbolId, shape: &Shape) -> Option<String> {
    let amounts = shape.amounts(&mut plan.chain, driver)?;
    plan.fit.start.resize(plan.chain.symbols.len(), 0.0);
    let driver = plan.chain.symbol(driver);
    let body = &plan.chain.body(place.body).name;
    let (kind, freedom) = (shape.kind(), place.freedom);
    let words = shape.words(driver.quantity);
    let name = format!("{words} of {} in {body} {}", driver.name, freedom.words());
    let stem = format!("{}_{}_{body}", kind.stem(), driver.name);
    let several = amounts.len() > 1;
    let functions = amounts.into_iter().enumerate().map(|(number, amount)| {
        let number = match kind {
            ShapeKind::Harmonic(order) => format!("_{}{order}", if number == 0 { "cos" } else { "sin" }),
            _ if several => format!("_{}", number + 1),
            _ => String::new(),
        };
        Function::new(amount, format!("{stem}{number}"))
    });
    let (family, form) = match kind {
        ShapeKind::Harmonic(order) => (HIGH_HARMONIC, Dependence::Harmonic { order }),
        _ => (SHAPE, kind.words().into()),
    };
    let effect = Effect {
        bends: None,
        family,
        name: name.clone(),
        place,
        functions: functions.collect(),
        driver: driver.name.clone(),
        form,
    };
    plan.search.own.push(effect);
    Some(name)
}
