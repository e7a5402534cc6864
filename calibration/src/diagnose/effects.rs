//! The accepted effects: what each does, how sure it is, and which physical causes these data cannot tell apart.

use std::collections::BTreeMap;

use model_core::{Role, SymbolId};
use serde::Serialize;

use super::Confirmed;
use super::detectability;
use super::rms::BeforeAfter;
use super::rms::observables_of;
use super::units::unit_of;
use crate::search::context::{Context, Found};
use crate::search::fitted::Fitted;
use crate::search::orders::aliases;
use crate::search::round::Round;
use crate::search::state::State;
use crate::search::{AS_GOOD, CompetingModel, SetColumns, SetId, competing_models};
use effects::candidate::{Dependence, Effect, EffectId};
use effects::families::{FAMILIES, HIGH_HARMONIC, SHAPE};
use evidence::Policy;
use observe::SiUnit;

/// Units of log-likelihood behind the best within which an explanation is kept in view when poses are chosen.
const IN_VIEW: f64 = 10.0;

/// An accepted effect.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EffectFound {
    /// As the amended declaration writes it.
    pub text: String,
    /// The body it sits in.
    pub body: String,
    /// `Rx` to `Tz`.
    pub dof: String,
    /// Before the joint moves the body, or after.
    pub side: Side,
    /// The direction whose line of sight it bends up, where it moves no body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bends: Option<String>,
    /// The joint or input behind it.
    pub driver: String,
    /// How it follows that.
    pub form: Dependence,
    /// Of a wave that was found blind, other numbers of periods a turn that look the same at these readings.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub alias_orders: Vec<u32>,
    /// What it may be called.
    pub names: Vec<String>,
    /// Effects that no data at these poses could tell from it.
    pub confounded_with: Vec<String>,
    /// Models that explain these data about as well, best first: each as the effects that no data at these poses could tell
    /// apart.
    pub competing_with: Vec<Vec<String>>,
    /// Whether these data determine how it follows its driver: no other function of the library explains them about as well.
    pub form_determined: bool,
    /// The physical causes that it may have, in the order in which to check them: its own, those confounded with it, those of competing models.
    pub causes: Vec<Cause>,
    /// The new errors and their estimates, SI.
    pub coefficients: BTreeMap<String, f64>,
    /// The SI unit of each.
    pub coefficient_units: BTreeMap<String, SiUnit>,
    /// The most that it moves an observation of these data, in the unit of those that show it best.
    pub amplitude: f64,
    /// Root mean square over these observations of what it moves.
    pub amplitude_rms: f64,
    /// The unit of both: `rad` or `m`.
    pub amplitude_unit: SiUnit,
    /// The first observable of that unit.
    pub amplitude_of: String,
    /// The larger of two effects has the larger of these, whatever their units: the most in terms of the noise.
    #[serde(skip)]
    pub standing: f64,
    /// Familywise p when it was accepted.
    pub p_value: f64,
    /// The share of the searches without one fold each that chose it too.
    pub selected_in_folds: f64,
    /// How many observations it hangs on, as an effective number.
    pub observations: f64,
    /// How far one standard uncertainty of it, left out, would move each declared error, SI.
    pub bias: BTreeMap<String, f64>,
}

impl EffectFound {
    /// Every name that is told for it: its own, those that these data cannot tell from it, and those that fit about as well.
    pub fn told(&self) -> impl Iterator<Item = &str> {
        let competing = self.competing_with.iter().flatten();
        self.names.iter().chain(&self.confounded_with).chain(competing).map(String::as_str)
    }
}

/// On which side of the joint an effect sits in its body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// Before the joint moves the body: it stays with the body below.
    Before,
    /// After it: it turns with the body.
    After,
}

/// A physical cause that an effect may have.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cause {
    /// Its name in the catalogue.
    pub name: String,
    /// Its family in the catalogue.
    pub family: &'static str,
    /// The body that it moves.
    pub body: String,
    /// How it stands to what was accepted.
    pub relation: Relation,
    /// Its share of the posterior among the causes that fit; absent where no contest weighed them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub share: Option<f64>,
    /// What other fields call it.
    pub published: Vec<String>,
    /// What usually causes it.
    pub causes: &'static str,
    /// What it looks like in residuals.
    pub looks: &'static str,
    /// What to check at the instrument.
    pub check: &'static str,
}

/// How a cause stands to the effect that was accepted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Relation {
    /// It is that effect.
    Accepted,
    /// No data at these poses could tell it from that effect: it makes the same correction there.
    Same,
    /// It explains these data about as well, by another correction.
    Competing,
}

/// How far an effect moves the observations of one unit.
struct Moved {
    unit: SiUnit,
    most: f64,
    mean: f64,
    /// The most, in terms of the noise.
    standing: f64,
}

/// What an accepted effect could be instead.
pub(super) struct Others {
    /// Effects of its confounded set, as it was when it came in or as it is at the last fit.
    pub alike: Vec<EffectId>,
    /// The members of each confounded set that explains these data about as well.
    pub competing: Vec<Vec<EffectId>>,
    /// The first of each confounded set that explains them somewhat worse.
    pub behind: Vec<EffectId>,
}

/// What each accepted effect could be instead.
pub(super) fn others(last: &Round<'_>) -> Vec<Others> {
    if last.is_given() {
        let none = |_| Others { alike: Vec::new(), competing: Vec::new(), behind: Vec::new() };
        return last.fitted.found.iter().map(none).collect();
    }
    let accepted = last.accepted_sets();
    let mut state = State::declared(&last.search.problem, |_| true);
    let blocks = SetColumns::of(&last.search.problem, &last.sets);
    accepted.iter().for_each(|&set| state.add(&blocks[set]));
    let mut competing =
        competing_models(&last.search.problem, &last.sets, &accepted, &state, IN_VIEW).into_iter();
    last.fitted
        .found
        .iter()
        .map(|found| {
            let set = last.set_of(found.effect);
            let mut alike = found.alike.clone();
            alike.extend(set.iter().flat_map(|&set| &last.sets[set].members));
            alike.retain(|&member| member != found.effect);
            alike.sort_unstable();
            alike.dedup();
            // An effect without a set competes with nothing: these data do not show it any more.
            let competing = set.and_then(|_| competing.next()).unwrap_or_default();
            // Where a contest said which causes may be it, no other is as good.
            let may_be = |set: SetId| {
                let members = &last.sets[set].members;
                found.shares.iter().any(|(other, _)| members.contains(other))
            };
            let is_as_good = |other: &CompetingModel| match found.shares.is_empty() {
                true => other.behind <= AS_GOOD,
                false => may_be(other.set),
            };
            let (competing, behind): (Vec<CompetingModel>, Vec<CompetingModel>) =
                competing.into_iter().partition(is_as_good);
            let others = |models: Vec<CompetingModel>| -> Vec<Vec<EffectId>> {
                let members = models.iter().map(|other| last.sets[other.set].members.clone());
                members.filter(|members| !alike.contains(&members[0])).collect()
            };
            let behind = others(behind).iter().map(|members| members[0]).collect();
            let competing = others(competing);
            Others { alike, competing, behind }
        })
        .collect()
}

/// The accepted effects, in the order they came in.
pub(super) fn effects(
    whole: &Context<'_>,
    last: &Round<'_>,
    confirmed: &Confirmed<'_>,
    others: &[Others],
) -> Vec<EffectFound> {
    let accepted = last.fitted.found.iter().zip(&last.fitted.errors).zip(others);
    accepted
        .map(|((found, errors), others)| {
            let effect = &whole.catalogue[found.effect];
            let chain = &last.fitted.chain;
            let set = last.set_of(found.effect);
            let moved = amplitude(last, &confirmed.rms, found.effect, errors);
            let name_of = |&id: &SymbolId| chain.symbol(id).name.clone();
            EffectFound {
                text: effect.text(chain, errors),
                body: chain.body(effect.place.body).name.clone(),
                dof: effect.freedoms(),
                side: if effect.place.role == Role::MotionError { Side::After } else { Side::Before },
                bends: effect.bends.as_ref().map(|bends| chain.observable(bends.observable).name.clone()),
                driver: effect.driver.clone(),
                form: effect.form.clone(),
                alias_orders: alias_orders(whole, effect),
                names: names(whole, effect, found.effect, &others.alike),
                confounded_with: others
                    .alike
                    .iter()
                    .map(|&other| whole.catalogue[other].name.clone())
                    .collect(),
                competing_with: others
                    .competing
                    .iter()
                    .map(|members| members.iter().map(|&other| whole.catalogue[other].name.clone()).collect())
                    .collect(),
                form_determined: true,
                causes: causes(whole, found, others),
                coefficients: errors
                    .iter()
                    .map(|id| (name_of(id), last.fitted.fit.values[id.index()]))
                    .collect(),
                coefficient_units: errors
                    .iter()
                    .map(|id| (name_of(id), unit_of(&whole.setting, chain, *id)))
                    .collect(),
                amplitude: moved.most,
                amplitude_rms: moved.mean,
                amplitude_unit: moved.unit,
                amplitude_of: observables_of(whole.request.observations, chain, moved.unit).swap_remove(0),
                standing: moved.standing,
                p_value: found.p_value,
                selected_in_folds: set.map_or(0.0, |set| confirmed.held_out.share(set)),
                observations: last.observations_behind(found.effect),
                bias: detectability::bias(whole, last, found.effect, errors),
            }
        })
        .collect()
}

/// Numbers of periods a turn that look like those of a wave that was found blind; none of other effects.
fn alias_orders(whole: &Context<'_>, effect: &Effect) -> Vec<u32> {
    let Dependence::Harmonic { order } = effect.form else { return Vec::new() };
    let joints = whole.setting.joints();
    let driver = joints.iter().find(|joint| whole.setting.name(joint.symbol) == effect.driver);
    let readings = driver.and_then(|joint| whole.request.observations.poses.column(joint.symbol));
    match readings {
        Some(readings) if effect.family == HIGH_HARMONIC => {
            aliases(readings, order, Policy::default().orders_own as u32)
        }
        _ => Vec::new(),
    }
}

/// Its own name, those of its set at the same place (the same function by another name), and those of other fields.
fn names(whole: &Context<'_>, effect: &Effect, number: EffectId, alike: &[EffectId]) -> Vec<String> {
    let mut names = vec![effect.name.clone()];
    let here =
        alike.iter().map(|&member| &whole.catalogue[member]).filter(|other| other.place == effect.place);
    names.extend(here.map(|other| other.name.clone()));
    names.dedup();
    names.extend(whole.names[number.0].iter().map(ToString::to_string));
    names
}

/// Every cause once.
fn causes(whole: &Context<'_>, found: &Found, others: &Others) -> Vec<Cause> {
    let mut causes: Vec<Cause> = Vec::new();
    let competing = others.competing.concat();
    let all = [
        (Relation::Accepted, &[found.effect][..]),
        (Relation::Same, &others.alike),
        (Relation::Competing, &competing),
    ];
    for (relation, effects) in all {
        for &number in effects {
            let effect = &whole.catalogue[number];
            if causes.iter().any(|cause| cause.name == effect.name) {
                continue;
            }
            let Some(family) = FAMILIES.iter().find(|family| family.name == effect.family) else {
                unreachable!("an effect names its family in the table of families");
            };
            causes.push(Cause {
                name: effect.name.clone(),
                family: family.name,
                body: whole.setting.body_name(effect.place.body).to_owned(),
                relation,
                share: found.shares.iter().find(|(own, _)| *own == number).map(|(_, share)| *share),
                published: whole.names[number.0].iter().map(ToString::to_string).collect(),
                causes: family.causes,
                looks: family.looks,
                check: family.check,
            });
        }
    }
    // Weighed ones by their shares in percent.
    causes.sort_by_key(|cause| std::cmp::Reverse((100.0 * cause.share.unwrap_or(0.0)).round() as u32));
    causes
}

/// The most that an effect moves an observation, and the root mean square over observations.
fn amplitude(last: &Round<'_>, rms: &[BeforeAfter], effect: EffectId, errors: &[SymbolId]) -> Moved {
    let rows = &last.search.rows;
    let mut by_row: BTreeMap<u32, f64> = BTreeMap::new();
    let columns: Vec<(&Vec<f64>, f64)> = rows.effects[effect.0]
        .iter()
        .zip(errors)
        .map(|(column, error)| (column, last.fitted.fit.values[error.index()]))
        .collect();
    for (component, &row) in rows.columns.row.iter().enumerate() {
        let moved: f64 = columns.iter().map(|(column, value)| column[component] * value).sum();
        *by_row.entry(row).or_insert(0.0) += moved * moved;
    }
    let of_row = rows.observations.poses.unit_of_row();
    let of_unit = |own: &BeforeAfter| {
        let squares =
            by_row.iter().filter(|(row, _)| of_row[**row as usize] == own.unit).map(|(_, square)| *square);
        let (most, sum, count) = squares.fold((0.0, 0.0, 0.0), |(most, sum, count): (f64, f64, f64), own| {
            (most.max(own), sum + own, count + 1.0)
        });
        let most = most.sqrt();
        Moved { unit: own.unit, most, mean: (sum / count.max(1.0)).sqrt(), standing: most / own.noise() }
    };
    // The first of those that show it as well.
    let best =
        rms.iter().map(of_unit).reduce(|best, own| if own.standing > best.standing { own } else { best });
    best.unwrap_or_else(|| unreachable!("an effect was found in observations"))
}

/// Whether a function without a name was taken up: a shape of several coefficients.
pub(super) fn has_unnamed(whole: &Context<'_>, last: &Fitted) -> bool {
    let mut effects = last.found.iter().map(|found| &whole.catalogue[found.effect]);
    effects.any(|effect| effect.family == SHAPE && effect.functions.len() > 1)
}
