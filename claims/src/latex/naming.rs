//! What stands on the left of `=`: a name, and perhaps which component it is. Where amounts stand around the name the
//! formula is solved for it.

mod side;

use std::ops::Range;

use super::glyph;
use super::layout::Row;
use super::parser::{Value, is_fraction, solved};
use super::printed::PrintedSymbols;
use super::token::{Kind, Token};
use super::{Unreadable, more_than_a_name};
use model_core::mistake::Mistake;
use side::{Part, Parts, group_length};

/// What a name on the left of `=` is the name of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NameOf {
    /// The formula, whatever it is: amounts beside the name are factors.
    Formula,
    /// A component, 0, 1 or 2 for x, y and z. A name that says so is one, and so is a whole side that changes another size:
    /// `R\sin V\,\Delta H`.
    Component(usize),
    /// How far a direction errs sideways. A whole side that changes an angle is its name: `\Delta A \cos E`.
    Sideways,
}

impl NameOf {
    /// That of one row of several; the only row is all of them.
    pub(super) fn in_row(names: &[Self], at: usize, alone: bool) -> Self {
        names.get(at).copied().filter(|_| !alone).unwrap_or(Self::Formula)
    }
}

/// Letters that make the one behind them a difference.
const DIFFERENCES: [&str; 4] = ["\\Delta", "\\delta", "d", "\\mathrm{d}"];

/// What the name of a row is, given what the row says.
pub(super) fn named(
    text: &str,
    row: &Row,
    symbols: &PrintedSymbols,
    name_of: NameOf,
    value: Value,
) -> Result<Value, Unreadable> {
    let side = row.name.as_slice();
    let Some(first) = side.first() else { return Ok(value) };
    if matches!(first.kind, Kind::Digit(_)) && side.len() == 1 {
        return Err(Mistake::new(first.place.clone(), "a number stands on the left of `=`")
            .with_help("give the right-hand side alone"));
    }
    match around(side, text, symbols, name_of)? {
        None => {
            check_axis(text, side, name_of)?;
            Ok(value)
        }
        Some(name) => {
            check_axis(text, &side[name.clone()], name_of)?;
            solved(text, side, name, symbols, value)
        }
    }
}

/// That nothing but a name stands on the left of a row.
pub(super) fn is_name_alone(text: &str, row: &Row, symbols: &PrintedSymbols) -> Result<(), Unreadable> {
    match row.name.first() {
        Some(first) => match around(&row.name, text, symbols, NameOf::Formula)? {
            None => Ok(()),
            Some(_) => Err(more_than_a_name(first.place.clone())),
        },
        None => Ok(()),
    }
}

/// That the name of a line of a program is one.
pub(super) fn check(text: &str, row: &Row, name_of: NameOf) -> Result<(), Unreadable> {
    let is_amount = |token: &&Token| {
        matches!(token.kind, Kind::Mark('+' | '-' | '/' | '*' | '⊙' | '×' | '^') | Kind::Digit(_))
    };
    let calls = row.name.iter().position(|token| matches!(token.kind, Kind::Mark('(' | '[')));
    match row.name[..calls.unwrap_or(row.name.len())].iter().find(is_amount) {
        Some(token) => Err(more_than_a_name(token.place.clone())),
        None => check_axis(text, &row.name, name_of),
    }
}

/// Where the name stands among amounts; `None` where the whole side is the name.
fn around(
    side: &[Token],
    text: &str,
    symbols: &PrintedSymbols,
    name_of: NameOf,
) -> Result<Option<Range<usize>>, Unreadable> {
    let whole = || place_of(side);
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
    // `R\sin V\,\Delta H` as a component: a change of another size, and what turns it into what is shown.
    let says_so = match name_of {
        NameOf::Formula => true,
        NameOf::Component(_) => named_axis(&side[name.tokens.clone()]).is_some(),
        NameOf::Sideways => false,
    };
    if says_so {
        return Ok(Some(name.tokens.clone()));
    }
    let is_named = name.changes_known(side, text, symbols) && parts.is_plain_product(side);
    if is_named { Ok(None) } else { Err(unclear(&text[place_of(&side[name.tokens.clone()])], whole())) }
}

/// The mistake that amounts beside a name may be factors of what is shown, or parts of its name.
fn unclear(name: &str, place: Range<usize>) -> Unreadable {
    Mistake::new(place, format!("are the amounts around `{name}` factors, or a part of the name?"))
        .with_help("give the right-hand side alone, as the formula of what is shown")
}

fn place_of(tokens: &[Token]) -> Range<usize> {
    let ends = tokens.first().zip(tokens.last());
    ends.map_or(0..0, |(first, last)| first.place.start..last.place.end)
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
fn check_axis(text: &str, name: &[Token], name_of: NameOf) -> Result<(), Unreadable> {
    match (name_of, named_axis(name)) {
        (NameOf::Component(axis), Some(said)) if axis != said => {
            let letters = ["x", "y", "z"];
            let place = place_of(name);
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

/// The component that a name says that is no difference: `x`, `p_y`.
pub(super) fn shown_axis(name: &[Token]) -> Option<usize> {
    let first = glyph::read(name).ok()??;
    let is_difference = DIFFERENCES.contains(&first.glyph.base.as_str());
    if is_difference || first.tokens != name.len() { None } else { named_axis(name) }
}

/// What `\partial x/\partial q` derives, and by what.
pub(super) fn derivative(side: &[Token]) -> Option<[&[Token]; 2]> {
    if !is_derivative(side) {
        return None;
    }
    let stroke = side.iter().position(|token| token.kind == Kind::Mark('/'));
    match stroke {
        Some(stroke) => Some([&side[1..stroke], &side[stroke + 2..]]),
        None => {
            let above = group_length(&side[1..], ['{', '}']);
            Some([&side[3..above], &side[above + 3..side.len() - 1]])
        }
    }
}

/// The name of a vector with its bracket, and the number of its component: `p[` and 0.
pub(super) fn numbered(name: &str) -> Option<(&str, usize)> {
    let open = name.find(['[', '('])?;
    let number = name[open + 1..].strip_suffix([']', ')'])?.parse().ok()?;
    Some((&name[..=open], number))
}

/// The component that a name says: `x`, `\Delta x`, `e_y`. The last letter of a longer name, `\Delta Az`, says none.
pub(super) fn named_axis(name: &[Token]) -> Option<usize> {
    // As programs name it: `dx`, `delta_y`, `p[0]`.
    if let [Token { kind: Kind::Name(name), .. }] = name {
        if let Some((vector, number)) = numbered(name) {
            return Some(number).filter(|_| vector.ends_with('['));
        }
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
