//! A claims file drawn up from a paper, its guesses marked, and what could not be read.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use model_core::expr::Expr;
use model_core::{Chain, ObservableId};

use super::guess::Guess;
use super::macros::Macros;
use super::source::{Equation, Kind, equations};
use super::written::{key, on_one_line, quoted, said, without_condition};
use super::{guess, prose};
use crate::checker::{Checker, Claim, Equality, Verdict, extended};
use crate::latex::{self, PrintedSymbols};

/// What the first line of a drawn-up file begins with.
pub const MARK: &str = "# Drawn up by trueaxis from";

/// What was made of a paper.
#[derive(Debug)]
pub struct Draft {
    /// The claims file.
    pub text: String,
    /// How many claims it makes.
    pub claims: usize,
    /// Equations without a claim: line, equation, reason.
    pub unread: Vec<(usize, String, String)>,
    /// The chain that the paper names, if it names one.
    pub chain: Option<String>,
}

/// The chain that a paper names in so many words.
fn chain_of(source: &str) -> Option<String> {
    prose::statements(source).into_iter().find(|(key, _)| key == "chain").map(|(_, value)| value)
}

impl Draft {
    /// The chain that a paper names: `% trueaxis: chain = instrument.chain`.
    #[must_use]
    pub fn chain_named(source: &str) -> Option<String> {
        chain_of(source)
    }
}

/// Draws up the claims of a paper about a chain; `file` and `chain_file` are what they are called.
#[must_use]
pub fn draft(source: &str, kind: Kind, chain: &Chain, file: &str, chain_file: &str) -> Draft {
    let chain = extended(chain);
    let macros = Macros::of_source(source);
    let found: Vec<Equation> = equations(source, kind)
        .into_iter()
        .map(|equation| Equation { text: macros.expanded(&equation.text), ..equation })
        .collect();
    // What one equation abbreviates, the others do, too.
    let texts: Vec<&str> = found.iter().map(|equation| equation.text.as_str()).collect();
    let mut drawn = Drawn {
        chain: &chain,
        symbols: PrintedSymbols::of_chain(&chain).reading(&texts).into_owned(),
        table: String::new(),
        claims: String::new(),
        count: 0,
        unread: Vec::new(),
        defined: Vec::new(),
        claimed: BTreeSet::new(),
        names: BTreeMap::new(),
        undefined: Vec::new(),
        turns_vectors: false,
    };
    for (symbol, name) in prose::statements(source) {
        if symbol != "chain" {
            drawn.letter(&macros.expanded(&symbol), &name, "stated");
        }
    }
    // Letters are named before and behind the equations that use them.
    for equation in found.iter().filter(|equation| !equation.is_display && !equation.text.contains('=')) {
        drawn.said(source, equation);
    }
    let mut checker = Checker::new(&chain);
    for equation in &found {
        if equation.is_display || equation.text.contains('=') {
            drawn.equation(&mut checker, equation);
        }
    }
    drawn.again(&mut checker);
    let mut text = format!("{MARK} {file}. What follows `guess` was not in the paper: look it over.\n");
    let rotations =
        if drawn.turns_vectors { "rotations = \"vectors\"  # guess, by the claims that hold\n" } else { "" };
    let _ = writeln!(text, "chain = {}\n{rotations}\n[symbols]\n{}", quoted(chain_file), drawn.table);
    text.push_str(&drawn.claims);
    let unread = drawn.unread.into_iter().map(|unread| (unread.line, unread.text, unread.reason)).collect();
    Draft { text, claims: drawn.count, unread, chain: chain_of(source) }
}

/// An equation without a claim.
#[derive(Debug, Clone)]
struct Unread {
    line: usize,
    text: String,
    reason: String,
    /// How many symbols were defined when it was read.
    known: usize,
}

struct Drawn<'a> {
    chain: &'a Chain,
    symbols: PrintedSymbols,
    table: String,
    claims: String,
    count: usize,
    unread: Vec<Unread>,
    /// Symbols that the paper defines, in the order in which their definitions were read.
    defined: Vec<String>,
    /// What is claimed: line and equation.
    claimed: BTreeSet<(usize, String)>,
    /// What names on the left of `=` stood for in claims so far.
    names: BTreeMap<String, (ObservableId, usize)>,
    /// Symbols whose definitions could not be read: the line, and why.
    undefined: Vec<(String, usize, String)>,
    /// Whether a claim holds with `R_z(\psi)` as a turn of vectors, so that the paper means that by it.
    turns_vectors: bool,
}

impl Drawn<'_> {
    /// A letter that stands for a declared name or an amount.
    fn letter(&mut self, symbol: &str, meaning: &str, why: &str) {
        let written = key(symbol);
        if self.table.lines().any(|line| line.starts_with(&format!("{written} = "))) {
            return;
        }
        let Ok(amount) = model_core::syntax::parse_amount(meaning) else { return };
        if crate::checker::lower(self.chain, &amount).is_ok() && self.symbols.define(symbol, &amount).is_ok()
        {
            let _ = writeln!(self.table, "{written} = {}  # {why}", quoted(meaning));
        }
    }

    /// A letter of which the text says what it is.
    fn said(&mut self, source: &str, equation: &Equation) {
        let symbols = latex::symbols_in(&equation.text);
        let [symbol] = symbols.as_slice() else { return };
        if self.symbols.knows_symbol(symbol) {
            return;
        }
        if let Some(name) = prose::named(source, equation, self.chain) {
            self.letter(symbol, &name, &format!("guess, line {}", equation.line));
        }
    }

    /// An equation: a claim, or several, or the definition of a symbol.
    fn equation(&mut self, checker: &mut Checker<'_>, equation: &Equation) {
        if self.whole(checker, equation, &equation.text) {
            return;
        }
        // `A = X,\quad B = Y`
        let beside = latex::equations_beside(&equation.text);
        if !beside.is_empty() {
            for text in beside {
                self.equation(checker, &Equation { text, ..equation.clone() });
            }
            return;
        }
        // Lines of which one is a chain of equalities are read one by one.
        let lines = latex::lines_of(&equation.text);
        if lines.len() > 1 && lines.iter().any(|line| latex::equalities_of(line).len() > 1) {
            for text in lines {
                self.equation(checker, &Equation { text, ..equation.clone() });
            }
            return;
        }
        // `A = B = C`, and a condition behind a wide space.
        let sides = latex::equalities_of(&equation.text);
        if sides.len() > 1 || sides.iter().any(|side| *side != equation.text) {
            let derivatives = latex::derivatives_of(&equation.text);
            if !derivatives.is_empty() && derivatives.iter().all(|text| self.whole(checker, equation, text)) {
                for side in &sides {
                    let _ = self.definition(equation, side);
                }
                return;
            }
            let mut failed = Vec::new();
            for side in &sides {
                if !self.whole(checker, equation, side)
                    && let Err(why) = self.definition(equation, side)
                {
                    failed.push((side.clone(), why));
                }
            }
            if failed.len() < sides.len() {
                for (side, why) in failed {
                    self.unread(equation.line, side, why);
                }
                return;
            }
        }
        if let Some(text) = without_condition(&equation.text)
            && self.whole(checker, equation, &text)
        {
            return;
        }
        let identity = self.identity(equation);
        if identity == Some(true) {
            return;
        }
        let rows = latex::rows_of(&equation.text);
        let mut read = false;
        let mut reason = None;
        for row in &rows {
            if rows.len() > 1 && self.whole(checker, equation, row) {
                read = true;
                continue;
            }
            if equation.is_display && self.named_before(checker, equation, row) {
                read = true;
                continue;
            }
            match self.definition(equation, row) {
                // A name that says a component is more than an abbreviation.
                Ok(()) if equation.is_display && latex::named_component(row).is_some() => {
                    read = true;
                    reason = reason.or(Some(USED.to_owned()));
                }
                Ok(()) => read = true,
                Err(why) => {
                    if let Some((name, _)) = latex::definition_of(row) {
                        self.undefined.push((name, equation.line, why.clone()));
                    }
                    reason = reason.or(Some(why));
                }
            }
        }
        if let Some(reason) = reason
            && (equation.is_display || !read)
        {
            // An aside such as `$n = 5$` is no statement about the chain.
            if equation.is_display || reason.starts_with("differs") {
                let shown = on_one_line(&equation.text);
                let missing = |(name, line, _): &&(String, usize, String)| {
                    *line != equation.line && reason.contains(&format!("unknown symbol `{name}`"))
                };
                let reason = match self.undefined.iter().find(missing) {
                    Some((_, line, why)) => format!("{reason}; line {line} defines it, where {why}"),
                    None if identity == Some(false) => OPEN.to_owned(),
                    None => reason,
                };
                self.unread(equation.line, shown, reason);
            }
        }
    }

    /// Equations with symbols that a later one defines are read once more.
    fn again(&mut self, checker: &mut Checker<'_>) {
        for _ in 0..ROUNDS {
            let is_late = |unread: &Unread| {
                let printed = latex::symbols_in(&unread.text);
                self.defined[unread.known..].iter().any(|symbol| printed.contains(symbol))
            };
            let (late, unread): (Vec<Unread>, Vec<Unread>) = self.unread.iter().cloned().partition(is_late);
            self.unread = unread;
            if late.is_empty() {
                break;
            }
            for Unread { line, text, .. } in late {
                self.equation(checker, &Equation { line, text, is_display: true, place: 0..0 });
            }
        }
        self.unread.sort_by_key(|unread| unread.line);
    }

    fn unread(&mut self, line: usize, text: String, reason: String) {
        self.unread.push(Unread { line, text, reason, known: self.defined.len() });
    }

    /// Two formulas that are one, both of them more than a name: `|\vec r|^2 = …`.
    fn identity(&mut self, equation: &Equation) -> Option<bool> {
        let text = &equation.text;
        let places = latex::equal_sides(text);
        let [first, second] = places.as_slice() else { return None };
        let sides = [&text[first.clone()], &text[second.clone()]];
        if !equation.is_display || latex::definition_of(text).is_some() {
            return None;
        }
        let claimed = match Equality::read(self.chain, &self.symbols, sides) {
            Ok(one) => vec![one],
            Err(_) => {
                let entries = Equality::read_entries(self.chain, &self.symbols, sides)?.ok()?;
                entries.into_iter().map(|(_, equality)| equality).collect()
            }
        };
        let turned = claimed.iter().any(Equality::is_turned);
        let mut checker = Checker::new(self.chain);
        for equality in claimed {
            let Ok(Verdict::Equality(verdict)) = checker.check(&Claim::Equality(Box::new(equality))) else {
                return None;
            };
            if !verdict.difference.is_zero() {
                return Some(false);
            }
        }
        self.claim(equation, text, &Guess::identity(turned));
        Some(true)
    }

    fn whole(&mut self, checker: &mut Checker<'_>, equation: &Equation, text: &str) -> bool {
        let Some(guess) = guess::of_equation(checker, self.chain, &self.symbols, text, self.turns_vectors)
        else {
            return false;
        };
        self.claim(equation, text, &guess);
        // What is claimed may be used by name, too.
        let _ = self.definition(equation, text);
        true
    }

    /// An equation of one number whose name stood for a number of an error before.
    fn named_before(&mut self, checker: &mut Checker<'_>, equation: &Equation, row: &str) -> bool {
        let Some((name, _)) = latex::definition_of(row) else { return false };
        let Some(&of) = self.names.get(&name) else { return false };
        let Some(guess) = guess::of_component(checker, self.chain, &self.symbols, row, of) else {
            return false;
        };
        self.claim(equation, row, &guess);
        true
    }

    fn claim(&mut self, equation: &Equation, text: &str, guess: &Guess) {
        if !self.claimed.insert((equation.line, on_one_line(text))) {
            return;
        }
        self.count += 1;
        self.turns_vectors |= guess.turned;
        if let Some((observable, only)) = guess.of {
            let rows = latex::rows_of(text);
            let names = rows.iter().map(|row| latex::definition_of(row).map(|(name, _)| name));
            for (at, name) in names.enumerate() {
                let at = only.unwrap_or(at);
                if let Some(name) = name
                    && (only.is_some() || rows.len() == self.chain.observable(observable).shown.len())
                {
                    self.names.entry(name).or_insert((observable, at));
                }
            }
        }
        let _ = writeln!(self.claims, "[[claim]]\nname = \"line {}, {}\"", equation.line, self.count);
        for (key, value) in &guess.keys {
            let value = if matches!(*key, "keep" | "order" | "by") { value.clone() } else { quoted(value) };
            let _ = writeln!(self.claims, "{key} = {value}  # guess");
        }
        let _ = writeln!(self.claims, "{} = {}  # as {} is a guess\n", guess.key, quoted(text), guess.key);
    }

    /// `\mathbf{r} = …`: a symbol that the paper defines.
    fn definition(&mut self, equation: &Equation, row: &str) -> Result<(), String> {
        let Some((name, formula)) = latex::definition_of(row) else {
            let read = latex::read_matrix(row, &self.symbols.reading(&[row]));
            return Err(read.map_or_else(said, |_| "agrees with no statement about the chain".to_owned()));
        };
        let unknown = || Err("agrees with no statement about the chain".to_owned());
        if self.symbols.prints(&name) {
            return unknown();
        }
        let symbols = self.symbols.reading(&[&formula]);
        let matrix = latex::read_matrix(&formula, &symbols).map_err(said)?;
        // `\mathbf{r}` may be a vector beside the length `r`.
        if matrix.entries.len() == 1 && self.symbols.knows_symbol(&name) {
            return unknown();
        }
        let known = |entry: &Expr<std::ops::Range<usize>>| {
            entry.names().iter().all(|(name, _)| self.chain.find_symbol(name).is_some())
        };
        if !matrix.entries.iter().all(known) {
            return Err("a symbol of it is not declared".to_owned());
        }
        let defined = match matrix.entries.as_slice() {
            [only] => self.symbols.define(&name, only),
            entries => self.symbols.define_matrix(&name, matrix.columns, entries),
        };
        defined.map_err(|mistake| mistake.message)?;
        self.defined.push(name.clone());
        let _ = writeln!(
            self.table,
            "{} = {}  # defined in line {}",
            key(&name),
            // Braces say that letters are printed symbols.
            quoted(&if formula.contains(['\\', '{']) { formula.clone() } else { format!("{{{formula}}}") }),
            equation.line
        );
        Ok(())
    }
}

/// Times that equations are read again for the sake of what a later one defines.
const ROUNDS: usize = 3;

/// What is said of an equation that is no statement about the chain, and names a component.
const USED: &str = "agrees with no statement about the chain, and is only used where its name stands";

/// What is said of an equation of two known formulas that are not one.
const OPEN: &str = "its sides differ. Where they should agree at every pose, claim it by `equal`";
