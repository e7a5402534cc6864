//! A formula whose name has amounts around it, `\Delta x + a = …`, `R\,\Delta x = …`, solved for the name.

use std::ops::Range;

use super::transforms::number;
use super::value::{added, is_number, multiplied, negated};
use super::{Formula, Matrix, Parser, Value};
use crate::latex::printed::PrintedSymbols;
use crate::latex::token::{Kind, Token};
use crate::latex::{Unreadable, more_than_a_name};
use model_core::algebra::Rational;
use model_core::expr::{Expr, Node};

/// What stands for the name while its side is read. Nobody can declare it, as it is no word.
pub(in crate::latex) const NAME: &str = "the name on the left";

/// A side that is linear in the name: how often it stands there, over what, and what is added.
struct Linear {
    above: Formula,
    below: Formula,
    rest: Formula,
}

/// The value of the name of which `side` says that it is `value`: what is added is taken away, and factors divide.
pub(in crate::latex) fn solved(
    text: &str,
    side: &[Token],
    name: Range<usize>,
    symbols: &PrintedSymbols,
    value: Value,
) -> Result<Value, Unreadable> {
    let place = side[name.start].place.start..side[name.end - 1].place.end;
    let refuse = || more_than_a_name(side[0].place.start..side[side.len() - 1].place.end);
    let mark = Token { kind: Kind::Word(NAME.to_owned()), place: place.clone(), bold: false };
    let tokens = [&side[..name.start], &[mark], &side[name.end..]].concat();
    let end = side.last().map_or(place.end, |token| token.place.end);
    let shape = match &value {
        Value::Scalar(_) => [1, 1],
        Value::Matrix(matrix) => [matrix.rows, matrix.columns],
        Value::Identity(_) => return Err(refuse()),
    };
    let symbols = symbols.with_name(NAME, shape);
    let mut parser = Parser::new(text, &tokens, end..end, &symbols);
    let left = parser.formula()?;
    parser.expect_end()?;
    match (left, value) {
        (Value::Scalar(left), Value::Scalar(right)) => {
            linear(&left, NAME).and_then(|left| alone(left, right)).map(Value::Scalar).ok_or_else(refuse)
        }
        (Value::Matrix(left), Value::Matrix(right))
            if [left.rows, left.columns] == [right.rows, right.columns] =>
        {
            let entries = left.entries.iter().zip(right.entries).enumerate();
            let entries = entries.map(|(at, (left, right))| {
                let name = format!("{NAME} {at}");
                // `R\,\Delta\mathbf{n}` is a vector of its own.
                let own = linear(left, &name).filter(|left| left.above.names().is_empty());
                alone(own?, right)
            });
            let entries: Option<Vec<Formula>> = entries.collect();
            Ok(Value::Matrix(Matrix::new(right.rows, entries.ok_or_else(refuse)?, right.place)))
        }
        _ => Err(refuse()),
    }
}

/// What a name is where a side that is linear in it is `right`.
fn alone(Linear { above, below, rest }: Linear, right: Formula) -> Option<Formula> {
    if is_number(&above, &Rational::ZERO) {
        return None;
    }
    let place = right.place.clone();
    let value = multiplied(added(right, negated(rest)), below.map_place(&|_| place.clone()));
    // What a factor is printed in is the formula.
    let above = above.map_place(&|_| place.clone());
    Some(match above.node {
        Node::Number(number) if number == Rational::ONE => value,
        Node::Neg(inside) if is_number(&inside, &Rational::ONE) => negated(value),
        _ => Expr { node: Node::Div(Box::new(value), Box::new(above)), place },
    })
}

/// A formula as one that is linear in a name; `None` where it is not, or where another entry's name is in it.
fn linear(formula: &Formula, name: &str) -> Option<Linear> {
    let place = &formula.place;
    let [zero, one] = [0, 1].map(|value| number(value, place));
    let is_in = |part: &Formula| part.names().iter().any(|(own, _)| own.starts_with(NAME));
    if !is_in(formula) {
        return Some(Linear { above: zero, below: one, rest: formula.clone() });
    }
    Some(match &formula.node {
        Node::Symbol(own) if own == name => Linear { above: one.clone(), below: one, rest: zero },
        Node::Neg(inside) => {
            let inside = linear(inside, name)?;
            Linear { above: negated(inside.above), rest: negated(inside.rest), ..inside }
        }
        Node::Add(a, b) => {
            let (a, b) = (linear(a, name)?, linear(b, name)?);
            let (left, right) = (multiplied(a.above, b.below.clone()), multiplied(b.above, a.below.clone()));
            Linear {
                above: added(left, right),
                below: multiplied(a.below, b.below),
                rest: added(a.rest, b.rest),
            }
        }
        Node::Mul(a, b) if !is_in(b) => scaled(linear(a, name)?, b),
        Node::Mul(a, b) if !is_in(a) => scaled(linear(b, name)?, a),
        Node::Div(a, b) if !is_in(b) => {
            let a = linear(a, name)?;
            let rest = if is_number(&a.rest, &Rational::ZERO) {
                a.rest
            } else {
                Expr { node: Node::Div(Box::new(a.rest), b.clone()), place: place.clone() }
            };
            Linear { above: a.above, below: multiplied(a.below, (**b).clone()), rest }
        }
        _ => return None,
    })
}

fn scaled(side: Linear, factor: &Formula) -> Linear {
    Linear {
        above: multiplied(side.above, factor.clone()),
        below: side.below,
        rest: multiplied(side.rest, factor.clone()),
    }
}
