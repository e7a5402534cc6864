//! The Pratt parser: tokens → expression. Functions, powers, roots and matrices, with their own conventions, have files
//! of their own.

mod abbreviations;
mod functions;
mod matrices;
mod named;
mod norms;
mod operands;
mod orders;
mod postfix;
mod powers;
mod roots;
mod solved;
mod sums;
mod transforms;
mod value;

use std::ops::Range;

use super::commands::{DETERMINANT, FRACTIONS, RAMP};
use super::token::{Kind, Token};
use super::{PrintedSymbols, Unreadable, glyph};
use functions::function;
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;
use value::Product;

pub(super) use solved::solved;
pub(super) use value::{Matrix, Value};

type Formula = Expr<Range<usize>>;

/// How tightly an operator binds, loosest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
}

pub(super) struct Parser<'a> {
    text: &'a str,
    tokens: &'a [Token],
    /// The empty place behind the last token.
    end: Range<usize>,
    symbols: &'a PrintedSymbols,
    at: usize,
    depth: usize,
    /// What closes the lengths that are open.
    bars: Vec<String>,
    /// What the formula turned out to need.
    pub notes: Notes,
}

/// What reading a formula took for granted, and what the formula itself says of its accuracy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Notes {
    /// Matrices with errors were multiplied, so that terms of higher order than a print keeps stand in the result.
    pub truncates: bool,
    /// Rotations about named axes were read as [`super::Turned`] says.
    pub turned: bool,
    /// `+ O(\varepsilon^2)`: from which order on the print drops terms.
    pub dropped: Option<u32>,
}

impl Notes {
    /// Those of another part of the same formula, too.
    pub fn join(&mut self, other: &Self) {
        self.truncates |= other.truncates;
        self.turned |= other.turned;
        self.dropped = self.dropped.or(other.dropped);
    }
}

impl<'a> Parser<'a> {
    pub fn new(text: &'a str, tokens: &'a [Token], end: Range<usize>, symbols: &'a PrintedSymbols) -> Self {
        Self { text, tokens, end, symbols, at: 0, depth: 0, bars: Vec::new(), notes: Notes::default() }
    }

    fn peek(&self) -> Option<&'a Token> {
        self.tokens.get(self.at)
    }

    fn advance(&mut self) {
        self.at += 1;
    }

    fn is_at(&self, kind: &Kind) -> bool {
        self.peek().is_some_and(|token| token.kind == *kind)
    }

    fn is_at_mark(&self, mark: char) -> bool {
        self.is_at(&Kind::Mark(mark))
    }

    fn is_at_command(&self, name: &str) -> bool {
        matches!(self.peek(), Some(Token { kind: Kind::Command(command), .. }) if command == name)
    }

    /// Where the parser is.
    fn here(&self) -> Range<usize> {
        self.peek().map_or_else(|| self.end.clone(), |token| token.place.clone())
    }

    /// The mistake that something else should stand here.
    fn unexpected(&self, wanted: &str) -> Unreadable {
        let found = match self.peek() {
            None => "the formula ends here".to_owned(),
            Some(token) => {
                if let Some(refusal) = self.refusal() {
                    return refusal;
                }
                format!("unexpected `{}`", &self.text[token.place.clone()])
            }
        };
        Mistake::new(self.here(), format!("{found}, where {wanted} should stand"))
    }

    /// What is said of a command here that no formula may hold.
    fn refusal(&self) -> Option<Unreadable> {
        let token = self.peek()?;
        let command = match &token.kind {
            Kind::Command(command) => command.as_str(),
            Kind::Mark('±' | '∓') => "pm",
            Kind::Mark('|' | '‖') => "vert",
            Kind::Mark('<' | '>' | '≤' | '≥' | '≪' | '≫' | '≠' | '∝' | '~') => "le",
            Kind::Mark('…' | '⋯') => "dots",
            Kind::Mark('∑' | '∫' | '∂' | '∇') => "sum",
            _ => return None,
        };
        let (message, help) = super::commands::refusal(command)?;
        let shown = &self.text[token.place.clone()];
        Some(Mistake::new(token.place.clone(), format!("`{shown}`: {message}")).with_help(help))
    }

    pub fn expect_end(&self) -> Result<(), Unreadable> {
        let Some(token) = self.peek() else { return Ok(()) };
        if let Some(refusal) = self.refusal() {
            return Err(refusal);
        }
        let mistake = Mistake::new(
            token.place.clone(),
            format!("unexpected `{}` behind the formula", &self.text[token.place.clone()]),
        );
        Err(match token.kind {
            Kind::Mark(',' | ';') | Kind::Row => {
                mistake.with_help("one component stands here, without punctuation")
            }
            Kind::Mark(')' | ']' | '}') | Kind::CloseBrace => mistake.with_help("no such bracket is open"),
            _ => mistake,
        })
    }

    fn expect_closer(&mut self, closer: &Kind) -> Result<(), Unreadable> {
        if self.is_at(closer) {
            self.advance();
            return Ok(());
        }
        let wanted = match closer {
            Kind::Mark(mark) => format!("`{mark}`"),
            Kind::End(name) => format!("`\\end{{{name}}}`"),
            _ => "`\\}`".to_owned(),
        };
        Err(self.unexpected(&wanted))
    }

    /// A whole sum.
    pub fn formula(&mut self) -> Result<Value, Unreadable> {
        self.expression(Binding::Sum)
    }

    /// `\sqrt{…}`, and what stands below the root; a length is one.
    pub fn radicand(&mut self) -> Result<Formula, Unreadable> {
        if self.starts_length() {
            return self.square_of_length();
        }
        if !self.is_at_command("sqrt") {
            return Err(self.unexpected("`\\sqrt{…}`"));
        }
        self.advance();
        self.argument()?.scalar()
    }

    fn expression(&mut self, at_least: Binding) -> Result<Value, Unreadable> {
        let mut left = self.signed()?;
        // What was divided by last with a stroke: whether more belongs below it is not said.
        let mut stroke: Option<Formula> = None;
        while let Some(token) = self.peek() {
            let (binding, written) = match token.kind {
                Kind::Mark('+' | '-') => (Binding::Sum, true),
                Kind::Mark('*' | '×' | '/' | '⊙') => (Binding::Product, true),
                _ if self.starts_operand() => (Binding::Product, false),
                _ => break,
            };
            if binding < at_least {
                break;
            }
            if token.kind == Kind::Mark('+') && self.skip_order()? {
                continue;
            }
            if token.kind == Kind::Mark('×') && self.is_last_in_brackets() {
                self.advance();
                left = self.skewed(left)?;
                continue;
            }
            if written {
                self.advance();
            } else {
                self.refuse_doubtful_product(&left, stroke.as_ref())?;
            }
            let right = match binding {
                Binding::Sum => self.expression(Binding::Product)?,
                Binding::Product if written => self.factor()?,
                Binding::Product => self.operand()?,
            };
            stroke = None;
            left = match token.kind {
                Kind::Mark('-') => {
                    // The sign belongs to the term it makes negative.
                    let place = token.place.start..right.place().end;
                    Value::sum(left, right.negated(place))?
                }
                Kind::Mark('+') => Value::sum(left, right)?,
                Kind::Mark('/') => {
                    let below = right.scalar()?;
                    stroke = Some(below.clone());
                    Value::quotient(left, Value::Scalar(below))?
                }
                Kind::Mark('⊙') => self.elementwise(left, right)?,
                Kind::Mark('*') => self.multiplied(left, right, Product::Dot)?,
                Kind::Mark('×') => self.multiplied(left, right, Product::Cross)?,
                _ => self.multiplied(left, right, Product::Plain)?,
            };
        }
        Ok(left)
    }

    /// Products that print does not write: a number behind a factor, a number in parentheses, more behind `a/b`.
    fn refuse_doubtful_product(&self, left: &Value, stroke: Option<&Formula>) -> Result<(), Unreadable> {
        let here = self.here();
        if let Some(below) = stroke.filter(|below| !functions::is_number(below)) {
            let shown = &self.text[below.place.clone()];
            let place = below.place.start..here.end;
            return Err(Mistake::new(
                place,
                format!("is what follows `/{shown}` divided by, too, or multiplied?"),
            )
            .with_help(r"write `\frac{…}{…}`, or put parentheses around the divisor"));
        }
        let number = match self.tokens.get(self.at..).unwrap_or_default() {
            [Token { kind: Kind::Digit(_), .. }, ..] => Some(here.clone()),
            [Token { kind: Kind::Mark('('), .. }, rest @ ..] => {
                let inside =
                    rest.iter().take_while(|token| matches!(token.kind, Kind::Digit(_) | Kind::Mark('.')));
                let digits = inside.count();
                let close = rest.get(digits).filter(|token| digits > 0 && token.kind == Kind::Mark(')'));
                close.map(|close| here.start..close.place.end)
            }
            _ => None,
        };
        match (left, number) {
            (Value::Scalar(Expr { node: Node::Number(_), .. }), _) | (_, None) => Ok(()),
            (_, Some(place)) => {
                let shown = &self.text[place.clone()];
                Err(Mistake::new(
                    place.clone(),
                    format!("is `{shown}` a factor, an index, or the number of the equation?"),
                )
                .with_help(r"a factor stands in front, or behind `\cdot`; an index behind `_`"))
            }
        }
    }

    /// What stands first in a sum or product: signs bind as loosely as the product behind them.
    fn signed(&mut self) -> Result<Value, Unreadable> {
        self.with_sign(|parser| parser.expression(Binding::Product))
    }

    /// What stands behind a written `\cdot` or `/`.
    fn factor(&mut self) -> Result<Value, Unreadable> {
        self.with_sign(Self::operand)
    }

    fn with_sign(
        &mut self,
        rest: impl FnOnce(&mut Self) -> Result<Value, Unreadable>,
    ) -> Result<Value, Unreadable> {
        let start = self.here().start;
        let is_negative = self.is_at_mark('-');
        if !is_negative && !self.is_at_mark('+') {
            return self.operand();
        }
        self.advance();
        let inside = rest(self)?;
        if !is_negative {
            return Ok(inside);
        }
        let place = start..inside.place().end;
        Ok(inside.negated(place))
    }

    fn starts_operand(&self) -> bool {
        self.starts_length()
            || self.peek().is_some_and(|token| match &token.kind {
                Kind::Digit(_) | Kind::OpenBrace | Kind::Begin(_) | Kind::Mark('(' | '[' | '{' | '.') => true,
                Kind::Command(name) => {
                    function(name).is_some()
                        || is_fraction(name)
                        || matches!(name.as_str(), "sqrt" | "sum" | "exp" | DETERMINANT | RAMP)
                        || glyph::starts(&token.kind)
                }
                Kind::Name(_) => true,
                kind => glyph::starts(kind),
            })
    }
}

/// Whether tokens are an amount or a matrix that is known.
pub(super) fn is_readable(text: &str, tokens: &[Token], symbols: &PrintedSymbols) -> bool {
    let end = tokens.last().map_or(0, |token| token.place.end);
    let mut parser = Parser::new(text, tokens, end..end, symbols);
    parser.formula().is_ok() && parser.at == tokens.len()
}

pub(super) fn is_fraction(name: &str) -> bool {
    FRACTIONS.contains(&name)
}
