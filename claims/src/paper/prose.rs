//! What a text says of its letters: `where $\alpha$ is the azimuth`, and `% trueaxis: \epsilon_x = ex` in so many words.

use model_core::symbol::SymbolKind;
use model_core::{Chain, Symbol};

use super::source::Equation;

/// What a source states for this program: a key and its value.
pub(super) fn statements(source: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for line in source.lines() {
        let Some((before, said)) = line.split_once("trueaxis:") else { continue };
        if !["%", "<!--"].iter().any(|mark| before.trim_end().ends_with(mark)) {
            continue;
        }
        let said = said.trim().trim_end_matches("-->").trim();
        if let Some((key, value)) = said.split_once('=') {
            let value = value.trim().trim_matches('"');
            found.push((key.trim().to_owned(), value.to_owned()));
        }
    }
    found
}

/// The declared name that a letter is said to be: the words behind it name one symbol of the chain and no other.
pub(super) fn named(source: &str, equation: &Equation, chain: &Chain) -> Option<String> {
    let behind = source.get(equation.place.end..)?;
    let sentence: String = behind.chars().take(160).collect();
    let sentence = sentence.split(['.', ';', '$', '\\']).next().unwrap_or_default();
    let words: Vec<String> = sentence
        .split(|c: char| !c.is_alphanumeric())
        .filter(|word| !word.is_empty())
        .map(str::to_lowercase)
        .collect();
    let says = words.iter().take(3).position(|word| {
        matches!(word.as_str(), "is" | "denotes" | "are" | "denote" | "being" | "the" | "for" | "stands")
    })?;
    let words = &words[says..];
    let score = |symbol: &Symbol| {
        let parts: Vec<String> =
            symbol.name.split('_').filter(|part| part.len() > 1).map(str::to_lowercase).collect();
        let hits = parts.iter().filter(|part| words.contains(part)).count();
        if parts.is_empty() || hits < parts.len() { 0 } else { hits }
    };
    let kinds = [SymbolKind::Error, SymbolKind::Joint, SymbolKind::Constant, SymbolKind::Input];
    let mut best: Vec<(usize, &Symbol)> = chain
        .symbols
        .iter()
        .filter(|symbol| kinds.contains(&symbol.kind))
        .map(|symbol| (score(symbol), symbol))
        .filter(|(score, _)| *score > 0)
        .collect();
    best.sort_by_key(|(score, _)| std::cmp::Reverse(*score));
    match best.as_slice() {
        [(_, only)] => Some(only.name.clone()),
        [(first, found), (second, _), ..] if first > second => Some(found.name.clone()),
        _ => None,
    }
}
