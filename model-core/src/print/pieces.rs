//! Functions of angles as a reader would write them: of a few exact forms, the shortest.
//!
//! The canonical form of sin(α + β) is sin α cos β + cos α sin β, that of cos²β is 1/2 + cos 2β/2. Here a function is
//! written as it is, with multiple angles as powers, or with products of several angles as functions of their sums; all of
//! these are the same function, and the shortest is printed. What a paper writes itself counts as short.

use std::collections::BTreeMap;

use crate::algebra::{Pole, Poly, Rational, Term, Wave};
use crate::symbol::SymbolId;

/// Whole multiples of symbols, by symbol; the first is positive.
pub(super) type Angle = Vec<(SymbolId, i32)>;

/// The paper's own way of writing: what it abbreviates, and which sums of angles it writes.
#[derive(Debug, Clone, Default)]
pub struct Hand {
    abbreviations: Vec<(Angle, bool, String)>,
    sums: Vec<Angle>,
}

impl Hand {
    /// Writes the sine (or cosine) of a sum of angles in this way: `s_{12}`.
    pub fn abbreviate(&mut self, angle: &[(SymbolId, i32)], is_sine: bool, printed: &str) {
        self.abbreviations.push((angle.to_vec(), is_sine, printed.to_owned()));
        self.sums.push(angle.to_vec());
    }

    /// Prefers functions of this sum of angles.
    pub fn prefer(&mut self, angle: &[(SymbolId, i32)]) {
        self.sums.push(angle.to_vec());
    }

    pub(super) fn abbreviation(&self, wave: &Function) -> Option<&str> {
        let found = self
            .abbreviations
            .iter()
            .find(|(angle, is_sine, _)| *angle == wave.angle && *is_sine == wave.is_sine);
        found.map(|(.., printed)| printed.as_str())
    }
}

/// A power of the sine or cosine of a sum of angles.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Function {
    pub angle: Angle,
    pub is_sine: bool,
    pub power: u32,
}

/// A number times functions of angles.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Piece {
    pub coefficient: Rational,
    pub functions: Vec<Function>,
    /// Denominators, each with whether the other function stands above.
    pub poles: Vec<(Pole, bool)>,
}

impl Piece {
    fn of_term(term: &Term) -> Self {
        let has_pole = |symbol| term.poles.iter().any(|pole| pole.symbol == symbol);
        let functions = term.waves.iter().filter(|wave| !has_pole(wave.symbol)).map(|wave| Function {
            angle: vec![(wave.symbol, i32::try_from(wave.harmonic).unwrap_or(i32::MAX))],
            is_sine: wave.wave == Wave::Sin,
            power: 1,
        });
        let poles = term.poles.iter().map(|pole| {
            let over = term.waves.iter().any(|wave| wave.symbol == pole.symbol);
            (*pole, over)
        });
        Self { coefficient: term.coefficient.clone(), functions: functions.collect(), poles: poles.collect() }
    }

    /// How much there is to read.
    fn cost(&self, hand: &Hand) -> usize {
        let functions = self.functions.iter().map(|function| {
            let sum = function.angle.len();
            let written = if sum > 1 && hand.sums.contains(&function.angle) { 1 } else { 1 + sum };
            let multiple = function.angle.iter().any(|(_, n)| n.unsigned_abs() > 1);
            written + usize::from(multiple) + usize::from(function.power > 1)
        });
        let number = usize::from(!self.coefficient.abs().is_one());
        2 + number + functions.sum::<usize>() + 3 * self.poles.len()
    }
}

/// Symbols of which sums are tried.
const SYMBOLS: usize = 8;
/// The highest multiple that is written as a power.
const HARMONIC: i32 = 4;
/// Terms above which a function is written as it is: nobody reads it for its form.
const TERMS: usize = 64;

/// The shortest of a few ways of writing a function of angles.
pub(super) fn shortest(angular: &Poly, hand: &Hand) -> Vec<Piece> {
    let plain: Vec<Piece> = angular.terms().map(|term| Piece::of_term(&term)).collect();
    if plain.len() > TERMS {
        return plain;
    }
    let mut symbols: Vec<SymbolId> =
        plain.iter().flat_map(|piece| piece.functions.iter().map(|function| function.angle[0].0)).collect();
    symbols.sort_unstable();
    symbols.dedup();
    symbols.retain(|symbol| {
        plain.iter().all(|piece| piece.poles.iter().all(|(pole, _)| pole.symbol != *symbol))
    });
    let mut best = plain.clone();
    let cost = |pieces: &[Piece]| pieces.iter().map(|piece| piece.cost(hand)).sum::<usize>();
    let mut least = cost(&best);
    let mut consider = |pieces: Vec<Piece>| {
        let needed = cost(&pieces);
        if needed < least {
            (best, least) = (pieces, needed);
        }
    };
    for in_cosines in [true, false] {
        consider(in_powers(&plain, &symbols, in_cosines));
    }
    if symbols.len() <= SYMBOLS {
        for subset in subsets(&symbols) {
            consider(in_sums(&plain, &subset));
        }
    }
    best
}

/// The pairs and triples of symbols, and all of them.
fn subsets(symbols: &[SymbolId]) -> Vec<Vec<SymbolId>> {
    let mut subsets = Vec::new();
    for (i, &a) in symbols.iter().enumerate() {
        for (j, &b) in symbols.iter().enumerate().skip(i + 1) {
            subsets.push(vec![a, b]);
            subsets.extend(symbols[j + 1..].iter().map(|&c| vec![a, b, c]));
        }
    }
    if symbols.len() > 3 {
        subsets.push(symbols.to_vec());
    }
    subsets
}

/// Pieces without their numbers, and these.
type Sum = BTreeMap<(Vec<Function>, Vec<(Pole, bool)>), Rational>;

fn collected(pieces: impl IntoIterator<Item = Piece>) -> Vec<Piece> {
    let mut sum = Sum::new();
    // In the order in which they come first.
    let mut order = Vec::new();
    for piece in pieces {
        let key = (piece.functions, piece.poles);
        let known = sum.entry(key.clone()).or_insert_with(|| {
            order.push(key);
            Rational::ZERO
        });
        *known = &*known + &piece.coefficient;
    }
    let piece = |key: (Vec<Function>, Vec<(Pole, bool)>)| {
        let coefficient = sum.get(&key)?.clone();
        let (functions, poles) = key;
        (!coefficient.is_zero()).then_some(Piece { coefficient, functions, poles })
    };
    order.into_iter().filter_map(piece).collect()
}

/// Products of functions of some symbols as functions of sums of these.
fn in_sums(pieces: &[Piece], symbols: &[SymbolId]) -> Vec<Piece> {
    let mut found = Vec::new();
    for piece in pieces {
        let (inside, outside): (Vec<Function>, Vec<Function>) =
            piece.functions.iter().cloned().partition(|function| symbols.contains(&function.angle[0].0));
        // Angle, whether its sine, and the number before it.
        let mut waves: Vec<(Angle, bool, Rational)> = vec![(Vec::new(), false, piece.coefficient.clone())];
        for function in inside {
            waves = waves.into_iter().flat_map(|wave| products(wave, &function)).collect();
        }
        for (angle, is_sine, coefficient) in waves {
            let mut functions = outside.clone();
            let turned = angle.first().is_some_and(|(_, n)| *n < 0);
            let coefficient = if turned && is_sine { -&coefficient } else { coefficient };
            let angle: Angle = angle.into_iter().map(|(id, n)| (id, if turned { -n } else { n })).collect();
            if angle.is_empty() {
                if is_sine {
                    continue;
                }
            } else {
                functions.push(Function { angle, is_sine, power: 1 });
            }
            found.push(Piece { coefficient, functions, poles: piece.poles.clone() });
        }
    }
    collected(found)
}

/// The two terms of a product of a wave and a function of another symbol.
fn products(
    (angle, is_sine, coefficient): (Angle, bool, Rational),
    other: &Function,
) -> Vec<(Angle, bool, Rational)> {
    if angle.is_empty() {
        return vec![(other.angle.clone(), other.is_sine, coefficient)];
    }
    let half = &coefficient * &Rational::half();
    let with = |sign: i32| -> Angle {
        let mut sum = angle.clone();
        sum.extend(other.angle.iter().map(|&(id, n)| (id, sign * n)));
        sum.sort_unstable();
        sum
    };
    let (sum, difference) = (with(1), with(-1));
    match (is_sine, other.is_sine) {
        (false, false) => vec![(sum, false, half.clone()), (difference, false, half)],
        (true, true) => vec![(sum, false, -&half), (difference, false, half)],
        (true, false) => vec![(sum, true, half.clone()), (difference, true, half)],
        (false, true) => vec![(sum, true, half.clone()), (difference, true, -&half)],
    }
}

/// Multiples of single angles as powers: with the square of the sine, or of the cosine, eliminated.
fn in_powers(pieces: &[Piece], symbols: &[SymbolId], in_cosines: bool) -> Vec<Piece> {
    let mut found = Vec::new();
    for piece in pieces {
        let mut products = vec![Piece { functions: Vec::new(), ..piece.clone() }];
        for function in &piece.functions {
            let (symbol, harmonic) = function.angle[0];
            let replaced: Vec<(Rational, Vec<Function>)> = if symbols.contains(&symbol)
                && (1..=HARMONIC).contains(&harmonic)
            {
                powers_of(harmonic, function.is_sine, in_cosines)
                    .into_iter()
                    .map(|(coefficient, cosines, sines)| {
                        let power = |is_sine, power| Function { angle: vec![(symbol, 1)], is_sine, power };
                        let both = [power(true, sines), power(false, cosines)];
                        (coefficient, both.into_iter().filter(|function| function.power > 0).collect())
                    })
                    .collect()
            } else {
                vec![(Rational::ONE, vec![function.clone()])]
            };
            products = products
                .iter()
                .flat_map(|product| {
                    replaced.iter().map(|(coefficient, functions)| {
                        let mut next = product.clone();
                        next.coefficient = &next.coefficient * coefficient;
                        next.functions.extend(functions.iter().cloned());
                        next
                    })
                })
                .collect();
        }
        found.extend(products);
    }
    collected(found)
}

/// cos kθ or sin kθ as a sum of products of powers of cos θ and sin θ, one of the two at most once.
fn powers_of(harmonic: i32, is_sine: bool, in_cosines: bool) -> Vec<(Rational, u32, u32)> {
    // (c + i s)^k, real and imaginary part.
    let mut sum: BTreeMap<(u32, u32), Rational> = BTreeMap::new();
    let k = u32::try_from(harmonic).unwrap_or_else(|_| unreachable!("waves have positive multiples"));
    let mut binomial = Rational::ONE;
    for sines in 0..=k {
        let keeps = (sines % 2 == 1) == is_sine;
        if keeps {
            let sign = if (sines / 2) % 2 == 1 { -&binomial } else { binomial.clone() };
            sum.insert((k - sines, sines), sign);
        }
        let (above, below) = (i64::from(k - sines), i64::from(sines + 1));
        let ratio = Rational::new(above, below).unwrap_or_else(|| unreachable!("it is over one or more"));
        binomial = &binomial * &ratio;
    }
    // s² = 1 − c², or c² = 1 − s².
    loop {
        let high = sum.keys().find(|(c, s)| if in_cosines { *s >= 2 } else { *c >= 2 }).copied();
        let Some((c, s)) = high else { break };
        let Some(coefficient) = sum.remove(&(c, s)) else { unreachable!("the key was found there") };
        let (one, other) =
            if in_cosines { ((c, s - 2), (c + 2, s - 2)) } else { ((c - 2, s), (c - 2, s + 2)) };
        for (key, sign) in [(one, Rational::ONE), (other, -&Rational::ONE)] {
            let known = sum.entry(key).or_default();
            *known = &*known + &(&coefficient * &sign);
        }
    }
    sum.into_iter()
        .filter(|(_, coefficient)| !coefficient.is_zero())
        .map(|((c, s), coefficient)| (coefficient, c, s))
        .collect()
}
