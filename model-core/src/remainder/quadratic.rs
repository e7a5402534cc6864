//! What amounts contribute by degree in the errors, error by error and pair by pair.

use super::domain::{Domain, DomainError};
use super::upper::Upper;
use crate::algebra::Poly;
use crate::chain::Chain;
use crate::symbol::SymbolId;

use super::majorant::Majorant;

/// Bounds on an amount, by degree in the errors.
#[derive(Debug, Clone, Default)]
pub(super) struct Amount {
    pub(super) nominal: Upper,
    pub(super) first: Linear,
    /// Products of two errors.
    pub(super) second: Vec<(SymbolId, SymbolId, Upper)>,
    pub(super) tail: Upper,
}

/// Bounds on a part of degree one: each error with what it contributes, and the sum.
#[derive(Debug, Clone, Default)]
pub(super) struct Linear {
    pub(super) parts: Vec<(SymbolId, Upper)>,
    pub(super) sum: Upper,
}

/// A contribution of degree two.
pub(super) enum Quadratic<'a> {
    /// `scale · left · right`
    Product { scale: Upper, left: &'a Linear, right: &'a Linear },
    /// `scale · Σ pairs`
    Pairs { scale: Upper, pairs: &'a [(SymbolId, SymbolId, Upper)] },
}

impl Amount {
    /// Bounds on an amount over a domain.
    pub(super) fn new(
        chain: &Chain,
        amount: &Poly,
        is_error: &[bool],
        domain: &Domain,
    ) -> Result<Self, DomainError> {
        let mut result = Self::default();
        for term in amount.terms() {
            let size = domain.size(chain, &term)?;
            let mut errors = term
                .powers
                .iter()
                .filter(|(symbol, _)| is_error[symbol.index()])
                .flat_map(|&(symbol, power)| std::iter::repeat_n(symbol, power as usize));
            match (errors.next(), errors.next(), errors.next()) {
                (None, _, _) => result.nominal = result.nominal + size,
                (Some(error), None, _) => result.first.push(error, size),
                (Some(one), Some(other), None) => result.second.push((one, other, size)),
                _ => result.tail = result.tail + size,
            }
        }
        Ok(result)
    }

    pub(super) fn second_sum(&self) -> Upper {
        self.second.iter().map(|&(_, _, size)| size).sum()
    }

    /// The amount as a majorant series.
    pub(super) fn majorant(&self) -> Majorant {
        Majorant { degree: [self.nominal, self.first.sum, self.second_sum()], tail: self.tail }
    }
}

impl Linear {
    pub(super) fn push(&mut self, error: SymbolId, size: Upper) {
        self.parts.push((error, size));
        self.sum = self.sum + size;
    }
}

impl Quadratic<'_> {
    pub(super) fn size(&self) -> Upper {
        match self {
            Self::Product { scale, left, right } => *scale * left.sum * right.sum,
            Self::Pairs { scale, pairs } => *scale * pairs.iter().map(|&(_, _, size)| size).sum(),
        }
    }
}

/// How much each unordered pair of errors contributes; for information, so without directed rounding.
#[derive(Debug, Clone)]
pub(super) struct PairTable {
    symbols: usize,
    values: Vec<f64>,
}

impl PairTable {
    pub(super) fn new(symbols: usize) -> Self {
        Self { symbols, values: vec![0.0; symbols * symbols] }
    }

    fn add(&mut self, one: SymbolId, other: SymbolId, value: f64) {
        let (low, high) = (one.min(other).index(), one.max(other).index());
        self.values[low * self.symbols + high] += value;
    }

    pub(super) fn add_table(&mut self, weight: f64, other: &Self) {
        if weight != 0.0 {
            for (value, more) in self.values.iter_mut().zip(&other.values) {
                *value += weight * more;
            }
        }
    }

    pub(super) fn add_product(&mut self, weight: f64, left: &[(SymbolId, f64)], right: &[(SymbolId, f64)]) {
        for &(one, a) in left {
            for &(other, b) in right {
                self.add(one, other, weight * a * b);
            }
        }
    }

    pub(super) fn add_quadratic(&mut self, weight: f64, quadratic: &Quadratic) {
        match quadratic {
            Quadratic::Product { scale, left, right } => {
                for &(one, a) in &left.parts {
                    for &(other, b) in &right.parts {
                        self.add(one, other, weight * scale.get() * a.get() * b.get());
                    }
                }
            }
            Quadratic::Pairs { scale, pairs } => {
                for &(one, other, size) in *pairs {
                    self.add(one, other, weight * scale.get() * size.get());
                }
            }
        }
    }

    /// The pairs that contribute.
    pub(super) fn entries(&self) -> impl Iterator<Item = (SymbolId, SymbolId, f64)> + '_ {
        let id = |index: usize| SymbolId(u16::try_from(index).unwrap_or(u16::MAX));
        self.values
            .iter()
            .enumerate()
            .filter(|(_, value)| **value > 0.0)
            .map(move |(index, &value)| (id(index / self.symbols), id(index % self.symbols), value))
    }
}
