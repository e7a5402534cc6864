//! Which of many equations are independent: their values at one place modulo a large prime.
//!
//! Rows that are independent there are independent as functions, which proves that they are worth eliminating. That the
//! others depend on them is likely only, and is decided afterwards in the canonical form: see
//! [`super::elimination`].

use crate::algebra::{Poly, Rational, Wave};
use crate::symbol::SymbolId;

/// A linear combination of unknowns: columns in order, no coefficient zero.
pub(super) type Row = Vec<(usize, Poly)>;

/// 2⁶¹ − 1.
pub(super) const PRIME: u64 = (1 << 61) - 1;

/// The numbers of the rows that do not depend on those before them.
pub(super) fn independent(rows: &[Row], columns: usize) -> Vec<usize> {
    let place = Place(0);
    let mut chosen = Vec::new();
    // Each with its pivot, where it is one.
    let mut reduced: Vec<(usize, Vec<u64>)> = Vec::new();
    for (number, row) in rows.iter().enumerate() {
        if reduced.len() == columns {
            break;
        }
        let mut values = vec![0; columns];
        let evaluated: Option<Vec<(usize, u64)>> =
            row.iter().map(|(column, entry)| Some((*column, place.value(entry)?))).collect();
        // A denominator that vanishes here says nothing; the elimination decides.
        let Some(evaluated) = evaluated else {
            chosen.push(number);
            continue;
        };
        for (column, value) in evaluated {
            values[column] = value;
        }
        for (pivot, other) in &reduced {
            let factor = values[*pivot];
            if factor != 0 {
                for (value, other) in values.iter_mut().zip(other) {
                    *value = difference(*value, product(factor, *other));
                }
            }
        }
        let Some(pivot) = values.iter().position(|&value| value != 0) else { continue };
        let inverse = inverse(values[pivot]);
        for value in &mut values {
            *value = product(*value, inverse);
        }
        reduced.push((pivot, values));
        chosen.push(number);
    }
    chosen
}

/// A value for every symbol and for its sine and cosine, which are those of one angle; another place for each number.
pub(super) struct Place(pub u64);

impl Place {
    pub(super) fn value(&self, poly: &Poly) -> Option<u64> {
        let mut sum = 0;
        for term in poly.terms() {
            let mut value = residue(&term.coefficient)?;
            for &(symbol, exponent) in &term.powers {
                value = product(value, power(self.symbol(symbol), u64::from(exponent)));
            }
            for wave in &term.waves {
                let (cosine, sine) = self.wave(wave.symbol, wave.harmonic);
                let factor = match wave.wave {
                    Wave::Cos => cosine,
                    Wave::Sin => sine,
                };
                value = product(value, factor);
            }
            for pole in &term.poles {
                let (cosine, sine) = self.wave(pole.symbol, 1);
                for (below, exponent) in [(cosine, pole.cos_power), (sine, pole.sin_power)] {
                    if exponent > 0 && below == 0 {
                        return None;
                    }
                    value = product(value, power(inverse(below), u64::from(exponent)));
                }
            }
            sum = (sum + value) % PRIME;
        }
        Some(sum)
    }

    fn symbol(&self, symbol: SymbolId) -> u64 {
        scattered((self.0 << 20) | (2 * u64::from(symbol.0))) % PRIME
    }

    /// The cosine and sine of a multiple, from t = tan of half the angle.
    fn wave(&self, symbol: SymbolId, harmonic: u32) -> (u64, u64) {
        let t = scattered((self.0 << 20) | (2 * u64::from(symbol.0) + 1)) % PRIME;
        let square = product(t, t);
        let over = inverse((1 + square) % PRIME);
        let one = (product(difference(1, square), over), product(product(2, t), over));
        let times = |a: (u64, u64), b: (u64, u64)| {
            (
                difference(product(a.0, b.0), product(a.1, b.1)),
                (product(a.0, b.1) + product(a.1, b.0)) % PRIME,
            )
        };
        let (mut result, mut base, mut left) = ((1, 0), one, harmonic);
        while left > 0 {
            if left & 1 == 1 {
                result = times(result, base);
            }
            base = times(base, base);
            left >>= 1;
        }
        result
    }
}

/// SplitMix64: places without any relation that a formula could have.
///
/// Source: Steele, Lea, Flood, "Fast splittable pseudorandom number generators" (2014).
pub(super) fn scattered(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Numerators and denominators up to here are looked for behind a residue.
const SIMPLE: u64 = 1000;

/// The fraction of small numbers that a residue stands for, if there is one.
pub(super) fn simple(residue: u64) -> Option<Rational> {
    (1..=SIMPLE).find_map(|below| {
        let above = product(residue, below);
        let (size, is_negative) = if above <= SIMPLE { (above, false) } else { (PRIME - above, true) };
        let size = i64::try_from(size).ok().filter(|size| size.unsigned_abs() <= SIMPLE)?;
        Rational::new(if is_negative { -size } else { size }, i64::try_from(below).ok()?)
    })
}

/// `None` if the denominator vanishes.
pub(super) fn residue(value: &Rational) -> Option<u64> {
    let (above, below) = value.residues(PRIME);
    (below != 0).then(|| product(above, inverse(below)))
}

pub(super) fn product(a: u64, b: u64) -> u64 {
    let wide = u128::from(a) * u128::from(b);
    // 2⁶¹ is 1.
    let (low, high) = ((wide as u64) & PRIME, (wide >> 61) as u64);
    (low + high) % PRIME
}

pub(super) fn difference(a: u64, b: u64) -> u64 {
    (a + PRIME - b) % PRIME
}

pub(super) fn power(base: u64, exponent: u64) -> u64 {
    let (mut result, mut base, mut left) = (1, base, exponent);
    while left > 0 {
        if left & 1 == 1 {
            result = product(result, base);
        }
        base = product(base, base);
        left >>= 1;
    }
    result
}

/// Of a number that is not 0, by Fermat.
pub(super) fn inverse(value: u64) -> u64 {
    power(value, PRIME - 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn residues_obey_the_rules_of_numbers_and_waves() {
        assert_eq!(product(inverse(12_345), 12_345), 1);
        assert_eq!(product(PRIME - 1, PRIME - 1), 1);
        let (cosine, sine) = Place(0).wave(SymbolId(7), 1);
        assert_eq!((product(cosine, cosine) + product(sine, sine)) % PRIME, 1);
        let (_, twice) = Place(0).wave(SymbolId(7), 2);
        assert_eq!(twice, product(2, product(cosine, sine)));
        let third = Rational::new(-1, 3).map(|third| residue(&third));
        assert_eq!(third.flatten().map(|third| product(third, 3)), Some(PRIME - 1));
    }
}
