//! The table from printed symbols to what they stand for: a declared name, or an abbreviation such as `s_\beta`.

use std::collections::BTreeMap;

use super::glyph::{self, Glyph};
use super::{Unreadable, left};
use model_core::chain::Chain;
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;
use model_core::symbol::SymbolKind;

/// What printed symbols stand for.
#[derive(Debug, Clone, Default)]
pub struct PrintedSymbols {
    pub(super) entries: BTreeMap<Key, Entry>,
    /// The same symbols with bold type ignored.
    faces: BTreeMap<Key, Vec<Key>>,
    /// The largest number of glyphs in one symbol.
    pub(super) longest: usize,
    /// Every declared name and what it is for.
    pub(super) names: BTreeMap<String, SymbolKind>,
    /// The joints that an error may be a function of: those of the body that it belongs to.
    pub(super) joints: BTreeMap<String, Vec<String>>,
    /// What a rotation about a named axis, `R_z(\psi)`, turns.
    pub(super) turned: Turned,
    /// Whether `c_1` and `s_1` are a cosine and a sine.
    pub(super) abbreviates: bool,
    /// Whether symbols that nobody defines are read as they usually are.
    pub(super) guesses: bool,
    /// Whether bold `i`, `j` and `k` are unit vectors.
    pub(super) has_unit_letters: bool,
}

/// What the matrix of a rotation about a named axis turns, where a print does not define it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Turned {
    /// Vectors: `R_z(\psi)` takes x towards y.
    #[default]
    Vectors,
    /// Axes: the transpose of that.
    Axes,
}

impl Key {
    fn without_bold(&self) -> Self {
        let plain = |glyph: &Glyph| Glyph { bold: false, ..glyph.clone() };
        let arguments = self.arguments.iter().map(|argument| argument.iter().map(plain).collect());
        Self { glyphs: self.glyphs.iter().map(plain).collect(), arguments: arguments.collect() }
    }
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
    /// Whether the declaration prints it so, and no table of symbols.
    pub is_declared: bool,
}

impl Entry {
    /// The declared name that it stands for, if it is one.
    pub(super) fn name(&self) -> Option<&str> {
        match &self.meaning {
            Meaning::Amount(Expr { node: Node::Symbol(name), .. }) => Some(name),
            _ => None,
        }
    }
}

#[derive(Debug, Clone)]
pub(super) enum Meaning {
    Amount(Expr<()>),
    /// Amounts in rows and columns, row after row.
    Matrix {
        rows: usize,
        columns: usize,
        entries: Vec<Expr<()>>,
    },
    /// A screw: the angular velocity and the linear one, of three components each.
    Twist(Box<[Expr<()>; 6]>),
    /// Several declared names print alike.
    Ambiguous(Vec<String>),
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
            table.insert(key, Entry { printed: symbol.latex.clone(), meaning, is_declared: true });
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
        self.define_matrix(printed, 1, components)
    }

    /// Declares that a printed symbol stands for a matrix, given row after row; one of one column is a vector.
    ///
    /// # Errors
    /// The printed form is no symbol.
    pub fn define_matrix<S>(
        &mut self,
        printed: &str,
        columns: usize,
        entries: &[Expr<S>],
    ) -> Result<(), Unreadable> {
        let rows = entries.len() / columns.max(1);
        let entries = entries.iter().map(|entry| entry.map_place(&|_| ())).collect();
        self.define_as(printed, Meaning::Matrix { rows, columns, entries })
    }

    /// Declares that a printed symbol stands for a screw: the angular velocity, then the linear one.
    ///
    /// # Errors
    /// The printed form is no symbol.
    pub fn define_twist<S>(&mut self, printed: &str, components: &[Expr<S>; 6]) -> Result<(), Unreadable> {
        let components = components.each_ref().map(|component| component.map_place(&|_| ()));
        self.define_as(printed, Meaning::Twist(Box::new(components)))
    }

    fn define_as(&mut self, printed: &str, meaning: Meaning) -> Result<(), Unreadable> {
        let key = symbol_key(printed)?;
        self.insert(key, Entry { printed: printed.trim().to_owned(), meaning, is_declared: false });
        Ok(())
    }

    fn insert(&mut self, key: Key, entry: Entry) {
        self.longest = self.longest.max(key.glyphs.len());
        let keys = self.faces.entry(key.without_bold()).or_default();
        if !keys.contains(&key) {
            keys.push(key.clone());
        }
        self.entries.insert(key, entry);
    }

    /// The same table where rotations about named axes turn something else.
    #[must_use]
    pub fn turning(mut self, turned: Turned) -> Self {
        self.turned = turned;
        self
    }

    /// The same table with a name for an amount, or for a matrix of them, that is looked for.
    pub(super) fn with_name(&self, wanted: &str, [rows, columns]: [usize; 2]) -> Self {
        let mut table = self.clone();
        let meaning = match rows * columns {
            1 => Meaning::Amount(name(wanted)),
            count => {
                let entries = (0..count).map(|at| name(&format!("{wanted} {at}"))).collect();
                Meaning::Matrix { rows, columns, entries }
            }
        };
        let key = Key { glyphs: vec![Glyph::bare(wanted)], arguments: Vec::new() };
        table.insert(key, Entry { printed: wanted.to_owned(), meaning, is_declared: false });
        table
    }

    /// A symbol as it is set, or in another weight if only one is known.
    pub(super) fn entry(&self, glyphs: &[Glyph], arguments: &[Vec<Glyph>]) -> Option<&Entry> {
        let key = Key { glyphs: glyphs.to_vec(), arguments: arguments.to_vec() };
        self.entries.get(&key).or_else(|| match self.faces.get(&key.without_bold())?.as_slice() {
            [only] => self.entries.get(only),
            _ => None,
        })
    }

    /// Whether a table of symbols gives a declared name a printed form.
    pub(super) fn renames(&self, name: &str) -> bool {
        self.entries.values().any(|entry| !entry.is_declared && entry.name() == Some(name))
    }

    /// The entry that a text is the printed form of, letter by letter: a name as programs have it.
    pub(super) fn entry_written(&self, text: &str) -> Option<&Entry> {
        self.entries.values().find(|entry| entry.printed == text)
    }

    /// Whether a text is one printed symbol, in the type that it is set in: `\mathbf{r}` is none where only `r` is known.
    pub(crate) fn prints(&self, text: &str) -> bool {
        symbol_key(text).is_ok_and(|key| self.entries.contains_key(&key))
    }

    /// Whether a text is one known symbol.
    #[must_use]
    pub fn knows_symbol(&self, text: &str) -> bool {
        symbol_key(text).is_ok_and(|key| self.entry(&key.glyphs, &key.arguments).is_some())
    }

    /// The declared name that a text is the printed symbol of.
    pub(crate) fn name_printed(&self, text: &str) -> Option<&str> {
        let key = symbol_key(text).ok()?;
        self.entry(&key.glyphs, &key.arguments)?.name()
    }

    /// Whether a name is declared.
    pub(crate) fn declares(&self, name: &str) -> bool {
        self.names.contains_key(name)
    }

    /// Whether a letter is a symbol by itself.
    pub(super) fn knows(&self, letter: char) -> bool {
        self.entry(&[Glyph::bare(letter)], &[]).is_some()
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
    let tokens = left::tokens(printed)?;
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
