//! Square roots that are canonical forms themselves: of x² + y², which a horizontal angle divides by, where the way leads
//! through turns about single angles.

use super::angle::AngleSum;
use super::poly::Poly;
use super::rational::Rational;
use crate::symbol::SymbolId;

/// Angles in one function beyond which no root is looked for.
const MOST_ANGLES: usize = 3;
/// The highest multiple of an angle in a root.
const HIGHEST_MULTIPLE: u32 = 4;
/// Functions of angles that are tried, at most, and sums of so many of them.
const MOST_WAVES: usize = 400;
const MOST_ADDENDS: usize = 4;

impl Poly {
    /// A polynomial whose square this is, the first of its terms positive; `None` if none is found. What is found is
    /// multiplied out and compared, so that it is right.
    ///
    /// Found are sums of a few terms, each a number times powers of symbols times sines and cosines of sums of up to
    /// three angles, if the square of each term can be told by its powers of symbols.
    #[must_use]
    pub fn square_root(&self) -> Option<Self> {
        if self.is_zero() {
            return Some(Self::zero());
        }
        // By powers of symbols: squares have even ones.
        let mut roots: Vec<Self> = Vec::new();
        for (monomial, factor) in self.collect_by(|_| true) {
            if monomial.iter().any(|(_, power)| power % 2 == 1) {
                continue;
            }
            let Some(root) = root_of_waves(&factor) else { continue };
            let powers = monomial.iter().fold(Self::one(), |product, &(symbol, power)| {
                (0..power / 2).fold(product, |product, _| &product * &Self::symbol(symbol))
            });
            roots.push(&powers * &root);
        }
        if roots.is_empty() || roots.len() > MOST_ADDENDS {
            return None;
        }
        let (first, others) = roots.split_first()?;
        (0..1_u32 << others.len()).find_map(|signs| {
            let root = others.iter().enumerate().fold(first.clone(), |sum, (index, other)| {
                if signs >> index & 1 == 0 { &sum + other } else { &sum - other }
            });
            (&root * &root == *self).then(|| positive(root))
        })
    }
}

/// The root with a positive first term.
fn positive(root: Poly) -> Poly {
    if root.terms.first().is_some_and(|head| head.coefficient.is_negative()) { -&root } else { root }
}

/// The root of a polynomial of sines and cosines alone: a number times one or two of them.
fn root_of_waves(square: &Poly) -> Option<Poly> {
    if let Some(number) = square.as_constant() {
        return number.square_root().map(Poly::constant);
    }
    let waves = waves(square)?;
    let scaled = |root: &Poly| -> Option<Poly> {
        let candidate = root * root;
        let (head, wanted) = (candidate.terms.first()?, square.terms.first()?);
        let factor = &wanted.coefficient * &head.coefficient.recip()?;
        let number = factor.square_root()?;
        (candidate.scale(&factor) == *square).then(|| root.scale(&number))
    };
    if let Some(root) = waves.iter().find_map(&scaled) {
        return Some(root);
    }
    let products =
        waves.iter().enumerate().flat_map(|(at, one)| waves[at..].iter().map(move |other| one * other));
    products.take(MOST_WAVES).find_map(|product| scaled(&product))
}

/// Sines and cosines of sums of multiples of the angles that occur.
fn waves(square: &Poly) -> Option<Vec<Poly>> {
    let symbols = square.symbols();
    if symbols.len() > MOST_ANGLES {
        return None;
    }
    let mut sums: Vec<Vec<(SymbolId, i64)>> = vec![Vec::new()];
    for symbol in symbols {
        let highest = i64::from((square.highest_harmonic(symbol) / 2).min(HIGHEST_MULTIPLE));
        let longer: Vec<_> = sums
            .iter()
            .flat_map(|sum| {
                let lowest = if sum.is_empty() { 1 } else { -highest };
                let multiples = (lowest..=highest).filter(|&multiple| multiple != 0);
                multiples.map(move |multiple| [sum.as_slice(), &[(symbol, multiple)]].concat())
            })
            .collect();
        sums.extend(longer);
        if sums.len() > MOST_WAVES {
            return None;
        }
    }
    sums.sort_by_key(Vec::len);
    let mut waves = Vec::new();
    for sum in sums.iter().filter(|sum| !sum.is_empty()) {
        let amount = sum.iter().fold(Poly::zero(), |total, &(symbol, multiple)| {
            &total + &Poly::symbol(symbol).scale(&Rational::from(multiple))
        });
        let (cosine, sine) = AngleSum::from_poly(&amount).ok()?.cos_sin();
        waves.extend([cosine, sine]);
    }
    Some(waves)
}
