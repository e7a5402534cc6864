//! `\sum_{k=1}^{3} e_k \cos(k\alpha)`: sums over whole numbers, written out.

use std::ops::Range;

use super::{Parser, Value};
use crate::latex::token::{Kind, Token};
use crate::latex::{Unreadable, glyph};
use model_core::mistake::Mistake;

/// Addends of a sum that are written out.
const MOST: i64 = 60;

impl Parser<'_> {
    /// The sum whose sign stands here.
    pub(super) fn sum(&mut self) -> Result<Value, Unreadable> {
        let start = self.here();
        self.advance();
        let (mut letter, mut from, mut to) = (None, None, None);
        for _ in 0..2 {
            if self.is_at_mark('_') && letter.is_none() {
                let (inside, length) = self.limit()?;
                let ([Token { kind: Kind::Word(name), .. }, rest @ ..], true) = (inside.as_slice(), true)
                else {
                    return Err(refused(start, "the index of this sum is not said"));
                };
                letter = Some(name.clone());
                from = rest
                    .first()
                    .filter(|token| token.kind == Kind::Mark('='))
                    .and_then(|_| whole(&rest[1..]));
                self.at += length;
            } else if self.is_at_mark('^') && to.is_none() {
                let (inside, length) = self.limit()?;
                to = whole(&inside);
                self.at += length;
            }
        }
        let (Some(letter), Some(from), Some(to)) = (letter, from, to) else {
            return Err(refused(start, "this sum does not say from where to where it runs"));
        };
        if to < from || to - from >= MOST {
            return Err(refused(start, "a sum has at least one addend, and here at most sixty"));
        }
        let (first, last) = (self.at, self.end_of_product());
        let body = self.tokens.get(first..last).unwrap_or_default();
        if body.is_empty() {
            return Err(self.unexpected("what is added up"));
        }
        // `\sum_k a_k + b_k`: does the second belong to the sum?
        if let Some(stray) = self
            .tokens
            .get(last..)
            .unwrap_or_default()
            .iter()
            .take_while(|token| token.kind != Kind::Row)
            .find(|token| token.kind == Kind::Word(letter.clone()))
            && !self.tokens[last..]
                .iter()
                .any(|token| matches!(&token.kind, Kind::Command(name) if name == "sum"))
        {
            return Err(Mistake::new(
                stray.place.clone(),
                format!("`{letter}` stands behind the sum over `{letter}`, and may belong into it"),
            )
            .with_help("put parentheses around what is added up"));
        }
        let end = body.last().map_or(start.end, |token| token.place.end);
        let mut sum: Option<Value> = None;
        for value in from..=to {
            let tokens = put_in(body, &letter, value)?;
            let mut parser = Parser::new(self.text, &tokens, end..end, self.symbols);
            let addend = parser.formula()?;
            parser.expect_end()?;
            self.notes.join(&parser.notes);
            sum = Some(match sum {
                None => addend,
                Some(sum) => Value::sum(sum, addend)?,
            });
        }
        self.at = last;
        let Some(sum) = sum else { return Err(refused(start, "this sum has no addend")) };
        Ok(sum.at(start.start..end))
    }

    /// The tokens of an index, and how many tokens it takes with its mark.
    fn limit(&self) -> Result<(Vec<Token>, usize), Unreadable> {
        let rest = self.tokens.get(self.at + 1..).unwrap_or_default();
        match rest.first().map(|token| &token.kind) {
            Some(Kind::Mark('{')) => {
                let length = rest.iter().position(|token| token.kind == Kind::Mark('}'));
                let length = length.ok_or_else(|| Mistake::new(self.here(), "this brace is never closed"))?;
                Ok((rest[1..length].to_vec(), length + 2))
            }
            Some(_) => Ok((rest[..1].to_vec(), 2)),
            None => Err(self.unexpected("a limit of the sum")),
        }
    }

    /// Where the product that begins here ends: at a sign outside of brackets, or at what ends a formula.
    fn end_of_product(&self) -> usize {
        let mut depth = 0;
        for (at, token) in self.tokens.iter().enumerate().skip(self.at) {
            match token.kind {
                Kind::Mark('(' | '[' | '{') | Kind::OpenBrace | Kind::Begin(_) => depth += 1,
                Kind::Mark(')' | ']' | '}') | Kind::CloseBrace | Kind::End(_) => depth -= 1,
                Kind::Mark('+' | '-') if depth == 0 && at > self.at => return at,
                Kind::Mark('=' | ',' | ';' | '&') | Kind::Row if depth == 0 => return at,
                _ => {}
            }
            if depth < 0 {
                return at;
            }
        }
        self.tokens.len()
    }
}

fn refused(place: Range<usize>, why: &str) -> Unreadable {
    Mistake::new(place, why).with_help(r"write `\sum_{k=1}^{3} …`, or write the sum out")
}

/// The whole number that tokens are.
fn whole(tokens: &[Token]) -> Option<i64> {
    let digits: Option<String> = tokens
        .iter()
        .map(|token| if let Kind::Digit(digit) = token.kind { Some(digit) } else { None })
        .collect();
    digits?.parse().ok()
}

/// The tokens with a number in place of a letter.
fn put_in(tokens: &[Token], letter: &str, value: i64) -> Result<Vec<Token>, Unreadable> {
    let mut found: Vec<Token> = Vec::with_capacity(tokens.len());
    for (at, token) in tokens.iter().enumerate() {
        let is_letter = matches!(&token.kind, Kind::Word(word) if word == letter);
        if !is_letter {
            found.push(token.clone());
            continue;
        }
        let in_index = at > 0 && is_index(&tokens[..at]);
        let mut number = value;
        if !in_index {
            // `2k` is a product of numbers.
            let mut digits = String::new();
            while let Some(Token { kind: Kind::Digit(digit), .. }) = found.last() {
                digits.insert(0, *digit);
                found.pop();
            }
            let before = found.last().map(|token| &token.kind);
            let behind = tokens.get(at + 1).map(|token| &token.kind);
            let broken = matches!(before, Some(Kind::Mark('.')))
                || matches!(behind, Some(Kind::Digit(_) | Kind::Mark('.')));
            let factor = if digits.is_empty() { Some(1) } else { digits.parse::<i64>().ok() };
            let behind_factor =
                before.is_some_and(|kind| glyph::starts(kind) || matches!(kind, Kind::Mark(')' | ']' | '}')));
            number = match factor.and_then(|factor| factor.checked_mul(value)) {
                Some(number) if !broken => number,
                _ => return Err(doubtful(token)),
            };
            if behind_factor && digits.is_empty() {
                found.push(Token { kind: Kind::Mark('*'), ..token.clone() });
            }
        }
        let place = token.place.clone();
        for (nth, digit) in number.to_string().chars().enumerate() {
            // Digits of one number stand at one place, the first of them.
            let place = if nth == 0 { place.clone() } else { place.end..place.end };
            let kind = if digit == '-' { Kind::Mark('-') } else { Kind::Digit(digit) };
            found.push(Token { kind, place, bold: false });
        }
    }
    Ok(found)
}

/// Whether the next token belongs to an index.
fn is_index(before: &[Token]) -> bool {
    let mut depth = 0i32;
    for (at, token) in before.iter().enumerate().rev() {
        match token.kind {
            Kind::Mark('}') => depth += 1,
            Kind::Mark('{') if depth > 0 => depth -= 1,
            Kind::Mark('{') => {
                return at > 0 && before[at - 1].kind == Kind::Mark('_');
            }
            Kind::Mark('_') if at + 1 == before.len() => return true,
            _ => {}
        }
    }
    false
}

fn doubtful(token: &Token) -> Unreadable {
    Mistake::new(token.place.clone(), "what number this index makes here is not clear")
        .with_help(r"write `\cdot` between the factors")
}
