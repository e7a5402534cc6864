//! The symbols that a formula prints, as far as they can be told without a table.

use super::glyph::{self, Glyph};
use super::token::{self, Kind};

/// Every symbol of a formula in one normal form, in the order in which they stand; Δ, δ and d belong to the letter behind them.
#[must_use]
pub fn symbols_in(text: &str) -> Vec<String> {
    let Ok(tokens) = token::tokens(text) else { return Vec::new() };
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
