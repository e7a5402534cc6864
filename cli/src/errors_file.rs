//! Errors files (`E.toml`, `BOX.toml`): a value, or a largest size, for errors named plainly or by pattern.

use std::collections::BTreeMap;
use std::ops::Range;

use calibration::units;
use model_core::{Chain, SymbolId, SymbolKind, names};
use toml::{Spanned, Value};

use crate::failure::Failure;
use crate::source::Source;

/// Names as written, with their quantities, each with its place.
type Entries = BTreeMap<Spanned<String>, Spanned<Value>>;

/// The values of all symbols in SI, indexed by [`SymbolId`]: constants at their nominal value unless the file
/// sets them (a calibration may have freed them), errors at the file's value or zero.
///
/// # Errors
/// A name that is no error or constant of the chain, a pattern that matches none, a quantity that cannot be
/// read or that has another unit; each with its place.
pub fn values(source: &Source, chain: &Chain) -> Result<Vec<f64>, Failure> {
    let mut values = chain.nominal_values();
    for (id, value) in read(source, chain, &[SymbolKind::Error, SymbolKind::Constant])? {
        values[id.index()] = value.0;
    }
    Ok(values)
}

/// The largest sizes of errors in SI, indexed by [`SymbolId`]; zero for errors that the file does not name.
///
/// # Errors
/// As [`values`], and a negative size.
pub fn largest_sizes(source: &Source, chain: &Chain) -> Result<Vec<f64>, Failure> {
    let mut sizes = vec![0.0; chain.symbols.len()];
    for (id, (size, place)) in read(source, chain, &[SymbolKind::Error])? {
        if size < 0.0 {
            return Err(source.mistake(place, "a largest size cannot be negative", "write its absolute value"));
        }
        sizes[id.index()] = size;
    }
    Ok(sizes)
}

/// What the file sets, each with the place of its quantity; a plain name wins over a pattern, and a pattern
/// with more letters over one with fewer.
fn read(
    source: &Source,
    chain: &Chain,
    kinds: &[SymbolKind],
) -> Result<BTreeMap<SymbolId, (f64, Range<usize>)>, Failure> {
    let entries: Entries = source.toml()?;
    let mut entries: Vec<_> = entries.iter().collect();
    entries.sort_by_key(|(name, _)| {
        let name = name.get_ref();
        (!names::is_pattern(name), name.chars().filter(|&letter| letter != '*').count(), name.clone())
    });
    let mut set = BTreeMap::new();
    for (name, quantity) in entries {
        for id in named(source, chain, kinds, name)? {
            let symbol = chain.symbol(id);
            let value = amount(quantity.get_ref(), symbol.quantity)
                .map_err(|why| source.mistake(quantity.span(), why, ""))?;
            set.insert(id, (value, quantity.span()));
        }
    }
    Ok(set)
}

/// The symbols that a name or pattern of the file means.
fn named(
    source: &Source,
    chain: &Chain,
    kinds: &[SymbolKind],
    name: &Spanned<String>,
) -> Result<Vec<SymbolId>, Failure> {
    let text = name.get_ref().as_str();
    if names::is_pattern(text) {
        let matching: Vec<SymbolId> = chain
            .symbols_of(SymbolKind::Error)
            .filter(|&id| names::matches(text, &chain.symbol(id).name))
            .collect();
        if matching.is_empty() {
            let message = format!("the pattern `{text}` matches no error of chain {}", chain.name);
            return Err(source.mistake(name.span(), message, "`*` stands for any letters: `da*`, `*_x2`"));
        }
        return Ok(matching);
    }
    match chain.find_symbol(text) {
        Some(id) if kinds.contains(&chain.symbol(id).kind) => Ok(vec![id]),
        Some(id) => {
            let message = format!("`{text}` is {}, not an error", kind_in_words(chain.symbol(id).kind));
            Err(source.mistake(name.span(), message, "name errors of the chain here"))
        }
        None => {
            let declared =
                kinds.iter().flat_map(|&kind| chain.symbols_of(kind)).map(|id| chain.symbol(id).name.as_str());
            let help = names::nearest(text, declared).map(|near| format!("did you mean `{near}`?"));
            let message = format!("chain {} has no error `{text}`", chain.name);
            Err(source.mistake(name.span(), message, help.unwrap_or_default()))
        }
    }
}

/// A kind of symbol as a sentence names it.
fn kind_in_words(kind: SymbolKind) -> &'static str {
    match kind {
        SymbolKind::Pi => "the number π",
        SymbolKind::Joint => "a joint",
        SymbolKind::Error => "an error",
        SymbolKind::Constant => "a constant",
        SymbolKind::Input => "an input",
    }
}

/// A quantity in SI: a text with a unit, or a number that is SI already.
fn amount(value: &Value, quantity: model_core::Quantity) -> Result<f64, String> {
    let si = match value {
        Value::String(text) => units::parse(text, quantity).map_err(|error| error.to_string())?,
        Value::Integer(number) => *number as f64,
        Value::Float(number) => *number,
        other => {
            return Err(format!(
                "expected a quantity such as {}, found {}",
                units::example(quantity),
                other.type_str()
            ));
        }
    };
    if si.is_finite() { Ok(si) } else { Err("a quantity must be a finite number".to_owned()) }
}
