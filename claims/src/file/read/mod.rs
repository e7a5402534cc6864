//! From the tables of a claims file to claims: names are looked up, formulas and quantities read, and every mistake of
//! the file is collected before any claim is checked. What a printed formula says is read in `formulas`, chains of
//! equalities are taken apart in `chains`, what is measured
//! in `measures`.

mod chains;
mod entries;
mod exactly;
mod formulas;
mod kinds;
mod matrices;
mod measures;
mod symbols;
mod turns;
mod values;

use std::ops::Range;

use model_core::names::{self, listed};
use model_core::print::Hand;
use model_core::{Chain, Mistake, ObservableId, ObservableKind, SymbolId, SymbolKind};
use toml::Spanned;

use crate::checker::{Claim, Count, Rank, RankSaid, errors_named, extended};
use crate::latex::{PrintedSymbols, Turned};

use kinds::{KINDS, Kind, particulars};

use super::free::doubt;
use super::table::{ClaimTable, CountTable, File, Texts};
use super::{Claims, Edge, NamedClaim, Unread};

type Place = Range<usize>;

/// Reads the claims of a file about a declaration; what cannot be read is kept with its mistakes.
pub(super) fn claims(text: &str, file: &File, chain: &Chain, edge: &dyn Edge) -> Claims {
    // With the roots and half angles that print has.
    let chain = extended(chain);
    let mut reader = Reader {
        text,
        edge,
        chain: &chain,
        symbols: PrintedSymbols::default(),
        says_what_turns: false,
        hand: Hand::default(),
        mistakes: Vec::new(),
    };
    // What one claim abbreviates, the others do, too.
    let printed: Vec<&str> = file.claim.iter().flat_map(|claim| claim.get_ref().formulas()).collect();
    reader.symbols = reader.turned(file).reading(&printed).into_owned();
    let printed = reader.printed_symbols(file);
    let mut mistakes = std::mem::take(&mut reader.mistakes);
    let mut claims = Vec::new();
    let mut unread = Vec::new();
    for table in &file.claim {
        let found = reader.claims_of(table.get_ref());
        let own = std::mem::take(&mut reader.mistakes);
        if own.is_empty() {
            let doubt = doubt(file, table.get_ref());
            claims.extend(found.into_iter().map(|claim| NamedClaim { doubt: doubt.clone(), ..claim }));
        } else if let Some(found) = reader.doubtful(table.get_ref(), &own[0]) {
            claims.extend(found);
        } else {
            let name = &table.get_ref().name;
            unread.push(Unread { name: name.get_ref().clone(), place: name.span(), mistakes: own });
        }
    }
    if file.claim.is_empty() {
        mistakes.push(Mistake::new(0..0, "this file makes no claim").with_help("add a [[claim]]"));
    }
    let hand = reader.hand;
    Claims { chain, printed, hand, claims, unread, mistakes }
}

struct Reader<'a> {
    text: &'a str,
    edge: &'a dyn Edge,
    chain: &'a Chain,
    symbols: PrintedSymbols,
    says_what_turns: bool,
    hand: Hand,
    mistakes: Vec<Mistake<Place>>,
}

impl Reader<'_> {
    fn mistake(&mut self, place: Place, message: impl Into<String>) -> &mut Mistake<Place> {
        self.mistakes.push(Mistake::new(place, message));
        let last = self.mistakes.len() - 1;
        &mut self.mistakes[last]
    }

    /// What a table claims: several things where it prints a matrix.
    fn claims_of(&mut self, claim: &ClaimTable) -> Vec<NamedClaim> {
        match chains::parts(claim) {
            Some(parts) => parts.iter().flat_map(|part| self.claims_of_one(part)).collect(),
            None => self.claims_of_one(claim),
        }
    }

    /// The claims of a table that is read where its symbols mean what they usually do; what is said of it otherwise is their doubt.
    fn doubtful(&mut self, claim: &ClaimTable, doubt: &Mistake<Place>) -> Option<Vec<NamedClaim>> {
        let guessing = self.symbols.guessing();
        let defined = std::mem::replace(&mut self.symbols, guessing);
        let found = self.claims_of(claim);
        self.symbols = defined;
        let is_read = std::mem::take(&mut self.mistakes).is_empty();
        let doubted = |claim| NamedClaim { doubt: Some(doubt.clone()), ..claim };
        is_read.then(|| found.into_iter().map(doubted).collect())
    }

    fn claims_of_one(&mut self, claim: &ClaimTable) -> Vec<NamedClaim> {
        let entries = self.matrix(claim).or_else(|| self.equal_matrices(claim));
        entries.unwrap_or_else(|| self.claim(claim).into_iter().collect())
    }

    /// One claim; `None` if it has a mistake, which is then noted.
    fn claim(&mut self, claim: &ClaimTable) -> Option<NamedClaim> {
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
        let texts: Vec<String> = claim.formulas().into_iter().map(str::to_owned).collect();
        let is_plain = !texts.is_empty() && texts.iter().all(|text| !text.contains(['\\', '{']));
        let read = (kind.read)(self, claim)?;
        let otherwise = if read.is_turned() { self.otherwise(kind, claim) } else { None };
        Some(NamedClaim {
            name: claim.name.get_ref().clone(),
            place: claim.name.span(),
            claim: read,
            otherwise,
            doubt: None,
            texts,
            is_plain,
        })
    }

    /// The same claim where rotations about named axes turn the other thing, if the file does not say what they turn.
    fn otherwise(&mut self, kind: &Kind, claim: &ClaimTable) -> Option<Claim> {
        if self.says_what_turns {
            return None;
        }
        let axes = self.symbols.clone().turning(Turned::Axes);
        let vectors = std::mem::replace(&mut self.symbols, axes);
        let count = self.mistakes.len();
        let read = (kind.read)(self, claim);
        self.mistakes.truncate(count);
        self.symbols = vectors;
        read
    }

    /// The symbols, with what rotations about named axes turn as the file says.
    fn turned(&mut self, file: &File) -> PrintedSymbols {
        let symbols = PrintedSymbols::of_chain(self.chain);
        let Some(said) = &file.rotations else { return symbols };
        self.says_what_turns = true;
        match said.get_ref().as_str() {
            "vectors" => symbols,
            "axes" => symbols.turning(Turned::Axes),
            other => {
                self.mistake(said.span(), format!("rotations turn vectors or axes, not `{other}`")).help =
                    Some("rotations = \"vectors\"".to_owned());
                symbols
            }
        }
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
