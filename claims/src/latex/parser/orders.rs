//! `+ O(\varepsilon^2)`: what a print says of the terms that it drops.

use super::{Parser, Value};
use crate::latex::Unreadable;
use crate::latex::lookup::After;
use crate::latex::token::Kind;
use model_core::mistake::Mistake;

impl Parser<'_> {
    /// Whether the sign here begins a term of dropped orders, which is then passed over.
    pub(super) fn skip_order(&mut self) -> Result<bool, Unreadable> {
        let start = self.at;
        let kind = |offset: usize| self.tokens.get(start + offset).map(|token| &token.kind);
        let is_letter =
            |kind: Option<&Kind>| matches!(kind, Some(Kind::Word(word)) if word == "O" || word == "o");
        // `\mathcal{O}` is an accent with its letter.
        let length = match kind(1) {
            found if is_letter(found) => 1,
            Some(Kind::Command(command)) if matches!(command.as_str(), "mathcal" | "mathscr") => {
                let braced = kind(2) == Some(&Kind::Mark('{'));
                if !is_letter(kind(if braced { 3 } else { 2 })) {
                    return Ok(false);
                }
                if braced { 4 } else { 2 }
            }
            _ => return Ok(false),
        };
        let open = start + 1 + length;
        if !matches!(self.tokens.get(open).map(|token| &token.kind), Some(Kind::Mark('('))) {
            return Ok(false);
        }
        let place = self.tokens[start + 1].place.clone();
        let mut depth = 0;
        let mut order = None;
        let mut digits = String::new();
        for at in open..self.tokens.len() {
            match &self.tokens[at].kind {
                Kind::Mark('(') => depth += 1,
                Kind::Mark(')') => depth -= 1,
                Kind::Mark('^') => {
                    let rest = self.tokens.get(at + 1..).unwrap_or_default();
                    let digit = rest.iter().find(|token| token.kind != Kind::Mark('{'));
                    if let Some(Kind::Digit(digit)) = digit.map(|token| &token.kind) {
                        order = digit.to_digit(10);
                    }
                }
                Kind::Digit(digit) => digits.push(*digit),
                _ => {}
            }
            if depth == 0 {
                let is_number = at == open + 2 && digits.len() == 1;
                let order = order.or_else(|| digits.parse().ok().filter(|_| is_number));
                let Some(order) = order.filter(|order| (2..=4).contains(order)) else {
                    return Err(Mistake::new(
                        place.start..self.tokens[at].place.end,
                        "of which order are the dropped terms?",
                    )
                    .with_help(r"write `O(\varepsilon^2)` for products of two or more errors"));
                };
                self.notes.dropped = Some(self.notes.dropped.map_or(order, |other| other.min(order)));
                self.at = at + 1;
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether a bracket closes behind the sign here: `[\omega \times]`.
    pub(super) fn is_last_in_brackets(&self) -> bool {
        matches!(self.tokens.get(self.at + 1).map(|token| &token.kind), Some(Kind::Mark(']' | ')')))
    }

    /// The matrix of the vector product with a value.
    pub(super) fn skewed(&mut self, value: Value) -> Result<Value, Unreadable> {
        match value {
            Value::Matrix(matrix) => self.changed(matrix, After::Skew).map(Value::Matrix),
            other => Err(Mistake::new(other.place(), "a vector is wanted before this cross")),
        }
    }
}
