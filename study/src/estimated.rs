//! What of a chain a study can ask to be estimated: errors and constants, by name or by pattern.

use model_core::{Chain, Symbol, SymbolId, SymbolKind, names};
use toml::Spanned;

use super::mistakes::{Outcome, mistake, unknown};

/// Whether a symbol can be estimated.
fn is_estimable(symbol: &Symbol) -> bool {
    matches!(symbol.kind, SymbolKind::Error | SymbolKind::Constant)
}

/// The error or constant of a name.
pub(super) fn estimable(chain: &Chain, name: &Spanned<String>) -> Outcome<SymbolId> {
    let found = chain.find_symbol(name.get_ref()).filter(|&id| is_estimable(chain.symbol(id)));
    found.ok_or_else(|| {
        let all = chain.symbols.iter().filter(|symbol| is_estimable(symbol));
        let names = all.map(|symbol| symbol.name.as_str());
        unknown(name.span(), "error or constant", name.get_ref(), names)
    })
}

/// The errors or constants that a name or a pattern means.
pub(super) fn matching(chain: &Chain, pattern: &Spanned<String>) -> Outcome<Vec<SymbolId>> {
    if !names::is_pattern(pattern.get_ref()) {
        return estimable(chain, pattern).map(|id| vec![id]);
    }
    let of = |kind| -> Vec<SymbolId> {
        let all = chain.symbols_of(kind);
        all.filter(|&id| names::matches(pattern.get_ref(), &chain.symbol(id).name)).collect()
    };
    // A pattern means errors; constants are freed by it only where no error matches.
    let matched = Some(of(SymbolKind::Error)).filter(|errors| !errors.is_empty());
    let matched = matched.unwrap_or_else(|| of(SymbolKind::Constant));
    if matched.is_empty() {
        let message = format!("no error or constant matches `{}`", pattern.get_ref());
        return Err(mistake(pattern.span(), message, instead_of(chain, pattern.get_ref())));
    }
    Ok(matched)
}

/// What to write instead of a pattern that matches nothing: the nearest name, or which there are.
fn instead_of(chain: &Chain, pattern: &str) -> String {
    let fixed: String = pattern.chars().filter(|letter| !matches!(letter, '*' | '?')).collect();
    let all = chain.symbols.iter().filter(|symbol| is_estimable(symbol));
    let names: Vec<&str> = all.map(|symbol| symbol.name.as_str()).collect();
    match names::nearest(&fixed, names.iter().copied()) {
        Some(near) => format!("the nearest name is `{near}`"),
        None if names.is_empty() => "the chain has none".to_owned(),
        None => {
            let listed: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
            format!("there are {}", listed.join(", "))
        }
    }
}
