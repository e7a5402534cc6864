//! What stands on the left of `=`: a name, and perhaps which component it is. Where amounts stand around the name the
//! formula is solved for it.

use std::ops::Range;

use super::glyph::{self, Glyph};
use super::layout::Row;
use super::parser::{Value, is_fraction, is_readable, solved};
use super::printed::{Beside, PrintedSymbols};
use super::token::{Kind, Token};
use super::{Unreadable, more_than_a_name};
use model_core::mistake::Mistake;

/// Letters that make the one behind them a difference.
const DIFFERENCES: [&str; 4] = ["\\Delta", "\\delta", "d", "\\mathrm{d}"];

/// Indices of what is wanted, and not of what is observed.
const AS_DESIGNED: [&str; 9] = ["0", "n", "nom", "nominal", "ref", "d", "des", "c", "cmd"];

/// Bars around a name say that it is a length.
const BARS: [&str; 6] = ["vert", "lvert", "rvert", "Vert", "lVert", "rVert"];

/// What the name of a row is, given what the row says.
pub(super) fn named(
    text: &str,
    row: &Row,
    symbols: &PrintedSymbols,
    axis: Option<usize>,
    value: Value,
) -> Result<Value, Unreadable> {
    let side = row.name.as_slice();
    let Some(first) = side.first() else { return Ok(value) };
    if matches!(first.kind, Kind::Digit(_)) && side.len() == 1 {
        return Err(Mistake::new(first.place.clone(), "a number stands on the left of `=`")
            .with_help("give the right-hand side alone"));
    }
    match around(side, text, symbols)? {
        None => {
            check_axis(text, side, axis)?;
            Ok(value)
        }
        Some(name) => {
            check_axis(text, &side[name.clone()], axis)?;
            solved(text, side, name, symbols, value)
        }
    }
}

/// That nothing but a name stands on the left of a row.
pub(super) fn is_name_alone(text: &str, row: &Row, symbols: &PrintedSymbols) -> Result<(), Unreadable> {
    match row.name.first() {
        Some(first) => match around(&row.name, text, symbols)? {
            None => Ok(()),
            Some(_) => Err(more_than_a_name(first.place.clone())),
        },
        None => Ok(()),
    }
}

/// That the name of a line of a program is one.
pub(super) fn check(text: &str, row: &Row, axis: Option<usize>) -> Result<(), Unreadable> {
    let is_amount = |token: &&Token| {
        matches!(token.kind, Kind::Mark('+' | '-' | '/' | '*' | '⊙' | '×' | '^') | Kind::Digit(_))
    };
    let calls = row.name.iter().position(|token| matches!(token.kind, Kind::Mark('(' | '[')));
    match row.name[..calls.unwrap_or(row.name.len())].iter().find(is_amount) {
        Some(token) => Err(more_than_a_name(token.place.clone())),
        None => check_axis(text, &row.name, axis),
    }
}

/// Where the name stands among amounts; `None` where the whole side is the name.
fn around(side: &[Token], text: &str, symbols: &PrintedSymbols) -> Result<Option<Range<usize>>, Unreadable> {
    let whole = || side[0].place.start..side[side.len() - 1].place.end;
    if let Some(cells) = cells(side) {
        let is_name = |cell: &&[Token]| Parts::of(cell, text, symbols).is_bare(cell);
        return if cells.iter().all(is_name) { Ok(None) } else { Err(more_than_a_name(whole())) };
    }
    let parts = Parts::of(side, text, symbols);
    if parts.is_bare(side) || parts.is_change(side) {
        return Ok(None);
    }
    let differences: Vec<&Part> = parts.unknown.iter().filter(|part| part.is_difference).collect();
    let name = match (differences.as_slice(), parts.unknown.as_slice()) {
        ([only], _) => only,
        ([], [only]) if !parts.has_sum => only,
        _ => return Err(more_than_a_name(whole())),
    };
    // `\delta(\cos\theta)` is no component, and `\Delta x\,(1 + a)` could be a function.
    let calls = side.get(name.tokens.end).is_some_and(|token| token.kind == Kind::Mark('('));
    if calls {
        return Err(more_than_a_name(whole()));
    }
    // `\Delta A\cos E` is the name of what the sky shows sideways.
    match (symbols.beside, parts.is_times_cosine(side, name)) {
        (Beside::Name, true) => Ok(None),
        (Beside::Unclear, true) => {
            Err(Mistake::new(whole(), "is this cosine a part of the name, or a factor?")
                .with_help("claim each number by itself: component = \"…\""))
        }
        _ => Ok(Some(name.tokens.clone())),
    }
}

/// A name on the left of `=`: its tokens, and whether it says that it is a difference.
struct Part {
    tokens: Range<usize>,
    is_difference: bool,
}

/// What the left of `=` is made of.
#[derive(Default)]
struct Parts {
    unknown: Vec<Part>,
    known: Vec<Range<usize>>,
    /// Numbers, functions, fractions.
    has_amounts: bool,
    has_sum: bool,
}

impl Parts {
    fn of(side: &[Token], text: &str, symbols: &PrintedSymbols) -> Self {
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
    fn is_bare(&self, side: &[Token]) -> bool {
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
    fn is_change(&self, side: &[Token]) -> bool {
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

    /// Whether the name is multiplied by the cosine of another letter, and by nothing else.
    fn is_times_cosine(&self, side: &[Token], name: &Part) -> bool {
        let (before, behind) = (&side[..name.tokens.start], &side[name.tokens.end..]);
        let others = match (before, behind) {
            ([], others) | (others, []) if !self.has_sum => others,
            _ => return false,
        };
        let [Token { kind: Kind::Command(function), .. }, angle @ ..] = others else { return false };
        let is_mark = |token: &&Token| !matches!(token.kind, Kind::Mark('(' | ')' | '{' | '}' | '*'));
        let angle: Vec<Token> = angle.iter().filter(is_mark).cloned().collect();
        let letter = last_letter(&angle);
        function == "cos" && letter.is_some() && letter != last_letter(&side[name.tokens.clone()])
    }
}

/// The last of the letters that tokens are, without its indices; `None` where they are more than letters.
fn last_letter(tokens: &[Token]) -> Option<String> {
    let mut at = 0;
    let mut last = None;
    while at < tokens.len() {
        let read = glyph::read(&tokens[at..]).ok()??;
        at += read.tokens;
        last = Some(read.glyph.base);
    }
    last
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
fn group_length(tokens: &[Token], [open, close]: [char; 2]) -> usize {
    let mut depth = 0;
    for (at, token) in tokens.iter().enumerate() {
        depth += i32::from(token.kind == Kind::Mark(open)) - i32::from(token.kind == Kind::Mark(close));
        if depth == 0 {
            return if at == 0 { 0 } else { at + 1 };
        }
    }
    0
}

/// The cells of a column or a list of names, `[x, y, z]^T`; `None` where the side is none.
fn cells(side: &[Token]) -> Option<Vec<&[Token]>> {
    if !matches!(side.first()?.kind, Kind::Mark('(' | '[') | Kind::OpenBrace | Kind::Begin(_)) {
        return None;
    }
    let parts = |kind: &Kind| matches!(kind, Kind::Mark(',' | ';' | '&') | Kind::Row);
    let is_bracket =
        |kind: &Kind| matches!(kind, Kind::Mark('(' | '[' | '{') | Kind::OpenBrace | Kind::Begin(_));
    let closes = |kind: &Kind| matches!(kind, Kind::Mark(')' | ']' | '}') | Kind::CloseBrace | Kind::End(_));
    let mut depth = 0;
    let mut close = None;
    let mut marks = Vec::new();
    for (at, token) in side.iter().enumerate() {
        depth += i32::from(is_bracket(&token.kind)) - i32::from(closes(&token.kind));
        if depth == 1 && parts(&token.kind) {
            marks.push(at);
        }
        if depth == 0 {
            close = Some(at);
            break;
        }
    }
    let close = close?;
    let behind = &side[close + 1..];
    let is_transposed =
        behind.first().is_none_or(|token| token.kind == Kind::Mark('^') || token.kind == Kind::Mark('\''));
    if marks.is_empty() || !is_transposed {
        return None;
    }
    let ends = marks.iter().copied().chain([close]);
    let mut start = 1;
    let mut found = Vec::new();
    for end in ends {
        if end > start {
            found.push(&side[start..end]);
        }
        start = end + 1;
    }
    Some(found)
}

/// `\partial p/\partial q`, `\frac{\mathrm{d} p}{\mathrm{d} q}`: the name of a Jacobian, whatever else it may be called.
pub(super) fn is_derivative(side: &[Token]) -> bool {
    let is_difference = |token: Option<&Token>| match token.map(|token| &token.kind) {
        Some(Kind::Command(command)) => command == "partial",
        Some(Kind::Word(word)) => word == "d",
        Some(Kind::Mark(mark)) => *mark == '∂',
        _ => false,
    };
    if side.iter().any(|token| matches!(token.kind, Kind::Mark('+' | '-' | '='))) {
        return false;
    }
    match side {
        [Token { kind: Kind::Command(fraction), .. }, groups @ ..] if is_fraction(fraction) => {
            let above = group_length(groups, ['{', '}']);
            let below = group_length(&groups[above..], ['{', '}']);
            above + below == groups.len()
                && above > 2
                && below > 2
                && is_difference(groups.get(1))
                && is_difference(groups.get(above + 1))
        }
        _ => {
            let strokes = (0..side.len()).filter(|&at| side[at].kind == Kind::Mark('/'));
            let strokes: Vec<usize> = strokes.collect();
            let [stroke] = strokes.as_slice() else { return false };
            is_difference(side.first()) && is_difference(side.get(stroke + 1))
        }
    }
}

/// That a name that says a component stands where that component belongs.
fn check_axis(text: &str, name: &[Token], axis: Option<usize>) -> Result<(), Unreadable> {
    let (Some(first), Some(last)) = (name.first(), name.last()) else { return Ok(()) };
    match (axis, named_axis(name)) {
        (Some(axis), Some(said)) if axis != said => {
            let letters = ["x", "y", "z"];
            let place = first.place.start..last.place.end;
            let shown = &text[place.clone()];
            Err(Mistake::new(
                place,
                format!(
                    "`{shown}` is named as component {}, and stands where {} belongs",
                    letters[said],
                    letters.get(axis).unwrap_or(&"none")
                ),
            )
            .with_help("write the components in the order x, y, z"))
        }
        _ => Ok(()),
    }
}

/// The component that a name says: `x`, `\Delta x`, `e_y`. The last letter of a longer name, `\Delta Az`, says none.
fn named_axis(name: &[Token]) -> Option<usize> {
    // As programs name it: `dx`, `delta_y`.
    if let [Token { kind: Kind::Name(name), .. }] = name {
        let letter = name.rsplit('_').next().unwrap_or(name);
        let letter = if letter.len() == 2 { letter.strip_prefix('d')? } else { letter };
        return ["x", "y", "z"].iter().position(|axis| *axis == letter);
    }
    let mut glyphs = Vec::new();
    let mut at = 0;
    while let Some(rest) = name.get(at..).filter(|rest| !rest.is_empty()) {
        match glyph::read(rest) {
            Ok(Some(read)) => {
                at += read.tokens;
                glyphs.push(read.glyph);
            }
            // An argument in parentheses ends the name.
            _ => break,
        }
    }
    let axis = |letter: &str| ["x", "y", "z"].iter().position(|axis| letter.eq_ignore_ascii_case(axis));
    let is_difference = |base: &str| DIFFERENCES.contains(&base) || matches!(base, "\\partial" | "e");
    let (last, before) = glyphs.split_last()?;
    if !before.iter().all(|glyph| is_difference(&glyph.base)) {
        return None;
    }
    axis(&last.base).filter(|_| last.lower.is_empty()).or_else(|| axis(&last.lower))
}
