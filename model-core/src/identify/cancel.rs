//! Cancelling: the short quotient of constants behind a long one.
//!
//! Elimination leaves quotients such as (cos²a − 1)/sin a. A short sum that could be the same, times a few sines, cosines and
//! lengths below, is fitted to its values modulo a large prime; that it is the same is then decided in the canonical form.

use super::modular::{Place, difference, inverse, product, simple};
use super::{Ratio, Row};
use crate::algebra::{AngleSum, Poly, Rational};
use crate::symbol::SymbolId;

/// Terms of a short sum that are tried at most.
const BASIS: usize = 120;
/// Terms above and below together that nobody needs to have fewer of.
const SHORT: usize = 2;

/// The same quotient, cancelled if a short one is found.
pub(super) fn cancelled(ratio: &Ratio) -> Ratio {
    let Ratio { numerator, denominator } = ratio;
    if numerator.len() + denominator.len() <= SHORT {
        return ratio.clone();
    }
    fitted(numerator, denominator)
        .filter(|short| length(short) < length(ratio))
        .unwrap_or_else(|| ratio.clone())
}

/// A row over its pivot, so that every entry is short; the row itself if that makes nothing shorter.
pub(super) fn cancelled_row(row: &Row, pivot: usize) -> Row {
    let size = |row: &Row| row.iter().map(|(_, entry)| entry.len()).sum::<usize>();
    let Some((_, below)) = row.iter().find(|(column, _)| *column == pivot) else { return row.clone() };
    if size(row) <= SHORT.max(row.len()) {
        return row.clone();
    }
    let quotients: Option<Vec<(usize, Ratio)>> =
        row.iter().map(|(column, entry)| Some((*column, fitted(entry, below)?))).collect();
    let Some(quotients) = quotients else { return row.clone() };
    let mut common: Vec<&Poly> = Vec::new();
    for (_, quotient) in &quotients {
        if quotient.denominator.as_constant().is_none() && !common.contains(&&quotient.denominator) {
            common.push(&quotient.denominator);
        }
    }
    let entry = |quotient: &Ratio| {
        let others = common.iter().filter(|other| ***other != quotient.denominator);
        others.fold(quotient.numerator.clone(), |above, other| &above * other)
    };
    let short: Row = quotients.iter().map(|(column, quotient)| (*column, entry(quotient))).collect();
    if size(&short) < size(row) { short } else { row.clone() }
}

fn length(ratio: &Ratio) -> usize {
    ratio.numerator.len() + ratio.denominator.len()
}

/// A quotient of a short sum and a product of at most two functions.
fn fitted(above: &Poly, below: &Poly) -> Option<Ratio> {
    let one = || vec![Poly::one()];
    let (angles, sizes) = constants(above, below);
    let mut basis = one();
    for &angle in &angles {
        let functions = functions(angle);
        let with = basis.iter().flat_map(|part| functions.iter().map(move |function| part * function));
        basis = basis.iter().cloned().chain(with).collect();
        if basis.len() > BASIS {
            return None;
        }
    }
    let mut divisors: Vec<Poly> = angles.iter().flat_map(|&angle| functions(angle)).collect();
    if !sizes.is_empty() {
        let sizes: Vec<Poly> = sizes.into_iter().map(Poly::symbol).collect();
        let with = basis.iter().flat_map(|part| sizes.iter().map(move |size| part * size));
        basis = basis.iter().cloned().chain(with).collect();
        divisors.extend(sizes);
    }
    if basis.len() > BASIS {
        return None;
    }
    let pairs =
        divisors.iter().enumerate().flat_map(|(at, one)| divisors[at..].iter().map(move |two| one * two));
    let divisors: Vec<Poly> = one().into_iter().chain(divisors.iter().cloned()).chain(pairs).collect();
    solutions(above, below, &basis, &divisors)?
        .into_iter()
        .zip(divisors)
        .filter_map(|(factors, denominator)| {
            let parts: Vec<Poly> =
                basis.iter().zip(factors?).map(|(part, factor)| part.scale(&factor)).collect();
            Some(Ratio { numerator: Poly::sum(&parts), denominator })
        })
        .find(|ratio| above * &ratio.denominator == &ratio.numerator * below)
}

/// The constants as angles, and those that are there by themselves.
fn constants(above: &Poly, below: &Poly) -> (Vec<SymbolId>, Vec<SymbolId>) {
    let (mut angles, mut sizes) = (Vec::new(), Vec::new());
    for term in above.terms().chain(below.terms()) {
        angles.extend(term.waves.iter().map(|wave| wave.symbol));
        angles.extend(term.poles.iter().map(|pole| pole.symbol));
        sizes.extend(term.powers.iter().map(|(symbol, _)| *symbol));
    }
    for list in [&mut angles, &mut sizes] {
        list.sort_unstable();
        list.dedup();
    }
    (angles, sizes)
}

fn functions(angle: SymbolId) -> [Poly; 2] {
    let angle = AngleSum::symbol(angle);
    [Poly::cos(&angle), Poly::sin(&angle)]
}

/// For each divisor the factors of the basis that make its sum the quotient times the divisor, at more places than there are
/// factors; `None` inside where there are none. `None` where a place cannot be used.
fn solutions(
    above: &Poly,
    below: &Poly,
    basis: &[Poly],
    divisors: &[Poly],
) -> Option<Vec<Option<Vec<Rational>>>> {
    /// Places beyond the number of unknowns, which a wrong sum does not pass.
    const MORE: usize = 3;
    let mut equations: Vec<Vec<u64>> = Vec::new();
    for number in 1..=basis.len() + MORE {
        let place = Place(number as u64);
        let quotient = product(place.value(above)?, inverse(place.value(below).filter(|value| *value != 0)?));
        let mut equation: Vec<u64> = basis.iter().map(|part| place.value(part)).collect::<Option<_>>()?;
        for divisor in divisors {
            equation.push(product(quotient, place.value(divisor)?));
        }
        equations.push(equation);
    }
    let unknowns = basis.len();
    for column in 0..unknowns {
        let place = (column..equations.len()).find(|&row| equations[row][column] != 0)?;
        equations.swap(column, place);
        let factor = inverse(equations[column][column]);
        equations[column].iter_mut().for_each(|value| *value = product(*value, factor));
        let pivot = equations[column].clone();
        for (row, equation) in equations.iter_mut().enumerate() {
            let factor = equation[column];
            if row != column && factor != 0 {
                for (value, other) in equation.iter_mut().zip(&pivot).skip(column) {
                    *value = difference(*value, product(factor, *other));
                }
            }
        }
    }
    let solution = |divisor: usize| -> Option<Vec<Rational>> {
        let column = unknowns + divisor;
        let fits = equations[unknowns..].iter().all(|equation| equation[column] == 0);
        fits.then(|| equations[..unknowns].iter().map(|equation| simple(equation[column])).collect())
            .flatten()
    };
    Some((0..divisors.len()).map(solution).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_less_one_over_a_cosine_is_cancelled() {
        let angle = AngleSum::symbol(SymbolId(3));
        let (cosine, sine) = angle.cos_sin();
        let long = Ratio {
            numerator: &(&cosine * &cosine) - &Poly::one(),
            denominator: &(&sine * &cosine) * &cosine,
        };
        let short = cancelled(&long);
        assert!(length(&short) == 3, "{short:?}");
        assert_eq!(&short.numerator * &long.denominator, &long.numerator * &short.denominator);
    }
}
