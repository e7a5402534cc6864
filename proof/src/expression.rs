//! Expressions as written, in Coq's syntax.

use model_core::expr::{Expr, Function, Node};

/// How tightly a text binds, loosest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Level {
    /// `a + b`
    Sum,
    /// `a * b`
    Product,
    /// `- a`
    Sign,
    /// `a ^ 2`
    Power,
    /// `cos a`
    Application,
    /// `a`
    Atom,
}

/// A text and how tightly it binds.
#[derive(Debug, Clone)]
pub(super) struct Term {
    text: String,
    level: Level,
}

impl Term {
    pub(super) fn new(text: impl Into<String>, level: Level) -> Self {
        Self { text: text.into(), level }
    }

    /// A single word.
    pub(super) fn word(text: impl Into<String>) -> Self {
        Self::new(text, Level::Atom)
    }

    /// The text where at least `level` is wanted.
    pub(super) fn at(self, level: Level) -> String {
        if self.level < level { format!("({})", self.text) } else { self.text }
    }
}

/// An expression in Coq's syntax; `leaf` says what stands for a name, a number with a unit, or a ramp.
pub(super) fn write(expression: &Expr<()>, leaf: &dyn Fn(&Expr<()>) -> Term) -> String {
    term(expression, leaf).text
}

/// The same where one argument stands, in parentheses unless it is a single word.
pub(super) fn argument(expression: &Expr<()>, leaf: &dyn Fn(&Expr<()>) -> Term) -> String {
    term(expression, leaf).at(Level::Atom)
}

fn term(expression: &Expr<()>, leaf: &dyn Fn(&Expr<()>) -> Term) -> Term {
    let inner = |inner: &Expr<()>, level| term(inner, leaf).at(level);
    match &expression.node {
        Node::Number(value) => {
            let text = value.to_string();
            let level = match (value.is_negative(), value.to_integer().is_some()) {
                (false, true) => Level::Atom,
                (true, true) => Level::Sign,
                _ => Level::Product,
            };
            Term::new(text.replace('-', "- ").replace('/', " / "), level)
        }
        Node::Pi => Term::new("PI", Level::Atom),
        Node::Symbol(_) | Node::Measured(..) | Node::Ramp(_) => leaf(expression),
        Node::Neg(a) => Term::new(format!("- {}", inner(a, Level::Power)), Level::Sign),
        Node::Add(..) => {
            let mut addends = Vec::new();
            flatten(expression, false, &mut addends);
            let mut text = String::new();
            for (negative, addend) in addends {
                let sign = match (text.is_empty(), negative) {
                    (true, false) => "",
                    (true, true) => "- ",
                    (false, false) => " + ",
                    (false, true) => " - ",
                };
                let level = if negative && text.is_empty() { Level::Power } else { Level::Product };
                text.push_str(sign);
                text.push_str(&inner(addend, level));
            }
            Term::new(text, Level::Sum)
        }
        Node::Mul(a, b) => {
            Term::new(format!("{} * {}", inner(a, Level::Product), inner(b, Level::Power)), Level::Product)
        }
        Node::Div(a, b) => {
            Term::new(format!("{} / {}", inner(a, Level::Product), inner(b, Level::Power)), Level::Product)
        }
        Node::Pow(a, power) => {
            let text = format!("{} ^ {}", inner(a, Level::Application), power.unsigned_abs());
            if *power < 0 {
                Term::new(format!("/ {text}"), Level::Sign)
            } else {
                Term::new(text, Level::Power)
            }
        }
        Node::Call(function, a) => {
            let name = match function {
                Function::Sin => "sin",
                Function::Cos => "cos",
                Function::Tan => "tan",
                Function::Cot => "cot",
                Function::Sec => "sec",
                Function::Csc => "csc",
            };
            Term::new(format!("{name} {}", inner(a, Level::Atom)), Level::Application)
        }
    }
}

/// The addends of a sum, each with whether it is subtracted; sums within a sum are taken apart, for readers group them.
fn flatten<'a>(expression: &'a Expr<()>, negative: bool, addends: &mut Vec<(bool, &'a Expr<()>)>) {
    match &expression.node {
        Node::Add(a, b) => {
            flatten(a, negative, addends);
            flatten(b, negative, addends);
        }
        Node::Neg(a) if matches!(a.node, Node::Add(..)) => addends.push((!negative, a)),
        Node::Neg(a) => flatten(a, !negative, addends),
        _ => addends.push((negative, expression)),
    }
}

/// What sines, cosines and their like are taken of.
pub(super) fn arguments<'a>(expression: &'a Expr<()>, found: &mut Vec<&'a Expr<()>>) {
    match &expression.node {
        Node::Number(_) | Node::Measured(..) | Node::Pi | Node::Symbol(_) | Node::Ramp(_) => {}
        Node::Call(_, inner) => found.push(inner),
        Node::Neg(inner) | Node::Pow(inner, _) => arguments(inner, found),
        Node::Add(a, b) | Node::Mul(a, b) | Node::Div(a, b) => {
            arguments(a, found);
            arguments(b, found);
        }
    }
}

/// What is divided by, written out or in the name of a function: one expression for each divisor.
pub(super) fn divisors(expression: &Expr<()>, found: &mut Vec<Expr<()>>) {
    match &expression.node {
        Node::Number(_) | Node::Measured(..) | Node::Pi | Node::Symbol(_) | Node::Ramp(_) => {}
        Node::Call(function, angle) => {
            let below = match function {
                Function::Sin | Function::Cos => return,
                Function::Tan | Function::Sec => Function::Cos,
                Function::Cot | Function::Csc => Function::Sin,
            };
            found.push(Expr { node: Node::Call(below, angle.clone()), place: () });
        }
        Node::Neg(inner) => divisors(inner, found),
        Node::Pow(base, power) => {
            divisors(base, found);
            if *power < 0 {
                found.push((**base).clone());
            }
        }
        Node::Add(a, b) | Node::Mul(a, b) => {
            divisors(a, found);
            divisors(b, found);
        }
        Node::Div(a, b) => {
            divisors(a, found);
            divisors(b, found);
            found.push((**b).clone());
        }
    }
}
