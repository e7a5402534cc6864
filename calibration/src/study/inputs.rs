//! Inputs that a study brings with it: side quantities that the chain does not declare, and what follows from the
//! sequence of the rows.

use model_core::{Chain, Meaning, Quantity, Symbol, SymbolKind, check};

use super::mistakes::{Outcome, every, mistake};
use super::written::Study;
use crate::data::units::Unit;
use crate::data::{Derived, parse_derived};

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
                None if !check::is_name(text) => {
                    let message = format!("`{text}` cannot be the name of an input");
                    let help = "write letters, digits and underscores, no reserved word, and name its column: \
                                temp_x = { column = \"temp x\" }";
                    Err(mistake(name.span(), message, help))
                }
                None => {
                    chain.symbols.push(input(text, self.quantity_of(text), None));
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
                chain.symbols.push(input(&name, derived.quantity(), meaning(&derived)));
            }
        }
        Ok(chain)
    }

    /// What an input measures that only the study names: what its column's unit says, or what it is derived as.
    fn quantity_of(&self, name: &str) -> Quantity {
        let column = self.columns.iter().find(|(written, _)| *written.get_ref() == name);
        let Some((_, column)) = column else { return Quantity::Number };
        match (&column.get_ref().derive, &column.get_ref().unit) {
            (Some(text), _) => parse_derived(text).map_or(Quantity::Number, |derived| derived.quantity()),
            (None, Some(unit)) => Unit::find(unit).map_or(Quantity::Number, |unit| unit.quantity),
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

/// What an input is that follows from the rows.
fn meaning(derived: &Derived) -> Option<Meaning> {
    match derived {
        Derived::Direction { .. } => Some(Meaning::Direction),
        Derived::Rate { .. } => Some(Meaning::Rate),
        Derived::Elapsed { .. } => Some(Meaning::Time),
        Derived::Face { .. } => Some(Meaning::Side),
        Derived::Phase { .. } => Some(Meaning::Angle),
        Derived::Turns { .. } | Derived::Is { .. } | Derived::Inverse { .. } => None,
    }
}

/// An input that a study brings with it.
fn input(name: &str, quantity: Quantity, meaning: Option<Meaning>) -> Symbol {
    Symbol {
        name: name.to_owned(),
        kind: SymbolKind::Input,
        quantity,
        meaning,
        documentation: String::new(),
        latex: format!("\\mathrm{{{}}}", name.replace('_', "\\_")),
        value: None,
    }
}
