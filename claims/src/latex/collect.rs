//! The symbols that a formula prints, as far as they can be told without a table.

use std::ops::Range;

use super::commands::TYPEFACES;
use super::glyph::{self, Glyph};
use super::layout;
use super::left;
use super::naming;
use super::token::{Kind, Token};

/// Every symbol of a formula in one normal form, in the order in which they stand; Δ, δ and d belong to the letter behind them.
#[must_use]
pub fn symbols_in(text: &str) -> Vec<String> {
    symbols_but(text, |_, _| false)
}

/// The same without what nobody defines: rotations about an axis, `R_z(\psi)`, bold unit vectors, and identities among matrices.
#[must_use]
pub fn variables_in(text: &str) -> Vec<String> {
    let tokens = left::tokens(text).unwrap_or_default();
    let has_matrices = tokens.windows(2).any(|pair| match &pair[0].kind {
        Kind::Begin(name) => layout::MATRICES.contains(&name.as_str()),
        Kind::Mark('_') => pair[1].kind == Kind::Mark('×'),
        _ => false,
    });
    symbols_but(text, |glyph, next| {
        let is_axis = matches!(glyph.lower.as_str(), "x" | "y" | "z");
        match glyph.base.as_str() {
            "R" | "Rot" => is_axis && next.is_some_and(|token| token.kind == Kind::Mark('(')),
            "e" => is_axis && glyph.bold,
            "I" => glyph.bold || (has_matrices && glyph.upper.is_empty()),
            _ => false,
        }
    })
}

fn symbols_but(text: &str, is_left_out: impl Fn(&Glyph, Option<&Token>) -> bool) -> Vec<String> {
    let Ok(tokens) = left::tokens(text) else { return Vec::new() };
    let mut found: Vec<String> = Vec::new();
    let mut before: Vec<Glyph> = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        match glyph::read(&tokens[at..]) {
            Ok(Some(read)) => {
                at += read.tokens;
                let glyph = without_power(read.glyph);
                let bare = glyph.lower.is_empty() && glyph.upper.is_empty();
                if bare && matches!(glyph.base.as_str(), "\\Delta" | "\\delta" | "d") && before.is_empty() {
                    before.push(glyph);
                    continue;
                }
                if (bare && glyph.base == "\\pi") || is_left_out(&glyph, tokens.get(at)) {
                    continue;
                }
                let glyphs = [std::mem::take(&mut before), vec![glyph]].concat();
                let symbol = glyph::normal_text(&glyphs);
                if !found.contains(&symbol) {
                    found.push(symbol);
                }
            }
            _ => {
                if let Kind::Begin(_) | Kind::End(_) = tokens[at].kind {
                    before.clear();
                }
                if !before.is_empty() {
                    let symbol = glyph::normal_text(&std::mem::take(&mut before));
                    if !found.contains(&symbol) {
                        found.push(symbol);
                    }
                }
                at += 1;
            }
        }
    }
    found
}

/// What stands above a symbol as a number is its power.
fn without_power(glyph: Glyph) -> Glyph {
    let is_power = glyph.upper.parse::<i32>().is_ok_and(|power| !(0..=1).contains(&power))
        || super::lookup::After::of(&glyph.upper).is_some();
    if is_power { Glyph { upper: String::new(), ..glyph } } else { glyph }
}

/// The equations of a display as texts: a row each, with the rows that go on.
#[must_use]
pub fn rows_of(text: &str) -> Vec<String> {
    let whole = || vec![text.to_owned()];
    let Ok(tokens) = left::tokens(text) else { return whole() };
    let Ok(rows) = layout::rows(text, tokens, false) else { return whole() };
    let mut found = Vec::new();
    for row in rows {
        let places = row.name.iter().chain(&row.formula).map(|token| token.place.clone());
        let Some(place) = places.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end)) else { continue };
        found.push(written(text, place).to_owned());
    }
    if found.is_empty() { whole() } else { found }
}

/// The lines of a display as texts, each with those that go on; one of these may be a chain of equalities.
#[must_use]
pub fn lines_of(text: &str) -> Vec<String> {
    let lines = left::tokens(text).and_then(|tokens| layout::lines(text, tokens)).unwrap_or_default();
    let place = |line: &Vec<Token>| Some(line.first()?.place.start..line.last()?.place.end);
    lines.iter().filter_map(place).map(|place| written(text, place).to_owned()).collect()
}

/// `A = B = C` as `A = B` and `A = C`, without sides that only say which derivative it is; an equation with one `=`, or none, as it is.
#[must_use]
pub fn equalities_of(text: &str) -> Vec<String> {
    let sides = if lines_of(text).len() > 1 { Vec::new() } else { sides_of(text, |_| true) };
    match sides.as_slice() {
        [name, rest @ ..] if rest.len() > 1 => {
            let said = |side: &Range<usize>| format!("{} = {}", &text[name.clone()], &text[side.clone()]);
            rest.iter().filter(|side| !is_derivative(&text[(*side).clone()])).map(said).collect()
        }
        _ => vec![text.to_owned()],
    }
}

/// `J = \partial p/\partial q = B` with the derivative for its name, `\partial p/\partial q = B`; nothing where no side is one.
#[must_use]
pub fn derivatives_of(text: &str) -> Vec<String> {
    let sides = if lines_of(text).len() > 1 { Vec::new() } else { sides_of(text, |_| true) };
    let (names, formulas): (Vec<_>, Vec<_>) =
        sides.iter().skip(1).map(|side| &text[side.clone()]).partition(|side| is_derivative(side));
    let [name] = names.as_slice() else { return Vec::new() };
    formulas.iter().map(|side| format!("{name} = {side}")).collect()
}

/// Whether a text is the name of a derivative, `\partial p/\partial q`, which says what another name means.
#[must_use]
pub fn is_derivative(text: &str) -> bool {
    left::tokens(text).is_ok_and(|tokens| naming::is_derivative(&tokens))
}

/// `\partial x/\partial q = …`: which component is derived, if one is, and the printed symbol that it is derived by.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Derivative {
    /// 0, 1 or 2 for x, y and z; `None` of a whole vector.
    pub component: Option<usize>,
    /// As printed.
    pub by: String,
}

/// The derivative that a formula gives.
#[must_use]
pub fn derivative_of(text: &str) -> Option<Derivative> {
    let name = name_of(text)?;
    let [of, by] = naming::derivative(&name)?;
    let place = by.first()?.place.start..by.last()?.place.end;
    Some(Derivative { component: naming::shown_axis(of), by: written(text, place).to_owned() })
}

/// The component that the name of a formula says, `p_x = …`, where it is no difference.
#[must_use]
pub fn shown_axis(text: &str) -> Option<usize> {
    naming::shown_axis(&name_of(text)?)
}

/// The component that the name of a formula says, be it a difference or not.
#[must_use]
pub fn named_component(text: &str) -> Option<usize> {
    naming::named_axis(&name_of(text)?)
}

/// The left-hand side of a formula.
fn name_of(text: &str) -> Option<Vec<Token>> {
    let rows = layout::rows(text, left::tokens(text).ok()?, false).ok()?;
    let [row] = rows.as_slice() else { return None };
    Some(row.name.clone())
}

/// Where the sides of one line of equalities stand, `a = b = c`; nothing where the text is of several lines or has no `=`.
#[must_use]
pub fn equal_sides(text: &str) -> Vec<Range<usize>> {
    // Lines of a program are statements of their own.
    if !text.contains('\\') && text.trim().contains('\n') {
        return Vec::new();
    }
    sides_of(text, |side| !layout::has_lines(side))
}

/// The equations that stand beside one another in one line, parted by wide spaces or columns; nothing where there is one.
#[must_use]
pub fn equations_beside(text: &str) -> Vec<String> {
    let pieces = left::tokens(text).and_then(|tokens| layout::beside(text, tokens)).unwrap_or_default();
    let place = |piece: &Vec<Token>| {
        let place = piece.first()?.place.start..piece.last()?.place.end;
        Some(written(text, place).to_owned())
    };
    let equations: Vec<String> = pieces.iter().filter_map(place).collect();
    if equations.len() == pieces.len() && equations.len() > 1 { equations } else { Vec::new() }
}

/// Where the sides stand, if there are several and all are as wanted. What has a comma outside brackets is a list and no side.
fn sides_of(text: &str, is_wanted: impl Fn(&[Token]) -> bool) -> Vec<Range<usize>> {
    let pieces = left::tokens(text).and_then(|tokens| layout::sides(text, tokens)).unwrap_or_default();
    let place = |side: &Vec<Token>| {
        let place = side.first()?.place.start..side.last()?.place.end;
        Some(written_place(text, place)).filter(|_| is_wanted(side) && !layout::is_list(side))
    };
    let sides: Vec<Range<usize>> = pieces.iter().filter_map(place).collect();
    if sides.len() == pieces.len() && sides.len() > 1 { sides } else { Vec::new() }
}

/// The text of a place, and the braces that tokens leave out.
fn written(text: &str, place: Range<usize>) -> &str {
    text[written_place(text, place)].trim()
}

/// The place with the braces that tokens leave out: those of typefaces, with the command before them.
fn written_place(text: &str, place: Range<usize>) -> Range<usize> {
    let (mut start, mut end) = (place.start, place.end);
    let count = |start: usize, end: usize, brace: char| text[start..end].matches(brace).count();
    while count(start, end, '{') < count(start, end, '}') {
        let Some(open) = text[..start].rfind('{') else { break };
        let command = text[..open].trim_end_matches(|c: char| c.is_ascii_alphabetic());
        start = if command.ends_with('\\') { command.len() - 1 } else { open };
    }
    while count(start, end, '{') > count(start, end, '}') {
        let Some(close) = text[end..].find('}') else { break };
        end += close + 1;
    }
    // `\mathbf p`: what says that a letter is bold stands before its token.
    let before = text[..start].trim_end();
    let name = before.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    if name.ends_with('\\') && TYPEFACES.contains(&&before[name.len()..]) {
        start = name.len() - 1;
    }
    start..end
}

/// The name and the formula of `name = formula`, if the name is one symbol; what it depends on may stand behind it: `r(\theta)`.
#[must_use]
pub fn definition_of(text: &str) -> Option<(String, String)> {
    let tokens = left::tokens(text).ok()?;
    let rows = layout::rows(text, tokens, false).ok()?;
    let [row] = rows.as_slice() else { return None };
    let mut glyphs = Vec::new();
    let mut at = 0;
    while at < row.name.len() {
        let Some(read) = glyph::read(&row.name[at..]).ok()? else {
            let (_, length) = glyph::arguments(&row.name[at..])?;
            if at + length == row.name.len() {
                break;
            }
            return None;
        };
        at += read.tokens;
        glyphs.push(read.glyph);
    }
    if glyphs.is_empty() || glyphs.len() > 3 {
        return None;
    }
    let place = row.formula.first()?.place.start..row.end.start;
    Some((glyph::normal_text(&glyphs), written(text, place).to_owned()))
}
