//! Rules about observables, and about gravity, which is written like one.

use proc_macro2::Span;

use super::super::Subject;
use super::super::amounts::Purpose;
use super::super::words::{GROUND, OBSERVABLE_KINDS, advice, meaning};
use super::bodies::unknown_body;
use crate::algebra::Poly;
use crate::chain::ObservableKind;
use crate::mistake::Mistake;
use crate::symbol::SymbolKind;

pub fn kind_is_known(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for observe in subject.declaration.observables() {
        if meaning(&OBSERVABLE_KINDS, &observe.kind).is_none() {
            mistakes.push(
                Mistake::new(observe.kind.span(), format!("unknown kind of observable `{}`", observe.kind))
                    .with_help(advice(&OBSERVABLE_KINDS, &observe.kind)),
            );
        }
    }
}

pub fn body_exists(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for observe in subject.declaration.observables() {
        if observe.body == GROUND {
            mistakes.push(
                Mistake::new(observe.body.span(), "an observable of the ground never moves").with_help(
                    "write the name of a body; what stands still and is seen from a body is of a body without factors: \
                     `body sky on ground { }`",
                ),
            );
        } else if !subject.declaration.bodies().any(|body| body.name == observe.body) {
            mistakes.push(unknown_body(subject, &observe.body.to_string(), observe.body.span()));
        }
    }
}

pub fn components_are_known(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for amount in &subject.amounts {
        let what = match amount.purpose {
            Purpose::Component(_) => "an observable",
            Purpose::Gravity => "the direction of gravity",
            Purpose::Factor { .. } | Purpose::Intrinsic(_) | Purpose::Bend(_) => continue,
        };
        for (name, place) in amount.written.names() {
            let kind = match subject.scope.lookup(name).map(|entry| entry.kind) {
                Some(SymbolKind::Joint) => "joint",
                Some(SymbolKind::Error) => "error",
                Some(SymbolKind::SightAngle) => "angle of a line of sight",
                _ => continue,
            };
            mistakes.push(
                Mistake::new(place, format!("the {kind} `{name}` stands in {what}"))
                    .with_help("write numbers, constants and inputs; factors say how bodies move"),
            );
        }
    }
}

pub fn direction_is_not_zero(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for observe in subject.declaration.observables() {
        let is_direction = meaning(&OBSERVABLE_KINDS, &observe.kind) == Some(ObservableKind::Direction);
        let components = subject.amounts.iter().filter(
            |amount| matches!(amount.purpose, Purpose::Component(other) if std::ptr::eq(other, observe)),
        );
        if is_direction && is_zero_vector(components.map(|amount| amount.value.as_ref())) {
            mistakes.push(
                Mistake::new(observe.kind.span(), format!("the direction `{}` is zero", observe.name))
                    .with_help("write the direction in the frame of the body: `direction(0, 0, 1)`"),
            );
        }
    }
}

pub fn gravity_is_a_direction(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    let components =
        subject.amounts.iter().filter(|amount| matches!(amount.purpose, Purpose::Gravity)).take(3);
    if let Some(first) = subject.declaration.gravities().next()
        && is_zero_vector(components.map(|amount| amount.value.as_ref()))
    {
        mistakes.push(
            Mistake::new(first.keyword, "the direction of gravity is zero")
                .with_help("write where down is in the ground frame: `gravity: (0, 0, -1);`"),
        );
    }
    for again in subject.declaration.gravities().skip(1) {
        mistakes.push(
            Mistake::new(again.keyword, "gravity is declared twice").with_help("remove one of the two"),
        );
    }
}

fn is_zero_vector<'a>(mut components: impl Iterator<Item = Option<&'a Poly>>) -> bool {
    components.all(|value| value.is_some_and(Poly::is_zero))
}
