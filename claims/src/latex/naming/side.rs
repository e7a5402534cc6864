//! What the left of `=` is made of: names that nobody knows, and amounts that are known.

use std::ops::Range;

use super::super::glyph::{self, Glyph};
use super::super::parser::{is_fraction, is_readable};
use super::super::printed::PrintedSymbols;
use super::super::token::{Kind, Token};
use super::DIFFERENCES;

/// Indices of what is wanted, and not of what is observed.
const AS_DESIGNED: [&str; 9] = ["0", "n", "nom", "nominal", "ref", "d", "des", "c", "cmd"];

/// Bars around a name say that it is a length.
const BARS: [&str; 6] = ["vert", "lvert", "rvert", "Vert", "lVert", "rVert"];

/// A name on the left of `=`: its tokens, and whether it says that it is a difference.
pub(super) struct Part {
    pub tokens: Range<usize>,
    pub is_difference: bool,
}

impl Part {
    /// Whether it is the change of an amount that is known, `\Delta H` of the joint `H`.
    pub fn changes_known(&self, side: &[Token], text: &str, symbols: &PrintedSymbols) -> bool {
        let tokens = &side[self.tokens.clone()];
        let mark = glyph::read(tokens).ok().flatten().map_or(0, |read| read.tokens);
        mark < tokens.len() && is_readable(text, &tokens[mark..], symbols)
    }
}

/// What the left of `=` is made of.
#[derive(Default)]
pub(super) struct Parts {
    pub unknown: Vec<Part>,
    known: Vec<Range<usize>>,
    /// Numbers, functions, fractions.
    has_amounts: bool,
    pub has_sum: bool,
}

impl Parts {
    pub fn of(side: &[Token], text: &str, symbols: &PrintedSymbols) -> Self {
        let mut parts = Self::default();
        let mut at = 0;
        while let Some(token) = side.get(at) {
            if glyph::starts(&token.kind) {
                at = parts.symbol(side, at, text, symbols);
                continue;
            }
            match &token.kind {
                // A sign in front of everything makes no sum.
                Kind::Mark('+' | '-') if at > 0 => parts.has_sum = true,
                Kind::Mark('+' | '-') => parts.has_amounts = true,
                Kind::Command(bar) if BARS.contains(&bar.as_str()) => {}
                Kind::Digit(_) | Kind::Mark('/') | Kind::Command(_) => parts.has_amounts = true,
                _ => {}
            }
            at += 1;
        }
        parts
    }

    /// A symbol, and where it ends: a known one, or a name with what makes it a difference and what it is a function of.
    fn symbol(&mut self, side: &[Token], start: usize, text: &str, symbols: &PrintedSymbols) -> usize {
        let mut at = start;
        let mut glyphs: Vec<Glyph> = Vec::new();
        let is_mark = |glyph: &Glyph| {
            DIFFERENCES.contains(&glyph.base.as_str()) && glyph.lower.is_empty() && glyph.upper.is_empty()
        };
        while let Ok(Some(read)) = glyph::read(&side[at..]) {
            at += read.tokens;
            let goes_on = is_mark(&read.glyph);
            glyphs.push(read.glyph);
            if !goes_on {
                break;
            }
        }
        if at == start {
            return start + 1;
        }
        // `Az`, `El`, `Hz`: a word.
        let letter = |at: usize| match side.get(at).map(|token| &token.kind) {
            Some(Kind::Word(word)) if word.chars().count() == 1 => word.chars().next(),
            _ => None,
        };
        let end = at;
        let mut is_word = letter(at - 1).is_some_and(char::is_uppercase);
        while is_word
            && letter(at).is_some_and(char::is_lowercase)
            && side[at].place.start == side[at - 1].place.end
        {
            let Ok(Some(read)) = glyph::read(&side[at..]) else { break };
            is_word = read.tokens == 1;
            at += read.tokens;
        }
        // `d` may be a length, and `dx` is a difference all the same.
        let is_long = at > end;
        let is_differential = glyphs.len() == 2 && glyphs[0].base == "d";
        if let Ok(found) = symbols.find(text, &side[start..])
            && start + found.tokens >= if is_differential || is_long { at } else { 0 }
        {
            self.known.push(start..start + found.tokens);
            return start + found.tokens;
        }
        // What the name is a function of.
        let is_difference = glyphs.iter().any(is_mark) || is_error(&glyphs[0]);
        let length = match glyph::arguments(&side[at..]) {
            Some((_, length)) => length,
            None if is_difference => 0,
            None => group_length(&side[at..], ['(', ')']),
        };
        let tokens = start..at + length;
        // `R_z(\psi)`, `\mathbf{I}`, `c_1`: what everybody knows.
        if !is_difference && is_readable(text, &side[tokens.clone()], symbols) {
            self.known.push(tokens);
        } else {
            self.unknown.push(Part { tokens, is_difference });
        }
        at + length
    }

    /// Whether a side is a name and nothing else: one symbol, or letters that nobody knows.
    pub fn is_bare(&self, side: &[Token]) -> bool {
        let has_change = self.unknown.iter().any(|part| part.is_difference);
        let is_whole = |tokens: &Range<usize>| {
            let length = group_length(&side[tokens.end..], ['(', ')']);
            tokens.start == 0
                && (tokens.end == side.len() || (!has_change && tokens.end + length == side.len()))
        };
        let is_nothing = self.unknown.is_empty() && self.known.is_empty();
        let is_digit = side.len() == 1 && matches!(side[0].kind, Kind::Digit(_));
        self.known.iter().any(is_whole)
            || is_digit
            || (self.known.is_empty() && !self.has_amounts && !self.has_sum && !is_nothing)
    }

    /// `x_a - x`: a change, of two letters that differ in their indices.
    pub fn is_change(&self, side: &[Token]) -> bool {
        let ([is], [was]) = (self.unknown.as_slice(), self.known.as_slice()) else { return false };
        let letter = |tokens: &Range<usize>| match glyph::read(&side[tokens.clone()]) {
            Ok(Some(read)) if read.tokens == tokens.len() => Some(read.glyph),
            _ => None,
        };
        let (Some(observed), Some(designed)) = (letter(&is.tokens), letter(was)) else { return false };
        is.tokens.start == 0
            && side.get(is.tokens.end).is_some_and(|token| token.kind == Kind::Mark('-'))
            && was.start == is.tokens.end + 1
            && was.end == side.len()
            && bare(&observed.base) == bare(&designed.base)
            && !AS_DESIGNED.contains(&observed.lower.as_str())
    }

    /// Whether the side is a product of letters and functions alone: a sign or a number could be a factor of what is shown.
    pub fn is_plain_product(&self, side: &[Token]) -> bool {
        let is_part = |token: &Token| match &token.kind {
            Kind::Digit(_) | Kind::Mark('+' | '-' | '/') => false,
            Kind::Command(command) => !is_fraction(command),
            _ => true,
        };
        !self.has_sum && side.iter().all(is_part)
    }
}

/// A letter without the accent over it.
fn bare(base: &str) -> &str {
    base.strip_suffix('}').and_then(|base| base.split_once('{')).map_or(base, |(_, letter)| letter)
}

/// `e_x`, `\epsilon_y`: letters that name errors by themselves.
fn is_error(glyph: &Glyph) -> bool {
    let letters = ["e", "E", "\\epsilon", "\\varepsilon", "\\delta", "\\Delta"];
    letters.contains(&glyph.base.as_str()) && !glyph.lower.is_empty()
}

/// The tokens of the group at the start; 0 where none stands.
pub(super) fn group_length(tokens: &[Token], [open, close]: [char; 2]) -> usize {
    let mut depth = 0;
    for (at, token) in tokens.iter().enumerate() {
        depth += i32::from(token.kind == Kind::Mark(open)) - i32::from(token.kind == Kind::Mark(close));
        if depth == 0 {
            return if at == 0 { 0 } else { at + 1 };
        }
    }
    0
}
