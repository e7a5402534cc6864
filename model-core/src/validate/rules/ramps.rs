//! Rules about ramps.

use proc_macro2::Span;

use super::super::Subject;
use crate::expr::{Expr, Node};
use crate::mistake::Mistake;
use crate::symbol::SymbolKind;

pub fn ramp_has_its_parts(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    let mut ramps = Vec::new();
    subject.declaration.amounts().for_each(|amount| amount.ramps(&mut ramps));
    for parts in ramps {
        let [of, from, to] = parts;
        let kind = match &of.node {
            Node::Symbol(name) => subject.scope.lookup(name).map(|entry| entry.kind),
            _ => Some(SymbolKind::Ramp),
        };
        // A name that nothing declares has a rule of its own.
        if !matches!(kind, None | Some(SymbolKind::Joint | SymbolKind::Input)) {
            mistakes.push(
                Mistake::new(of.place, "a ramp is taken of one joint or input, and here is something else")
                    .with_help(
                        "write `ramp(elevation, 39 deg, 53 deg)`; thresholds make up for a sign or an offset",
                    ),
            );
        }
        let before = mistakes.len();
        for threshold in [from, to] {
            threshold_is_fixed(subject, threshold, mistakes);
        }
        let [first, second] = [from, to].map(|threshold| value(subject, threshold));
        let written_alike = subject.scope.ramp_parts(parts).is_none_or(|(_, [from, to])| from == to);
        if mistakes.len() > before || written_alike {
            continue;
        }
        if first == second {
            mistakes.push(
                Mistake::new(
                    to.place,
                    "the two thresholds of a ramp have the same value, written differently",
                )
                .with_help("write the same amount twice for a step"),
            );
        } else if [first, second].iter().any(|value| value.is_none_or(|value| !value.is_finite())) {
            mistakes.push(
                Mistake::new(from.place, "a threshold of a ramp is not finite")
                    .with_help("write numbers and constants, as in `ramp(elevation, 39 deg, 53 deg)`"),
            );
        }
    }
}

/// Sums and products of numbers and constants.
fn threshold_is_fixed(subject: &Subject<'_>, threshold: &Expr<Span>, mistakes: &mut Vec<Mistake<Span>>) {
    const HELP: &str = "write numbers and constants, as in `ramp(elevation, 39 deg, 53 deg)`";
    let known = |name: &str| subject.scope.lookup(name).map(|entry| entry.kind);
    let mut is_fixed = true;
    for (name, place) in threshold.names() {
        let what = match known(name) {
            Some(SymbolKind::Joint) => "joint",
            Some(SymbolKind::Input) => "input",
            Some(SymbolKind::Error) => "error",
            Some(SymbolKind::SightAngle) => "angle of a line of sight",
            Some(SymbolKind::Pi | SymbolKind::Constant | SymbolKind::Ramp) | None => continue,
        };
        is_fixed = false;
        mistakes.push(
            Mistake::new(place, format!("the {what} `{name}` stands in a threshold of a ramp"))
                .with_help(HELP),
        );
    }
    let is_known = threshold.names().iter().all(|(name, _)| known(name).is_some());
    if is_fixed && is_known && subject.scope.threshold(threshold).is_none() {
        mistakes.push(
            Mistake::new(threshold.place, "a threshold of a ramp is made of more than numbers and constants")
                .with_help(HELP),
        );
    }
}

/// The value of a threshold with constants as declared.
fn value(subject: &Subject<'_>, threshold: &Expr<Span>) -> Option<f64> {
    threshold.eval(&|name| {
        let constant = subject.declaration.constants().find(|constant| constant.name == name)?;
        constant.value.as_ref()?.eval(&|_| None)
    })
}
