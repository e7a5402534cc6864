//! Rules about what bodies hang on.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Span;

use super::super::Subject;
use super::super::words::GROUND;
use crate::mistake::Mistake;
use crate::names::nearest;
use crate::syntax::declaration::BodyStatement;

pub fn lower_body_exists(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    let names: BTreeSet<String> = subject.declaration.bodies().map(|body| body.name.to_string()).collect();
    for body in subject.declaration.bodies() {
        let lower = body.lower.to_string();
        if lower != GROUND && !names.contains(&lower) {
            mistakes.push(unknown_body(subject, &lower, body.lower.span()));
        }
    }
}

/// The mistake that a body is not declared, with the nearest that is.
pub fn unknown_body(subject: &Subject<'_>, name: &str, place: Span) -> Mistake<Span> {
    let names: Vec<String> = subject.declaration.bodies().map(|body| body.name.to_string()).collect();
    let known = names.iter().map(String::as_str).chain(std::iter::once(GROUND));
    let help = match nearest(name, known) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("declare it: `body {name} on ground {{ … }}`"),
    };
    Mistake::new(place, format!("unknown body `{name}`")).with_help(help)
}

/// Reports a circle once, at the body of it that comes first in the text.
pub fn hangs_on_ground(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    let bodies: Vec<&BodyStatement> = subject.declaration.bodies().collect();
    let names: Vec<String> = bodies.iter().map(|body| body.name.to_string()).collect();
    let mut index: BTreeMap<String, usize> = BTreeMap::new();
    for (at, name) in names.iter().enumerate() {
        index.entry(name.clone()).or_insert(at);
    }
    let mut is_settled = vec![false; bodies.len()];
    for start in 0..bodies.len() {
        let mut way: Vec<usize> = Vec::new();
        let mut next = Some(start);
        while let Some(at) = next.filter(|&at| !is_settled[at]) {
            is_settled[at] = true;
            way.push(at);
            next = Some(bodies[at].lower.to_string())
                .filter(|lower| lower != GROUND)
                .and_then(|lower| index.get(&lower).copied());
        }
        let circle = next.and_then(|back| way.iter().position(|&at| at == back)).map(|from| &way[from..]);
        if let Some(circle) = circle {
            let mut message = format!("the body `{}` hangs on itself", names[circle[0]]);
            if circle.len() > 1 {
                let route: Vec<&str> =
                    circle.iter().chain(&circle[..1]).map(|&at| names[at].as_str()).collect();
                message = format!("{message}: {}", route.join(" on "));
            }
            mistakes.push(
                Mistake::new(bodies[circle[0]].lower.span(), message)
                    .with_help("hang one of them on `ground`, or on a body that does"),
            );
        }
    }
}
