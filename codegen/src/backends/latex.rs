//! LaTeX: the program as equations, for a paper's appendix or a reader who checks what is computed.

use model_core::{Chain, SymbolId};

use super::notation::Notation;
use super::unit::{self, Shared, describe_form};
use crate::lower::pose;
use crate::lower::tree::{Angle, Function, Name, Statement, Wave};
use crate::program::Form;
use model_core::escape::comments;

/// The text of the file: a fragment to be included in a document that uses `amsmath`.
pub(crate) fn write(shared: &Shared<'_>) -> String {
    let mut text = comments::latex(&shared.preamble());
    for function in &shared.functions {
        text.push_str(&one_form(shared, function));
    }
    text
}

fn one_form(shared: &Shared<'_>, function: &unit::Function) -> String {
    let lowered = pose(&function.program);
    let latex = Latex { chain: shared.unit.chain };
    let mut prepared = latex.equations(&lowered.prepared);
    for (place, value) in lowered.kept.iter().enumerate() {
        prepared.push(format!("{} &= {}", latex.name(Name::Kept(place)), latex.text(value)));
    }
    let mut outputs = lowered.outputs.iter().map(|value| latex.text(value));
    let mut results = Vec::new();
    for &id in shared.unit.observables {
        let name = shared.unit.chain.observable(id).name.replace('_', "\\_");
        for label in shared.unit.chain.observable(id).labels() {
            let component = match label.len() {
                1 => label.to_owned(),
                _ => format!("{{\\text{{{}}}}}", label.replace('_', " ")),
            };
            let observed = format!("\\mathrm{{{name}}}_{component}");
            match function.form {
                Form::ExactValue => {
                    results.extend(outputs.next().map(|value| format!("{observed} &= {value}")));
                }
                Form::ExactError | Form::FirstOrderError => {
                    results.extend(outputs.next().map(|value| format!("\\Delta {observed} &= {value}")));
                }
                Form::Uncertainty => {
                    results.extend(outputs.next().map(|value| format!("u({observed}) &= {value}")));
                }
                Form::ExactJacobian | Form::FirstOrderJacobian => {
                    for (&column, value) in shared.columns.iter().zip(&mut outputs) {
                        let error = &shared.unit.chain.symbol(column).latex;
                        if value != "0" {
                            results.push(format!("\\partial {observed} / \\partial {error} &= {value}"));
                        }
                    }
                }
            }
        }
    }
    let so = if function.form.is_jacobian() { "Derivatives that are not zero:" } else { "So that:" };
    [
        format!("\n\\paragraph{{}} {}\n", describe_form(function.form)),
        display("What depends on the errors and constants alone:", &prepared),
        display("For each pose:", &latex.equations(&lowered.evaluated)),
        display(so, &results),
    ]
    .concat()
}

fn display(heading: &str, equations: &[String]) -> String {
    if equations.is_empty() {
        return String::new();
    }
    format!("{heading}\n\\begin{{align*}}\n{}\n\\end{{align*}}\n", equations.join(" \\\\\n"))
}

/// How LaTeX writes a program.
struct Latex<'a> {
    chain: &'a Chain,
}

impl Latex<'_> {
    fn equations(&self, statements: &[Statement]) -> Vec<String> {
        let mut equations = Vec::new();
        for statement in statements {
            match statement {
                Statement::Let(name, value) => {
                    equations.push(format!("{} &= {}", self.name(*name), self.text(value)));
                }
                Statement::SinCos { angle, sine, cosine } => {
                    for (function, name) in [("\\sin", sine), ("\\cos", cosine)] {
                        // The sine of a symbol is its own name.
                        if let Some(name @ Name::Node(_)) = name {
                            equations.push(format!(
                                "{} &= {function}({})",
                                self.name(*name),
                                self.text(angle)
                            ));
                        }
                    }
                }
                Statement::Angles(_)
                | Statement::SinCosOfRows(_)
                | Statement::EachRow(_)
                | Statement::Store(..) => unreachable!("LaTeX is written from what is done for one pose"),
            }
        }
        equations
    }
}

impl Notation for Latex<'_> {
    fn symbol(&self, id: SymbolId) -> String {
        self.chain.symbol(id).latex.clone()
    }

    fn name(&self, name: Name) -> String {
        match name {
            Name::Kept(place) => format!("p_{{{place}}}"),
            Name::Node(node) => format!("t_{{{}}}", node.index()),
            Name::Wave(wave, angle) => {
                let function = match wave {
                    Wave::Sine => "\\sin",
                    Wave::Cosine => "\\cos",
                };
                match angle {
                    Angle::Symbol(symbol) => format!("{function} {}", self.symbol(symbol)),
                    Angle::Node(node) => format!("{function} {}", self.name(Name::Node(node))),
                }
            }
        }
    }

    fn call(&self, function: Function, a: &str) -> String {
        match function {
            Function::Saturate => format!("\\operatorname{{ramp}}({a}, 0, 1)"),
            Function::Step => format!("\\operatorname{{ramp}}({a}, 0, 0)"),
            Function::Root => format!("\\sqrt{{{a}}}"),
        }
    }

    fn arc_tangent(&self, y: &str, x: &str) -> String {
        format!("\\operatorname{{atan2}}({y}, {x})")
    }

    fn number(&self, value: f64) -> String {
        let text = format!("{value:?}");
        match text.split_once('e') {
            Some((digits, exponent)) => format!("{} \\cdot 10^{{{exponent}}}", digits.trim_end_matches(".0")),
            None => text.trim_end_matches(".0").to_owned(),
        }
    }

    /// Numbers first.
    fn product(&self, a: &str, b: &str) -> String {
        let is_number = b.starts_with(|first: char| first.is_ascii_digit());
        if is_number { format!("{b} \\, {a}") } else { format!("{a} \\, {b}") }
    }

    fn quotient(&self, a: &str, b: &str) -> String {
        format!("\\frac{{{a}}}{{{b}}}")
    }
}
