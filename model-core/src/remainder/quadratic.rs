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

    /// The parts of some errors only.
    pub(super) fn only(&self, keep: impl Fn(SymbolId) -> bool) -> Self {
        let mut first = Linear::default();
        for &(error, size) in self.first.parts.iter().filter(|(error, _)| keep(*error)) {
            first.push(error, size);
        }
        let second = self.second.iter().filter(|(one, other, _)| keep(*one) && keep(*other));
        Self { first, second: second.copied().collect(), ..*self }
    }

    /// Whether nothing is there.
    pub(super) fn is_zero(&self) -> bool {
        self.nominal.is_zero() && self.first.parts.is_empty() && self.second.is_empty() && self.tail.is_zero()
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

/// How much each unordered pair of some errors contributes; for information, so without directed rounding.
#[derive(Debug, Clone)]
pub(super) struct PairTable {
    /// In order.
    errors: Vec<SymbolId>,
    /// A row for each error; of pairs the one with the earlier error first.
    values: Vec<f64>,
}

impl PairTable {
    pub(super) fn new(errors: &[SymbolId]) -> Self {
        Self { errors: errors.to_vec(), values: vec![0.0; errors.len() * errors.len()] }
    }

    fn add(&mut self, one: SymbolId, other: SymbolId, value: f64) {
        let place = |error: SymbolId| self.errors.binary_search(&error).ok();
        if let (Some(low), Some(high)) = (place(one.min(other)), place(one.max(other))) {
            self.values[low * self.errors.len() + high] += value;
        }
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
        let count = self.errors.len();
        let places = self.values.iter().enumerate().filter(|(_, value)| **value > 0.0);
        places.map(move |(index, &value)| (self.errors[index / count], self.errors[index % count], value))
    }
}
