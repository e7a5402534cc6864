//! The terms of a formula as printed: products multiplied out, every factor with its place, so that a difference can
//! be laid at the door of one term.

use std::ops::Range;

use model_core::expr::{Expr, Node};

/// A product of factors as they stand in the text.
#[derive(Debug, Clone)]
pub(super) struct PrintedTerm<'a> {
    pub negative: bool,
    pub factors: Vec<TermFactor<'a>>,
    /// The summand of the innermost sum that the term comes from: where a caret belongs.
    pub place: Option<Range<usize>>,
}

/// One factor, or one divisor.
#[derive(Debug, Clone, Copy)]
pub(super) struct TermFactor<'a> {
    pub expression: &'a Expr<Range<usize>>,
    pub divides: bool,
}

/// Terms that a printed formula may have before its places are given up.
const LIMIT: usize = 2_000;

/// Multiplies a formula out; `None` if it has more terms than anybody prints.
pub(super) fn expand(formula: &Expr<Range<usize>>) -> Option<Vec<PrintedTerm<'_>>> {
    let single = |divides| {
        vec![PrintedTerm {
            negative: false,
            factors: vec![TermFactor { expression: formula, divides }],
            place: None,
        }]
    };
    Some(match &formula.node {
        Node::Add(left, right) => {
            let mut terms = summand(left)?;
            terms.extend(summand(right)?);
            terms
        }
        Node::Neg(inside) => {
            let mut terms = expand(inside)?;
            terms.iter_mut().for_each(|term| term.negative = !term.negative);
            terms
        }
        Node::Mul(left, right) => {
            let (left, right) = (expand(left)?, expand(right)?);
            if left.len() * right.len() > LIMIT {
                return None;
            }
            left.iter().flat_map(|left| right.iter().map(|right| product(left, right))).collect()
        }
        Node::Div(above, below) => {
            let mut terms = expand(above)?;
            for term in &mut terms {
                term.factors.push(TermFactor { expression: below, divides: true });
            }
            terms
        }
        Node::Number(_)
        | Node::Measured(..)
        | Node::Pi
        | Node::Symbol(_)
        | Node::Pow(..)
        | Node::Call(..)
        | Node::Ramp(_) => single(false),
    })
}

/// The terms of one side of a sum; those from a sum within it have their place already.
fn summand(side: &Expr<Range<usize>>) -> Option<Vec<PrintedTerm<'_>>> {
    let mut terms = expand(side)?;
    for term in &mut terms {
        term.place.get_or_insert_with(|| side.place.clone());
    }
    Some(terms)
}

fn product<'a>(left: &PrintedTerm<'a>, right: &PrintedTerm<'a>) -> PrintedTerm<'a> {
    let mut factors = left.factors.clone();
    factors.extend_from_slice(&right.factors);
    PrintedTerm {
        negative: left.negative != right.negative,
        factors,
        place: left.place.clone().or_else(|| right.place.clone()),
    }
}
