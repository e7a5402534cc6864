//! Square roots of numbers, as products of roots of primes: `\sqrt{12}` is 2·√3.

use super::{Formula, Parser};
use crate::latex::{ROOTS, Unreadable, root_name};
use model_core::algebra::Rational;
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;

/// The largest number that a root is taken of.
const LARGEST: i64 = 1_000_000_000;

impl Parser<'_> {
    /// `\sqrt{2}`
    pub(super) fn root(&mut self) -> Result<Formula, Unreadable> {
        let start = self.here().start;
        self.advance();
        if self.is_at_mark('[') {
            return Err(Mistake::new(self.here(), "only square roots are known"));
        }
        let inside = self.argument()?.scalar()?;
        let place = start..inside.place.end;
        let Some(number) = number(&inside) else {
            return Err(Mistake::new(place, "the root of an amount is no sum of products")
                .with_help("a total error is a claim of its own: `total = '\\sqrt{…}'`"));
        };
        let node = |node| Box::new(Expr { node, place: place.clone() });
        let refuse = || {
            Mistake::new(place.clone(), format!("the root of {number} is not known"))
                .with_help("roots of positive numbers made of 2, 3, 5 and 7 are")
        };
        // √(p/q) = √(p·q)/q
        let parts = (whole(&number.numerator().to_string()), whole(&number.denominator().to_string()));
        let (Some(above), Some(below)) = parts else { return Err(refuse()) };
        let Some(mut left) = above.checked_mul(below).filter(|product| (0..=LARGEST).contains(product))
        else {
            return Err(refuse());
        };
        let mut outside = 1;
        let mut roots = Vec::new();
        for prime in ROOTS {
            while left > 0 && left % (prime * prime) == 0 {
                left /= prime * prime;
                outside *= prime;
            }
            if left > 0 && left % prime == 0 {
                left /= prime;
                roots.push(prime);
            }
        }
        // What is left may be a square of another number.
        let rest = (left as f64).sqrt().round() as i64;
        if rest * rest != left {
            return Err(refuse());
        }
        let Some(factor) = Rational::new(outside * rest, below) else { return Err(refuse()) };
        Ok(roots.into_iter().fold(*node(Node::Number(factor)), |product, prime| {
            let root = node(Node::Symbol(root_name(prime)));
            *node(Node::Mul(Box::new(product), root))
        }))
    }
}

fn whole(digits: &str) -> Option<i64> {
    digits.parse().ok()
}

/// The value of an expression of numbers.
fn number(formula: &Formula) -> Option<Rational> {
    Some(match &formula.node {
        Node::Number(value) => value.clone(),
        Node::Neg(a) => -&number(a)?,
        Node::Add(a, b) => &number(a)? + &number(b)?,
        Node::Mul(a, b) => &number(a)? * &number(b)?,
        Node::Div(a, b) => &number(a)? * &number(b)?.recip()?,
        _ => return None,
    })
}
