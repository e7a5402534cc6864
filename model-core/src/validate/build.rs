//! From a declaration that keeps every rule to the chain that it stands for.

use std::collections::BTreeMap;

use proc_macro2::{Ident, Span};

use super::Subject;
use super::amounts::{Amount, Purpose};
use super::printed_form;
use super::quantity::inferred;
use super::scope::documentation;
use super::sight;
use super::words::{self, GROUND, OBSERVABLE_KINDS, meaning};
use crate::algebra::{Poly, Rational};
use crate::chain::image::Image;
use crate::chain::reading::{COMPONENTS, IMAGE, ROTATION, Reading};
use crate::chain::{Body, BodyId, Chain, Factor, Observable};
use crate::mistake::Mistake;
use crate::symbol::{Quantity, Symbol, SymbolId, SymbolKind};
use crate::syntax::ORIENTATION;
use crate::syntax::declaration::{BodyStatement, ObserveStatement, ReadingTerm};

/// Why a lookup here finds what it looks for.
const RULED: &str = "a declaration that breaks a rule is not built";

/// The chain of a declaration that breaks no rule.
///
/// # Errors
/// Lines of sight whose angle from up the algebra cannot follow.
pub fn chain(subject: &Subject<'_>) -> Result<Chain, Vec<Mistake<Span>>> {
    let bodies = in_order(subject.declaration.bodies().collect());
    let ids: BTreeMap<String, BodyId> =
        (0u16..).zip(&bodies).map(|(index, body)| (body.name.to_string(), BodyId(index))).collect();
    let known = |body: &Ident| match ids.get(&body.to_string()) {
        Some(id) => *id,
        None => unreachable!("the body `{body}` is not declared: {RULED}"),
    };
    let above_ground = |body: &Ident| (body != GROUND).then(|| known(body));
    let mut chain = Chain {
        name: subject.declaration.name.to_string(),
        documentation: subject.declaration.documentation.clone(),
        symbols: symbols(subject),
        bodies: bodies
            .iter()
            .map(|body| Body {
                name: body.name.to_string(),
                documentation: body.documentation.clone(),
                lower: above_ground(&body.lower),
                factors: factors(subject, body),
            })
            .collect(),
        observables: subject
            .declaration
            .observables()
            .map(|observe| Observable {
                name: observe.name.to_string(),
                documentation: observe.documentation.clone(),
                kind: meaning(&OBSERVABLE_KINDS, &observe.kind)
                    .unwrap_or_else(|| unreachable!("`{}` is no kind: {RULED}", observe.kind)),
                components: components(subject, observe),
                body: known(&observe.body),
                frame: seen_in(observe).and_then(above_ground),
                shown: match observe.readings.as_slice() {
                    [] if observe.kind == ORIENTATION => ROTATION.to_vec(),
                    [] if observe.image.is_some() => IMAGE.to_vec(),
                    [] => COMPONENTS.to_vec(),
                    readings => readings.iter().map(reading).collect(),
                },
                image: observe.image.as_ref().map(|_| Box::new(image(subject, observe))),
                bend: None,
            })
            .collect(),
        ramps: Vec::new(),
        sight_angles: Vec::new(),
        gravity: gravity(subject),
    };
    for ramp in subject.scope.ramps() {
        let symbol = chain.add_ramp(ramp.of, ramp.from.clone(), ramp.to.clone());
        assert_eq!(symbol, Some(ramp.symbol), "the ramps are the last names of the scope, in order");
    }
    sight::complete(subject, &mut chain)?;
    Ok(chain)
}

/// The bodies, each after its lower body, otherwise in the order of the text.
fn in_order(bodies: Vec<&BodyStatement>) -> Vec<&BodyStatement> {
    let index: BTreeMap<String, usize> =
        bodies.iter().enumerate().map(|(at, body)| (body.name.to_string(), at)).collect();
    let mut is_placed = vec![false; bodies.len()];
    let mut ordered = Vec::with_capacity(bodies.len());
    for start in 0..bodies.len() {
        let mut way = Vec::new();
        let mut next = Some(start);
        while let Some(at) = next.filter(|&at| !is_placed[at]) {
            is_placed[at] = true;
            way.push(bodies[at]);
            next = index.get(&bodies[at].lower.to_string()).copied();
        }
        ordered.extend(way.into_iter().rev());
    }
    ordered
}

fn reading(written: &ReadingTerm) -> Reading {
    words::reading(written).unwrap_or_else(|| unreachable!("`{}` is no reading: {RULED}", written.word))
}

/// What an amount comes to; a mistake was told where it comes to nothing.
fn value(amount: &Amount<'_>) -> Poly {
    amount.value.clone().unwrap_or_else(|| unreachable!("an amount without a value: {RULED}"))
}

fn factors(subject: &Subject<'_>, body: &BodyStatement) -> Vec<Factor> {
    subject
        .amounts
        .iter()
        .filter_map(|amount| match amount.purpose {
            Purpose::Factor { body: owner, group, factor, role, kind, axis } if std::ptr::eq(owner, body) => {
                Some(Factor {
                    role,
                    kind,
                    axis,
                    amount: value(amount),
                    documentation: documentation(group, factor).to_owned(),
                })
            }
            _ => None,
        })
        .collect()
}

fn components(subject: &Subject<'_>, observe: &ObserveStatement) -> [Poly; 3] {
    let values = subject
        .amounts
        .iter()
        .filter(|amount| matches!(amount.purpose, Purpose::Component(owner) if std::ptr::eq(owner, observe)));
    match three(values) {
        Some(components) => components,
        // An orientation states none, and needs none.
        None => [0; 3].map(|number| Poly::constant(Rational::from(number))),
    }
}

/// The body in whose frame an observable is seen, or to which an image point is fixed.
fn seen_in(observe: &ObserveStatement) -> Option<&Ident> {
    observe.image.as_ref().map_or(observe.frame.as_ref(), |image| image.target.as_ref())
}

fn image(subject: &Subject<'_>, observe: &ObserveStatement) -> Image {
    let own = |amount: &&Amount<'_>| matches!(amount.purpose, Purpose::Intrinsic(owner) if std::ptr::eq(owner, observe));
    let numbers: Vec<Poly> = subject.amounts.iter().filter(own).map(value).collect();
    match numbers.try_into() {
        Ok(intrinsics) => Image { intrinsics },
        Err(_) => unreachable!("a camera has all of its numbers: {RULED}"),
    }
}

/// Down is −z, unless declared.
fn gravity(subject: &Subject<'_>) -> [Poly; 3] {
    let values = subject.amounts.iter().filter(|amount| matches!(amount.purpose, Purpose::Gravity));
    three(values).unwrap_or_else(|| [0, 0, -1].map(|number| Poly::constant(Rational::from(number))))
}

/// The three components of a vector; `None` if it is not stated.
fn three<'a>(amounts: impl Iterator<Item = &'a Amount<'a>>) -> Option<[Poly; 3]> {
    match amounts.map(value).collect::<Vec<Poly>>().try_into() {
        Ok(components) => Some(components),
        Err(stated) if stated.is_empty() => None,
        Err(stated) => unreachable!("a vector has three components, not {}: {RULED}", stated.len()),
    }
}

fn symbols(subject: &Subject<'_>) -> Vec<Symbol> {
    let scope = &subject.scope;
    let quantities = error_quantities(subject);
    let printed: BTreeMap<String, &str> = subject
        .declaration
        .printed_symbols()
        .map(|symbol| (symbol.name.to_string(), symbol.latex.as_str()))
        .collect();
    let of: BTreeMap<String, SymbolId> = subject
        .declaration
        .inputs()
        .filter_map(|input| Some((input.name.to_string(), scope.find(&input.of.as_ref()?.to_string())?)))
        .collect();
    let values: BTreeMap<String, f64> = subject
        .declaration
        .constants()
        .filter_map(|constant| Some((constant.name.to_string(), constant.value.as_ref()?.eval(&|_| None)?)))
        .collect();
    (0u16..)
        .map(SymbolId)
        .zip(scope.entries())
        .filter(|(_, entry)| entry.kind != SymbolKind::Ramp)
        .map(|(id, entry)| Symbol {
            name: entry.name.clone(),
            kind: entry.kind,
            quantity: entry.quantity.or_else(|| quantities.get(&id).copied()).unwrap_or(Quantity::Number),
            meaning: entry.meaning,
            of: of.get(&entry.name).copied(),
            documentation: entry.documentation.clone(),
            latex: printed
                .get(&entry.name)
                .map_or_else(|| printed_form::latex(&entry.name), |latex| (*latex).to_owned()),
            value: match entry.kind {
                SymbolKind::Pi => Some(std::f64::consts::PI),
                _ => entry.value.or_else(|| values.get(&entry.name).copied()),
            },
        })
        .collect()
}

/// What errors measure: an angle or a length where any use says so, a number otherwise.
fn error_quantities(subject: &Subject<'_>) -> BTreeMap<SymbolId, Quantity> {
    let mut quantities = BTreeMap::new();
    for (id, quantity) in subject.amounts.iter().flat_map(|amount| inferred(&subject.scope, amount)) {
        let known = quantities.entry(id).or_insert(quantity);
        if *known == Quantity::Number {
            *known = quantity;
        }
    }
    quantities
}
