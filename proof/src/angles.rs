//! Sums of angles in a statement: what their sines and cosines are in those of single angles, proved once each.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use super::Refusal;
use super::expanded::{Expanded, HARMONIC_LIMIT};
use super::expression::{self, Term};
use model_core::algebra::{AngleSum, Poly, Rational};
use model_core::expr::{Expr, Node};
use model_core::symbol::SymbolId;

/// The angles that sines and cosines are taken of.
#[derive(Debug, Clone, Default)]
pub(super) struct Angles {
    /// As written, each once, with what they say.
    sums: Vec<(String, Poly)>,
    /// Every symbol in an angle, with its highest multiple.
    highest: BTreeMap<SymbolId, u32>,
}

impl Angles {
    /// Adds an angle as written.
    pub(super) fn add(
        &mut self,
        lower: &dyn Fn(&Expr<()>) -> Result<Poly, Refusal>,
        angle: &Expr<()>,
        leaf: &dyn Fn(&Expr<()>) -> Term,
    ) -> Result<(), Refusal> {
        let sum = lower(angle)?;
        for term in sum.terms() {
            let [(id, 1)] = term.powers.as_slice() else { continue };
            if *id == SymbolId::PI {
                continue;
            }
            let multiple =
                term.coefficient.abs().to_integer().and_then(|n| u32::try_from(n).ok()).unwrap_or(u32::MAX);
            if multiple > HARMONIC_LIMIT {
                return Err(Refusal::Harmonic { multiple });
            }
            let highest = self.highest.entry(*id).or_default();
            *highest = multiple.max(*highest);
        }
        // Zero, or quarter turns: what is put in for a constant has no name of its own.
        let is_number = sum.symbols().iter().all(|id| *id == SymbolId::PI);
        let has_rules = matches!(angle.node, Node::Symbol(_)) || is_multiple(angle);
        let text = expression::argument(angle, leaf);
        if (is_number || !has_rules) && self.sums.iter().all(|(other, _)| *other != text) {
            self.sums.push((text, sum));
        }
        Ok(())
    }

    /// Adds every angle in an expression.
    pub(super) fn add_all(
        &mut self,
        lower: &dyn Fn(&Expr<()>) -> Result<Poly, Refusal>,
        expression: &Expr<()>,
        leaf: &dyn Fn(&Expr<()>) -> Term,
    ) -> Result<(), Refusal> {
        let mut found = Vec::new();
        expression::arguments(expression, &mut found);
        found.into_iter().try_for_each(|angle| self.add(lower, angle, leaf))
    }

    /// The symbols in angles.
    pub(super) fn symbols(&self) -> BTreeSet<SymbolId> {
        self.highest.keys().copied().collect()
    }

    /// The lemmas, and the rules by which a certificate calculates.
    pub(super) fn write(&self, out: &mut String, name: &dyn Fn(SymbolId) -> String) -> Result<(), Refusal> {
        let squares: Vec<String> = self.highest.keys().map(|id| format!("(squares {})", name(*id))).collect();
        let squares = if squares.is_empty() { String::new() } else { format!(" [{}]", squares.join(" ")) };
        let _ = writeln!(out, "Ltac settle ::= first [ring{squares} | field{squares}; nonzero].");
        let _ = writeln!(out, "Ltac level ::= ring{squares}.");
        let mut rules = Vec::new();
        for (id, highest) in &self.highest {
            let a = name(*id);
            for k in 2..=*highest {
                let angle = AngleSum::symbol(*id).times(k)?;
                for (wave, poly) in [("cos", Poly::cos(&angle)), ("sin", Poly::sin(&angle))] {
                    let value = Expanded::new(&poly)?.write(name);
                    let _ = writeln!(out, "Lemma {wave}_of_{k}_{a} : {wave} ({k} * {a}) = {value}.");
                    let _ = writeln!(out, "Proof. next_multiple ({wave} (({} + 1) * {a})). Qed.", k - 1);
                }
                rules.extend(["cos", "sin"].map(|wave| format!("?{wave}_of_{k}_{a}")));
                let _ = writeln!(out, "Ltac multiples ::= rewrite {}.", rules.join(", "));
            }
        }
        for (index, (text, sum)) in self.sums.iter().enumerate() {
            let angle = AngleSum::from_poly(sum)?;
            let by_parts = parts(sum, name);
            for (wave, poly) in [("cos", Poly::cos(&angle)), ("sin", Poly::sin(&angle))] {
                let value = Expanded::new(&poly)?.write(name);
                let _ = writeln!(out, "Lemma {wave}_of_sum_{index} : {wave} {text} = {value}.");
                let _ = writeln!(out, "Proof. sum_of_angles ({wave} ({by_parts})). Qed.");
                rules.push(format!("?{wave}_of_sum_{index}"));
            }
        }
        let rules = if rules.is_empty() { String::new() } else { format!("; rewrite {}", rules.join(", ")) };
        let _ = writeln!(out, "Ltac angles ::= cbv beta delta [tan cot sec csc]{rules}.");
        Ok(())
    }
}

/// Whether an angle is written as a multiple of a symbol: `2*alpha`.
fn is_multiple(angle: &Expr<()>) -> bool {
    let Node::Mul(a, b) = &angle.node else { return false };
    let above_one = |value: &Rational| value.to_integer().is_some_and(|k| k > 1);
    matches!((&a.node, &b.node), (Node::Number(k), Node::Symbol(_)) if above_one(k))
}

/// An angle as a sum of multiples of symbols and of quarter turns.
fn parts(sum: &Poly, name: &dyn Fn(SymbolId) -> String) -> String {
    let mut parts = Vec::new();
    for term in sum.terms() {
        let [(id, 1)] = term.powers.as_slice() else { continue };
        let negative = term.coefficient.is_negative();
        let signed = |text: &str| if negative { format!("- {text}") } else { text.to_owned() };
        let magnitude = term.coefficient.abs();
        if *id == SymbolId::PI {
            let Some(quarters) = (&magnitude + &magnitude).to_integer() else {
                unreachable!("an angle has whole quarter turns, or its sine would have been refused")
            };
            parts.extend((0..quarters / 2).map(|_| signed("PI")));
            parts.extend((quarters % 2 == 1).then(|| signed("(PI / 2)")));
        } else if magnitude.is_one() {
            parts.push(signed(&name(*id)));
        } else {
            parts.push(signed(&format!("({magnitude} * {})", name(*id))));
        }
    }
    if parts.is_empty() { "0".to_owned() } else { parts.join(" + ") }
}
