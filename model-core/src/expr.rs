//! Expressions as written: the tree that every reader of formulas produces (the declaration's amounts, the
//! plain syntax of claims, LaTeX), before the algebra makes a canonical form of it.
//!
//! `S` is the place in the source: a token's span or a byte range.

use crate::algebra::Rational;
use crate::ramp::{saturated, step};
use crate::unit::Unit;

/// An expression as written, every node with its place.
#[derive(Debug, Clone)]
pub struct Expr<S> {
    /// What stands here.
    pub node: Node<S>,
    /// Where it stands.
    pub place: S,
}

/// One node of an expression.
#[derive(Debug, Clone)]
pub enum Node<S> {
    /// An exact rational number; decimals are read exactly.
    Number(Rational),
    /// A number with a unit: `53 deg`.
    Measured(Rational, Unit),
    /// The number π.
    Pi,
    /// A name, as declared (LaTeX readers have already translated printed symbols).
    Symbol(String),
    /// `-a`
    Neg(Box<Expr<S>>),
    /// `a + b`; subtraction is the addition of a [`Node::Neg`].
    Add(Box<Expr<S>>, Box<Expr<S>>),
    /// `a * b`
    Mul(Box<Expr<S>>, Box<Expr<S>>),
    /// `a / b`
    Div(Box<Expr<S>>, Box<Expr<S>>),
    /// `a^n`, a whole power.
    Pow(Box<Expr<S>>, i32),
    /// `sin(a)`, and so on.
    Call(Function, Box<Expr<S>>),
    /// `ramp(x, from, to)`: 0 before `from`, 1 behind `to`, linear between.
    Ramp(Box<[Expr<S>; 3]>),
}

/// The functions of the language of amounts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Function {
    /// Sine.
    Sin,
    /// Cosine.
    Cos,
    /// Tangent: sine over cosine.
    Tan,
    /// Cotangent: cosine over sine.
    Cot,
    /// Secant: one over cosine.
    Sec,
    /// Cosecant: one over sine.
    Csc,
}

impl<S> Expr<S> {
    /// Every use of a name, from left to right, with its place.
    #[must_use]
    pub fn names(&self) -> Vec<(&str, S)>
    where
        S: Clone,
    {
        let mut names = Vec::new();
        self.collect_names(&mut names);
        names
    }

    /// What sines and cosines are taken of, from left to right; nothing stands in one of these itself that counts.
    pub fn arguments<'a>(&'a self, found: &mut Vec<&'a Self>) {
        match &self.node {
            Node::Number(_) | Node::Measured(..) | Node::Pi | Node::Symbol(_) | Node::Ramp(_) => {}
            Node::Call(_, argument) => found.push(argument),
            Node::Neg(inner) | Node::Pow(inner, _) => inner.arguments(found),
            Node::Add(left, right) | Node::Mul(left, right) | Node::Div(left, right) => {
                left.arguments(found);
                right.arguments(found);
            }
        }
    }

    fn collect_names<'a>(&'a self, names: &mut Vec<(&'a str, S)>)
    where
        S: Clone,
    {
        match &self.node {
            Node::Number(_) | Node::Measured(..) | Node::Pi => {}
            Node::Ramp(parts) => parts.iter().for_each(|part| part.collect_names(names)),
            Node::Symbol(name) => names.push((name, self.place.clone())),
            Node::Neg(inner) | Node::Pow(inner, _) | Node::Call(_, inner) => inner.collect_names(names),
            Node::Add(left, right) | Node::Mul(left, right) | Node::Div(left, right) => {
                left.collect_names(names);
                right.collect_names(names);
            }
        }
    }

    /// Every ramp, from left to right: its variable and its two thresholds.
    pub fn ramps<'a>(&'a self, ramps: &mut Vec<&'a [Self; 3]>) {
        match &self.node {
            Node::Number(_) | Node::Measured(..) | Node::Pi | Node::Symbol(_) => {}
            Node::Ramp(parts) => ramps.push(parts),
            Node::Neg(inner) | Node::Pow(inner, _) | Node::Call(_, inner) => inner.ramps(ramps),
            Node::Add(left, right) | Node::Mul(left, right) | Node::Div(left, right) => {
                left.ramps(ramps);
                right.ramps(ramps);
            }
        }
    }

    /// The same expression with its places translated.
    #[must_use]
    pub fn map_place<T>(&self, translate: &impl Fn(&S) -> T) -> Expr<T> {
        let inner = |inner: &Self| Box::new(inner.map_place(translate));
        let node = match &self.node {
            Node::Number(value) => Node::Number(value.clone()),
            Node::Measured(value, unit) => Node::Measured(value.clone(), *unit),
            Node::Pi => Node::Pi,
            Node::Ramp(parts) => Node::Ramp(Box::new(parts.each_ref().map(|part| part.map_place(translate)))),
            Node::Symbol(name) => Node::Symbol(name.clone()),
            Node::Neg(a) => Node::Neg(inner(a)),
            Node::Add(a, b) => Node::Add(inner(a), inner(b)),
            Node::Mul(a, b) => Node::Mul(inner(a), inner(b)),
            Node::Div(a, b) => Node::Div(inner(a), inner(b)),
            Node::Pow(a, power) => Node::Pow(inner(a), *power),
            Node::Call(function, a) => Node::Call(*function, inner(a)),
        };
        Expr { node, place: translate(&self.place) }
    }

    /// The value in floating point; `None` if `resolve` knows no value of a name.
    #[must_use]
    pub fn eval(&self, resolve: &impl Fn(&str) -> Option<f64>) -> Option<f64> {
        Some(match &self.node {
            Node::Number(value) => value.to_f64(),
            Node::Measured(value, unit) => unit.amount(value).eval(&[std::f64::consts::PI]),
            Node::Pi => std::f64::consts::PI,
            Node::Ramp(parts) => {
                let [at, from, to] = parts.each_ref().map(|part| part.eval(resolve));
                let (at, from, to) = (at?, from?, to?);
                if from == to { step(at - from) } else { saturated((at - from) / (to - from)) }
            }
            Node::Symbol(name) => resolve(name)?,
            Node::Neg(a) => -a.eval(resolve)?,
            Node::Add(a, b) => a.eval(resolve)? + b.eval(resolve)?,
            Node::Mul(a, b) => a.eval(resolve)? * b.eval(resolve)?,
            Node::Div(a, b) => a.eval(resolve)? / b.eval(resolve)?,
            Node::Pow(a, power) => a.eval(resolve)?.powi(*power),
            Node::Call(function, a) => {
                let (sine, cosine) = a.eval(resolve)?.sin_cos();
                match function {
                    Function::Sin => sine,
                    Function::Cos => cosine,
                    Function::Tan => sine / cosine,
                    Function::Cot => cosine / sine,
                    Function::Sec => 1.0 / cosine,
                    Function::Csc => 1.0 / sine,
                }
            }
        })
    }
}
