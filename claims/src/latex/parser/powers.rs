//! What stands above an operand: whole powers, and the degree sign.

use super::{Formula, Parser};
use crate::latex::Unreadable;
use crate::latex::token::Kind;
use model_core::algebra::Rational;
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;

impl Parser<'_> {
    /// The power, or the degree sign, behind an operand.
    pub(super) fn powered(&mut self, base: Formula) -> Result<Formula, Unreadable> {
        let mut base = base;
        loop {
            let start = self.at;
            let raised_sign = self.is_at_mark('^');
            self.at += usize::from(raised_sign);
            if raised_sign && self.is_at_mark('{') && self.is_braced_degree() {
                self.at += 2;
                base = degrees(base, self.here().end);
                self.advance();
            } else if self.is_at_command("degree") {
                base = degrees(base, self.here().end);
                self.advance();
            } else if raised_sign {
                let (power, end) = self.power()?;
                base = raised(base, power, end);
            } else {
                self.at = start;
                return Ok(base);
            }
        }
    }

    fn is_braced_degree(&self) -> bool {
        let kind = |offset: usize| self.tokens.get(self.at + offset).map(|token| &token.kind);
        kind(1) == Some(&Kind::Command("degree".to_owned())) && kind(2) == Some(&Kind::Mark('}'))
    }

    /// A whole power behind `^`, and where it ends.
    pub(super) fn power(&mut self) -> Result<(i32, usize), Unreadable> {
        let start = self.here();
        let braced = self.is_at_mark('{');
        self.at += usize::from(braced);
        let negative = braced && self.is_at_mark('-');
        self.at += usize::from(negative);
        let digits_start = self.at;
        while self.peek().is_some_and(|token| matches!(token.kind, Kind::Digit(_)))
            && (braced || self.at == digits_start)
        {
            self.advance();
        }
        let digits: String = self.tokens[digits_start..self.at]
            .iter()
            .filter_map(|token| if let Kind::Digit(digit) = token.kind { Some(digit) } else { None })
            .collect();
        let closed = !braced || self.is_at_mark('}');
        let place = start.start..self.here().end.max(start.end);
        let Some(power) = digits.parse::<i32>().ok().filter(|_| closed) else {
            return Err(Mistake::new(place, "a power has to be a whole number")
                .with_help("an upper index of an unknown symbol is read as a power"));
        };
        self.at += usize::from(braced);
        let end = self.tokens[self.at - 1].place.end;
        Ok((if negative { -power } else { power }, end))
    }
}

/// `base^power`.
pub(super) fn raised(base: Formula, power: i32, end: usize) -> Formula {
    let place = base.place.start..end;
    Expr { node: Node::Pow(Box::new(base), power), place }
}

/// `90^\circ` is `90*pi/180`.
fn degrees(number: Formula, end: usize) -> Formula {
    let place = number.place.start..end;
    let node = |node| Box::new(Expr { node, place: place.clone() });
    let half_turn = node(Node::Number(Rational::from(180)));
    let unit = node(Node::Div(node(Node::Pi), half_turn));
    Expr { node: Node::Mul(Box::new(number), unit), place }
}
