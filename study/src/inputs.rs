//! Inputs that a study brings with it: side quantities that the chain does not declare, and what follows from the
//! sequence of the rows.

use model_core::unit::Unit;
use model_core::{Chain, Meaning, ObservableId, Quantity, Symbol, SymbolId, SymbolKind, names, validate};
use toml::Spanned;

use super::mistakes::{Outcome, every, mistake};
use super::written::{Column, Study};
use observe::{Derived, parse_derived};

impl Study {
    /// The chain with an input for each side quantity that it does not declare.
    pub(super) fn with_inputs(&self, chain: &Chain) -> Outcome<Chain> {
        let mut chain = chain.clone();
        let derived = self.columns.iter().filter(|(_, column)| column.get_ref().derive.is_some());
        let wanted = self.search.inputs.iter().chain(derived.map(|(name, _)| name));
        every(wanted.map(|name| {
            let text = name.get_ref();
            match chain.find_symbol(text).map(|id| chain.symbol(id).kind) {
                // The amended declaration would declare it under this name.
                None if !validate::is_name(text) => {
                    let message = format!("`{text}` cannot be the name of an input");
                    let help = "write letters, digits and underscores, no reserved word, and name its column: \
                                temp_x = { column = \"temp x\" }";
                    Err(mistake(name.span(), message, help))
                }
                None => {
                    chain.symbols.push(input(text, self.quantity_of(text)));
                    Ok(())
                }
                Some(SymbolKind::Input | SymbolKind::Joint) => Ok(()),
                Some(_) => {
                    let message = format!("`{text}` is neither a joint nor an input of the chain");
                    Err(mistake(name.span(), message, "give the column another name"))
                }
            }
        }))?;
        for (name, derived) in self.implied(&chain) {
            if chain.find_symbol(&name).is_none() {
                chain.symbols.push(input(&name, derived.quantity()));
                let at = chain.symbols.len() - 1;
                let (meaning, of) = derived_meaning(&derived, &chain);
                (chain.symbols[at].meaning, chain.symbols[at].of) = (meaning, of);
            }
        }
        every(self.columns.iter().map(|(name, column)| self.give_meaning(&mut chain, name, column)))?;
        name_sight_angles(&mut chain);
        Ok(chain)
    }

    /// What an input is that only the study names, or that the chain says nothing of: as its column states, or as it is derived.
    fn give_meaning(
        &self,
        chain: &mut Chain,
        name: &Spanned<String>,
        column: &Spanned<Column>,
    ) -> Outcome<()> {
        let Some(id) = chain.find_symbol(name.get_ref()) else { return Ok(()) };
        let symbol = chain.symbol(id);
        let derived = column.get_ref().derive.as_ref().and_then(|text| parse_derived(text).ok());
        let stated = column.get_ref().meaning.as_ref();
        let (meaning, of) = match (stated, &derived) {
            (Some(text), _) => stated_meaning(text, chain)?,
            (None, Some(derived)) if symbol.meaning.is_none() => derived_meaning(derived, chain),
            (None, _) => return Ok(()),
        };
        if let Some(text) = stated {
            if symbol.kind != SymbolKind::Input {
                let message = format!("`{}` is no input: it has no meaning to state", name.get_ref());
                return Err(mistake(text.span(), message, "leave `meaning` out"));
            }
            let declared = (symbol.meaning, symbol.of);
            if declared.0.is_some() && declared != (meaning, of) {
                let message = format!("the chain says otherwise of `{}`", name.get_ref());
                return Err(mistake(
                    text.span(),
                    message,
                    "leave `meaning` out here, or mend the declaration",
                ));
            }
        }
        let symbol = &mut chain.symbols[id.index()];
        (symbol.meaning, symbol.of) = (meaning, of);
        if let (Some(meaning), SymbolKind::Input, Quantity::Number) = (meaning, symbol.kind, symbol.quantity)
        {
            symbol.quantity = meaning.quantity();
        }
        Ok(())
    }

    /// What an input measures that only the study names: what its column's unit says, or what it is derived as.
    fn quantity_of(&self, name: &str) -> Quantity {
        let column = self.columns.iter().find(|(written, _)| *written.get_ref() == name);
        let Some((_, column)) = column else { return Quantity::Number };
        match (&column.get_ref().derive, &column.get_ref().unit) {
            (Some(text), _) => parse_derived(text).map_or(Quantity::Number, |derived| derived.quantity()),
            (None, Some(unit)) => {
                Unit::find(unit).map_or(Quantity::Number, |unit| unit.measures().quantity())
            }
            (None, None) => Quantity::Number,
        }
    }

    /// Inputs that need no column: where the rows are in sequence, the direction of motion of each joint, and the time
    /// since the first row if the study names the column of the order.
    pub(super) fn implied(&self, chain: &Chain) -> Vec<(String, Derived)> {
        if !self.search.sequence {
            return Vec::new();
        }
        let directions = chain.symbols_of(SymbolKind::Joint).map(|joint| {
            let joint = chain.symbol(joint).name.clone();
            (format!("{joint}_direction"), Derived::Direction { joint })
        });
        let elapsed = self
            .noise
            .order
            .iter()
            .map(|time| ("elapsed".to_owned(), Derived::Elapsed { time: time.clone() }));
        let mut implied: Vec<(String, Derived)> = directions.chain(elapsed).collect();
        // What the study names itself it also says how to read.
        implied.retain(|(name, _)| {
            let named = self.columns.keys().chain(&self.search.inputs).any(|own| own.get_ref() == name);
            let taken = chain.find_symbol(name).is_some_and(|id| chain.symbol(id).kind != SymbolKind::Input);
            !named && !taken
        });
        implied
    }
}

/// Names the angles between lines of sight and up that effects may use. Where one follows from a single joint it needs no name, and
/// where the algebra cannot follow it there is none.
fn name_sight_angles(chain: &mut Chain) {
    for id in (0_u16..).take(chain.observables.len()).map(ObservableId) {
        if chain.sight_angle_of(id).is_some() {
            continue;
        }
        let own = format!("zenith_{}", chain.observable(id).name);
        let names = ["zenith", own.as_str()]
            .into_iter()
            .map(str::to_owned)
            .chain((2..).map(|n| format!("zenith_{n}")));
        let Some(name) = names.into_iter().find(|name| chain.find_symbol(name).is_none()) else { continue };
        let before = chain.clone();
        let is_needed = chain.add_sight_angle(&name, id).is_ok()
            && chain.sight_angle_of(id).is_some_and(|angle| angle.cosine.recip().is_none());
        if !is_needed {
            *chain = before;
        }
    }
}

/// `temperature`, `direction of beta`, as a column states it.
fn stated_meaning(text: &Spanned<String>, chain: &Chain) -> Outcome<(Option<Meaning>, Option<SymbolId>)> {
    let words: Vec<&str> = text.get_ref().split_whitespace().collect();
    let refuse = |message: String, help: String| Err(mistake(text.span(), message, &help));
    let meaning = |word: &str| Meaning::of_word(word);
    match words[..] {
        [word] => match meaning(word) {
            Some(meaning) => Ok((Some(meaning), None)),
            None => {
                let known = Meaning::WORDS.map(|(word, _)| word);
                let help = names::nearest(word, known).map_or_else(
                    || format!("write one of {}", known.join(", ")),
                    |near| format!("did you mean `{near}`?"),
                );
                refuse(format!("unknown meaning `{word}`"), help)
            }
        },
        [word, "of", name] => {
            let subject = meaning(word).and_then(Meaning::subject);
            let id = chain.find_symbol(name);
            let fits = id.zip(subject).is_some_and(|(id, subject)| {
                let symbol = chain.symbol(id);
                subject.is_met_by(symbol.kind, Some(symbol.quantity))
            });
            if fits {
                return Ok((meaning(word), id));
            }
            let help = "write `direction of JOINT`, `rate of JOINT`, `turns of JOINT`, `phase of RANGE` or \
                        `inverse of RANGE`, with a joint or a length of the chain";
            refuse(format!("`{}` is no meaning of an input", text.get_ref()), help.to_owned())
        }
        _ => refuse(
            format!("`{}` is no meaning of an input", text.get_ref()),
            "write `temperature`, `direction of JOINT` and the like".to_owned(),
        ),
    }
}

/// What an input is that is derived from other columns.
fn derived_meaning(derived: &Derived, chain: &Chain) -> (Option<Meaning>, Option<SymbolId>) {
    let of = |name: &str| chain.find_symbol(name);
    match derived {
        Derived::Direction { joint } => (Some(Meaning::Direction), of(joint)),
        Derived::Rate { joint, .. } => (Some(Meaning::Rate), of(joint)),
        Derived::Turns { joint } => (Some(Meaning::Turns), of(joint)),
        Derived::Elapsed { .. } => (Some(Meaning::Time), None),
        Derived::Face { .. } => (Some(Meaning::Side), None),
        Derived::Is { .. } => (Some(Meaning::Session), None),
        Derived::Phase { range, .. } => (Some(Meaning::Phase), of(range)),
        Derived::Inverse { range } => (Some(Meaning::Inverse), of(range)),
    }
}

/// An input that a study brings with it.
fn input(name: &str, quantity: Quantity) -> Symbol {
    Symbol {
        name: name.to_owned(),
        kind: SymbolKind::Input,
        quantity,
        meaning: None,
        of: None,
        documentation: String::new(),
        latex: format!("\\mathrm{{{}}}", name.replace('_', "\\_")),
        value: None,
    }
}

/// The joints and inputs that an observable depends on.
pub(super) fn needed(chain: &Chain, observable: ObservableId) -> Vec<SymbolId> {
    let mut symbols = chain.symbols_of_way(observable);
    symbols.retain(|&id| matches!(chain.symbol(id).kind, SymbolKind::Joint | SymbolKind::Input));
    symbols
}
