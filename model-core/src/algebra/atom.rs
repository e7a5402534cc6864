//! Atoms: what a term is a product of. One word each, so that a term is a slice of words.
//!
//! An atom is a power of a symbol, or one element of the basis of functions of one angle
//! ([`Circle`]). Atoms of a term are sorted; a term has at most one power and one circle function
//! of each symbol.

use std::cmp::Ordering;

use crate::symbol::SymbolId;

/// One element of the basis of the functions of one angle θ, other than the constant 1.
///
/// Together with 1 these are a basis of the polynomials in sin θ, cos θ, 1/sin θ and 1/cos θ over the
/// rationals: a Fourier series, and the partial fractions at the zeros of the sine and of the cosine.
/// (Modulo sin θ, every function is a combination of 1 and cos θ; modulo cos θ, of 1 and sin θ. And
/// 1/(sin θ cos θ) = tan θ + cot θ, so no mixed fraction is needed.)
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Circle {
    /// cos kθ, k ≥ 1
    Cos(u32),
    /// sin kθ, k ≥ 1
    Sin(u32),
    /// 1 / cosᵏ θ, k ≥ 1
    OverCos(u32),
    /// sin θ / cosᵏ θ, k ≥ 1
    SinOverCos(u32),
    /// 1 / sinᵏ θ, k ≥ 1
    OverSin(u32),
    /// cos θ / sinᵏ θ, k ≥ 1
    CosOverSin(u32),
}

/// What an atom says of its symbol.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Meaning {
    /// The symbol to a power ≥ 1.
    Power(u32),
    /// A function of the symbol as an angle.
    Circle(Circle),
}

/// A packed atom: symbol (16 bits), kind (16 bits), complement of the number (32 bits).
///
/// The complement sorts high powers before low ones, which makes the order of terms a monomial order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Atom(u64);

const POWER: u16 = 0;

impl Atom {
    fn pack(symbol: SymbolId, kind: u16, number: u32) -> Self {
        Self(u64::from(symbol.0) << 48 | u64::from(kind) << 32 | u64::from(u32::MAX - number))
    }

    pub(crate) fn power(symbol: SymbolId, power: u32) -> Self {
        Self::pack(symbol, POWER, power)
    }

    pub(crate) fn circle(symbol: SymbolId, function: Circle) -> Self {
        let (kind, number) = match function {
            Circle::Cos(k) => (1, k),
            Circle::Sin(k) => (2, k),
            Circle::OverCos(k) => (3, k),
            Circle::SinOverCos(k) => (4, k),
            Circle::OverSin(k) => (5, k),
            Circle::CosOverSin(k) => (6, k),
        };
        Self::pack(symbol, kind, number)
    }

    pub(crate) fn symbol(self) -> SymbolId {
        SymbolId((self.0 >> 48) as u16)
    }

    pub(crate) fn number(self) -> u32 {
        u32::MAX - self.0 as u32
    }

    pub(crate) fn is_power(self) -> bool {
        self.0 >> 32 & 0xffff == u64::from(POWER)
    }

    pub(crate) fn meaning(self) -> Meaning {
        let number = self.number();
        Meaning::Circle(match self.0 >> 32 & 0xffff {
            1 => Circle::Cos(number),
            2 => Circle::Sin(number),
            3 => Circle::OverCos(number),
            4 => Circle::SinOverCos(number),
            5 => Circle::OverSin(number),
            6 => Circle::CosOverSin(number),
            _ => return Meaning::Power(number),
        })
    }

    /// Whether two atoms are the same kind of thing (power or circle function) of the same symbol, so that
    /// their product is not just both of them.
    pub(crate) fn meets(self, other: Self) -> bool {
        self.symbol() == other.symbol() && self.is_power() == other.is_power()
    }
}

/// The order of terms: a monomial order, so that multiplying by something new keeps it.
///
/// A term that ends sorts after one that goes on, as if infinity followed its last atom.
pub(crate) fn compare(a: &[Atom], b: &[Atom]) -> Ordering {
    for (x, y) in a.iter().zip(b) {
        match x.cmp(y) {
            Ordering::Equal => {}
            unequal => return unequal,
        }
    }
    b.len().cmp(&a.len())
}
