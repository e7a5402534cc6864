//! What these data hide: effects that they could not have shown, and what those would do to the declared errors.

use std::collections::BTreeMap;

use model_core::algebra::Poly;
use model_core::{Chain, SymbolId, SymbolKind};
use serde::Serialize;

use super::rms::BeforeAfter;
use crate::search::SearchError;
use crate::search::context::{Context, declared};
use crate::search::round::Round;
use effects::candidate::{Effect, EffectId, Place};
use effects::families::assembly_name;
use observe::SiUnit;

/// Standard deviations at which an effect is found four times out of five, corrected for the size of the catalogue.
const FOUND: f64 = 4.4;

/// Shifts of declared errors this many times smaller than the largest are not told.
const TOLD: f64 = 0.05;

/// Beside unknown objects a declared error counts that takes at least this share of what an effect does to the points that are observed.
const TAKEN: f64 = 0.1;

/// Where declared errors take less than this share of it together, objects and stations take most.
const MOST: f64 = 0.5;

/// An effect that these data would not show below some size.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NotShown {
    /// Its name.
    pub name: String,
    /// The body that it moves.
    pub body: String,
    /// `Rx` to `Tz`.
    pub dof: String,
    /// The smallest amplitude that would be found four times out of five, SI; absent if no size would show.
    pub smallest: Option<f64>,
    /// `rad` or `m`.
    pub unit: SiUnit,
    /// The share of it that the declared errors absorb, 0 to 1.
    pub absorbed: f64,
    /// The bias that it would put into the declared errors: how far an effect of amplitude 1 SI would move each at most, SI.
    pub mistaken_for: BTreeMap<String, f64>,
    /// Whether objects and stations, which would come to stand elsewhere, take most of it.
    pub by_places: bool,
}

/// How far one standard uncertainty of an accepted effect, left out, would move each declared error, SI.
pub(crate) fn bias(
    whole: &Context<'_>,
    last: &Round<'_>,
    effect: EffectId,
    errors: &[SymbolId],
) -> BTreeMap<String, f64> {
    let columns = last.search.problem.block(effect);
    let sigmas = errors.iter().map(|&error| {
        let sigma = last.fitted.fit.standard_uncertainty(error);
        sigma.unwrap_or_else(|| unreachable!("the errors of an accepted effect are estimated"))
    });
    moved(whole, last, columns.zip(sigmas))
}

/// The largest shift of each declared error by functions of some sizes whose signs are not known: columns of the problem,
/// each with its size.
fn moved(
    whole: &Context<'_>,
    last: &Round<'_>,
    sizes: impl Iterator<Item = (usize, f64)>,
) -> BTreeMap<String, f64> {
    let combinations = &last.fitted.combinations;
    let mut squares = vec![0.0; combinations.nrows()];
    for (column, size) in sizes {
        let share = last.search.problem.share(column);
        for (i, square) in squares.iter_mut().enumerate() {
            let moved: f64 = share.iter().enumerate().map(|(j, s)| combinations[(i, j)] * s).sum();
            *square += (size * moved).powi(2);
        }
    }
    declared(whole)
        .iter()
        .zip(squares)
        .filter(|&(_, square)| square > 0.0)
        .map(|(&id, square)| (last.fitted.chain.symbol(id).name.clone(), square.sqrt()))
        .collect()
}

/// Effects that could be as large as the residual without these data showing them.
///
/// # Errors
/// Values that do not fit the chain.
pub(crate) fn not_shown(
    whole: &Context<'_>,
    last: &Round<'_>,
    rms: &[BeforeAfter],
) -> Result<Vec<NotShown>, SearchError> {
    let problem = &last.search.problem;
    let moves = match whole.request.observations.unknowns {
        Some(_) => Some(Moves::of(whole, last)?),
        None => None,
    };
    let accepted: Vec<EffectId> = last.fitted.found.iter().map(|found| found.effect).collect();
    let hidden = |name: String, place: Place| NotShown {
        name,
        body: whole.setting.body_name(place.body).to_owned(),
        dof: place.freedom.word().to_owned(),
        smallest: None,
        unit: place.freedom.quantity().into(),
        absorbed: 0.0,
        mistaken_for: BTreeMap::new(),
        by_places: false,
    };
    let unmoved = whole.setting.unmoved().into_iter().map(|place| {
        hidden(assembly_name(whole.setting.body_name(place.body), place.role, place.freedom), place)
    });
    let mut list: Vec<NotShown> = unmoved.collect();
    for (number, effect) in whole.catalogue.iter().enumerate().map(|(at, effect)| (EffectId(at), effect)) {
        if accepted.contains(&number) || is_declared(&whole.request.plan.chain, effect) {
            continue;
        }
        let unseen = hidden(effect.name.clone(), effect.place);
        if problem.block(number).is_empty() {
            list.push(unseen);
            continue;
        }
        let columns = problem.columns(number);
        let shortest = columns.iter().map(|&column| problem.length(column)).fold(f64::INFINITY, f64::min);
        let smallest = (!columns.is_empty()).then(|| FOUND / shortest);
        // Where nothing is left to compare with, no size is small enough to be seen.
        let of_unit = rms.iter().find(|own| own.unit == unseen.unit).or(rms.first());
        let left = of_unit.and_then(|own| own.after.rms_kept);
        let hides = |smallest: f64| left.is_none_or(|left| smallest > left);
        if smallest.is_none_or(hides) {
            let absorbed = 1.0 - problem.visible(number);
            let mut mistaken_for = mistaken_for(whole, last, number);
            let by_places = moves.as_ref().is_some_and(|moves| moves.take_out(number, &mut mistaken_for));
            list.push(NotShown { smallest, absorbed, mistaken_for, by_places, ..unseen });
        }
    }
    let mut told = std::collections::BTreeSet::new();
    list.retain(|effect| told.insert(effect.name.clone()));
    Ok(list)
}

/// How far the points that are observed move, root of the sum of squares over rows of the search, by a unit of each declared error and
/// of each effect.
struct Moves {
    declared: BTreeMap<String, f64>,
    effects: Vec<f64>,
}

impl Moves {
    fn of(whole: &Context<'_>, last: &Round<'_>) -> Result<Self, SearchError> {
        let chain = &last.fitted.chain;
        let (columns, effects) =
            last.fitted.at_poses(&whole.catalogue, &last.search.rows.observations.poses.bare())?;
        let errors = declared(whole).iter().zip(columns.declared.col_iter());
        let squares = |column: &Vec<f64>| column.iter().map(|moved| moved * moved).sum::<f64>();
        Ok(Self {
            declared: errors.map(|(&id, column)| (chain.symbol(id).name.clone(), column.norm_l2())).collect(),
            effects: effects.iter().map(|own| own.iter().map(squares).sum::<f64>().sqrt()).collect(),
        })
    }

    /// Takes errors out that would take hardly any of an effect; whether that leaves most of it to objects and stations.
    fn take_out(&self, effect: EffectId, mistaken_for: &mut BTreeMap<String, f64>) -> bool {
        let whole = self.effects[effect.0];
        let share = |name: &String, shift: f64| {
            let Some(unit) = self.declared.get(name) else { unreachable!("a declared error has its column") };
            if whole > 0.0 { shift * unit / whole } else { 0.0 }
        };
        mistaken_for.retain(|name, shift| share(name, *shift) >= TAKEN);
        let together: f64 = mistaken_for.iter().map(|(name, shift)| share(name, *shift).powi(2)).sum();
        together.sqrt() < MOST
    }
}

/// Whether the declaration has this very effect: an error of its own for each function, at the same place.
fn is_declared(chain: &Chain, effect: &Effect) -> bool {
    let Place { body, role, freedom } = effect.place;
    let factors = chain
        .body(body)
        .factors
        .iter()
        .filter(|factor| (factor.role, factor.kind, factor.axis) == (role, freedom.kind, freedom.axis));
    let declared: Vec<Poly> = factors
        .flat_map(|factor| factor.amount.collect_by(|symbol| chain.symbol(symbol).kind == SymbolKind::Error))
        .filter(|(errors, _)| matches!(errors.as_slice(), [(_, 1)]))
        .map(|(_, function)| function)
        .collect();
    effect.functions.iter().all(|function| {
        let negative = -&function.amount;
        function.elsewhere.is_empty()
            && declared.iter().any(|own| *own == function.amount || *own == negative)
    })
}

/// The declared errors that would take an effect of amplitude one upon them, and how far each would move.
fn mistaken_for(whole: &Context<'_>, last: &Round<'_>, effect: EffectId) -> BTreeMap<String, f64> {
    let mut moved = moved(whole, last, last.search.problem.block(effect).map(|column| (column, 1.0)));
    let largest = moved.values().copied().fold(0.0, f64::max);
    moved.retain(|_, shift| *shift > TOLD * largest);
    moved
}
