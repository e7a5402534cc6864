//! Expressions as written: the tree that every reader of formulas produces (the declaration's amounts, the
//! plain syntax of claims, LaTeX), before the algebra makes a canonical form of it.
//!
//! `S` is the place in the source: a token's span or a byte range.

use crate::algebra::Rational;

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
