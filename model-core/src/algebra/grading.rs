//! The grading: degrees in chosen symbols (the errors), and the parts of each degree.

use std::collections::BTreeMap;

use super::atom::Atom;
use super::poly::Poly;
use crate::symbol::SymbolId;

/// A product of powers of symbols and of their sines, cosines and poles: an element of the basis of the canonical form.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct BasisFunction(Vec<Atom>);

impl BasisFunction {
    pub(super) fn atoms(&self) -> &[Atom] {
        &self.0
    }
}

impl Poly {
    /// The highest total power of the chosen symbols in any term; sines and cosines do not count.
    #[must_use]
    pub fn degree_in(&self, chosen: impl Fn(SymbolId) -> bool) -> u32 {
        self.iter().map(|(_, atoms)| degree(atoms, &chosen)).max().unwrap_or(0)
    }

    /// The terms whose total power of the chosen symbols is `order`.
    #[must_use]
    pub fn graded_part(&self, chosen: impl Fn(SymbolId) -> bool, order: u32) -> Self {
        self.filtered(|atoms| degree(atoms, &chosen) == order)
    }

    /// The factor of a monomial: of the terms in which the chosen symbols occur to exactly these powers, what
    /// stands beside them. `monomial` is sorted by symbol.
    #[must_use]
    pub fn coefficient_of(&self, monomial: &[(SymbolId, u32)], chosen: impl Fn(SymbolId) -> bool) -> Self {
        let mut result = Self::zero();
        let mut rest = Vec::new();
        for (coefficient, atoms) in self.iter() {
            let mut wanted = monomial.iter();
            rest.clear();
            let mut matches = true;
            for atom in atoms {
                if atom.is_power() && chosen(atom.symbol()) {
                    matches &= wanted.next() == Some(&(atom.symbol(), atom.number()));
                } else {
                    rest.push(*atom);
                }
            }
            if matches && wanted.next().is_none() {
                result.push(coefficient.clone(), &rest);
            }
        }
        result.normalised()
    }

    /// The monomials of the chosen symbols that occur, each with its factor, in the order of terms.
    #[must_use]
    pub fn collect_by(&self, chosen: impl Fn(SymbolId) -> bool) -> Vec<(Vec<(SymbolId, u32)>, Self)> {
        let mut monomials: Vec<Vec<(SymbolId, u32)>> = Vec::new();
        let mut parts: Vec<Self> = Vec::new();
        let mut rest = Vec::new();
        for (coefficient, atoms) in self.iter() {
            rest.clear();
            let mut monomial = Vec::new();
            for atom in atoms {
                if atom.is_power() && chosen(atom.symbol()) {
                    monomial.push((atom.symbol(), atom.number()));
                } else {
                    rest.push(*atom);
                }
            }
            let index = monomials.iter().position(|other| *other == monomial).unwrap_or_else(|| {
                monomials.push(monomial);
                parts.push(Self::zero());
                parts.len() - 1
            });
            parts[index].push(coefficient.clone(), &rest);
        }
        monomials.into_iter().zip(parts.into_iter().map(Self::normalised)).collect()
    }

    /// The basis functions of the chosen symbols that occur, each with what stands beside it. They are linearly
    /// independent, so this is zero if and only if all the parts are.
    #[must_use]
    pub fn split_by(&self, chosen: impl Fn(SymbolId) -> bool) -> Vec<(BasisFunction, Self)> {
        let mut parts: BTreeMap<BasisFunction, Self> = BTreeMap::new();
        for (coefficient, atoms) in self.iter() {
            let (key, rest): (Vec<Atom>, Vec<Atom>) = atoms.iter().partition(|atom| chosen(atom.symbol()));
            parts.entry(BasisFunction(key)).or_default().push(coefficient.clone(), &rest);
        }
        parts.into_iter().map(|(key, part)| (key, part.normalised())).collect()
    }

    /// The symbols that every term has, with the lowest of their powers.
    #[must_use]
    pub fn monomial_content(&self) -> Vec<(SymbolId, u32)> {
        let powers = |atoms: &[Atom]| -> Vec<(SymbolId, u32)> {
            let powers = atoms.iter().filter(|atom| atom.is_power());
            powers.map(|atom| (atom.symbol(), atom.number())).collect()
        };
        let mut keys = self.iter().map(|(_, atoms)| powers(atoms));
        let first = keys.next().unwrap_or_default();
        keys.fold(first, |common, key| {
            let lowest = |(symbol, n): (SymbolId, u32)| {
                key.iter().find(|(other, _)| *other == symbol).map(|&(_, m)| (symbol, n.min(m)))
            };
            common.into_iter().filter_map(lowest).collect()
        })
    }

    /// This divided by a monomial that divides every term.
    #[must_use]
    pub fn without_monomial(&self, monomial: &[(SymbolId, u32)]) -> Self {
        let mut result = Self::zero();
        for (coefficient, atoms) in self.iter() {
            let key: Vec<Atom> = atoms
                .iter()
                .filter_map(|&atom| {
                    let divisor = monomial.iter().find(|(symbol, _)| *symbol == atom.symbol());
                    match divisor {
                        Some(&(symbol, power)) if atom.is_power() => {
                            let left = atom.number().saturating_sub(power);
                            (left > 0).then(|| Atom::power(symbol, left))
                        }
                        _ => Some(atom),
                    }
                })
                .collect();
            result.push(coefficient.clone(), &key);
        }
        result.normalised()
    }

    /// The terms whose atoms satisfy a condition.
    fn filtered(&self, keep: impl Fn(&[Atom]) -> bool) -> Self {
        let mut result = Self::zero();
        for (coefficient, atoms) in self.iter().filter(|(_, atoms)| keep(atoms)) {
            result.push(coefficient.clone(), atoms);
        }
        result
    }
}

fn degree(atoms: &[Atom], chosen: &impl Fn(SymbolId) -> bool) -> u32 {
    atoms
        .iter()
        .filter(|atom| atom.is_power() && chosen(atom.symbol()))
        .fold(0, |sum, atom| sum.saturating_add(atom.number()))
}
