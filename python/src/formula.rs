//! Closed forms: their texts, and trees from which other algebra systems build expressions without reading a text.

use std::ops::Range;

use model_core::expr::{Expr, Function, Node};
use pyo3::prelude::*;
use trueaxis_cli::library;

/// The closed form of an observable's error.
#[pyclass(frozen, get_all, module = "trueaxis._native")]
pub struct ClosedForm {
    /// What it is, in words.
    title: String,
    /// The names of the components.
    names: Vec<String>,
    /// The components with their names, in the plain syntax of amounts and in LaTeX.
    printed: [String; 2],
    /// Components in the plain syntax of amounts.
    text: Vec<String>,
    /// Components in LaTeX.
    latex: Vec<String>,
    /// Components as steps for a stack.
    steps: Vec<Vec<Step>>,
}

/// One step for a stack: what is done, the name or number that it is done with, and how many operands it takes.
type Step = (&'static str, String, usize);

impl From<library::ClosedForm> for ClosedForm {
    fn from(form: library::ClosedForm) -> Self {
        let steps = form.trees.iter().map(|tree| {
            let mut steps = Vec::new();
            push(tree, &mut steps);
            steps
        });
        let steps = steps.collect();
        let library::ClosedForm { title, names, printed, text, latex, .. } = form;
        Self { title, names, printed, text, latex, steps }
    }
}

/// Operands first; sums and products with all their operands at once, however long.
fn push(expression: &Expr<Range<usize>>, steps: &mut Vec<Step>) {
    let mut step = |what, with: String, operands: &[&Expr<Range<usize>>]| {
        operands.iter().for_each(|operand| push(operand, steps));
        steps.push((what, with, operands.len()));
    };
    match &expression.node {
        Node::Number(number) | Node::Measured(number, _) => step("number", number.to_string(), &[]),
        Node::Pi => step("pi", String::new(), &[]),
        Node::Symbol(name) => step("symbol", name.clone(), &[]),
        Node::Neg(inner) => step("negative", String::new(), &[inner]),
        Node::Add(..) => step(
            "sum",
            String::new(),
            &operands(expression, |node| match node {
                Node::Add(left, right) => Some((left, right)),
                _ => None,
            }),
        ),
        Node::Mul(..) => step(
            "product",
            String::new(),
            &operands(expression, |node| match node {
                Node::Mul(left, right) => Some((left, right)),
                _ => None,
            }),
        ),
        Node::Div(above, below) => step("quotient", String::new(), &[above, below]),
        Node::Pow(base, power) => step("power", power.to_string(), &[base]),
        Node::Call(function, inner) => {
            let name = match function {
                Function::Sin => "sin",
                Function::Cos => "cos",
                Function::Tan => "tan",
                Function::Cot => "cot",
                Function::Sec => "sec",
                Function::Csc => "csc",
            };
            step("function", name.to_owned(), &[inner]);
        }
        Node::Ramp(parts) => step("ramp", String::new(), &parts.each_ref()),
    }
}

/// The operands of a chain of one binary operation, from left to right.
fn operands<'e>(
    expression: &'e Expr<Range<usize>>,
    split: impl Fn(&'e Node<Range<usize>>) -> Option<(&'e Box<Expr<Range<usize>>>, &'e Box<Expr<Range<usize>>>)>,
) -> Vec<&'e Expr<Range<usize>>> {
    let (mut waiting, mut operands) = (vec![expression], Vec::new());
    while let Some(next) = waiting.pop() {
        match split(&next.node) {
            Some((left, right)) => waiting.extend([&**right, &**left]),
            None => operands.push(next),
        }
    }
    operands
}
