//! Where a statement is defined: the conditions that its quotients and roots ask for.

use super::condition::Condition;
use super::section::Section;
use super::{Refusal, section};
use model_core::algebra::{Poly, Wave};
use model_core::expr::Expr;
use model_core::symbol::SymbolId;

impl Section<'_> {
    /// What has to differ from zero for a quotient to exist.
    pub(super) fn add_divisor(&mut self, divisor: &Expr<()>) -> Result<(), Refusal> {
        let poly = section::lower(self.certificate, self.question, divisor)?;
        if poly.is_zero() {
            return Err(Refusal::Divisor);
        }
        if !self.add_nonzero(&poly) {
            self.add(Condition::NonZero(poly));
        }
        Ok(())
    }

    /// That a product is not zero, factor by factor; whether it is such a product.
    fn add_nonzero(&mut self, product: &Poly) -> bool {
        let content = product.monomial_content();
        let Some(inverse) = product.without_monomial(&content).recip() else { return false };
        let waves = inverse
            .terms()
            .flat_map(|term| term.poles)
            .map(|pole| Condition::Wave(pole.symbol, if pole.sin_power > 0 { Wave::Sin } else { Wave::Cos }));
        let symbols = content.iter().filter(|(symbol, _)| *symbol != SymbolId::PI);
        let symbols = symbols.map(|(symbol, _)| Condition::NonZero(Poly::symbol(*symbol)));
        let all: Vec<Condition> = waves.chain(symbols).collect();
        all.into_iter().for_each(|condition| self.add(condition));
        true
    }

    /// That a square, given its root if that is known, is not zero. In Coq's syntax, a product that is seen not to be zero then.
    pub(super) fn add_square(&mut self, square: &Poly) -> Result<String, Refusal> {
        let Some(root) = square.square_root() else {
            self.add(Condition::NonZero(square.clone()));
            return Ok(format!("({})", self.poly(square)?));
        };
        if root.as_constant().is_none() && !self.add_nonzero(&root) {
            self.add(Condition::NonZero(root.clone()));
        }
        let root = self.poly(&root)?;
        Ok(format!("(({root}) * ({root}))"))
    }

    /// The root of a square, which is greater than zero, in Coq's syntax.
    pub(super) fn add_root(&mut self, square: &Poly) -> Result<String, Refusal> {
        let mut root = square.square_root().ok_or(Refusal::Divisor)?;
        match root.as_constant() {
            Some(number) if number.is_negative() => root = -&root,
            Some(_) => {}
            None => {
                self.add_nonzero(&root);
                self.add(Condition::Positive(root.clone()));
            }
        }
        self.poly(&root)
    }

    fn add(&mut self, condition: Condition) {
        if !self.conditions.contains(&condition) {
            self.conditions.push(condition);
        }
    }

    /// `sin e <> 0`, `0 < cos e`
    pub(super) fn condition(&self, condition: &Condition) -> Result<String, Refusal> {
        Ok(match condition {
            Condition::Wave(symbol, Wave::Sin) => format!("sin {} <> 0", self.name(*symbol)),
            Condition::Wave(symbol, Wave::Cos) => format!("cos {} <> 0", self.name(*symbol)),
            Condition::NonZero(amount) => format!("{} <> 0", self.poly(amount)?),
            Condition::Positive(amount) => format!("0 < {}", self.poly(amount)?),
        })
    }
}
