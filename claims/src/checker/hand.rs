//! How a claim writes functions of angles itself: its abbreviations, and the sums of angles it keeps together.

use std::ops::Range;

use super::lowering::lower;
use super::{Claim, PrintedVector};
use model_core::algebra::AngleSum;
use model_core::chain::Chain;
use model_core::expr::{Expr, Function, Node};
use model_core::print::Hand;

/// Notes that a printed symbol is the sine or cosine of an angle, if it is.
pub fn abbreviate(hand: &mut Hand, chain: &Chain, printed: &str, amount: &Expr<Range<usize>>) {
    let Node::Call(function @ (Function::Sin | Function::Cos), angle) = &amount.node else { return };
    if let Some(sum) = sum(chain, angle) {
        hand.abbreviate(sum.multiples(), *function == Function::Sin, printed);
    }
}

/// The hand of one claim: that of its file, and the sums of angles that it writes.
#[must_use]
pub fn of_claim(file: &Hand, chain: &Chain, claim: &Claim) -> Hand {
    let mut hand = file.clone();
    if let Claim::ClosedForm(form) = claim {
        let PrintedVector { components, .. } = &form.printed;
        components.iter().for_each(|component| prefer_sums(&mut hand, chain, &component.expression));
    }
    hand
}

fn prefer_sums(hand: &mut Hand, chain: &Chain, expression: &Expr<Range<usize>>) {
    match &expression.node {
        Node::Number(_) | Node::Measured(..) | Node::Pi | Node::Symbol(_) | Node::Ramp(_) => {}
        Node::Neg(inside) | Node::Pow(inside, _) => prefer_sums(hand, chain, inside),
        Node::Add(left, right) | Node::Mul(left, right) | Node::Div(left, right) => {
            prefer_sums(hand, chain, left);
            prefer_sums(hand, chain, right);
        }
        Node::Call(_, angle) => {
            if let Some(sum) = sum(chain, angle).filter(|sum| sum.multiples().len() > 1) {
                hand.prefer(sum.multiples());
            }
        }
    }
}

/// A sum of angles whose first is counted forwards, without quarter turns.
fn sum(chain: &Chain, angle: &Expr<Range<usize>>) -> Option<AngleSum> {
    let sum = AngleSum::from_poly(&lower(chain, angle).ok()?).ok()?;
    let forwards = sum.multiples().first().is_some_and(|(_, multiple)| *multiple > 0);
    (forwards && sum.quarters() == 0).then_some(sum)
}
