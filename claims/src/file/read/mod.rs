//! From the tables of a claims file to claims: names are looked up, formulas and quantities read, and every mistake of
//! the file is collected before any claim is checked. What a printed formula says is read in `formulas`, what is measured
//! in `measures`.

mod formulas;
mod measures;
mod turns;

use std::ops::Range;

use model_core::expr::{Expr, Node};
use model_core::names::{self, listed};
use model_core::print::Hand;
use model_core::{Chain, Mistake, Mistakes, ObservableId, ObservableKind, SymbolId, SymbolKind, syntax};
use toml::Spanned;

use crate::checker::{Claim, Count, Rank, RankSaid, errors_named, extended, hand, lower};
use crate::latex::PrintedSymbols;

use super::strings::place_in_string;
use super::table::{ClaimTable, CountTable, File, Texts};
use super::{Claims, Edge, NamedClaim};

type Place = Range<usize>;

/// Reads the claims of a file about a declaration.
///
/// # Errors
/// Every mistake, each with its place.
pub(super) fn claims(text: &str, file: &File, chain: &Chain, edge: &dyn Edge) -> Result<Claims, Mistakes> {
    // With the roots and half angles that print has.
    let chain = extended(chain);
    let mut reader = Reader {
        text,
        edge,
        chain: &chain,
        symbols: PrintedSymbols::of_chain(&chain),
        hand: Hand::default(),
        mistakes: Vec::new(),
    };
    let printed = reader.printed_symbols(file);
    let claims: Vec<NamedClaim> = file.claim.iter().flat_map(|claim| reader.claims_of(claim)).collect();
    if file.claim.is_empty() {
        reader.mistake(0..0, "this file makes no claim").help = Some("add a [[claim]]".to_owned());
    }
    let Reader { mistakes, hand, .. } = reader;
    if !mistakes.is_empty() {
        return Err(Mistakes::locate(text, mistakes));
    }
    Ok(Claims { chain, printed, hand, claims })
}

struct Reader<'a> {
    text: &'a str,
    edge: &'a dyn Edge,
    chain: &'a Chain,
    symbols: PrintedSymbols,
    hand: Hand,
    mistakes: Vec<Mistake<Place>>,
}

impl Reader<'_> {
    fn mistake(&mut self, place: Place, message: impl Into<String>) -> &mut Mistake<Place> {
        self.mistakes.push(Mistake::new(place, message));
        let last = self.mistakes.len() - 1;
        &mut self.mistakes[last]
    }

    /// Fills the table of symbols; returns the chain with the printed forms that the file gives its names.
    fn printed_symbols(&mut self, file: &File) -> Chain {
        let mut printed = self.chain.clone();
        for (symbol, meaning) in &file.symbols {
            if meaning.get_ref().trim_start().starts_with('[') {
                self.printed_vector(symbol, meaning);
                continue;
            }
            let amount = match syntax::parse_amount(meaning.get_ref()) {
                Ok(amount) => amount,
                Err(mistakes) => {
                    for mistake in &mistakes {
                        let place = place_in_string(self.text, meaning.span(), mistake.place.bytes.clone());
                        self.mistake(place, mistake.message.clone()).help.clone_from(&mistake.help);
                    }
                    continue;
                }
            };
            if let Err(mistake) = lower(self.chain, &amount) {
                let place = place_in_string(self.text, meaning.span(), mistake.place);
                self.mistake(place, mistake.message).help = mistake.help;
                continue;
            }
            if let Err(mistake) = self.symbols.define(symbol.get_ref(), &amount) {
                let place = place_in_string(self.text, symbol.span(), mistake.place);
                self.mistake(place, mistake.message).help = mistake.help;
                continue;
            }
            hand::abbreviate(&mut self.hand, self.chain, symbol.get_ref().trim(), &amount);
            if let Node::Symbol(name) = &amount.node
                && let Some(id) = printed.find_symbol(name)
            {
                printed.symbols[id.index()].latex = symbol.get_ref().trim().to_owned();
            }
        }
        printed
    }

    /// A printed symbol that stands for a vector: `"[sin(alpha), 0, cos(alpha)]"`.
    fn printed_vector(&mut self, symbol: &Spanned<String>, meaning: &Spanned<String>) {
        let text = meaning.get_ref();
        let inside = text.trim().trim_start_matches('[').trim_end_matches(']');
        let mut end = text.len() - text.trim_start().trim_start_matches('[').len();
        let mut components: Vec<Expr<Place>> = Vec::new();
        for part in inside.split(',') {
            let start = end;
            end += part.len() + 1;
            let shift = |place: &Place| place.start + start..place.end + start;
            let read = syntax::parse_amount(part).map(|amount| amount.map_place(&shift));
            let read = read.map_err(|mistakes| {
                let first = mistakes.iter().next().cloned();
                first.map_or(Mistake::new(0..text.len(), "an amount is missing"), |first| Mistake {
                    place: shift(&first.place.bytes),
                    message: first.message,
                    help: first.help,
                })
            });
            match read.and_then(|amount| lower(self.chain, &amount).map(|_| amount)) {
                Ok(amount) => components.push(amount),
                Err(Mistake { place, message, help }) => {
                    let place = place_in_string(self.text, meaning.span(), place);
                    self.mistake(place, message).help = help;
                    return;
                }
            }
        }
        let count = components.len();
        let defined = match <[Expr<Place>; 3]>::try_from(components) {
            Ok(components) => self.symbols.define_vector(symbol.get_ref(), &components),
            Err(_) => {
                self.mistake(meaning.span(), format!("{count} components, where a vector has three"));
                return;
            }
        };
        if let Err(Mistake { place, message, help }) = defined {
            let place = place_in_string(self.text, symbol.span(), place);
            self.mistake(place, message).help = help;
        }
    }

    /// What a table claims: several things where it prints a matrix.
    fn claims_of(&mut self, table: &Spanned<ClaimTable>) -> Vec<NamedClaim> {
        self.matrix(table.get_ref()).unwrap_or_else(|| self.claim(table).into_iter().collect())
    }

    /// One claim; `None` if it has a mistake, which is then noted.
    fn claim(&mut self, table: &Spanned<ClaimTable>) -> Option<NamedClaim> {
        let claim = table.get_ref();
        let kinds: Vec<&Kind> = KINDS.iter().filter(|kind| (kind.place)(claim).is_some()).collect();
        let [kind] = kinds.as_slice() else {
            let message = if kinds.is_empty() {
                "this claim claims nothing"
            } else {
                "this claim is of several kinds at once"
            };
            let all: Vec<String> = KINDS.iter().map(|kind| format!("`{}`", kind.key)).collect();
            self.mistake(claim.name.span(), message).help =
                Some(format!("give it one of {}", all.join(", ")));
            return None;
        };
        for (key, place) in particulars(claim) {
            if let Some(place) = place.filter(|_| !kind.takes.contains(&key)) {
                let message = format!("`{key}` means nothing in {}", kind.name);
                self.mistake(place, message).help = Some("leave it out".to_owned());
            }
        }
        let texts: Vec<String> = match (claim.components.as_ref().or(claim.equal.as_ref()), &claim.total) {
            (Some(formulas), _) => each(formulas).into_iter().map(|(text, _)| text.to_owned()).collect(),
            (None, Some(total)) => vec![total.get_ref().clone()],
            (None, None) => Vec::new(),
        };
        let is_plain = !texts.is_empty() && texts.iter().all(|text| !text.contains(['\\', '{']));
        let read = (kind.read)(self, claim)?;
        Some(NamedClaim {
            name: claim.name.get_ref().clone(),
            place: claim.name.span(),
            claim: read,
            texts,
            is_plain,
        })
    }

    /// The observable that the claim names; otherwise the chain's only one, or for a comparison its first direction.
    fn observable(&mut self, claim: &ClaimTable) -> Option<ObservableId> {
        let chain = self.chain;
        if let Some(names) = &claim.observable {
            let [(name, place)] = each(names).try_into().ok().or_else(|| {
                self.mistake(names.span(), "this claim is about one observable");
                None
            })?;
            return self.observable_named(name, place);
        }
        let direction =
            chain.observables.iter().find(|observable| observable.kind == ObservableKind::Direction);
        let only = match chain.observables.as_slice() {
            [only] => Some(only),
            _ if claim.compare.is_some() => direction,
            _ => None,
        };
        match only {
            Some(only) => chain.find_observable(&only.name),
            None => {
                self.mistake(claim.name.span(), "the claim does not say of which observable").help =
                    Some("observable = \"…\"".to_owned());
                None
            }
        }
    }

    fn observable_named(&mut self, name: &str, place: Place) -> Option<ObservableId> {
        let chain = self.chain;
        let found = chain.find_observable(name);
        if found.is_none() {
            let declared = || chain.observables.iter().map(|observable| observable.name.as_str());
            let help = names::nearest(name, declared()).map_or_else(
                || format!("it declares {}", listed(declared())),
                |near| format!("did you mean `{near}`?"),
            );
            let message = format!("chain {} has no observable `{name}`", chain.name);
            self.mistake(place, message).help = Some(help);
        }
        found
    }

    /// The observables that are seen together: those that the claim names, or the one that it would name.
    fn observables(&mut self, claim: &ClaimTable) -> Option<Vec<ObservableId>> {
        match &claim.observable {
            Some(names) => {
                each(names).into_iter().map(|(name, place)| self.observable_named(name, place)).collect()
            }
            None => self.observable(claim).map(|only| vec![only]),
        }
    }

    /// The errors that are not zero.
    fn kept(&mut self, claim: &ClaimTable) -> Option<Vec<SymbolId>> {
        let all = || self.chain.symbols_of(SymbolKind::Error).collect::<Vec<_>>();
        match (&claim.keep, &claim.neglect) {
            (Some(_), Some(neglect)) => {
                self.mistake(neglect.span(), "`keep` and `neglect` are both given").help =
                    Some("leave one out: errors that are not kept are neglected".to_owned());
                None
            }
            (Some(keep), None) => self.errors(keep),
            (None, Some(neglect)) => {
                let neglected = self.errors(neglect)?;
                Some(all().into_iter().filter(|error| !neglected.contains(error)).collect())
            }
            (None, None) => Some(all()),
        }
    }

    /// The errors that names and patterns mean, in order and each once.
    fn errors(&mut self, patterns: &Spanned<Texts>) -> Option<Vec<SymbolId>> {
        let mut found = Vec::new();
        let mut complete = true;
        for (pattern, place) in each(patterns) {
            match self.errors_of(pattern, place) {
                Some(errors) => found.extend(errors),
                None => complete = false,
            }
        }
        found.sort_unstable();
        found.dedup();
        complete.then_some(found)
    }

    fn errors_of(&mut self, pattern: &str, place: Place) -> Option<Vec<SymbolId>> {
        match errors_named(self.chain, pattern) {
            Ok(errors) => Some(errors),
            Err(Mistake { message, help, .. }) => {
                self.mistake(place, message).help = help;
                None
            }
        }
    }

    fn count(&mut self, claim: &ClaimTable) -> Option<Claim> {
        let count = claim.count.as_ref()?.get_ref();
        let errors = self.errors(&count.errors)?;
        let equals = self.number(count)?;
        Some(Claim::Count(Count { errors, equals }))
    }

    fn number(&mut self, count: &CountTable) -> Option<usize> {
        let number = usize::try_from(*count.equals.get_ref()).ok();
        if number.is_none() {
            self.mistake(count.equals.span(), "a count cannot be negative");
        }
        number
    }

    fn rank(&mut self, claim: &ClaimTable) -> Option<Claim> {
        let rank = claim.rank.as_ref()?.get_ref();
        let observables = self.observables(claim)?;
        let errors = self.errors(&rank.errors)?;
        let said = RankSaid::Is(self.number(rank)?);
        Some(Claim::Rank(Rank { observables, errors, said }))
    }

    fn confounded(&mut self, claim: &ClaimTable) -> Option<Claim> {
        let observables = self.observables(claim)?;
        let errors = self.errors(claim.confounded.as_ref()?)?;
        Some(Claim::Rank(Rank { observables, errors, said: RankSaid::Confounded }))
    }

    fn separable(&mut self, claim: &ClaimTable) -> Option<Claim> {
        let observables = self.observables(claim)?;
        let errors = self.errors(claim.separable.as_ref()?)?;
        let mut others = self.kept(claim)?;
        others.extend(&errors);
        others.sort_unstable();
        others.dedup();
        Some(Claim::Rank(Rank { observables, errors, said: RankSaid::Separable(others) }))
    }
}

/// A kind of claim: its key, its name in messages, the keys that go with it, and its reader.
struct Kind {
    key: &'static str,
    name: &'static str,
    takes: &'static [&'static str],
    place: fn(&ClaimTable) -> Option<Place>,
    read: fn(&mut Reader<'_>, &ClaimTable) -> Option<Claim>,
}

const KINDS: [Kind; 10] = [
    Kind {
        key: "components",
        name: "a closed form",
        takes: &["observable", "order", "keep", "neglect", "component", "faces"],
        place: |claim| span(&claim.components),
        read: |reader, claim| reader.closed_form(claim),
    },
    Kind {
        key: "equal",
        name: "an equality of two formulas",
        takes: &[],
        place: |claim| span(&claim.equal),
        read: |reader, claim| reader.equality(claim),
    },
    Kind {
        key: "total",
        name: "a total error",
        takes: &["observable", "keep", "neglect"],
        place: |claim| span(&claim.total),
        read: |reader, claim| reader.total(claim),
    },
    Kind {
        key: "compare",
        name: "a comparison",
        takes: &["observable", "path", "range"],
        place: |claim| span(&claim.compare),
        read: |reader, claim| reader.comparison(claim),
    },
    Kind {
        key: "size",
        name: "a size",
        takes: &["observable", "path", "range"],
        place: |claim| span(&claim.size),
        read: |reader, claim| reader.size(claim),
    },
    Kind {
        key: "bound",
        name: "a bound",
        takes: &["observable", "range"],
        place: |claim| span(&claim.bound),
        read: |reader, claim| reader.bound(claim),
    },
    Kind {
        key: "count",
        name: "a count",
        takes: &[],
        place: |claim| span(&claim.count),
        read: |reader, claim| reader.count(claim),
    },
    Kind {
        key: "rank",
        name: "a rank",
        takes: &["observable"],
        place: |claim| span(&claim.rank),
        read: |reader, claim| reader.rank(claim),
    },
    Kind {
        key: "confounded",
        name: "a claim of what is confounded",
        takes: &["observable"],
        place: |claim| span(&claim.confounded),
        read: |reader, claim| reader.confounded(claim),
    },
    Kind {
        key: "separable",
        name: "a claim of what is separable",
        takes: &["observable", "keep", "neglect"],
        place: |claim| span(&claim.separable),
        read: |reader, claim| reader.separable(claim),
    },
];

/// The keys that some kinds of claims have.
fn particulars(claim: &ClaimTable) -> [(&'static str, Option<Place>); 8] {
    [
        ("observable", span(&claim.observable)),
        ("order", span(&claim.order)),
        ("keep", span(&claim.keep)),
        ("neglect", span(&claim.neglect)),
        ("component", span(&claim.component)),
        ("faces", span(&claim.faces)),
        ("path", span(&claim.path)),
        ("range", span(&claim.range)),
    ]
}

fn span<T>(value: &Option<Spanned<T>>) -> Option<Place> {
    value.as_ref().map(Spanned::span)
}

/// The texts, each with the place of its string.
fn each(texts: &Spanned<Texts>) -> Vec<(&str, Place)> {
    match texts.get_ref() {
        Texts::One(text) => vec![(text, texts.span())],
        Texts::Many(many) => many.iter().map(|text| (text.get_ref().as_str(), text.span())).collect(),
    }
}
