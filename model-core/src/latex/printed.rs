//! The table from printed symbols to what they stand for: a declared name, or an abbreviation such as `s_\beta`.

use std::collections::BTreeMap;
use std::ops::Range;

use super::glyph::{self, Glyph, ReadGlyph};
use super::token::{FUNCTIONS, Token};
use super::{Unreadable, token};
use crate::chain::Chain;
use crate::expr::{Expr, Node};
use crate::mistake::Mistake;
use crate::names;
use crate::symbol::SymbolKind;

/// What printed symbols stand for.
#[derive(Debug, Clone, Default)]
pub struct PrintedSymbols {
    entries: BTreeMap<Vec<Glyph>, Entry>,
    /// The largest number of glyphs in one symbol.
    longest: usize,
}

#[derive(Debug, Clone)]
struct Entry {
    /// As it was given, for printing.
    printed: String,
    meaning: Meaning,
}

#[derive(Debug, Clone)]
enum Meaning {
    Amount(Expr<()>),
    /// Several declared names print alike.
    Ambiguous(Vec<String>),
}

/// A printed symbol found in a formula.
pub(super) struct Found<'a> {
    pub amount: &'a Expr<()>,
    /// Byte range in the text, the power left out.
    pub place: Range<usize>,
    /// Number of tokens it takes, the power included.
    pub tokens: usize,
    /// What stands as the upper index if that is a power.
    pub power: Option<i32>,
}

impl PrintedSymbols {
    /// The symbols of a chain in their printed forms. A printed form that is no symbol cannot stand in a formula and is
    /// left out.
    #[must_use]
    pub fn of_chain(chain: &Chain) -> Self {
        let mut table = Self::default();
        // π is read as itself unless the user declares `\pi` to be something else.
        for symbol in
            chain.symbols.iter().filter(|symbol| !matches!(symbol.kind, SymbolKind::Pi | SymbolKind::Ramp))
        {
            let Ok(glyphs) = symbol_glyphs(&symbol.latex) else { continue };
            let meaning = match table.entries.remove(&glyphs).map(|entry| entry.meaning) {
                None => Meaning::Amount(name(&symbol.name)),
                Some(Meaning::Ambiguous(mut names)) => {
                    names.push(symbol.name.clone());
                    Meaning::Ambiguous(names)
                }
                Some(Meaning::Amount(first)) => match first.node {
                    Node::Symbol(first) => Meaning::Ambiguous(vec![first, symbol.name.clone()]),
                    _ => Meaning::Amount(first),
                },
            };
            table.insert(glyphs, Entry { printed: symbol.latex.clone(), meaning });
        }
        table
    }

    /// Declares that a printed symbol stands for a name or an amount; it wins over the chain's own printed form.
    ///
    /// # Errors
    /// The printed form is no symbol, that is, no letters with indices.
    pub fn define<S>(&mut self, printed: &str, amount: &Expr<S>) -> Result<(), Unreadable> {
        let glyphs = symbol_glyphs(printed)?;
        let meaning = Meaning::Amount(amount.map_place(&|_| ()));
        self.insert(glyphs, Entry { printed: printed.trim().to_owned(), meaning });
        Ok(())
    }

    fn insert(&mut self, glyphs: Vec<Glyph>, entry: Entry) {
        self.longest = self.longest.max(glyphs.len());
        self.entries.insert(glyphs, entry);
    }

    /// The longest known symbol at the start of `tokens`, which starts one.
    pub(super) fn find(&self, tokens: &[Token]) -> Result<Found<'_>, Unreadable> {
        let mut read: Vec<ReadGlyph> = Vec::new();
        let mut used = 0;
        while read.len() < self.longest.max(3) {
            match glyph::read(&tokens[used..]) {
                Ok(Some(next)) => {
                    used += next.tokens;
                    read.push(next);
                }
                Ok(None) => break,
                Err(error) if read.is_empty() => return Err(error),
                Err(_) => break,
            }
        }
        let mut glyphs: Vec<Glyph> = read.iter().map(|read| read.glyph.clone()).collect();
        while let Some(last) = glyphs.last() {
            let whole = self.entries.get(&glyphs).map(|entry| (entry, None));
            let known = whole.or_else(|| {
                // Nobody prints the powers 0 and 1: there it is an index, and the symbol unknown.
                let power = last.upper.parse().ok().filter(|power| !(0..=1).contains(power))?;
                let mut base = glyphs.clone();
                base.last_mut()?.upper.clear();
                Some((self.entries.get(&base)?, Some(power)))
            });
            if let Some((entry, power)) = known {
                let place = read[0].place.start..read[glyphs.len() - 1].place.end;
                return match &entry.meaning {
                    Meaning::Amount(amount) => Ok(Found {
                        amount,
                        place,
                        tokens: read[..glyphs.len()].iter().map(|read| read.tokens).sum(),
                        power,
                    }),
                    Meaning::Ambiguous(names) => {
                        let message =
                            format!("`{}` is the printed form of {}", entry.printed, names.join(" and "));
                        Err(Mistake::new(place, message).with_help(format!(
                            "say which under [symbols]: '{}' = \"{}\"",
                            entry.printed, names[0]
                        )))
                    }
                };
            }
            glyphs.pop();
        }
        Err(self.unknown(&read))
    }

    /// The mistake at a symbol that the table does not hold.
    fn unknown(&self, read: &[ReadGlyph]) -> Unreadable {
        let Some(first) = read.first() else {
            return Mistake::new(0..0, "a symbol is missing");
        };
        // Δ (and d) in front of a letter belongs to it.
        let bare = first.glyph.lower.is_empty() && first.glyph.upper.is_empty();
        let joined =
            bare && matches!(first.glyph.base.as_str(), "\\Delta" | "\\delta" | "d") && read.len() > 1;
        let taken = &read[..if joined { 2 } else { 1 }];
        let glyphs: Vec<Glyph> = taken.iter().map(|read| read.glyph.clone()).collect();
        let place = first.place.start..taken[taken.len() - 1].place.end;
        let text = glyph::normal_text(&glyphs);
        let mistake = Mistake::new(place, format!("unknown symbol `{text}`"));
        let letters: String = read.iter().map(|read| read.glyph.base.as_str()).collect();
        if let Some(function) = FUNCTIONS.iter().find(|function| letters.starts_with(**function)) {
            return mistake.with_help(format!("for the function write `\\{function}`"));
        }
        // A control word that is none is likely a misspelt one: then its own letters count.
        let spell =
            if glyph::spelling(&glyphs).contains('\\') { glyph::normal_text } else { glyph::spelling };
        let known: Vec<(String, &str)> =
            self.entries.iter().map(|(glyphs, entry)| (spell(glyphs), entry.printed.as_str())).collect();
        // Any two single letters are one change apart: there is no likeness to speak of.
        let wanted = Some(spell(&glyphs)).filter(|spelling| spelling.chars().count() > 1);
        let nearest = wanted
            .and_then(|wanted| names::nearest(&wanted, known.iter().map(|(spelling, _)| spelling.as_str())));
        match known.iter().find(|(spelling, _)| Some(spelling.as_str()) == nearest) {
            Some((_, printed)) => mistake.with_help(format!("did you mean `{printed}`?")),
            None => mistake.with_help(format!("name it under [symbols]: '{text}' = \"…\"")),
        }
    }
}

fn name(name: &str) -> Expr<()> {
    Expr { node: Node::Symbol(name.to_owned()), place: () }
}

/// The glyphs of a text that is one symbol.
fn symbol_glyphs(printed: &str) -> Result<Vec<Glyph>, Unreadable> {
    let tokens = token::tokens(printed)?;
    let mut glyphs = Vec::new();
    let mut used = 0;
    while let Some(read) = glyph::read(&tokens[used..])? {
        used += read.tokens;
        glyphs.push(read.glyph);
    }
    match tokens.get(used) {
        None if !glyphs.is_empty() => Ok(glyphs),
        None => {
            Err(Mistake::new(0..printed.len(), "a printed symbol is missing")
                .with_help(r"\Delta\theta_{y1}^0"))
        }
        Some(token) => Err(Mistake::new(token.place.clone(), "this cannot be part of a symbol")
            .with_help("a symbol is letters with indices and accents")),
    }
}
