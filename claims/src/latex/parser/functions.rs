//! Functions with their powers and arguments: `\sin^2 \beta`, `\cos(\alpha + \beta)`, `\sin 2\beta`.

use super::powers::raised;
use super::{Formula, Parser, is_fraction};
use crate::latex::commands::INVERSE_HELP;
use crate::latex::token::Kind;
use crate::latex::{Unreadable, glyph};
use model_core::expr::{Expr, Function, Node};
use model_core::mistake::Mistake;

impl Parser<'_> {
    /// A function with its power and argument: `\sin^2 \beta`, `\cos(\alpha + \beta)`, `\sin 2\beta`.
    pub(super) fn function(&mut self, function: Function, name: &str) -> Result<Formula, Unreadable> {
        let place = self.here();
        let start = place.start;
        // Letters in a row are the function, unless each of them is a symbol.
        let letters = &self.text[place.clone()];
        if letters == name && letters.chars().all(|letter| self.symbols.knows(letter)) {
            return Err(Mistake::new(
                place,
                format!("is this the function or a product of {name}'s letters?"),
            )
            .with_help(format!("for the function write `\\{name}`")));
        }
        self.advance();
        let mut power = None;
        if self.is_at_mark('^') {
            let caret = self.here();
            self.advance();
            let (value, end) = self.power()?;
            if value < 0 {
                return Err(Mistake::new(
                    caret.start..end,
                    "a negative power of a function can mean its inverse",
                )
                .with_help(format!(
                    r"for the reciprocal write `\frac{{1}}{{\{name}…}}`; for the inverse, {INVERSE_HELP}"
                )));
            }
            power = Some(value);
        }
        let grouped = self.peek().is_some_and(|token| {
            matches!(token.kind, Kind::OpenBrace | Kind::Mark('(' | '[' | '{')) || is_stacked(&token.kind)
        });
        let argument = self.function_argument()?;
        let end = argument.place.end;
        if self.is_at_mark('/')
            && !grouped
            && self.tokens.get(self.at + 1).is_some_and(|next| matches!(next.kind, Kind::Digit(_)))
        {
            return Err(Mistake::new(start..self.here().end, "is the angle divided, or the function?")
                .with_help(format!(r"write `\{name}\frac{{…}}{{…}}` or `\frac{{\{name} …}}{{…}}`")));
        }
        let call = Expr { node: Node::Call(function, Box::new(argument)), place: start..end };
        match power {
            Some(power) => Ok(raised(call, power, end)),
            // Behind a group the power is the function's: `\sin(\beta)^2`.
            None => self.powered(call),
        }
    }

    /// `\operatorname{ramp}(x, from, to)`.
    pub(super) fn ramp(&mut self) -> Result<Formula, Unreadable> {
        let start = self.here().start;
        self.advance();
        if !self.is_at_mark('(') {
            return Err(self.unexpected("`(`").with_help(r"write `\operatorname{ramp}(x, from, to)`"));
        }
        self.advance();
        let of = self.formula()?.scalar()?;
        self.expect_closer(&Kind::Mark(','))?;
        let from = self.formula()?.scalar()?;
        self.expect_closer(&Kind::Mark(','))?;
        let to = self.formula()?.scalar()?;
        let end = self.here().end;
        self.expect_closer(&Kind::Mark(')'))?;
        self.powered(Expr { node: Node::Ramp(Box::new([of, from, to])), place: start..end })
    }

    /// What a function takes: a group, or numbers and one symbol.
    pub(super) fn function_argument(&mut self) -> Result<Formula, Unreadable> {
        let start = self.here().start;
        if self.is_at_mark('-') {
            self.advance();
            let inside = self.function_argument()?;
            let place = start..inside.place.end;
            return Ok(Expr { node: Node::Neg(Box::new(inside)), place });
        }
        let Some(token) = self.peek() else {
            return Err(self.unexpected("the angle of the function"));
        };
        match &token.kind {
            Kind::OpenBrace | Kind::Mark('(' | '[' | '{') => self.group()?.scalar(),
            Kind::Digit(_) | Kind::Mark('.') => {
                let number = self.number()?;
                let number = self.powered(number)?;
                self.behind_number(number)
            }
            Kind::Command(name) if is_fraction(name) => {
                let fraction = self.fraction()?.scalar()?;
                if is_number(&fraction) { self.behind_number(fraction) } else { Ok(fraction) }
            }
            kind if glyph::starts(kind) => {
                let symbol = self.symbol()?.scalar()?;
                if let Node::Pow(..) = symbol.node {
                    return Err(Mistake::new(
                        symbol.place,
                        "is this a power of the function or of the angle?",
                    )
                    .with_help(r"write `\sin^2 \beta`"));
                }
                Ok(symbol)
            }
            Kind::Command(name) if function(name).is_some() => Err(self
                .unexpected("the angle of the function")
                .with_help("put parentheses around the argument")),
            _ => Err(self.unexpected("the angle of the function")),
        }
    }

    /// The symbol or group that a number inside a function multiplies, if there is one.
    fn behind_number(&mut self, number: Formula) -> Result<Formula, Unreadable> {
        let continues = self.peek().is_some_and(|token| {
            glyph::starts(&token.kind) || matches!(token.kind, Kind::Mark('(' | '[' | '{') | Kind::OpenBrace)
        });
        if !continues {
            return Ok(number);
        }
        let angle = self.function_argument()?;
        let place = number.place.start..angle.place.end;
        Ok(Expr { node: Node::Mul(Box::new(number), Box::new(angle)), place })
    }
}

/// The function of a control word.
pub(super) fn function(name: &str) -> Option<Function> {
    Some(match name {
        "sin" => Function::Sin,
        "cos" => Function::Cos,
        "tan" => Function::Tan,
        "cot" => Function::Cot,
        "sec" => Function::Sec,
        "csc" => Function::Csc,
        _ => return None,
    })
}

fn is_stacked(kind: &Kind) -> bool {
    matches!(kind, Kind::Command(name) if is_fraction(name))
}

pub(super) fn is_number(formula: &Formula) -> bool {
    match &formula.node {
        Node::Number(_) => true,
        Node::Neg(inside) => is_number(inside),
        Node::Div(above, below) => is_number(above) && is_number(below),
        _ => false,
    }
}
