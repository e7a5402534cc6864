//! What was found, in words: the report, and the lines of the amended declaration.

use std::collections::BTreeMap;

use model_core::{SymbolId, SymbolKind};

use crate::amend::{Addition, NewInput};
use crate::calibrate::Loop;
use crate::calibrate::held_out::BeforeAfter;
use crate::calibrate::round::Round;
use crate::candidate::Function;
use crate::data::Measure;
use crate::design::discrimination::separation;
use crate::design::{Criterion, Proposal, propose};
use crate::diagnose::detectability;
use crate::diagnose::precision;
use crate::report::{EffectFound, ErrorFound, Remaining, Report, SetAsideRow, Used, Verdict};
use crate::search::select::{State, class_columns};
use crate::search::{AS_GOOD, HeldOut, Rival, rivals};

/// Fewer observations than this are no evidence of an effect.
const FEW: f64 = 5.0;

/// Units of log-likelihood behind the best within which an explanation is kept in view when poses are chosen.
const IN_VIEW: f64 = 10.0;

/// The lines to add to the declaration.
pub(crate) fn additions(
    whole: &Loop<'_>,
    last: &Round<'_>,
    held_out: &HeldOut,
    rms: BeforeAfter,
) -> Vec<Addition> {
    let measure = whole.request.observations.series.first().map_or("rad", |series| series.measure.unit());
    last.fitted
        .found
        .iter()
        .zip(&last.fitted.errors)
        .flat_map(|(found, errors)| {
            let effect = &whole.catalogue[found.effect];
            let share = last.class_of(found.effect).map_or(0.0, |class| held_out.share(class));
            let held = match (rms.before.held_out_rms, rms.after.held_out_rms) {
                (Some(before), Some(after)) => format!(
                    ", held-out residual {} to {} RMS",
                    in_words(before, measure),
                    in_words(after, measure)
                ),
                _ => String::new(),
            };
            let documentation = format!(
                "Found {}: {}. Familywise p {}, found again in {:.0} % of the folds{held}.",
                whole.request.when,
                effect.name,
                p_in_words(found.p_value),
                100.0 * share
            );
            effect.texts(&last.fitted.chain, errors).into_iter().map(move |(body, role, factor)| Addition {
                body,
                role,
                factor,
                documentation: vec![documentation.clone()],
            })
        })
        .collect()
}

/// A residual with the unit that its size is usually told in.
fn in_words(si: f64, unit: &str) -> String {
    match unit {
        "rad" => format!("{:.4} arcsec", si.to_degrees() * 3600.0),
        _ => format!("{:.4} mm", 1e3 * si),
    }
}

fn p_in_words(p: f64) -> String {
    if p < 0.0015 { "≤ 0.001".to_owned() } else { format!("{p:.3}") }
}

/// Inputs that accepted effects use and the declaration does not have.
pub(crate) fn new_inputs(whole: &Loop<'_>, last: &Round<'_>) -> Vec<NewInput> {
    let declared = model_core::Chain::from_text(whole.request.text);
    let mut used: Vec<SymbolId> = last
        .fitted
        .found
        .iter()
        .flat_map(|found| &whole.catalogue[found.effect].functions)
        .flat_map(Function::symbols)
        .filter(|&symbol| last.fitted.chain.symbol(symbol).kind == SymbolKind::Input)
        .collect();
    used.sort_unstable();
    used.dedup();
    used.into_iter()
        .map(|symbol| last.fitted.chain.symbol(symbol))
        .filter(|symbol| declared.as_ref().is_ok_and(|chain| chain.find_symbol(&symbol.name).is_none()))
        .map(|symbol| NewInput {
            name: symbol.name.clone(),
            quantity: symbol.quantity,
            documentation: "Measured beside the joints, in the unit of the data.".to_owned(),
        })
        .collect()
}

/// Puts everything into the report.
pub(crate) fn report(
    whole: &Loop<'_>,
    last: &Round<'_>,
    held_out: &HeldOut,
    rms: BeforeAfter,
    remaining: Remaining,
) -> Report {
    let observations = whole.request.observations;
    let others = others(last);
    let effects = effects(whole, last, held_out, &others);
    let separating = others
        .iter()
        .enumerate()
        .filter_map(|(at, others)| {
            let all: Vec<usize> = others.alike.iter().chain(&others.rivals).copied().collect();
            separation(whole, last, at, &all, &others.behind)
        })
        .collect();
    let alone = effects.iter().all(|effect| effect.class.is_empty() && effect.rivals.is_empty());
    let thin = last.fitted.found.iter().any(|found| evidence(last, found.effect) < FEW);
    let verdict = if remaining.place.is_some() || remaining.p_value <= whole.options.false_alarm {
        Verdict::StructureRemains
    } else if thin {
        Verdict::FewObservations
    } else if effects.is_empty() {
        Verdict::NothingDetectable
    } else if alone {
        Verdict::Explained
    } else {
        Verdict::UpToAClass
    };
    let mut precision = precision(&last.fitted.chain, observations, &last.fitted.fit);
    let stated = whole.request.plan.fit.noise.sigma.zip(observations.series.first());
    precision.noise.extend(stated.map(|(sigma, series)| stated_noise(sigma, series.measure)));
    let row_number = |row: usize| observations.row_numbers.get(row).copied().unwrap_or(row as u64 + 1);
    let aside = &last.fitted.fit.set_aside;
    Report {
        verdict,
        observations: Used {
            rows: observations.rows(),
            used: observations.rows() - aside.len(),
            set_aside: aside
                .iter()
                .map(|aside| SetAsideRow { row: row_number(aside.row), why: aside.why.clone() })
                .collect(),
        },
        errors: errors(last),
        not_separable: precision.not_separable.iter().map(|set| set.names.clone()).collect(),
        next_poses: next_poses(whole, last),
        separating,
        precision,
        effects,
        remaining,
        not_shown: detectability::not_shown(whole, last, rms),
        before: rms.before,
        after: rms.after,
        unit: observations.series.first().map_or("rad", |series| series.measure.unit()),
    }
}

/// How many observations an effect hangs on: the rows' share of its projected columns, as an effective number.
fn evidence(last: &Round<'_>, effect: usize) -> f64 {
    let problem = last.posed.of_rows();
    let rows = problem.rows();
    let mut by_row = BTreeMap::new();
    for column in problem.columns(effect) {
        for (i, &row) in last.posed.rows.columns.row.iter().enumerate() {
            *by_row.entry(row).or_insert(0.0) += rows[(i, column)] * rows[(i, column)];
        }
    }
    let sum: f64 = by_row.values().sum();
    let squares: f64 = by_row.values().map(|share| share * share).sum();
    if squares > 0.0 { last.posed.share() * sum * sum / squares } else { 0.0 }
}

fn errors(last: &Round<'_>) -> Vec<ErrorFound> {
    last.fitted
        .fit
        .parameters
        .iter()
        .zip(&last.fitted.fit.separable)
        .map(|(&id, &separable)| {
            let symbol = last.fitted.chain.symbol(id);
            ErrorFound {
                name: symbol.name.clone(),
                value: last.fitted.fit.values[id.index()],
                standard_uncertainty: last.fitted.fit.standard_uncertainty(id).unwrap_or(0.0),
                unit: symbol.quantity.unit(),
                separable,
            }
        })
        .collect()
}

/// What became of the standard deviation that the study states, rad or m.
fn stated_noise(sigma: f64, measure: Measure) -> String {
    format!(
        "the study states {}; weights and uncertainties go by what the residuals show, since something may be missing",
        in_words(sigma, measure.unit())
    )
}

/// The poses that the study asks for; none if it asks for none, or if they cannot be computed.
fn next_poses(whole: &Loop<'_>, last: &Round<'_>) -> Vec<Proposal> {
    let Some(next) = &whole.request.plan.next else { return Vec::new() };
    let proposal = |criterion| {
        propose(
            &last.fitted.chain,
            whole.request.observations,
            &last.fitted.fit,
            next.count,
            &next.ranges,
            criterion,
        )
        .ok()
    };
    [Criterion::D, Criterion::A].into_iter().filter_map(proposal).collect()
}

/// What an accepted effect could be instead.
struct Others {
    /// Effects of its class, as it was when it came in or as it is at the last fit.
    alike: Vec<usize>,
    /// The first of each class that explains these data about as well.
    rivals: Vec<usize>,
    /// The first of each class that explains them somewhat worse.
    behind: Vec<usize>,
}

fn others(last: &Round<'_>) -> Vec<Others> {
    let accepted = last.accepted_classes();
    let mut state = State::declared(&last.posed.problem, |_| true);
    let blocks = class_columns(&last.posed.problem, &last.classes);
    accepted.iter().for_each(|&class| state.add(&blocks[class]));
    let mut rivals = rivals(&last.posed.problem, &last.classes, &accepted, &state, IN_VIEW).into_iter();
    last.fitted
        .found
        .iter()
        .map(|found| {
            let class = last.class_of(found.effect);
            let mut alike = found.alike.clone();
            alike.extend(class.iter().flat_map(|&class| &last.classes[class].members));
            alike.retain(|&member| member != found.effect);
            alike.sort_unstable();
            alike.dedup();
            // An effect without a class has no rivals: these data do not show it any more.
            let rivals = class.and_then(|_| rivals.next()).unwrap_or_default();
            let (rivals, behind): (Vec<Rival>, Vec<Rival>) =
                rivals.into_iter().partition(|rival| rival.behind <= AS_GOOD);
            let first = |rivals: Vec<Rival>| -> Vec<usize> {
                let effects = rivals.iter().map(|rival| last.classes[rival.class].members[0]);
                effects.filter(|effect| !alike.contains(effect)).collect()
            };
            let (rivals, behind) = (first(rivals), first(behind));
            Others { alike, rivals, behind }
        })
        .collect()
}

fn effects(whole: &Loop<'_>, last: &Round<'_>, held_out: &HeldOut, others: &[Others]) -> Vec<EffectFound> {
    let name = |effect: &usize| whole.catalogue[*effect].name.clone();
    last.fitted
        .found
        .iter()
        .zip(&last.fitted.errors)
        .zip(others)
        .map(|((found, errors), others)| {
            let effect = &whole.catalogue[found.effect];
            let class = last.class_of(found.effect);
            // Members of the class at the same place are the same function by another name.
            let mut names = vec![effect.name.clone()];
            let here = |member: &&usize| whole.catalogue[**member].place == effect.place;
            names.extend(others.alike.iter().filter(here).map(name));
            names.dedup();
            names.extend(whole.names[found.effect].iter().map(ToString::to_string));
            EffectFound {
                text: effect.text(&last.fitted.chain, errors),
                body: last.fitted.chain.body(effect.place.body).name.clone(),
                dof: effect.freedoms(),
                driver: effect.driver.clone(),
                form: effect.form.clone(),
                names,
                class: others.alike.iter().map(name).collect(),
                rivals: others.rivals.iter().map(name).collect(),
                coefficients: errors
                    .iter()
                    .map(|&id| {
                        (last.fitted.chain.symbol(id).name.clone(), last.fitted.fit.values[id.index()])
                    })
                    .collect(),
                p_value: found.p_value,
                selected_in_folds: class.map_or(0.0, |class| held_out.share(class)),
                bias: detectability::bias(whole, last, found.effect, errors),
            }
        })
        .collect()
}
