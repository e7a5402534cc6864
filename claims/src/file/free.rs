//! Formulas that are compared without a chain: each symbol that they print is a variable of its own.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::table::{File, Meant, Texts};
use crate::latex;

/// A declaration of nothing but the symbols that equalities of a file print; an angle may stand anywhere that another
/// variable may.
#[must_use]
pub fn declaration(file: &File) -> String {
    let (mut printed, mut names) = (BTreeSet::new(), BTreeSet::new());
    let defined: Vec<&str> = file.symbols.keys().map(|symbol| symbol.get_ref().trim()).collect();
    let mut read = |text: &str| {
        if text.chars().any(|c| matches!(c, '\\' | '{' | '}') || (c.is_alphabetic() && !c.is_ascii())) {
            printed.extend(
                latex::symbols_in(text).into_iter().filter(|symbol| !defined.contains(&symbol.as_str())),
            );
        } else {
            let words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            names.extend(
                words
                    .filter(|word| model_core::validate::is_name(word) && !defined.contains(word))
                    .map(str::to_owned),
            );
        }
    };
    for meaning in file.symbols.values() {
        if let Meant::Text(text) = meaning.get_ref() {
            read(text);
        }
    }
    for claim in &file.claim {
        match claim.get_ref().equal.as_ref().map(toml::Spanned::get_ref) {
            Some(Texts::One(text)) => read(text),
            Some(Texts::Many(many)) => many.iter().for_each(|text| read(text.get_ref())),
            None => {}
        }
    }
    let mut text = String::from("chain Formulas {\n");
    for (at, symbol) in printed.into_iter().enumerate() {
        // A letter that is a name as well is the same symbol.
        let is_letter = symbol.len() == 1 && model_core::validate::is_name(&symbol);
        let name = if is_letter { symbol.clone() } else { format!("symbol{at}") };
        names.remove(&name);
        let _ = writeln!(text, "    input {name}: angle;\n    symbol {name} = r\"{symbol}\";");
    }
    for name in names {
        let _ = writeln!(text, "    input {name}: angle;");
    }
    text.push_str("    body moved on ground { motion: Rz(turned); }\n    observe nothing: direction(1, 0, 0) of moved;\n}\n");
    text
}
