//! Names of the generated module: where each was declared, so that the compiler and editors point there, and
//! which would stand for two things.

use std::collections::{BTreeMap, BTreeSet};

use codegen::snake_case;
use model_core::syntax::Declaration;
use model_core::syntax::declaration::Statement;
use model_core::{Chain, Mistake, Observable};
use proc_macro2::{Ident, Span};

/// Where names were declared; everything is at the call of the macro if they come from a file.
#[derive(Default)]
pub struct Names {
    chain: Option<Span>,
    symbols: BTreeMap<String, Span>,
    observables: BTreeMap<String, Span>,
}

impl Names {
    /// The places of a declaration's names: statements for constants and inputs, first uses for joints and errors.
    pub fn of(declaration: &Declaration) -> Self {
        let mut symbols = BTreeMap::new();
        let mut observables = BTreeMap::new();
        for statement in &declaration.statements {
            match statement {
                Statement::Constant(constant) => {
                    symbols.insert(constant.name.to_string(), constant.name.span());
                }
                Statement::Input(input) => {
                    symbols.insert(input.name.to_string(), input.name.span());
                }
                Statement::Observe(observe) => {
                    observables.insert(observe.name.to_string(), observe.name.span());
                }
                Statement::Body(_) | Statement::Symbol(_) | Statement::Gravity(_) => {}
            }
        }
        let groups = declaration.bodies().flat_map(|body| &body.groups);
        let factors = groups.flat_map(|group| &group.factors).filter_map(|factor| factor.amount.as_ref());
        let bent = declaration.statements.iter().filter_map(|statement| match statement {
            Statement::Observe(observe) => observe.bent.as_ref()?.amount.as_ref(),
            _ => None,
        });
        for amount in factors.chain(bent) {
            for (name, span) in amount.names() {
                symbols.entry(name.to_owned()).or_insert(span);
            }
        }
        Self { chain: Some(declaration.name.span()), symbols, observables }
    }

    /// Where the chain's name stands.
    pub fn chain(&self) -> Span {
        self.chain.unwrap_or_else(Span::call_site)
    }

    /// Where a name was declared: a symbol, or an observable.
    pub fn place(&self, name: &str) -> Option<Span> {
        self.symbols.get(name).or_else(|| self.observables.get(name)).copied()
    }

    /// Where an observable is declared.
    pub fn observable(&self, name: &str) -> Span {
        self.observables.get(name).copied().unwrap_or_else(Span::call_site)
    }
}

/// The types that every module may have beside the chain's own.
const TYPES: [&str; 7] =
    ["Joints", "Inputs", "Errors", "Constants", "JointRows", "InputRows", "LengthsDiffer"];

/// What the methods of an observable add to its name.
const METHODS: [&str; 10] = [
    "",
    "_error",
    "_first_order",
    "_jacobian",
    "_error_rows",
    "_first_order_rows",
    "_jacobian_rows",
    "_parts",
    "_first_order_prepared",
    "_first_order_at",
];

/// Names that would stand for two things in the module.
pub fn clashes(chain: &Chain, names: &Names) -> Vec<Mistake<Span>> {
    let mut mistakes = Vec::new();
    if TYPES.contains(&chain.name.as_str()) {
        mistakes.push(
            Mistake::new(names.chain(), format!("`{}` is a type that every chain's module has", chain.name))
                .with_help("write another name for the chain"),
        );
    }
    if syn::parse_str::<Ident>(&snake_case(&chain.name)).is_err() {
        mistakes.push(
            Mistake::new(
                names.chain(),
                format!("the module of `{}` cannot be named `{}`", chain.name, snake_case(&chain.name)),
            )
            .with_help("write another name for the chain"),
        );
    }
    let mut taken: BTreeSet<String> = BTreeSet::from(["new".to_owned()]);
    for Observable { name, .. } in &chain.observables {
        let methods = METHODS.map(|ending| format!("{name}{ending}"));
        if let Some(method) = methods.iter().find(|method| taken.contains(*method)) {
            mistakes.push(
                Mistake::new(
                    names.observable(name),
                    format!("the observable `{name}` needs the method `{method}`, which exists already"),
                )
                .with_help("write another name for the observable"),
            );
        }
        taken.extend(methods);
    }
    mistakes
}
