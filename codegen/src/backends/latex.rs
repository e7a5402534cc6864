//! LaTeX: the program as equations, for a paper's appendix or a reader who checks what is computed.

use std::fmt::Write;

use model_core::{Chain, SymbolId};

use super::listing::{Statement, Words, list};
use super::unit::{Function, Unit, describe_form};
use crate::program::Form;

/// The text of the file: a fragment to be included in a document that uses `amsmath`.
pub(crate) fn write(unit: &Unit<'_>) -> String {
    let mut text = unit.preamble().iter().fold(String::new(), |mut text, line| {
        let _ = writeln!(text, "{}", format!("% {line}").trim_end());
        text
    });
    for function in &unit.functions() {
        text.push_str(&one_form(unit, function));
    }
    text
}

fn one_form(unit: &Unit<'_>, function: &Function) -> String {
    let listing = list(&function.program, &Names { chain: unit.chain });
    let mut text = format!("\n\\paragraph{{}} {}\n", describe_form(function.form));
    let mut prepared = equations(&listing.prepared);
    for (index, value) in listing.carried.iter().enumerate() {
        prepared.push(format!("p_{{{index}}} &= {value}"));
    }
    display(&mut text, "What depends on the errors and constants alone:", &prepared);
    display(&mut text, "For each pose:", &equations(&listing.evaluated));
    let columns = unit.errors();
    let mut outputs = listing.outputs.iter();
    let mut results = Vec::new();
    for name in unit.observable_names() {
        for component in ["x", "y", "z"] {
            let observed = format!("\\mathrm{{{}}}_{component}", name.replace('_', "\\_"));
            match function.form {
                Form::ExactValue => {
                    results.extend(outputs.next().map(|value| format!("{observed} &= {value}")))
                }
                Form::ExactError | Form::FirstOrderError => {
                    results.extend(outputs.next().map(|value| format!("\\Delta {observed} &= {value}")));
                }
                Form::ExactJacobian | Form::FirstOrderJacobian => {
                    results.extend(columns.iter().zip(&mut outputs).filter(|(_, value)| *value != "0").map(
                        |(&column, value)| {
                            let error = &unit.chain.symbol(column).latex;
                            format!("\\partial {observed} / \\partial {error} &= {value}")
                        },
                    ));
                }
            }
        }
    }
    display(
        &mut text,
        if function.form.is_jacobian() { "Derivatives that are not zero:" } else { "So that:" },
        &results,
    );
    text
}

fn equations(statements: &[Statement]) -> Vec<String> {
    let mut equations = Vec::new();
    for statement in statements {
        match statement {
            Statement::Let { name, value } => equations.push(format!("{name} &= {value}")),
            Statement::SinCos { angle, sin, cos } => {
                for (function, name) in [("\\sin", sin), ("\\cos", cos)] {
                    // The sine of a symbol is its own name.
                    if let Some(name) = name.as_deref().filter(|name| !name.starts_with(function)) {
                        equations.push(format!("{name} &= {function}({angle})"));
                    }
                }
            }
        }
    }
    equations
}

fn display(text: &mut String, heading: &str, equations: &[String]) {
    if !equations.is_empty() {
        let _ =
            write!(text, "{heading}\n\\begin{{align*}}\n{}\n\\end{{align*}}\n", equations.join(" \\\\\n"));
    }
}

/// How LaTeX writes a program.
struct Names<'a> {
    chain: &'a Chain,
}

impl Words for Names<'_> {
    fn symbol(&self, id: SymbolId) -> String {
        self.chain.symbol(id).latex.clone()
    }

    fn wave_of_symbol(&self, wave: &str, id: SymbolId) -> String {
        format!("\\{wave} {}", self.chain.symbol(id).latex)
    }

    fn saturate(&self, a: &str) -> String {
        format!("\\operatorname{{ramp}}({a}, 0, 1)")
    }

    fn step(&self, a: &str) -> String {
        format!("\\operatorname{{ramp}}({a}, 0, 0)")
    }

    fn carried(&self, index: usize) -> String {
        format!("p_{{{index}}}")
    }

    fn local(&self, index: usize) -> String {
        format!("t_{{{index}}}")
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
