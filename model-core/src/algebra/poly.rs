//! [`Poly`]: the canonical form, how it is laid out and kept sorted, sums and multiples.

use std::fmt;
use std::ops::{Add, Neg, Sub};

use super::atom::{Atom, Circle, compare};
use super::rational::Rational;
use crate::symbol::SymbolId;

/// A polynomial with exact rational coefficients in symbols and in sines and cosines of symbols, and in the
/// reciprocals of those: the canonical form of everything in this crate.
///
/// It is a linear combination of a *basis*: products of powers of symbols and, for each symbol as an angle,
/// at most one of cos kθ, sin kθ, 1/cosᵏ θ, sin θ/cosᵏ θ, 1/sinᵏ θ, cos θ/sinᵏ θ. Those products are linearly
/// independent as functions, so two `Poly` are equal as functions of their symbols if and only if they are
/// identical (`==`), with π transcendental and every other symbol free.
///
/// Layout: all atoms of all terms lie in one vector, term after term in the order of terms; no term has
/// storage of its own.
#[derive(Clone, PartialEq, Default)]
pub struct Poly {
    pub(super) atoms: Vec<Atom>,
    pub(super) terms: Vec<Head>,
}

/// A term: its coefficient, never zero, and where its atoms end in [`Poly::atoms`].
#[derive(Clone, PartialEq)]
pub(super) struct Head {
    pub(super) coefficient: Rational,
    pub(super) end: usize,
}

impl Poly {
    /// Zero: no terms.
    #[must_use]
    pub const fn zero() -> Self {
        Self { atoms: Vec::new(), terms: Vec::new() }
    }

    /// One.
    #[must_use]
    pub fn one() -> Self {
        Self::constant(Rational::ONE)
    }

    /// A number.
    #[must_use]
    pub fn constant(value: Rational) -> Self {
        let mut result = Self::zero();
        result.push(value, &[]);
        result
    }

    /// A symbol.
    #[must_use]
    pub fn symbol(symbol: SymbolId) -> Self {
        Self::atom(Atom::power(symbol, 1))
    }

    /// A function of one angle.
    pub(super) fn circle(symbol: SymbolId, function: Circle) -> Self {
        Self::atom(Atom::circle(symbol, function))
    }

    pub(super) fn atom(atom: Atom) -> Self {
        let mut result = Self::zero();
        result.push(Rational::ONE, &[atom]);
        result
    }

    /// Whether this is zero, for all values of its symbols.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// How many terms there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.terms.len()
    }

    /// Whether there are no terms: the same as [`Self::is_zero`].
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.is_zero()
    }

    /// The number, if no symbol occurs.
    #[must_use]
    pub fn as_constant(&self) -> Option<Rational> {
        match self.terms.as_slice() {
            [] => Some(Rational::ZERO),
            [head] if head.end == 0 => Some(head.coefficient.clone()),
            _ => None,
        }
    }

    /// The symbols that occur, in order.
    #[must_use]
    pub fn symbols(&self) -> Vec<SymbolId> {
        let mut symbols: Vec<SymbolId> = self.atoms.iter().map(|atom| atom.symbol()).collect();
        symbols.sort_unstable();
        symbols.dedup();
        symbols
    }

    /// Every coefficient times `factor`.
    #[must_use]
    pub fn scale(&self, factor: &Rational) -> Self {
        if factor.is_zero() {
            return Self::zero();
        }
        let mut result = self.clone();
        for head in &mut result.terms {
            head.coefficient = &head.coefficient * factor;
        }
        result
    }

    /// The sum of many, brought to canonical form once.
    pub(crate) fn sum(addends: &[Self]) -> Self {
        let mut sum = Self::zero();
        for addend in addends {
            for (coefficient, atoms) in addend.iter() {
                sum.push(coefficient.clone(), atoms);
            }
        }
        sum.normalised()
    }

    /// Appends a term; the caller keeps the order of terms, and coefficients from zero.
    pub(super) fn push(&mut self, coefficient: Rational, atoms: &[Atom]) {
        if !coefficient.is_zero() {
            self.atoms.extend_from_slice(atoms);
            self.terms.push(Head { coefficient, end: self.atoms.len() });
        }
    }

    /// The atoms of the term at `index`.
    pub(super) fn key(&self, index: usize) -> &[Atom] {
        let start = if index == 0 { 0 } else { self.terms[index - 1].end };
        &self.atoms[start..self.terms[index].end]
    }

    /// Terms as coefficient and atoms.
    pub(super) fn iter(&self) -> impl Iterator<Item = (&Rational, &[Atom])> {
        self.terms.iter().scan(0, |start, head| {
            let atoms = &self.atoms[*start..head.end];
            *start = head.end;
            Some((&head.coefficient, atoms))
        })
    }

    /// Sorts terms that were pushed in any order, and adds up those of equal atoms.
    pub(super) fn normalised(self) -> Self {
        let ordered = (1..self.terms.len()).all(|i| compare(self.key(i - 1), self.key(i)).is_lt());
        if ordered {
            return self;
        }
        let mut order: Vec<usize> = (0..self.terms.len()).collect();
        order.sort_unstable_by(|&a, &b| compare(self.key(a), self.key(b)));
        let mut result =
            Self { atoms: Vec::with_capacity(self.atoms.len()), terms: Vec::with_capacity(self.terms.len()) };
        let mut at = 0;
        while at < order.len() {
            let key = self.key(order[at]);
            let mut sum = self.terms[order[at]].coefficient.clone();
            at += 1;
            while at < order.len() && self.key(order[at]) == key {
                sum = &sum + &self.terms[order[at]].coefficient;
                at += 1;
            }
            result.push(sum, key);
        }
        result
    }

    /// `self + sign · other` by merging, with `sign` applied to the coefficients of `other`.
    fn merged(&self, other: &Self, sign: impl Fn(&Rational) -> Rational) -> Self {
        let mut result = Self {
            atoms: Vec::with_capacity(self.atoms.len() + other.atoms.len()),
            terms: Vec::with_capacity(self.terms.len() + other.terms.len()),
        };
        let (mut left, mut right) = (self.iter().peekable(), other.iter().peekable());
        loop {
            match (left.peek(), right.peek()) {
                (Some(&(a, left_key)), Some(&(b, right_key))) => match compare(left_key, right_key) {
                    std::cmp::Ordering::Less => {
                        result.push(a.clone(), left_key);
                        left.next();
                    }
                    std::cmp::Ordering::Greater => {
                        result.push(sign(b), right_key);
                        right.next();
                    }
                    std::cmp::Ordering::Equal => {
                        result.push(a + &sign(b), left_key);
                        left.next();
                        right.next();
                    }
                },
                (Some(&(a, key)), None) => {
                    result.push(a.clone(), key);
                    left.next();
                }
                (None, Some(&(b, key))) => {
                    result.push(sign(b), key);
                    right.next();
                }
                (None, None) => return result,
            }
        }
    }
}

impl Add for &Poly {
    type Output = Poly;

    fn add(self, other: &Poly) -> Poly {
        if other.is_zero() {
            return self.clone();
        }
        self.merged(other, Clone::clone)
    }
}

impl Sub for &Poly {
    type Output = Poly;

    fn sub(self, other: &Poly) -> Poly {
        self.merged(other, |value| -value)
    }
}

impl Neg for &Poly {
    type Output = Poly;

    fn neg(self) -> Poly {
        self.scale(&Rational::from(-1))
    }
}

/// For debugging only: symbols by number. [`crate::print`] knows their names.
impl fmt::Debug for Poly {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_zero() {
            return f.write_str("0");
        }
        for (index, (coefficient, atoms)) in self.iter().enumerate() {
            if index > 0 {
                f.write_str(" + ")?;
            }
            write!(f, "{coefficient}")?;
            for atom in atoms {
                write!(f, "·{:?}(s{})", atom.meaning(), atom.symbol().0)?;
            }
        }
        Ok(())
    }
}
