//! The Pratt parser: tokens → expression. Functions and powers, with their own conventions, have files of their own.

mod functions;
mod powers;

use std::ops::Range;

use super::token::{Kind, RAMP, Token};
use super::{PrintedSymbols, Unreadable, glyph};
use crate::algebra::Rational;
use crate::expr::{Expr, Node};
use crate::mistake::Mistake;
use functions::function;
use powers::raised;

type Formula = Expr<Range<usize>>;

/// How tightly an operator binds, loosest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
}

/// Groups within groups that are read; print never comes near it.
const DEEPEST: usize = 100;

pub(super) struct Parser<'a> {
    text: &'a str,
    tokens: &'a [Token],
    symbols: &'a PrintedSymbols,
    at: usize,
    depth: usize,
}

impl<'a> Parser<'a> {
    pub fn new(text: &'a str, tokens: &'a [Token], symbols: &'a PrintedSymbols) -> Self {
        Self { text, tokens, symbols, at: 0, depth: 0 }
    }

    pub fn peek(&self) -> Option<&'a Token> {
        self.tokens.get(self.at)
    }

    pub fn advance(&mut self) {
        self.at += 1;
    }

    pub fn is_at(&self, kind: &Kind) -> bool {
        self.peek().is_some_and(|token| token.kind == *kind)
    }

    fn is_at_mark(&self, mark: char) -> bool {
        self.is_at(&Kind::Mark(mark))
    }

    fn is_at_command(&self, name: &str) -> bool {
        matches!(self.peek(), Some(Token { kind: Kind::Command(command), .. }) if command == name)
    }

    /// The empty place behind the last token.
    fn end(&self) -> Range<usize> {
        let end = self.tokens.last().map_or(self.text.len(), |token| token.place.end);
        end..end
    }

    /// Where the parser is.
    fn here(&self) -> Range<usize> {
        self.peek().map_or_else(|| self.end(), |token| token.place.clone())
    }

    /// The mistake that something else should stand here.
    fn unexpected(&self, wanted: &str) -> Unreadable {
        let found = match self.peek() {
            None => "the formula ends here".to_owned(),
            Some(token) => format!("unexpected `{}`", &self.text[token.place.clone()]),
        };
        Mistake::new(self.here(), format!("{found}, where {wanted} should stand"))
    }

    pub fn expect_end(&self) -> Result<(), Unreadable> {
        let Some(token) = self.peek() else { return Ok(()) };
        let mistake = Mistake::new(
            token.place.clone(),
            format!("unexpected `{}` behind the formula", &self.text[token.place.clone()]),
        );
        Err(match token.kind {
            Kind::Mark('=') => mistake.with_help("give the right-hand side alone"),
            Kind::Mark(',' | ';') | Kind::Row => {
                mistake.with_help("one component stands here, without punctuation")
            }
            Kind::Mark(')' | ']' | '}') | Kind::CloseBrace => mistake.with_help("no such bracket is open"),
            _ => mistake,
        })
    }

    pub fn expect_closer(&mut self, closer: &Kind) -> Result<(), Unreadable> {
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

    /// Whether the bracket that opens here is closed by the last token, marks of transposition aside.
    pub fn is_wrapped_by(&self, closer: &Kind) -> bool {
        let open = &self.tokens[self.at].kind;
        let mut depth = 0usize;
        for (index, token) in self.tokens.iter().enumerate().skip(self.at) {
            if token.kind == *open {
                depth += 1;
            } else if token.kind == *closer {
                depth -= 1;
            }
            if depth == 0 {
                let behind = &self.tokens[index + 1..];
                return behind.first().is_none_or(|next| {
                    matches!(next.kind, Kind::Mark('^' | '\'' | ']' | ')') | Kind::CloseBrace | Kind::End(_))
                });
            }
        }
        // Never closed: open it all the same, so that the mistake is found where the closer should stand.
        true
    }

    pub fn take_separator(&mut self) -> bool {
        let separates =
            self.peek().is_some_and(|token| matches!(token.kind, Kind::Mark(',' | ';' | '&') | Kind::Row));
        if separates {
            self.advance();
        }
        separates
    }

    /// `^T`, `^{\mathrm{T}}`, `^\top`, `'`.
    pub fn skip_transposition(&mut self) {
        if self.is_at_mark('\'') {
            self.advance();
        } else if self.is_at_mark('^') {
            let start = self.at;
            self.advance();
            let braced = self.is_at_mark('{');
            self.at += usize::from(braced);
            let is_mark = self.is_at(&Kind::Word("T".to_owned())) || self.is_at_command("top");
            self.at += usize::from(is_mark);
            let closed = !braced || self.is_at_mark('}');
            self.at += usize::from(braced && closed);
            if !is_mark || !closed {
                self.at = start;
            }
        }
    }

    /// A whole sum.
    pub fn formula(&mut self) -> Result<Formula, Unreadable> {
        self.expression(Binding::Sum)
    }

    fn expression(&mut self, at_least: Binding) -> Result<Formula, Unreadable> {
        let mut left = self.signed()?;
        while let Some(token) = self.peek() {
            let (binding, written) = match token.kind {
                Kind::Mark('+' | '-') => (Binding::Sum, true),
                Kind::Mark('*' | '/') => (Binding::Product, true),
                _ if self.starts_operand() => (Binding::Product, false),
                _ => break,
            };
            if binding < at_least {
                break;
            }
            if written {
                self.advance();
            }
            let right = match binding {
                Binding::Sum => self.expression(Binding::Product)?,
                Binding::Product if written => self.factor()?,
                Binding::Product => self.operand()?,
            };
            let place = left.place.start..right.place.end;
            let (left_side, right_side) = (Box::new(left), Box::new(right));
            let node = match token.kind {
                Kind::Mark('-') => {
                    // The sign belongs to the term it makes negative.
                    let place = token.place.start..right_side.place.end;
                    Node::Add(left_side, Box::new(Expr { node: Node::Neg(right_side), place }))
                }
                Kind::Mark('+') => Node::Add(left_side, right_side),
                Kind::Mark('/') => Node::Div(left_side, right_side),
                _ => Node::Mul(left_side, right_side),
            };
            left = Expr { node, place };
        }
        Ok(left)
    }

    /// What stands first in a sum or product: signs bind as loosely as the product behind them.
    fn signed(&mut self) -> Result<Formula, Unreadable> {
        self.with_sign(|parser| parser.expression(Binding::Product))
    }

    /// What stands behind a written `\cdot` or `/`.
    fn factor(&mut self) -> Result<Formula, Unreadable> {
        self.with_sign(Self::operand)
    }

    fn with_sign(
        &mut self,
        rest: impl FnOnce(&mut Self) -> Result<Formula, Unreadable>,
    ) -> Result<Formula, Unreadable> {
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
        let place = start..inside.place.end;
        Ok(Expr { node: Node::Neg(Box::new(inside)), place })
    }

    fn starts_operand(&self) -> bool {
        self.peek().is_some_and(|token| match &token.kind {
            Kind::Digit(_) | Kind::OpenBrace | Kind::Mark('(' | '[' | '{' | '.') => true,
            Kind::Command(name) => {
                function(name).is_some() || is_fraction(name) || name == RAMP || glyph::starts(&token.kind)
            }
            kind => glyph::starts(kind),
        })
    }

    /// A number, symbol, function, fraction or group, with the power behind it.
    fn operand(&mut self) -> Result<Formula, Unreadable> {
        let Some(token) = self.peek() else {
            return Err(self.unexpected("a term"));
        };
        match &token.kind {
            Kind::Digit(_) | Kind::Mark('.') => {
                let number = self.number()?;
                self.powered(number)
            }
            Kind::OpenBrace | Kind::Mark('(' | '[' | '{') => {
                let group = self.group()?;
                self.powered(group)
            }
            Kind::Command(name) => {
                if let Some(function) = function(name) {
                    return self.function(function, name);
                }
                if is_fraction(name) {
                    let fraction = self.fraction()?;
                    return self.powered(fraction);
                }
                if name == RAMP {
                    return self.ramp();
                }
                self.symbol()
            }
            kind if glyph::starts(kind) => self.symbol(),
            Kind::Mark('+' | '-') => {
                Err(self.unexpected("a term").with_help("put parentheses around a signed factor"))
            }
            _ => Err(self.unexpected("a term")),
        }
    }

    fn number(&mut self) -> Result<Formula, Unreadable> {
        let start = self.here().start;
        let mut end = start;
        while let Some(token) = self.peek() {
            let continues = matches!(token.kind, Kind::Digit(_) | Kind::Mark('.'));
            if !continues || token.place.start != end {
                break;
            }
            end = token.place.end;
            self.advance();
        }
        let place = start..end;
        if self.peek().is_some_and(|token| matches!(token.kind, Kind::Digit(_))) {
            return Err(Mistake::new(place.start..self.here().end, "two numbers next to each other")
                .with_help(r"write `\cdot` between them"));
        }
        let text = &self.text[place.clone()];
        match Rational::parse_decimal(text) {
            Ok(value) => Ok(Expr { node: Node::Number(value), place }),
            Err(error) => Err(Mistake::new(place, error.to_string())),
        }
    }

    fn group(&mut self) -> Result<Formula, Unreadable> {
        let start = self.here();
        let closer = match self.peek().map(|token| &token.kind) {
            Some(Kind::Mark('(')) => Kind::Mark(')'),
            Some(Kind::Mark('[')) => Kind::Mark(']'),
            Some(Kind::Mark('{')) => Kind::Mark('}'),
            Some(Kind::OpenBrace) => Kind::CloseBrace,
            _ => return Err(self.unexpected("a group")),
        };
        if self.depth == DEEPEST {
            return Err(Mistake::new(start, format!("more than {DEEPEST} groups within each other")));
        }
        self.depth += 1;
        self.advance();
        let inside = self.formula()?;
        let end = self.here().end;
        self.expect_closer(&closer)?;
        self.depth -= 1;
        Ok(Expr { node: inside.node, place: start.start..end })
    }

    /// A group in braces, or a single digit or symbol: what TeX takes as an argument.
    fn argument(&mut self) -> Result<Formula, Unreadable> {
        match self.peek().map(|token| &token.kind) {
            Some(Kind::Mark('{')) => self.group(),
            Some(Kind::Digit(digit)) => {
                let place = self.here();
                self.advance();
                let value = Rational::from(i64::from(digit.to_digit(10).unwrap_or_default()));
                Ok(Expr { node: Node::Number(value), place })
            }
            Some(kind) if glyph::starts(kind) => self.symbol(),
            _ => Err(self.unexpected("a group in braces")),
        }
    }

    fn fraction(&mut self) -> Result<Formula, Unreadable> {
        let start = self.here().start;
        self.advance();
        let above = self.argument()?;
        let below = self.argument()?;
        let place = start..below.place.end;
        Ok(Expr { node: Node::Div(Box::new(above), Box::new(below)), place })
    }

    fn symbol(&mut self) -> Result<Formula, Unreadable> {
        let found = match self.symbols.find(&self.tokens[self.at..]) {
            Ok(found) => found,
            Err(_) if self.is_at_command("pi") => {
                let place = self.here();
                self.advance();
                return self.powered(Expr { node: Node::Pi, place });
            }
            Err(mistake) => return Err(mistake),
        };
        self.at += found.tokens;
        let symbol = found.amount.map_place(&|()| found.place.clone());
        match found.power {
            Some(power) => self.powered(raised(symbol, power, found.place.end)),
            None => self.powered(symbol),
        }
    }
}

fn is_fraction(name: &str) -> bool {
    matches!(name, "frac" | "tfrac" | "dfrac")
}
