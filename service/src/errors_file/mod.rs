//! Errors files (`E.toml`, `BOX.toml`): a value, or a largest size, for errors named plainly or by pattern; and, where a
//! calibration wrote it, the ranges of joints and inputs that it was found over.

mod written;

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use model_core::mistake::Mistake;
use model_core::unit::Measures;
use model_core::{Chain, Quantity, Symbol, SymbolId, SymbolKind, names};
use serde::de::{self, Deserialize, Deserializer, IntoDeserializer as _};
use tables::units::{Amount, Plausible};
use toml::Spanned;

use crate::refusal::Refusal;
use crate::source::Source;
use crate::warn::Warn;

pub use written::{errors, found_over as found_over_of};
pub(crate) use written::{key, lines_of, ranges_of_readings, written_value};

/// Names as written, with their quantities, each with its place.
pub(crate) type Entries = BTreeMap<Spanned<String>, Spanned<Amount>>;

/// The table of the ranges that a calibration was found over. No symbol of a chain has a name with a hyphen.
pub const FOUND_OVER: &str = "found-over";

/// What stands behind a key.
enum Entry {
    Amount(Amount),
    Table(BTreeMap<Spanned<String>, Spanned<toml::Value>>),
}

impl<'de> Deserialize<'de> for Entry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl<'de> de::Visitor<'de> for Visitor {
            type Value = Entry;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("a number (SI) or a quantity with its unit, as in \"2 arcsec\"")
            }

            fn visit_f64<E: de::Error>(self, number: f64) -> Result<Entry, E> {
                Amount::deserialize(number.into_deserializer()).map(Entry::Amount)
            }

            fn visit_i64<E: de::Error>(self, number: i64) -> Result<Entry, E> {
                Amount::deserialize(number.into_deserializer()).map(Entry::Amount)
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Entry, E> {
                Amount::deserialize(text.into_deserializer()).map(Entry::Amount)
            }

            fn visit_map<A: de::MapAccess<'de>>(self, map: A) -> Result<Entry, A::Error> {
                Deserialize::deserialize(de::value::MapAccessDeserializer::new(map)).map(Entry::Table)
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

/// A range that a calibration was found over, SI; `low <= high`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoundOver {
    /// The joint or input.
    pub symbol: SymbolId,
    /// The smallest reading.
    pub low: f64,
    /// The largest reading.
    pub high: f64,
}

/// The ranges of readings by names, each with its place.
pub(crate) type Ranges = BTreeMap<Spanned<String>, Spanned<[Amount; 2]>>;

/// What to write where a pattern means errors of two kinds, and its quantity fits one of them.
fn both_kinds(pattern: &str, symbol: &Symbol) -> String {
    let size = match symbol.quantity {
        Quantity::Angle => "\"10 arcsec\"",
        Quantity::Length => "\"0.1 mm\"",
        Quantity::Number => "1e-5",
    };
    format!(
        "`{pattern}` matches angles and lengths: add a line for the others, such as {} = {size}, which wins over the pattern",
        symbol.name
    )
}

/// The two quantities of a range.
fn range_of(
    source: &Source,
    (name, range): (Spanned<String>, Spanned<toml::Value>),
) -> Result<(Spanned<String>, Spanned<[Amount; 2]>), Refusal> {
    let place = range.span();
    let range = range.into_inner();
    let is_pair = range.as_array().is_some_and(|bounds| bounds.len() == 2);
    match <[Amount; 2]>::deserialize(range) {
        Ok(bounds) => Ok((name, Spanned::new(place, bounds))),
        Err(error) if is_pair => Err(source.mistake(Mistake::new(place, error.message()))),
        Err(_) => {
            let mistake = Mistake::new(place, format!("`{}` has no two bounds", name.get_ref()));
            Err(source.mistake(mistake.with_help("write both in a list, as in [\"10 deg\", \"80 deg\"]")))
        }
    }
}

/// What a file says of errors, as it is written: a file of its own, or a part of an instrument file.
pub(crate) struct Given<'s> {
    /// The text that all places are in.
    pub source: &'s Source,
    /// Values, or sizes.
    pub amounts: Entries,
    /// What it was found over.
    pub ranges: Ranges,
}

impl<'s> Given<'s> {
    /// A file of errors.
    pub fn of(source: &'s Source) -> Result<Self, Refusal> {
        let is_chain = |line: &str| {
            line.strip_prefix("chain").is_some_and(|behind| behind.trim_start().starts_with('='))
        };
        // An error may be called as the first key of an instrument file is.
        if source.is_instrument() && source.text.lines().any(is_chain) {
            return Err(Refusal::Input(format!(
                "`{}` is an instrument file: give it in place of the declaration, and leave the file of errors out",
                source.path.display()
            )));
        }
        let all: BTreeMap<Spanned<String>, Spanned<Entry>> = source.toml()?;
        let mut given = Self { source, amounts: Entries::new(), ranges: Ranges::new() };
        for (name, entry) in all {
            let place = entry.span();
            match entry.into_inner() {
                Entry::Amount(amount) => {
                    given.amounts.insert(name, Spanned::new(place, amount));
                }
                Entry::Table(ranges) if name.get_ref() == FOUND_OVER => {
                    given.ranges =
                        ranges.into_iter().map(|own| range_of(source, own)).collect::<Result<_, _>>()?;
                }
                Entry::Table(_) => {
                    let message = format!("`{}` is a table, and errors have values", name.get_ref());
                    let help = "leave the line out, and write each error as a line of its own, such as tilt_x = \"10 arcsec\"";
                    return Err(source.mistake(Mistake::new(name.span(), message).with_help(help)));
                }
            }
        }
        Ok(given)
    }

    /// The ranges in SI.
    pub fn found_over(&self, chain: &Chain) -> Result<Vec<FoundOver>, Refusal> {
        let source = self.source;
        let mut found = Vec::new();
        for (name, range) in &self.ranges {
            let movable = || chain.symbols_of(SymbolKind::Joint).chain(chain.symbols_of(SymbolKind::Input));
            let Some(symbol) = movable().find(|&id| chain.symbol(id).name == *name.get_ref()) else {
                let message = format!("chain {} has no joint or input `{}`", chain.name, name.get_ref());
                let mistake = Mistake::new(name.span(), message);
                let near = names::nearest(name.get_ref(), movable().map(|id| chain.symbol(id).name.as_str()));
                return Err(source.mistake(match near {
                    Some(near) => mistake.with_help(format!("did you mean `{near}`?")),
                    None => mistake.with_help("leave the line out"),
                }));
            };
            let wrong = |why: String| source.mistake(Mistake::new(range.span(), why));
            let measures = Measures::of(chain.symbol(symbol));
            let [low, high] = *range.get_ref();
            let low = low.to_si(measures).map_err(|why| wrong(why.to_string()))?;
            let high = high.to_si(measures).map_err(|why| wrong(why.to_string()))?;
            if low > high {
                return Err(wrong("the lower bound is above the upper one; swap them".to_owned()));
            }
            found.push(FoundOver { symbol, low, high });
        }
        Ok(found)
    }

    /// What is set of symbols of these kinds. A plain name wins over a pattern, and a pattern with more letters over one with fewer.
    pub fn settings(&self, chain: &Chain, kinds: &[SymbolKind], warn: Warn<'_>) -> Result<Settings, Refusal> {
        let (source, entries) = (self.source, &self.amounts);
        // What it was found over is read with everything else, so that no command takes a file that another refuses.
        self.found_over(chain)?;
        let mut ranked: Vec<_> =
            entries.iter().map(|(name, amount)| (rank(name.get_ref()), name, amount)).collect();
        ranked.sort_by_key(|&(rank, ..)| rank);
        let mut settings = Settings::new();
        let mut set_by: BTreeMap<SymbolId, (usize, &str)> = BTreeMap::new();
        let mut winners = BTreeMap::new();
        for (rank, name, amount) in ranked {
            for id in named(source, chain, kinds, name)? {
                let symbol = chain.symbol(id);
                if let Some((_, other)) =
                    set_by.insert(id, (rank, name.get_ref())).filter(|&(other, _)| other == rank)
                {
                    let message = format!("`{}` and `{other}` both set `{}`", name.get_ref(), symbol.name);
                    let help = format!("write `{} = …` as well: a plain name wins", symbol.name);
                    return Err(source.mistake(Mistake::new(name.span(), message).with_help(help)));
                }
                winners.insert(id, (name, amount));
            }
        }
        // What is overruled need not fit: `"*" = "10 arcsec"` beside a plain name for a length.
        for (&id, &(name, amount)) in &winners {
            let symbol = chain.symbol(id);
            let value = amount.get_ref().to_si(symbol.quantity).map_err(|why| {
                let mistake = Mistake::new(amount.span(), format!("{}: {why}", symbol.name));
                let fits = |id: SymbolId| amount.get_ref().to_si(chain.symbol(id).quantity).is_ok();
                let of_both =
                    winners.iter().any(|(&other, (own, _))| own.span() == name.span() && fits(other));
                source.mistake(if of_both {
                    mistake.with_help(both_kinds(name.get_ref(), symbol))
                } else {
                    mistake
                })
            })?;
            settings.insert(id, (value, amount.span()));
        }
        warn_of_missing_units(chain, entries, &settings, warn);
        Ok(settings)
    }
}

/// The ranges that the file says a calibration was found over; none if it says nothing of them.
///
/// # Errors
/// A name that is no joint or input of the chain, or a range that is none; each with its place.
pub fn found_over(source: &Source, chain: &Chain) -> Result<Vec<FoundOver>, Refusal> {
    Given::of(source)?.found_over(chain)
}

/// What the file sets: values in SI, each with the place of its quantity.
pub(crate) type Settings = BTreeMap<SymbolId, (f64, Range<usize>)>;

/// The values of all symbols in SI, indexed by [`SymbolId`]: constants at their nominal value unless the file
/// sets them (a calibration may have freed them), errors at the file's value or zero.
///
/// # Errors
/// A name that is no error or constant of the chain, a pattern that matches none, a quantity that cannot be
/// read or that has another unit; each with its place.
pub fn values(source: &Source, chain: &Chain, warn: Warn<'_>) -> Result<Vec<f64>, Refusal> {
    let mut values = chain.nominal_values();
    for (id, value) in named_values(source, chain, warn)? {
        values[id.index()] = value;
    }
    Ok(values)
}

/// The errors and constants that the file names, with their values in SI.
///
/// # Errors
/// As [`values`].
pub fn named_values(source: &Source, chain: &Chain, warn: Warn<'_>) -> Result<Vec<(SymbolId, f64)>, Refusal> {
    let named = Given::of(source)?.settings(chain, &[SymbolKind::Error, SymbolKind::Constant], warn)?;
    Ok(named.into_iter().map(|(id, (value, _))| (id, value)).collect())
}

/// The largest sizes of errors in SI, indexed by [`SymbolId`]; zero for errors that the file does not name.
///
/// # Errors
/// As [`values`], and a negative size.
pub fn largest_sizes(source: &Source, chain: &Chain, warn: Warn<'_>) -> Result<Vec<f64>, Refusal> {
    let mut sizes = vec![0.0; chain.symbols.len()];
    let settings = Given::of(source)?.settings(chain, &[SymbolKind::Error], warn)?;
    if settings.is_empty() {
        return Err(Refusal::Input(format!(
            "`{}` has no size of an error: write lines such as \"*\" = \"10 arcsec\"",
            source.path.display()
        )));
    }
    for (id, (size, place)) in settings {
        if size < 0.0 {
            let mistake = Mistake::new(place, "a largest size cannot be negative");
            return Err(source.mistake(mistake.with_help("write its absolute value")));
        }
        sizes[id.index()] = size;
    }
    Ok(sizes)
}

/// The errors of a chain that a name, or a pattern with `*`, means, in the order of the chain.
///
/// # Errors
/// It means none; the message names the nearest, or all.
pub fn errors_named(chain: &Chain, pattern: &str) -> Result<Vec<SymbolId>, String> {
    let is_named = |id: &SymbolId| names::matches(pattern, &chain.symbol(*id).name);
    let named: Vec<SymbolId> = chain.symbols_of(SymbolKind::Error).filter(is_named).collect();
    if named.is_empty() {
        let declared = || chain.symbols_of(SymbolKind::Error).map(|id| chain.symbol(id).name.as_str());
        let instead = names::nearest(pattern, declared()).map_or_else(
            || format!("it has {}", names::listed(declared())),
            |near| format!("did you mean `{near}`?"),
        );
        return Err(format!("chain {} has no error `{pattern}`; {instead}", chain.name));
    }
    Ok(named)
}

/// How much a name says: more letters beside its stars say more, and a plain name says everything.
pub fn rank(name: &str) -> usize {
    if names::is_pattern(name) { name.chars().filter(|&letter| letter != '*').count() } else { usize::MAX }
}

/// Warns of bare numbers that are no small errors in radians, or longer than the chain itself in metres: arcseconds or
/// millimetres were meant, most likely.
fn warn_of_missing_units(chain: &Chain, entries: &Entries, settings: &Settings, warn: Warn<'_>) {
    let plausible = Plausible::errors(chain);
    for (&id, (value, place)) in settings {
        let symbol = chain.symbol(id);
        let Some(amount) = entries.values().find(|amount| amount.span() == *place) else { continue };
        if symbol.kind == SymbolKind::Error {
            let name = &symbol.name;
            let meant = |unit: &str| format!("{name} = \"{value} {unit}\"");
            let written = format!("{name} = {value}");
            let doubt = plausible.doubt(symbol.quantity, &[*amount.get_ref()], &written, meant);
            doubt.iter().for_each(|doubt| warn(doubt.to_string()));
        }
    }
}

/// The symbols that a name or pattern of the file means.
fn named(
    source: &Source,
    chain: &Chain,
    kinds: &[SymbolKind],
    name: &Spanned<String>,
) -> Result<Vec<SymbolId>, Refusal> {
    let text = name.get_ref().as_str();
    // Where errors may stand, constants may beside them.
    let wanted = if kinds.contains(&SymbolKind::Error) { SymbolKind::Error } else { SymbolKind::Constant };
    let wrong = |message: String, help: String| {
        Err(source.mistake(Mistake::new(name.span(), message).with_help(help)))
    };
    if kinds.contains(&SymbolKind::Error) && names::is_pattern(text) {
        let errors = chain.symbols_of(SymbolKind::Error);
        let matching: Vec<SymbolId> =
            errors.filter(|&id| names::matches(text, &chain.symbol(id).name)).collect();
        if matching.is_empty() {
            let message = format!("the pattern `{text}` matches no error of chain {}", chain.name);
            return wrong(message, "`*` stands for any letters, as in `da*` or `*_x2`".to_owned());
        }
        return Ok(matching);
    }
    match chain.find_symbol(text) {
        Some(id) if kinds.contains(&chain.symbol(id).kind) => Ok(vec![id]),
        Some(id) => {
            let message = format!(
                "`{text}` is {}, not {}",
                kind_in_words(chain.symbol(id).kind),
                kind_in_words(wanted)
            );
            wrong(message, format!("name {}s of the chain here", word(wanted)))
        }
        None => {
            let settable = kinds.iter().flat_map(|&kind| chain.symbols_of(kind));
            let near = names::nearest(text, settable.map(|id| chain.symbol(id).name.as_str()));
            let help = near.map_or_else(
                || format!("`trueaxis derive` shows the {}s of {}", word(wanted), chain.name),
                |near| format!("did you mean `{near}`?"),
            );
            wrong(format!("chain {} has no {} `{text}`", chain.name, word(wanted)), help)
        }
    }
}

/// The same without its article.
fn word(kind: SymbolKind) -> &'static str {
    kind_in_words(kind).split_once(' ').map_or("", |(_, word)| word)
}

/// A kind of symbol as a sentence names it.
fn kind_in_words(kind: SymbolKind) -> &'static str {
    match kind {
        SymbolKind::Pi => "the number π",
        SymbolKind::Ramp => "a ramp",
        SymbolKind::SightAngle => "an angle of a line of sight",
        SymbolKind::Joint => "a joint",
        SymbolKind::Error => "an error",
        SymbolKind::Constant => "a constant",
        SymbolKind::Input => "an input",
    }
}
