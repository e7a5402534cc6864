//! The table of symbols: amounts, vectors, matrices and screws, in the plain syntax or in LaTeX.

use model_core::expr::{Expr, Node};
use model_core::{Chain, Mistake, syntax};
use toml::Spanned;

use super::super::strings::place_in_string;
use super::super::table::{File, Meant};
use super::{Place, Reader};
use crate::checker::{hand, lower};
use crate::latex::{self, PrintedMatrix, program};

type Symbol<'a> = (&'a Spanned<String>, &'a str, Place);

impl Reader<'_> {
    /// Fills the table of symbols; returns the chain with the printed forms that the file gives its names.
    pub(super) fn printed_symbols(&mut self, file: &File) -> Chain {
        let mut printed = self.chain.clone();
        let mut in_latex: Vec<Symbol<'_>> = Vec::new();
        for (symbol, meaning) in &file.symbols {
            match meaning.get_ref() {
                Meant::Screw(parts) => self.screw(symbol, parts),
                Meant::Text(text) if text.contains(['\\', '{']) => {
                    in_latex.push((symbol, text, meaning.span()));
                }
                Meant::Text(text) if text.trim_start().starts_with('[') => {
                    let read = program::read_matrix(text, &self.symbols);
                    self.define(symbol, text, meaning.span(), read);
                }
                // `(a, b, c)^T`. A word that nobody declared is a misspelt name, and no product of letters.
                Meant::Text(text) if syntax::parse_amount(text).is_err() => {
                    in_latex.push((symbol, text, meaning.span()));
                }
                Meant::Text(text) => self.amount(symbol, text, meaning.span(), &mut printed),
            }
        }
        // A formula may hold symbols that another one of the table defines.
        while !in_latex.is_empty() {
            let (readable, rest): (Vec<Symbol<'_>>, Vec<Symbol<'_>>) = in_latex
                .iter()
                .cloned()
                .partition(|(_, text, _)| latex::read_matrix(text, &self.symbols.reading(&[text])).is_ok());
            for (symbol, text, place) in if readable.is_empty() { &rest } else { &readable } {
                let read = latex::read_matrix(text, &self.symbols.reading(&[text]));
                if read.is_err() && !text.contains(['\\', '{']) {
                    self.amount(symbol, text, place.clone(), &mut printed);
                    continue;
                }
                self.define(symbol, text, place.clone(), read);
            }
            in_latex = if readable.is_empty() { Vec::new() } else { rest };
        }
        printed
    }

    fn amount(&mut self, symbol: &Spanned<String>, text: &str, whole: Place, printed: &mut Chain) {
        let amount = match syntax::parse_amount(text) {
            Ok(amount) => amount,
            Err(mistakes) => {
                for mistake in &mistakes {
                    let place = place_in_string(self.text, whole.clone(), mistake.place.bytes.clone());
                    self.mistake(place, mistake.message.clone()).help.clone_from(&mistake.help);
                }
                return;
            }
        };
        if let Err(mistake) = lower(self.chain, &amount) {
            return self.noted(whole, mistake);
        }
        if let Err(mistake) = self.symbols.define(symbol.get_ref(), &amount) {
            return self.noted(symbol.span(), mistake);
        }
        hand::abbreviate(&mut self.hand, self.chain, symbol.get_ref().trim(), &amount);
        if let Node::Symbol(name) = &amount.node
            && let Some(id) = printed.find_symbol(name)
        {
            printed.symbols[id.index()].latex = symbol.get_ref().trim().to_owned();
        }
    }

    /// A mistake in a string of the file.
    fn noted(&mut self, string: Place, Mistake { place, message, help }: Mistake<Place>) {
        let place = place_in_string(self.text, string, place);
        self.mistake(place, message).help = help;
    }

    /// Defines a symbol by what was read of a matrix; one of one entry is an amount.
    fn define(
        &mut self,
        symbol: &Spanned<String>,
        text: &str,
        whole: Place,
        read: Result<PrintedMatrix, Mistake<Place>>,
    ) {
        let matrix = match read {
            Ok(matrix) => matrix,
            Err(mistake) => return self.noted(whole, mistake),
        };
        let names: Vec<(String, Place)> = matrix
            .entries
            .iter()
            .flat_map(Expr::names)
            .map(|(name, place)| (name.to_owned(), place))
            .collect();
        if let Some((name, place)) =
            names.into_iter().find(|(name, _)| self.chain.find_symbol(name).is_none())
        {
            let place = place.start.min(text.len())..place.end.min(text.len());
            return self.noted(whole, Mistake::new(place, format!("unknown name `{name}`")));
        }
        let defined = match matrix.entries.as_slice() {
            [only] => self.symbols.define(symbol.get_ref(), only),
            entries => self.symbols.define_matrix(symbol.get_ref(), matrix.columns, entries),
        };
        if let Err(mistake) = defined {
            self.noted(symbol.span(), mistake);
        }
    }

    /// `{ omega = "[0, 0, 1]", v = "[0, 0, 0]" }`
    fn screw(&mut self, symbol: &Spanned<String>, parts: &[Spanned<String>; 2]) {
        let mut components = Vec::with_capacity(6);
        for part in parts {
            match program::read_matrix(part.get_ref(), &self.symbols) {
                Ok(matrix) if matrix.entries.len() == 3 => components.extend(matrix.entries),
                Ok(matrix) => {
                    let count = matrix.entries.len();
                    self.mistake(part.span(), format!("{count} components, where a vector has three"));
                    return;
                }
                Err(mistake) => return self.noted(part.span(), mistake),
            }
        }
        let Ok(components) = <[Expr<Place>; 6]>::try_from(components) else {
            unreachable!("twice three components are six")
        };
        if let Err(mistake) = self.symbols.define_twist(symbol.get_ref(), &components) {
            self.noted(symbol.span(), mistake);
        }
    }
}
