//! The symbols that a formula prints, as far as they can be told without a table.

use super::glyph::{self, Glyph};
use super::layout;
use super::left;
use super::token::Kind;

/// Every symbol of a formula in one normal form, in the order in which they stand; Δ, δ and d belong to the letter behind them.
#[must_use]
pub fn symbols_in(text: &str) -> Vec<String> {
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
                if bare && glyph.base == "\\pi" {
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
        let Some(written) = text.get(place) else { continue };
        found.push(written.trim().to_owned());
    }
    if found.is_empty() { whole() } else { found }
}

/// The name and the formula of `name = formula`, if the name is one symbol.
#[must_use]
pub fn definition_of(text: &str) -> Option<(String, String)> {
    let tokens = left::tokens(text).ok()?;
    let rows = layout::rows(text, tokens, false).ok()?;
    let [row] = rows.as_slice() else { return None };
    let mut glyphs = Vec::new();
    let mut at = 0;
    while at < row.name.len() {
        let read = glyph::read(&row.name[at..]).ok()??;
        at += read.tokens;
        glyphs.push(read.glyph);
    }
    if glyphs.is_empty() || glyphs.len() > 3 {
        return None;
    }
    let place = row.formula.first()?.place.start..row.end.start;
    Some((glyph::normal_text(&glyphs), text.get(place)?.trim().to_owned()))
}
