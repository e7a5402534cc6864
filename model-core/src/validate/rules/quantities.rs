//! Rules about what symbols measure, and about the values of constants.

use std::collections::BTreeMap;

use proc_macro2::{Ident, Span};

use super::super::Subject;
use super::super::amounts::Purpose;
use super::super::quantity::inferred;
use super::super::words::{QUANTITIES, advice, meaning, quantity_moved};
use crate::chain::Role;
use crate::mistake::Mistake;
use crate::symbol::{self, Meaning, Quantity, SymbolId, SymbolKind};

pub fn quantity_is_known(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    let declaration = subject.declaration;
    for word in declaration.constants().filter_map(|constant| constant.quantity.as_ref()) {
        if meaning(&QUANTITIES, word).is_none() {
            mistakes.push(unknown("quantity", &QUANTITIES, word));
        }
    }
    for word in declaration.inputs().filter_map(|input| input.meaning.as_ref()) {
        if meaning(&Meaning::WORDS, word).is_none() {
            mistakes.push(unknown("meaning", &Meaning::WORDS, word));
        }
    }
}

/// `direction of beta` names a joint, `phase of range` a length, and a temperature is of nothing.
pub fn meaning_is_of_what_it_can_be_of(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    let scope = &subject.scope;
    for input in subject.declaration.inputs() {
        let (Some(word), Some(of)) = (&input.meaning, &input.of) else { continue };
        let Some(meaning) = meaning(&Meaning::WORDS, word) else { continue };
        let entry = scope.find(&of.to_string()).and_then(|id| scope.entries().get(id.index()));
        let Some(wanted) = meaning.subject() else {
            mistakes.push(
                Mistake::new(of.span(), format!("the meaning `{word}` is of nothing"))
                    .with_help(format!("write `input {}: {word};`", input.name)),
            );
            continue;
        };
        let such = match wanted {
            symbol::Subject::Joint => "a joint",
            symbol::Subject::Length => "a joint or input that is a length",
        };
        if !entry.is_some_and(|entry| wanted.is_met_by(entry.kind, entry.quantity)) {
            mistakes.push(
                Mistake::new(of.span(), format!("`{word}` is of {such}, which `{of}` is not"))
                    .with_help(format!("name {such}: `input {}: {word} of NAME;`", input.name)),
            );
        }
    }
}

fn unknown<T>(what: &str, words: &[(&str, T)], word: &Ident) -> Mistake<Span> {
    Mistake::new(word.span(), format!("unknown {what} `{word}`")).with_help(format!(
        "{}, or leave it out for a plain number",
        advice(words, word).trim_end_matches('?')
    ))
}

pub fn constant_has_a_value(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for constant in subject.declaration.constants() {
        let Some(value) = &constant.value else { continue };
        let names = value.names();
        let mut ramps = Vec::new();
        value.ramps(&mut ramps);
        if !ramps.is_empty() {
            mistakes.push(
                Mistake::new(value.place, "a ramp stands in the value of a constant")
                    .with_help("write a value of numbers and `pi`: `0.25`, `30*pi/180`"),
            );
        }
        for (name, place) in &names {
            mistakes.push(
                Mistake::new(*place, format!("the name `{name}` stands in the value of a constant"))
                    .with_help("write a value of numbers and `pi`: `0.25`, `30*pi/180`"),
            );
        }
        if names.is_empty() && value.eval(&|_| None).is_none_or(|value| !value.is_finite()) {
            mistakes.push(
                Mistake::new(value.place, format!("the value of `{}` is not finite", constant.name))
                    .with_help("write a value of numbers and `pi`: `0.25`, `30*pi/180`"),
            );
        }
    }
}

/// A joint turns or shifts, an error is an angle or a length; not both.
pub fn one_quantity_each(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    let scope = &subject.scope;
    let mut known: BTreeMap<SymbolId, Quantity> = BTreeMap::new();
    for amount in &subject.amounts {
        let Purpose::Factor { role, kind, .. } = amount.purpose else { continue };
        let uses: Vec<(SymbolId, Quantity)> = if role == Role::Motion {
            let names = amount.written.names().into_iter().filter_map(|(name, _)| scope.find(name));
            names
                .filter(|&id| scope.entry(id).kind == SymbolKind::Joint)
                .map(|id| (id, quantity_moved(kind)))
                .collect()
        } else {
            inferred(scope, amount)
        };
        for (id, quantity) in uses.into_iter().filter(|(_, quantity)| *quantity != Quantity::Number) {
            if *known.entry(id).or_insert(quantity) == quantity {
                continue;
            }
            let name = &scope.entry(id).name;
            let place = amount
                .written
                .names()
                .into_iter()
                .find(|(used, _)| used == name)
                .map_or(amount.written.place, |(_, place)| place);
            let message = format!("`{name}` is used as an angle and as a length");
            let help = match scope.entry(id).kind {
                SymbolKind::Joint => {
                    format!("write another name for the second joint, or `{name}*lead` in `motion_error`")
                }
                _ => "write another name for the second error, or multiply by a constant: `arm*tilt`"
                    .to_owned(),
            };
            mistakes.push(Mistake::new(place, message).with_help(help));
        }
    }
}
