//! The table from printed symbols to what they stand for: a declared name, or an abbreviation such as `s_\beta`.

use std::collections::BTreeMap;
use std::ops::Range;

use super::glyph::{self, Glyph, ReadGlyph};
use super::token::Token;
use super::unknown::{self, Known};
use super::{Unreadable, token};
use model_core::chain::Chain;
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;
use model_core::symbol::SymbolKind;

/// What printed symbols stand for.
#[derive(Debug, Clone, Default)]
pub struct PrintedSymbols {
    pub(super) entries: BTreeMap<Key, Entry>,
    /// The largest number of glyphs in one symbol.
    longest: usize,
    /// Every declared name and what it is for.
    pub(super) names: BTreeMap<String, SymbolKind>,
    /// The joints that an error may be a function of: those of the body that it belongs to.
    joints: BTreeMap<String, Vec<String>>,
}

/// A printed symbol: its glyphs, and the arguments in parentheses that belong to it.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Key {
    pub glyphs: Vec<Glyph>,
    pub arguments: Vec<Vec<Glyph>>,
}

#[derive(Debug, Clone)]
pub(super) struct Entry {
    /// As it was given, for printing.
    pub printed: String,
    pub meaning: Meaning,
}

impl Entry {
    /// The declared name that it stands for, if it is one.
    fn name(&self) -> Option<&str> {
        match &self.meaning {
            Meaning::Amount(Expr { node: Node::Symbol(name), .. }) => Some(name),
            _ => None,
        }
    }
}

#[derive(Debug, Clone)]
pub(super) enum Meaning {
    Amount(Expr<()>),
    /// Three components.
    Vector([Expr<()>; 3]),
    /// Several declared names print alike.
    Ambiguous(Vec<String>),
}

/// A printed symbol found in a formula.
pub(super) struct Found<'a> {
    pub meaning: &'a Meaning,
    /// Byte range in the text, the power left out.
    pub place: Range<usize>,
    /// Number of tokens it takes, the power included.
    pub tokens: usize,
    /// What stands as the upper index if that is a power.
    pub power: Option<i32>,
}

impl PrintedSymbols {
    /// The symbols of a chain in their printed forms. A printed form that is no symbol cannot stand in a formula and is
    /// left out.
    #[must_use]
    pub fn of_chain(chain: &Chain) -> Self {
        let mut table = Self::default();
        // π is read as itself unless the user declares `\pi` to be something else.
        for symbol in
            chain.symbols.iter().filter(|symbol| !matches!(symbol.kind, SymbolKind::Pi | SymbolKind::Ramp))
        {
            table.names.insert(symbol.name.clone(), symbol.kind);
            let Ok(key) = symbol_key(&symbol.latex) else { continue };
            let meaning = match table.entries.remove(&key).map(|entry| entry.meaning) {
                Some(Meaning::Ambiguous(mut names)) => {
                    names.push(symbol.name.clone());
                    Meaning::Ambiguous(names)
                }
                Some(Meaning::Amount(Expr { node: Node::Symbol(first), .. })) => {
                    Meaning::Ambiguous(vec![first, symbol.name.clone()])
                }
                _ => Meaning::Amount(name(&symbol.name)),
            };
            table.insert(key, Entry { printed: symbol.latex.clone(), meaning });
        }
        table.joints = joints_of_errors(chain);
        table
    }

    /// Declares that a printed symbol stands for a name or an amount; it wins over the chain's own printed form.
    ///
    /// # Errors
    /// The printed form is no symbol, that is, no letters with indices.
    pub fn define<S>(&mut self, printed: &str, amount: &Expr<S>) -> Result<(), Unreadable> {
        self.define_as(printed, Meaning::Amount(amount.map_place(&|_| ())))
    }

    /// Declares that a printed symbol stands for a vector.
    ///
    /// # Errors
    /// The printed form is no symbol.
    pub fn define_vector<S>(&mut self, printed: &str, components: &[Expr<S>; 3]) -> Result<(), Unreadable> {
        let components = components.each_ref().map(|component| component.map_place(&|_| ()));
        self.define_as(printed, Meaning::Vector(components))
    }

    fn define_as(&mut self, printed: &str, meaning: Meaning) -> Result<(), Unreadable> {
        let key = symbol_key(printed)?;
        self.insert(key, Entry { printed: printed.trim().to_owned(), meaning });
        Ok(())
    }

    fn insert(&mut self, key: Key, entry: Entry) {
        self.longest = self.longest.max(key.glyphs.len());
        self.entries.insert(key, entry);
    }

    fn entry(&self, glyphs: &[Glyph], arguments: &[Vec<Glyph>]) -> Option<&Entry> {
        self.entries.get(&Key { glyphs: glyphs.to_vec(), arguments: arguments.to_vec() })
    }

    /// Whether a text is one printed symbol.
    pub(crate) fn prints(&self, text: &str) -> bool {
        symbol_key(text).is_ok_and(|key| self.entries.contains_key(&key))
    }

    /// Whether a name is declared.
    pub(crate) fn declares(&self, name: &str) -> bool {
        self.names.contains_key(name)
    }

    /// Whether a letter is a symbol by itself.
    pub(super) fn knows(&self, letter: char) -> bool {
        let glyph = Glyph { base: letter.to_string(), lower: String::new(), upper: String::new() };
        self.entry(&[glyph], &[]).is_some()
    }

    /// The longest known symbol at the start of `tokens`, which starts one.
    pub(super) fn find(&self, text: &str, tokens: &[Token]) -> Result<Found<'_>, Unreadable> {
        let mut read: Vec<ReadGlyph> = Vec::new();
        let mut used = 0;
        while read.len() < self.longest.max(3) {
            match glyph::read(&tokens[used..]) {
                Ok(Some(next)) => {
                    used += next.tokens;
                    read.push(next);
                }
                Ok(None) => break,
                Err(error) if read.is_empty() => return Err(error),
                Err(_) => break,
            }
        }
        for count in (1..=read.len()).rev() {
            let glyphs: Vec<Glyph> = read[..count].iter().map(|read| read.glyph.clone()).collect();
            let taken: usize = read[..count].iter().map(|read| read.tokens).sum();
            let arguments = glyph::arguments(&tokens[taken..]);
            let place = read[0].place.start..read[count - 1].place.end;
            if let Some((arguments, length)) = &arguments
                && let Some(entry) = self.entry(&glyphs, arguments)
            {
                let place = place.start..tokens[taken + length - 1].place.end;
                return entry.found(place, taken + length, None);
            }
            let whole = self.entry(&glyphs, &[]).map(|entry| (entry, None));
            let known = whole.or_else(|| {
                let last = glyphs.last()?;
                // Nobody prints the powers 0 and 1: there it is an index, and the symbol unknown.
                let power = last.upper.parse().ok().filter(|power| !(0..=1).contains(power))?;
                let mut base = glyphs.clone();
                base.last_mut()?.upper.clear();
                Some((self.entry(&base, &[])?, Some(power)))
            });
            match (known, arguments) {
                (Some((entry, power)), None) => return entry.found(place, taken, power),
                (Some((entry, power)), Some((arguments, length))) => {
                    let inside = place.start..tokens[taken + length - 1].place.end;
                    let is_function =
                        power.is_none() && self.is_function_of(entry, &arguments, text, inside)?;
                    let length = if is_function { length } else { 0 };
                    return entry.found(place, taken + length, power);
                }
                (None, Some((_, length))) if self.has_arguments(&glyphs) => {
                    let place = place.start..tokens[taken + length - 1].place.end;
                    let message = format!("unknown symbol `{}`", &text[place.clone()]);
                    let others = self.entries.iter().filter(|(key, _)| key.glyphs == glyphs);
                    let known: Vec<String> =
                        others.map(|(_, entry)| format!("`{}`", entry.printed)).collect();
                    return Err(
                        Mistake::new(place, message).with_help(format!("known are {}", known.join(", ")))
                    );
                }
                (None, _) => {}
            }
        }
        let known: Vec<Known<'_>> = self
            .entries
            .iter()
            .map(|(key, entry)| Known { glyphs: &key.glyphs, printed: &entry.printed, name: entry.name() })
            .collect();
        Err(unknown::symbol(&known, |name| self.names.contains_key(name), text, &read))
    }

    /// Whether a symbol is known with other arguments.
    fn has_arguments(&self, glyphs: &[Glyph]) -> bool {
        self.entries.keys().any(|key| key.glyphs == glyphs && !key.arguments.is_empty())
    }

    /// Whether `e(\alpha)` says that an error is a function of its joint. A product is only read where the parentheses
    /// cannot mean an argument.
    fn is_function_of(
        &self,
        entry: &Entry,
        arguments: &[Vec<Glyph>],
        text: &str,
        place: Range<usize>,
    ) -> Result<bool, Unreadable> {
        // Several factors in parentheses are no argument.
        if arguments.iter().any(|argument| argument.len() > 1 && self.entry(argument, &[]).is_none()) {
            return Ok(false);
        }
        let mut names = Vec::new();
        for argument in arguments {
            let name = match self.entry(argument, &[]).map(|entry| &entry.meaning) {
                Some(Meaning::Amount(Expr { node: Node::Symbol(name), .. })) => Some(name),
                _ => None,
            };
            names.push(name);
        }
        let varies = |name: &Option<&String>| {
            name.is_none_or(|name| {
                self.names.get(name).is_none_or(|kind| matches!(kind, SymbolKind::Joint | SymbolKind::Input))
            })
        };
        if arguments.len() == 1 && !names.iter().any(varies) {
            return Ok(false);
        }
        let ambiguous = |message: String| {
            Err(Mistake::new(place.clone(), message).with_help(format!(
                "for a product write `\\cdot` before the parenthesis; for a name of its own: '{}' = \"…\" under [symbols]",
                &text[place.clone()]
            )))
        };
        let Meaning::Amount(Expr { node: Node::Symbol(error), .. }) = &entry.meaning else {
            return ambiguous("is this a function of its argument, or a product?".to_owned());
        };
        if self.names.get(error) != Some(&SymbolKind::Error) {
            return ambiguous(format!("is this `{error}` as a function, or a product?"));
        }
        let own = self.joints.get(error).map_or(&[][..], Vec::as_slice);
        match names.iter().find(|name| name.is_none_or(|name| !own.contains(name))) {
            None => Ok(true),
            Some(other) => {
                let of = other.map_or("this", String::as_str);
                let moved = match own {
                    [] => "no joint moves its body".to_owned(),
                    own => format!("its body is moved by {}", own.join(" and ")),
                };
                ambiguous(format!("`{error}` is no function of {of}: {moved}"))
            }
        }
    }
}

impl Entry {
    fn found(&self, place: Range<usize>, tokens: usize, power: Option<i32>) -> Result<Found<'_>, Unreadable> {
        match &self.meaning {
            Meaning::Ambiguous(names) => {
                let message = format!("`{}` is the printed form of {}", self.printed, names.join(" and "));
                Err(Mistake::new(place, message)
                    .with_help(format!("say which under [symbols]: '{}' = \"{}\"", self.printed, names[0])))
            }
            meaning => Ok(Found { meaning, place, tokens, power }),
        }
    }
}

/// The joints of the body that carries an error, or of the nearest below it that has any.
fn joints_of_errors(chain: &Chain) -> BTreeMap<String, Vec<String>> {
    let of_kind = |body: &model_core::Body, kind| -> Vec<String> {
        let mut names: Vec<String> = body
            .factors
            .iter()
            .flat_map(|factor| factor.amount.symbols())
            .map(|id| chain.symbol(id))
            .filter(|symbol| symbol.kind == kind)
            .map(|symbol| symbol.name.clone())
            .collect();
        names.dedup();
        names
    };
    let mut joints: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for body in &chain.bodies {
        let mut carrier = Some(body);
        let mut own = Vec::new();
        while let Some(body) = carrier.filter(|_| own.is_empty()) {
            own = of_kind(body, SymbolKind::Joint);
            carrier = body.lower.map(|lower| chain.body(lower));
        }
        for error in of_kind(body, SymbolKind::Error) {
            let known = joints.entry(error).or_default();
            known.extend(own.iter().filter(|joint| !known.contains(joint)).cloned().collect::<Vec<_>>());
        }
    }
    joints
}

fn name(name: &str) -> Expr<()> {
    Expr { node: Node::Symbol(name.to_owned()), place: () }
}

/// The glyphs of a text that is one symbol, and its arguments: `\delta_x(y)`.
fn symbol_key(printed: &str) -> Result<Key, Unreadable> {
    let tokens = token::tokens(printed)?;
    let mut glyphs = Vec::new();
    let mut used = 0;
    while let Some(read) = glyph::read(&tokens[used..])? {
        used += read.tokens;
        glyphs.push(read.glyph);
    }
    let mut arguments = Vec::new();
    if !glyphs.is_empty()
        && let Some((found, length)) = glyph::arguments(&tokens[used..])
    {
        arguments = found;
        used += length;
    }
    match tokens.get(used) {
        None if !glyphs.is_empty() => Ok(Key { glyphs, arguments }),
        None => {
            Err(Mistake::new(0..printed.len(), "a printed symbol is missing")
                .with_help(r"\Delta\theta_{y1}^0"))
        }
        Some(token) => Err(Mistake::new(token.place.clone(), "this cannot be part of a symbol").with_help(
            "a symbol is letters with indices and accents, and perhaps an argument: `\\delta_x(y)`",
        )),
    }
}
