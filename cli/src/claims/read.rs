//! From the tables of a claims file to claims: names are looked up, formulas and quantities read, and every mistake of
//! the file is collected before any claim is checked.

use std::ops::Range;

use calibration::data::units;
use model_core::budget::{Measure, Poses};
use model_core::checker::{Claim, ClosedForm, Comparison, Count, PrintedVector, errors_named, lower};
use model_core::expr::Node;
use model_core::latex::PrintedSymbols;
use model_core::{
    Chain, Mistake, Mistakes, ObservableId, ObservableKind, SymbolId, SymbolKind, names, syntax,
};
use toml::{Spanned, Value};

use super::table::{ClaimTable, CompareTable, CountTable, File, Texts};
use super::{ClaimsFile, NamedClaim, place_in_string};
use crate::failure::Failure;
use crate::poses;
use crate::ranges::{self, RangeArgument};
use crate::source::{Source, listed};

type Place = Range<usize>;

/// Reads the claims of a file about a declaration.
///
/// # Errors
/// Every mistake, each with its place.
pub(super) fn claims(source: Source, declaration: Source, file: &File) -> Result<ClaimsFile, Failure> {
    let chain = declaration.chain()?;
    let mut reader = Reader {
        text: &source.text,
        chain: &chain,
        symbols: PrintedSymbols::of_chain(&chain),
        mistakes: Vec::new(),
    };
    let printed = reader.printed_symbols(file);
    let claims: Vec<NamedClaim> = file.claim.iter().filter_map(|claim| reader.claim(claim)).collect();
    if file.claim.is_empty() {
        reader.mistake(0..0, "this file makes no claim").help = Some("add a [[claim]]".to_owned());
    }
    let mistakes = reader.mistakes;
    if !mistakes.is_empty() {
        return Err(source.mistakes(&Mistakes::locate(&source.text, mistakes)));
    }
    Ok(ClaimsFile { source, declaration, chain, printed, claims })
}

struct Reader<'a> {
    text: &'a str,
    chain: &'a Chain,
    symbols: PrintedSymbols,
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
            if let Node::Symbol(name) = &amount.node
                && let Some(id) = printed.find_symbol(name)
            {
                printed.symbols[id.index()].latex = symbol.get_ref().trim().to_owned();
            }
        }
        printed
    }

    /// One claim; `None` if it has a mistake, which is then noted.
    fn claim(&mut self, table: &Spanned<ClaimTable>) -> Option<NamedClaim> {
        let place = table.get_ref().name.span();
        let claim = table.get_ref();
        let kinds = [claim.components.is_some(), claim.compare.is_some(), claim.count.is_some()];
        if kinds.iter().filter(|given| **given).count() != 1 {
            let message = if kinds.contains(&true) {
                "this claim is of several kinds at once"
            } else {
                "this claim claims nothing"
            };
            self.mistake(place, message).help =
                Some("give it one of `components`, `compare` and `count`".to_owned());
            return None;
        }
        let (texts, is_plain, read) = if let Some(components) = &claim.components {
            self.refuse("a closed form", &[("path", span(&claim.path)), ("range", span(&claim.range))]);
            let texts: Vec<String> = each(components).into_iter().map(|(text, _)| text.to_owned()).collect();
            let is_plain = texts.iter().all(|text| !text.contains(['\\', '{']));
            (texts, is_plain, self.closed_form(claim, components))
        } else if let Some(compare) = &claim.compare {
            self.refuse("a comparison", &not_of_closed_forms(claim));
            (Vec::new(), false, self.comparison(claim, compare.get_ref()))
        } else {
            self.refuse(
                "a count",
                &[
                    ("observable", span(&claim.observable)),
                    ("path", span(&claim.path)),
                    ("range", span(&claim.range)),
                ],
            );
            self.refuse("a count", &not_of_closed_forms(claim));
            (Vec::new(), false, claim.count.as_ref().and_then(|count| self.count(count.get_ref())))
        };
        Some(NamedClaim { name: claim.name.get_ref().clone(), place, claim: read?, texts, is_plain })
    }

    /// Notes the keys that mean nothing in a kind of claim.
    fn refuse(&mut self, kind: &str, keys: &[(&str, Option<Place>)]) {
        for (key, place) in keys {
            if let Some(place) = place {
                self.mistake(place.clone(), format!("`{key}` means nothing in {kind}")).help =
                    Some("leave it out".to_owned());
            }
        }
    }

    fn closed_form(&mut self, claim: &ClaimTable, components: &Spanned<Texts>) -> Option<Claim> {
        let observable = self.observable(claim)?;
        let order = self.order(claim);
        let kept = self.kept(claim);
        let texts = each(components);
        let plain: Vec<&str> = texts.iter().map(|(text, _)| *text).collect();
        match PrintedVector::read(self.chain, &self.symbols, &plain) {
            Ok(printed) => Some(Claim::ClosedForm(Box::new(ClosedForm {
                observable,
                order: order?,
                kept: kept?,
                printed,
            }))),
            Err(mistakes) => {
                for mistake in mistakes {
                    let string = texts.get(mistake.place.text_index).map(|(_, place)| place.clone());
                    let place = string.map_or(components.span(), |string| {
                        place_in_string(self.text, string, mistake.place.bytes)
                    });
                    self.mistake(place, mistake.message).help = mistake.help;
                }
                None
            }
        }
    }

    /// The observable that the claim names; otherwise the chain's only one, or for a comparison its first direction.
    fn observable(&mut self, claim: &ClaimTable) -> Option<ObservableId> {
        let chain = self.chain;
        if let Some(name) = &claim.observable {
            let found = chain.find_observable(name.get_ref());
            if found.is_none() {
                let declared = || chain.observables.iter().map(|observable| observable.name.as_str());
                let help = names::nearest(name.get_ref(), declared()).map_or_else(
                    || format!("it declares {}", listed(declared())),
                    |near| format!("did you mean `{near}`?"),
                );
                let message = format!("chain {} has no observable `{}`", chain.name, name.get_ref());
                self.mistake(name.span(), message).help = Some(help);
            }
            return found;
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

    fn order(&mut self, claim: &ClaimTable) -> Option<u32> {
        let Some(order) = &claim.order else { return Some(1) };
        match u32::try_from(*order.get_ref()) {
            Ok(value @ 1..=3) => Some(value),
            _ => {
                self.mistake(order.span(), format!("order {} is none of 1, 2 and 3", order.get_ref()));
                None
            }
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

    fn comparison(&mut self, claim: &ClaimTable, compare: &CompareTable) -> Option<Claim> {
        let observable = self.observable(claim);
        let error = self.one_error(&compare.error);
        let against = self.one_error(&compare.against);
        let measure = self.measure(&compare.measure);
        let poses = self.poses(claim);
        let at_most = *compare.at_most.get_ref();
        if !at_most.is_finite() || at_most < 0.0 {
            self.mistake(compare.at_most.span(), "the largest ratio is a number that is not negative");
            return None;
        }
        let (error, against) = (error?, against?);
        let quantity = self.chain.symbol(error).quantity;
        if quantity != self.chain.symbol(against).quantity {
            let message = format!(
                "`{}` is measured in {} and `{}` in {}: one size cannot fit both",
                compare.error.get_ref(),
                quantity.unit(),
                compare.against.get_ref(),
                self.chain.symbol(against).quantity.unit()
            );
            self.mistake(compare.against.span(), message);
            return None;
        }
        let size = match compare.size.get_ref() {
            Value::String(text) => units::parse(text, quantity).map_err(|error| error.to_string()),
            Value::Float(number) => Ok(*number),
            Value::Integer(number) => Ok(*number as f64),
            other => Err(format!("expected a quantity, found {}", other.type_str())),
        };
        let size = size.and_then(|size| {
            if size.is_finite() && size > 0.0 { Ok(size) } else { Err("a size is above zero".to_owned()) }
        });
        match size {
            Ok(size) => Some(Claim::Comparison(Comparison {
                observable: observable?,
                error,
                against,
                size,
                measure: measure?,
                at_most,
                poses: poses?,
            })),
            Err(why) => {
                self.mistake(compare.size.span(), why).help =
                    Some(format!("write it like {}", units::example(quantity)));
                None
            }
        }
    }

    fn one_error(&mut self, name: &Spanned<String>) -> Option<SymbolId> {
        match self.errors_of(name.get_ref(), name.span())?.as_slice() {
            [only] => Some(*only),
            _ => {
                self.mistake(name.span(), "a comparison is of one error, and this pattern matches several");
                None
            }
        }
    }

    fn measure(&mut self, measure: &Spanned<String>) -> Option<Measure> {
        match measure.get_ref().as_str() {
            "sup" => Some(Measure::Sup),
            "rms" => Some(Measure::Rms),
            other => {
                self.mistake(measure.span(), format!("unknown measure `{other}`")).help =
                    Some("\"sup\" is the largest influence, \"rms\" its root mean square".to_owned());
                None
            }
        }
    }

    fn poses(&mut self, claim: &ClaimTable) -> Option<Poses> {
        match (&claim.path, &claim.range) {
            (Some(_), Some(range)) => {
                self.mistake(range.span(), "`path` and `range` are both given").help =
                    Some("leave one out".to_owned());
                None
            }
            (Some(path), None) => match poses::path(self.chain, path.get_ref()) {
                Ok(path) => Some(Poses::Path(path)),
                Err(mistake) => {
                    let place = place_in_string(self.text, path.span(), mistake.place);
                    self.mistake(place, mistake.message).help = mistake.help;
                    None
                }
            },
            (None, Some(texts)) => {
                let mut found: Vec<ranges::Range> = Vec::new();
                for (text, place) in each(texts) {
                    let read = text.parse::<RangeArgument>().map_err(str::to_owned);
                    match read.and_then(|argument| ranges::read(self.chain, &argument)) {
                        Ok(range) if found.iter().any(|earlier| earlier.symbol == range.symbol) => {
                            self.mistake(place, "this range is given twice");
                            return None;
                        }
                        Ok(range) => found.push(range),
                        Err(why) => {
                            self.mistake(place, why);
                            return None;
                        }
                    }
                }
                Some(Poses::Ranges(poses::joint_ranges(&found)))
            }
            (None, None) => Some(Poses::Ranges(Vec::new())),
        }
    }

    fn count(&mut self, count: &CountTable) -> Option<Claim> {
        let errors = self.errors(&count.errors)?;
        match usize::try_from(*count.equals.get_ref()) {
            Ok(equals) => Some(Claim::Count(Count { errors, equals })),
            Err(_) => {
                self.mistake(count.equals.span(), "a count cannot be negative");
                None
            }
        }
    }
}

/// The keys that only a closed form has.
fn not_of_closed_forms(claim: &ClaimTable) -> [(&'static str, Option<Place>); 3] {
    [("order", span(&claim.order)), ("keep", span(&claim.keep)), ("neglect", span(&claim.neglect))]
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
