//! Formulas that are compared without a chain: each symbol that they print is a variable of its own.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::ops::Range;

use model_core::Mistake;

use super::table::{ClaimTable, File, Meant, Texts};
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
                latex::variables_in(text).into_iter().filter(|symbol| !defined.contains(&symbol.as_str())),
            );
        } else {
            // What stands before a parenthesis is a function, or a matrix such as `R_x(a)`.
            let pieces = text.split_inclusive(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            let words = pieces.filter(|piece| !piece.ends_with('('));
            let words =
                words.map(|piece| piece.trim_end_matches(|c: char| !c.is_ascii_alphanumeric() && c != '_'));
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
    let printed = without_abbreviations(printed);
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

/// The index in `c_{…}` or `s_{…}` of which both are printed: a cosine and a sine.
fn abbreviated(printed: &BTreeSet<String>) -> Vec<[String; 3]> {
    let of_letters = |cosine: &str, sine: &str| -> Vec<[String; 3]> {
        let index = |symbol: &String| Some(symbol.strip_prefix(cosine)?.strip_suffix('}')?.to_owned());
        let pair = |index: String| [format!("{cosine}{index}}}"), format!("{sine}{index}}}"), index];
        let pairs = printed.iter().filter_map(index).map(pair);
        pairs.filter(|[_, sine, _]| printed.contains(sine)).collect()
    };
    [of_letters("c_{", "s_{"), of_letters("C_{", "S_{")].concat()
}

fn is_number(index: &str) -> bool {
    index.chars().all(|c| c.is_ascii_digit() || c == ',')
}

/// The symbols with the angle in place of its cosine and sine, `c_\alpha` and `s_\alpha`.
fn without_abbreviations(mut printed: BTreeSet<String>) -> BTreeSet<String> {
    for [cosine, sine, index] in abbreviated(&printed) {
        if !is_number(&index) {
            printed.remove(&cosine);
            printed.remove(&sine);
            printed.extend(latex::symbols_in(&index));
        }
    }
    printed
}

/// Whether `c_1` and `s_1` of a claim without a chain are variables, which nobody says: then only what holds for any values is judged.
pub(super) fn doubt(file: &File, claim: &ClaimTable) -> Option<Mistake<Range<usize>>> {
    if file.chain.is_some() || file.dh.is_some() {
        return None;
    }
    let defined: Vec<String> =
        file.symbols.keys().flat_map(|symbol| latex::symbols_in(symbol.get_ref())).collect();
    let printed = claim.formulas().into_iter().flat_map(latex::symbols_in);
    let printed: BTreeSet<String> = printed.filter(|symbol| !defined.contains(symbol)).collect();
    let [cosine, sine, _] = abbreviated(&printed).into_iter().find(|[_, _, index]| is_number(index))?;
    let message = format!("are `{cosine}` and `{sine}` variables, or a cosine and a sine?");
    Some(Mistake::new(claim.name.span(), message).with_help(format!(
        "if they are, name them under [symbols]: '{cosine}' = \"cos(a)\" and '{sine}' = \"sin(a)\""
    )))
}
