//! Rules about what acts on a line of sight: the angle from up, and the bending of a direction.

use std::collections::BTreeSet;

use proc_macro2::Span;

use super::super::Subject;
use super::super::amounts::Purpose;
use crate::mistake::Mistake;
use crate::syntax::declaration::ObserveStatement;

/// The word for where a plumb line points away from.
const UP: &str = "up";

pub fn angle_is_from_up(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    let mut named: BTreeSet<String> = BTreeSet::new();
    for input in subject.declaration.inputs() {
        let Some(between) = &input.between else { continue };
        let (name, sight) = (&input.name, between.sight.to_string());
        let written = format!("write `input {name}: angle = between({sight}, up);`");
        if input.meaning.as_ref().is_none_or(|meaning| meaning != "angle") || input.of.is_some() {
            let place = input.meaning.as_ref().map_or(name.span(), proc_macro2::Ident::span);
            mistakes.push(
                Mistake::new(
                    place,
                    format!("what is between two directions is an angle, and so is `{name}`"),
                )
                .with_help(written.clone()),
            );
        }
        if between.up != UP {
            mistakes.push(
                Mistake::new(
                    between.up.span(),
                    format!("an angle is counted from `up`, not from `{}`", between.up),
                )
                .with_help(written),
            );
        }
        let observe = subject.declaration.observables().find(|observe| observe.name == sight);
        match observe {
            Some(observe) if is_direction(observe) => {}
            Some(observe) => mistakes.push(
                Mistake::new(
                    between.sight.span(),
                    format!("`{sight}` is observed as {}", with_article(observe)),
                )
                .with_help("name an observed direction"),
            ),
            None => mistakes.push(
                Mistake::new(between.sight.span(), format!("no observable is called `{sight}`"))
                    .with_help(format!("declare it: `observe {sight}: direction(0, 0, 1) of body;`")),
            ),
        }
        if !named.insert(sight.clone()) {
            mistakes.push(
                Mistake::new(name.span(), format!("the angle between `{sight}` and up has two names"))
                    .with_help("remove one of the two"),
            );
        }
    }
}

pub fn direction_is_bent_by_errors(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for observe in subject.declaration.observables() {
        let Some(bent) = &observe.bent else { continue };
        let name = &observe.name;
        if !is_direction(observe) {
            mistakes.push(
                Mistake::new(
                    bent.keyword,
                    format!(
                        "`{name}` is observed as {}, and only a direction is bent",
                        with_article(observe)
                    ),
                )
                .with_help("bend the direction that points to it"),
            );
            continue;
        }
        let mut angles = subject.declaration.inputs().filter_map(|input| input.between.as_ref());
        if !angles.any(|between| between.sight == *name) {
            mistakes.push(
                Mistake::new(bent.keyword, format!("the angle between `{name}` and up has no name"))
                    .with_help(format!("declare it: `input zenith: angle = between({name}, up);`")),
            );
        }
    }
    for amount in &subject.amounts {
        let (Purpose::Bend(_), Some(value)) = (&amount.purpose, &amount.value) else { continue };
        if !value.graded_part(|id| subject.scope.is_error(id), 0).is_zero() {
            mistakes.push(
                Mistake::new(amount.written.place, "this amount does not vanish when every error is zero")
                    .with_help("multiply every term by an error: `refraction*tan(zenith)`"),
            );
        }
    }
}

fn is_direction(observe: &ObserveStatement) -> bool {
    // An unknown kind has a rule of its own.
    !(observe.kind == "point" || observe.kind == crate::syntax::ORIENTATION)
}

fn with_article(observe: &ObserveStatement) -> &'static str {
    if observe.kind == "point" { "a point" } else { "an orientation" }
}
