//! The ramps of a chain: each that an amount uses becomes a symbol of the chain.

use crate::algebra::Poly;
use crate::chain::Chain;
use crate::expr::{Expr, Node};
use crate::print;
use crate::ramp::Ramp;
use crate::symbol::{Quantity, Symbol, SymbolId, SymbolKind};

impl Chain {
    /// The ramp that a symbol stands for.
    #[must_use]
    pub fn ramp(&self, symbol: SymbolId) -> Option<&Ramp> {
        self.ramps.iter().find(|ramp| ramp.symbol == symbol)
    }

    /// The symbol of the ramp of a joint or input between two thresholds, if the chain uses it.
    #[must_use]
    pub fn find_ramp(&self, of: SymbolId, from: &Poly, to: &Poly) -> Option<SymbolId> {
        let same = |ramp: &&Ramp| ramp.of == of && ramp.from == *from && ramp.to == *to;
        self.ramps.iter().find(same).map(|ramp| ramp.symbol)
    }

    /// The symbol of a ramp, new if the chain does not use it yet; `None` if a chain cannot have more symbols.
    pub fn add_ramp(&mut self, of: SymbolId, from: Poly, to: Poly) -> Option<SymbolId> {
        if let Some(known) = self.find_ramp(of, &from, &to) {
            return Some(known);
        }
        let symbol = SymbolId(u16::try_from(self.symbols.len()).ok()?);
        let documentation = "0 before its first threshold, 1 behind its second, linear between.".to_owned();
        self.symbols.push(Symbol {
            name: format!(
                "ramp({}, {}, {})",
                self.symbol(of).name,
                print::text(&from, self),
                print::text(&to, self)
            ),
            kind: SymbolKind::Ramp,
            quantity: Quantity::Number,
            meaning: None,
            of: None,
            documentation,
            latex: format!(
                "\\operatorname{{ramp}}\\left({}, {}, {}\\right)",
                self.symbol(of).latex,
                print::latex(&from, self),
                print::latex(&to, self)
            ),
            value: None,
        });
        self.ramps.push(Ramp { symbol, of, from, to });
        Some(symbol)
    }

    /// Adds every ramp that an expression uses and whose names the chain knows, so that the expression has a canonical
    /// form.
    pub fn add_ramps_of<S: Clone>(&mut self, expression: &Expr<S>) {
        let mut found = Vec::new();
        expression.ramps(&mut found);
        for [of, from, to] in found {
            let Node::Symbol(name) = &of.node else { continue };
            let (Some(of), Ok(from), Ok(to)) = (self.find_symbol(name), self.amount(from), self.amount(to))
            else {
                continue;
            };
            self.add_ramp(of, from, to);
        }
    }

    /// Gives the ramps and the angles of lines of sight the values that follow from those of the other symbols; `values` by
    /// [`SymbolId`], SI.
    pub fn set_derived(&self, values: &mut [f64]) {
        for ramp in &self.ramps {
            let value = ramp.value(values);
            if let Some(slot) = values.get_mut(ramp.symbol.index()) {
                *slot = value;
            }
        }
        for angle in &self.sight_angles {
            let value = angle.value(values);
            if let Some(slot) = values.get_mut(angle.symbol.index()) {
                *slot = value;
            }
        }
    }

    /// The symbols that an amount depends on, in order: those in it, and in place of a ramp or of the angle of a line of sight those
    /// that it follows from.
    #[must_use]
    pub fn symbols_in(&self, amount: &Poly) -> Vec<SymbolId> {
        let mut symbols: Vec<SymbolId> = Vec::new();
        for symbol in amount.symbols() {
            match (self.ramp(symbol), self.sight_angle(symbol)) {
                (Some(ramp), _) => symbols.extend(ramp.depends_on()),
                (_, Some(angle)) => symbols.extend(angle.depends_on()),
                (None, None) => symbols.push(symbol),
            }
        }
        symbols.sort_unstable();
        symbols.dedup();
        symbols
    }
}
