//! What was found, in words: the report, and the lines of the amended declaration.

use std::collections::BTreeMap;

use model_core::{SymbolId, SymbolKind};

use super::held_out::BeforeAfter;
use super::round::Round;
use super::{Loop, declared};
use crate::amend::Addition;
use crate::fit::precision;
use crate::poses::{Criterion, Proposal, propose};
use crate::report::{EffectFound, ErrorFound, NotShown, Remaining, Report, SetAsideRow, Used, Verdict};
use crate::search::{HeldOut, rivals};

/// Standard deviations at which an effect is found four times out of five, corrected for the size of the catalogue.
const FOUND: f64 = 4.4;

/// Fewer observations than this are no evidence of an effect.
const FEW: f64 = 5.0;

/// The lines to add to the declaration.
pub(crate) fn additions(
    whole: &Loop<'_>,
    last: &Round,
    held_out: &HeldOut,
    rms: BeforeAfter,
) -> Vec<Addition> {
    let measure = whole.request.observations.series.first().map_or("rad", |series| series.measure.unit());
    last.found
        .iter()
        .zip(&last.errors)
        .map(|(found, errors)| {
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
            Addition {
                body: effect.place.body,
                role: effect.place.role,
                factor: effect.text(&last.chain, errors),
                documentation: vec![format!(
                    "Found {}: {}. Familywise p {}, found again in {:.0} % of the folds{held}.",
                    whole.request.when,
                    effect.name,
                    p_in_words(found.p_value),
                    100.0 * share
                )],
            }
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
pub(crate) fn new_inputs(whole: &Loop<'_>, last: &Round) -> Vec<(String, String)> {
    let declared = model_core::Chain::from_text(whole.request.text);
    let mut used: Vec<SymbolId> = last
        .found
        .iter()
        .flat_map(|found| &whole.catalogue[found.effect].functions)
        .flat_map(|function| function.amount.symbols())
        .filter(|&symbol| last.chain.symbol(symbol).kind == SymbolKind::Input)
        .collect();
    used.sort_unstable();
    used.dedup();
    used.into_iter()
        .map(|symbol| last.chain.symbol(symbol).name.clone())
        .filter(|name| declared.as_ref().is_ok_and(|chain| chain.find_symbol(name).is_none()))
        .map(|name| (name, "Measured beside the joints, in the unit of the data.".to_owned()))
        .collect()
}

/// Puts everything into the report.
pub(crate) fn report(
    whole: &Loop<'_>,
    last: &Round,
    held_out: &HeldOut,
    rms: BeforeAfter,
    remaining: Remaining,
) -> Report {
    let observations = whole.request.observations;
    let effects = effects(whole, last, held_out);
    let alone = effects.iter().all(|effect| effect.class.is_empty() && effect.rivals.is_empty());
    let thin = last.found.iter().any(|found| evidence(last, found.effect) < FEW);
    let verdict = if remaining.place.is_some() {
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
    let precision = precision(&last.chain, observations, &last.fit);
    let row_number = |row: usize| observations.row_numbers.get(row).copied().unwrap_or(row as u64 + 1);
    let aside = &last.fit.set_aside;
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
        precision,
        effects,
        remaining,
        not_shown: not_shown(whole, last, rms),
        before: rms.before,
        after: rms.after,
        unit: observations.series.first().map_or("rad", |series| series.measure.unit()),
    }
}

/// How many observations an effect hangs on: the rows' share of its projected columns, as an effective number.
fn evidence(last: &Round, effect: usize) -> f64 {
    let rows = last.problem.rows();
    let mut by_row = BTreeMap::new();
    for column in last.problem.columns(effect) {
        for (i, &row) in last.columns.row.iter().enumerate() {
            *by_row.entry(row).or_insert(0.0) += rows[(i, column)] * rows[(i, column)];
        }
    }
    let sum: f64 = by_row.values().sum();
    let squares: f64 = by_row.values().map(|share| share * share).sum();
    if squares > 0.0 { sum * sum / squares } else { 0.0 }
}

fn errors(last: &Round) -> Vec<ErrorFound> {
    last.fit
        .parameters
        .iter()
        .zip(&last.fit.separable)
        .map(|(&id, &separable)| {
            let symbol = last.chain.symbol(id);
            ErrorFound {
                name: symbol.name.clone(),
                value: last.fit.values[id.index()],
                standard_uncertainty: last.fit.standard_uncertainty(id).unwrap_or(0.0),
                unit: symbol.quantity.unit(),
                separable,
            }
        })
        .collect()
}

/// The poses that the study asks for; none if it asks for none, or if they cannot be computed.
fn next_poses(whole: &Loop<'_>, last: &Round) -> Vec<Proposal> {
    let Some(next) = &whole.request.plan.next else { return Vec::new() };
    let proposal = |criterion| {
        propose(&last.chain, whole.request.observations, &last.fit, next.count, &next.ranges, criterion).ok()
    };
    [Criterion::D, Criterion::A].into_iter().filter_map(proposal).collect()
}

fn effects(whole: &Loop<'_>, last: &Round, held_out: &HeldOut) -> Vec<EffectFound> {
    let accepted = last.accepted_classes();
    let selection = last.selection(whole);
    let all_rivals = rivals(&last.problem, &last.classes, &accepted, &selection.state);
    let name = |effect: usize| whole.catalogue[effect].name.clone();
    last.found
        .iter()
        .zip(&last.errors)
        .enumerate()
        .map(|(at, (found, errors))| {
            let effect = &whole.catalogue[found.effect];
            let class = last.class_of(found.effect);
            let mut alike = found.alike.clone();
            alike.extend(class.iter().flat_map(|&class| &last.classes[class].members));
            alike.retain(|&member| member != found.effect);
            alike.sort_unstable();
            alike.dedup();
            let others: Vec<String> = alike.iter().map(|&member| name(member)).collect();
            // Members of the class at the same place are the same function by another name.
            let mut names = vec![effect.name.clone()];
            let here = |member: &&usize| whole.catalogue[**member].place == effect.place;
            names.extend(alike.iter().filter(here).map(|&member| name(member)));
            names.dedup();
            EffectFound {
                text: effect.text(&last.chain, errors),
                body: last.chain.body(effect.place.body).name.clone(),
                dof: effect.place.freedom.word().to_owned(),
                driver: effect.driver.clone(),
                form: effect.form.clone(),
                names,
                class: others,
                rivals: all_rivals.get(at).map_or_else(Vec::new, |rivals| {
                    rivals.iter().map(|rival| name(last.classes[rival.class].members[0])).collect()
                }),
                coefficients: errors
                    .iter()
                    .map(|&id| (last.chain.symbol(id).name.clone(), last.fit.values[id.index()]))
                    .collect(),
                p_value: found.p_value,
                selected_in_folds: class.map_or(0.0, |class| held_out.share(class)),
                bias: bias(whole, last, found.effect, errors),
            }
        })
        .collect()
}

/// How far one standard uncertainty of an effect, left out, would move each declared error.
fn bias(whole: &Loop<'_>, last: &Round, effect: usize, errors: &[SymbolId]) -> BTreeMap<String, f64> {
    let columns = last.problem.columns(effect);
    let combinations = &last.combinations;
    let mut squares = vec![0.0; combinations.nrows()];
    for (&column, &error) in columns.iter().zip(errors) {
        let sigma = last.fit.standard_uncertainty(error).unwrap_or(0.0);
        let share = last.problem.share(column);
        for (i, square) in squares.iter_mut().enumerate() {
            let moved: f64 = share.iter().enumerate().map(|(j, s)| combinations[(i, j)] * s).sum();
            *square += (sigma * moved).powi(2);
        }
    }
    declared(whole)
        .iter()
        .zip(squares)
        .filter(|&(_, square)| square > 0.0)
        .map(|(&id, square)| (last.chain.symbol(id).name.clone(), square.sqrt()))
        .collect()
}

/// Effects that could be as large as the residual without these data showing them.
fn not_shown(whole: &Loop<'_>, last: &Round, rms: BeforeAfter) -> Vec<NotShown> {
    let problem = &last.problem;
    let accepted: Vec<usize> = last.found.iter().map(|found| found.effect).collect();
    let mut list = Vec::new();
    for (number, effect) in whole.catalogue.iter().enumerate() {
        if accepted.contains(&number) {
            continue;
        }
        if last.effects[number].is_empty() {
            let unit = effect.place.freedom.quantity().unit();
            list.push(NotShown { name: effect.name.clone(), smallest: None, unit, absorbed: 0.0 });
            continue;
        }
        let columns = problem.columns(number);
        let shortest = columns.iter().map(|&column| problem.length(column)).fold(f64::INFINITY, f64::min);
        let smallest = (!columns.is_empty()).then(|| FOUND / shortest);
        if smallest.is_none_or(|smallest| smallest > rms.after.rms) {
            list.push(NotShown {
                name: effect.name.clone(),
                smallest,
                unit: effect.place.freedom.quantity().unit(),
                absorbed: 1.0 - problem.visible(number),
            });
        }
    }
    list
}
