//! What is said of a symbol that nobody declared: the nearest one, or what its letters would have to be.

use super::Unreadable;
use super::commands::FUNCTIONS;
use super::glyph::{self, Glyph, ReadGlyph};
use model_core::mistake::Mistake;
use model_core::names;

/// A symbol that a table holds.
pub(super) struct Known<'a> {
    /// Its letters.
    pub glyphs: &'a [Glyph],
    /// As it is printed.
    pub printed: &'a str,
    /// The declared name that it stands for, if it is one.
    pub name: Option<&'a str>,
}

/// The mistake at a symbol that a table does not hold; `is_declared` tells the declared names.
pub(super) fn symbol(
    table: &[Known<'_>],
    is_declared: impl Fn(&str) -> bool,
    text: &str,
    read: &[ReadGlyph],
) -> Unreadable {
    let Some(first) = read.first() else {
        return Mistake::new(0..0, "a symbol is missing");
    };
    // A declared name typed as it is: its letters are symbols of their own in LaTeX.
    let start = first.place.start;
    let length =
        text[start..].find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(text.len() - start);
    let word = &text[start..start + length];
    if word.len() > 1 && is_declared(word) {
        let known = table.iter().find(|known| known.name == Some(word));
        let instead = known.map_or(word, |known| known.printed);
        return Mistake::new(
            start..start + length,
            format!("in LaTeX the letters of `{word}` are symbols of their own"),
        )
        .with_help(format!("write `{instead}`, or name it under [symbols]: '{word}' = \"{word}\""));
    }
    // Δ (and d) in front of a letter belongs to it.
    let bare = first.glyph.lower.is_empty() && first.glyph.upper.is_empty();
    let joined = bare && matches!(first.glyph.base.as_str(), "\\Delta" | "\\delta" | "d") && read.len() > 1;
    let taken = &read[..if joined { 2 } else { 1 }];
    let glyphs: Vec<Glyph> = taken.iter().map(|read| read.glyph.clone()).collect();
    let place = first.place.start..taken[taken.len() - 1].place.end;
    let shown = glyph::normal_text(&glyphs);
    let mistake = Mistake::new(place, format!("unknown symbol `{shown}`"));
    let letters: String = read.iter().map(|read| read.glyph.base.as_str()).collect();
    if let Some(function) = FUNCTIONS.iter().find(|function| letters.starts_with(**function)) {
        return mistake.with_help(format!("for the function write `\\{function}`"));
    }
    // A control word that is none is likely a misspelt one: then its own letters count.
    let spell = if glyph::spelling(&glyphs).contains('\\') { glyph::normal_text } else { glyph::spelling };
    let known: Vec<(String, &str)> = table.iter().map(|known| (spell(known.glyphs), known.printed)).collect();
    // Any two single letters are one change apart: there is no likeness to speak of.
    let wanted = Some(spell(&glyphs)).filter(|spelling| spelling.chars().count() > 1);
    let nearest = wanted
        .and_then(|wanted| names::nearest(&wanted, known.iter().map(|(spelling, _)| spelling.as_str())));
    match known.iter().find(|(spelling, _)| Some(spelling.as_str()) == nearest) {
        Some((_, printed)) => mistake.with_help(format!("did you mean `{printed}`?")),
        None => {
            mistake.with_help(format!("name it under [symbols]: '{shown}' = \"{}\"", likely(&first.glyph)))
        }
    }
}

/// What a bold letter is likely to be, as the table of symbols has it: a matrix, a vector.
fn likely(glyph: &Glyph) -> &'static str {
    match glyph.base.trim_start_matches('\\').chars().next() {
        Some(letter) if glyph.bold && letter.is_uppercase() => "[[…, …, …], […, …, …], […, …, …]]",
        Some(_) if glyph.bold => "[…, …, …]",
        _ => "…",
    }
}
