//! Rules about names: which words can be names, each declared once, printed forms of names that exist.

use std::collections::BTreeSet;

use proc_macro2::{Ident, Span};

use super::super::Subject;
use super::super::words::is_reserved;
use crate::mistake::Mistake;
use crate::names::nearest;
use crate::symbol::SymbolKind;
use crate::syntax::declaration::Statement;

pub fn not_reserved(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    let declaration = subject.declaration;
    let declared = std::iter::once(&declaration.name)
        .chain(declaration.bodies().map(|body| &body.name))
        .chain(declaration.constants().map(|constant| &constant.name))
        .chain(declaration.inputs().map(|input| &input.name))
        .chain(declaration.observables().map(|observe| &observe.name));
    for name in declared {
        refuse(&name.to_string(), name.span(), mistakes);
    }
    for amount in &subject.amounts {
        for (name, place) in amount.written.names() {
            refuse(name, place, mistakes);
        }
    }
}

fn refuse(name: &str, place: Span, mistakes: &mut Vec<Mistake<Span>>) {
    if let Some(plain) = name.strip_prefix("r#") {
        mistakes.push(
            Mistake::new(place, format!("`{name}` is not a plain name"))
                .with_help(format!("write another name: `{plain}_`")),
        );
    } else if is_reserved(name) {
        let another = if name == "_" { "unnamed" } else { name };
        mistakes.push(
            Mistake::new(place, format!("`{name}` is a reserved word"))
                .with_help(format!("write another name: `{another}_`")),
        );
    }
}

pub fn declared_once(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    let declaration = subject.declaration;
    let symbols = declaration.statements.iter().filter_map(|statement| match statement {
        Statement::Constant(constant) => Some(&constant.name),
        Statement::Input(input) => Some(&input.name),
        _ => None,
    });
    once("the body", declaration.bodies().map(|body| &body.name), mistakes);
    once("the name", symbols, mistakes);
    once("the observable", declaration.observables().map(|observe| &observe.name), mistakes);
    once("the printed form of", declaration.printed_symbols().map(|symbol| &symbol.name), mistakes);
}

fn once<'a>(what: &str, names: impl Iterator<Item = &'a Ident>, mistakes: &mut Vec<Mistake<Span>>) {
    let mut seen: BTreeSet<String> = BTreeSet::new();
    for name in names {
        if !seen.insert(name.to_string()) {
            mistakes.push(
                Mistake::new(name.span(), format!("{what} `{name}` is declared twice"))
                    .with_help("write another name, or remove one of the two"),
            );
        }
    }
}

pub fn printed_names_exist(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    if !subject.scope.is_complete {
        return;
    }
    for symbol in subject.declaration.printed_symbols() {
        let name = symbol.name.to_string();
        if subject.scope.find(&name).is_none() {
            mistakes.push(unknown_name(
                subject,
                &name,
                symbol.name.span(),
                "a symbol must be used in an amount, or be declared with `const` or `input`",
            ));
        }
    }
}

/// The mistake that a name is not declared: the nearest name that is, or other advice.
pub fn unknown_name(subject: &Subject<'_>, name: &str, place: Span, otherwise: &str) -> Mistake<Span> {
    let named = subject.scope.entries().iter().filter(|entry| entry.kind != SymbolKind::Ramp);
    let known = named.map(|entry| entry.name.as_str());
    let help = match nearest(name, known) {
        Some(near) => format!("did you mean `{near}`?"),
        None => otherwise.to_owned(),
    };
    Mistake::new(place, format!("unknown name `{name}`")).with_help(help)
}
