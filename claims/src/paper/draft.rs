//! A claims file drawn up from a paper, its guesses marked, and what could not be read.

use std::fmt::Write as _;

use model_core::Chain;
use model_core::expr::Expr;
use toml::Value;

use super::macros::Macros;
use super::source::{Equation, Kind, equations};
use super::{guess, prose};
use crate::checker::{Checker, extended};
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
    let mut drawn = Drawn {
        chain: &chain,
        symbols: PrintedSymbols::of_chain(&chain),
        table: String::new(),
        claims: String::new(),
        count: 0,
        unread: Vec::new(),
    };
    for (symbol, name) in prose::statements(source) {
        if symbol != "chain" {
            drawn.letter(&symbol, &name, "stated");
        }
    }
    let found: Vec<Equation> = equations(source, kind)
        .into_iter()
        .map(|equation| Equation { text: macros.expanded(&equation.text), ..equation })
        .collect();
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
    let mut text = format!("{MARK} {file}. What follows `guess` was not in the paper: look it over.\n");
    let _ = writeln!(text, "chain = {}\n\n[symbols]\n{}", quoted(chain_file), drawn.table);
    text.push_str(&drawn.claims);
    Draft { text, claims: drawn.count, unread: drawn.unread, chain: chain_of(source) }
}

struct Drawn<'a> {
    chain: &'a Chain,
    symbols: PrintedSymbols,
    table: String,
    claims: String,
    count: usize,
    unread: Vec<(usize, String, String)>,
}

impl Drawn<'_> {
    /// A letter that stands for a declared name or an amount.
    fn letter(&mut self, symbol: &str, meaning: &str, why: &str) {
        let Ok(amount) = model_core::syntax::parse_amount(meaning) else { return };
        if crate::checker::lower(self.chain, &amount).is_ok() && self.symbols.define(symbol, &amount).is_ok()
        {
            let _ = writeln!(self.table, "{} = {}  # {why}", key(symbol), quoted(meaning));
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
        let rows = latex::rows_of(&equation.text);
        let mut read = false;
        let mut reason = None;
        for row in &rows {
            if rows.len() > 1 && self.whole(checker, equation, row) {
                read = true;
                continue;
            }
            match self.definition(equation, row) {
                Ok(()) => read = true,
                Err(why) => reason = reason.or(Some(why)),
            }
        }
        if let Some(reason) = reason
            && (equation.is_display || !read)
        {
            // An aside such as `$n = 5$` is no statement about the chain.
            if equation.is_display || reason.starts_with("differs") {
                let shown = equation.text.split_whitespace().collect::<Vec<_>>().join(" ");
                self.unread.push((equation.line, shown, reason));
            }
        }
    }

    fn whole(&mut self, checker: &mut Checker<'_>, equation: &Equation, text: &str) -> bool {
        let Some(guess) = guess::of_equation(checker, self.chain, &self.symbols, text) else { return false };
        self.count += 1;
        let _ = writeln!(self.claims, "[[claim]]\nname = \"line {}, {}\"", equation.line, self.count);
        for (key, value) in &guess.keys {
            let value = if matches!(*key, "keep" | "order") { value.clone() } else { quoted(value) };
            let _ = writeln!(self.claims, "{key} = {value}  # guess");
        }
        let _ = writeln!(self.claims, "{} = {}  # as {} is a guess\n", guess.key, quoted(text), guess.key);
        // What is claimed may be used by name, too.
        let _ = self.definition(equation, text);
        true
    }

    /// `\mathbf{r} = …`: a symbol that the paper defines.
    fn definition(&mut self, equation: &Equation, row: &str) -> Result<(), String> {
        let (name, formula) =
            latex::definition_of(row).ok_or_else(|| "no equation with one `=`".to_owned())?;
        if self.symbols.knows_symbol(&name) {
            return Err("agrees with no statement about the chain".to_owned());
        }
        let symbols = self.symbols.reading(&[&formula]);
        let matrix = latex::read_matrix(&formula, &symbols).map_err(|mistake| {
            mistake.help.map_or(mistake.message.clone(), |help| format!("{}; {help}", mistake.message))
        })?;
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
        let _ = writeln!(
            self.table,
            "{} = {}  # defined in line {}",
            key(&name),
            quoted(&formula),
            equation.line
        );
        Ok(())
    }
}

/// A text as a key of TOML.
fn key(text: &str) -> String {
    if text.contains(['\'', '\n']) { Value::String(text.to_owned()).to_string() } else { format!("'{text}'") }
}

/// A text as a string of TOML.
fn quoted(text: &str) -> String {
    if text.contains("'''") || text.ends_with('\'') {
        return Value::String(text.to_owned()).to_string();
    }
    if text.contains(['\\', '\n', '"', '\'']) { format!("'''{text}'''") } else { format!("\"{text}\"") }
}
