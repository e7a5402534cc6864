//! What printed formulas have beyond the symbols of a chain: square roots of small primes, and halves of angles. Both are
//! symbols of an extended chain; the relations between them and the rest (√2² = 2, θ = 2·θ/2) are put in here, so that
//! equality stays a decision. Source: numbers made of roots of different primes have one normal form, because the
//! products of such roots are linearly independent over the rationals.

use crate::latex::{ROOTS, root_name};
use model_core::algebra::{AlgebraError, AngleSum, Fraction, Poly, Rational, Term, Wave};
use model_core::chain::Chain;
use model_core::symbol::{Quantity, Symbol, SymbolId, SymbolKind};

/// The chain with a symbol for the root of each small prime, and for half of each angle that is no error. No declared
/// name has the names of these.
#[must_use]
pub fn extended(chain: &Chain) -> Chain {
    let mut extended = chain.clone();
    let constant = |name, quantity, latex, value| Symbol {
        name,
        kind: SymbolKind::Constant,
        quantity,
        meaning: None,
        of: None,
        documentation: String::new(),
        latex,
        value,
    };
    for prime in ROOTS {
        let value = (prime as f64).sqrt();
        let latex = format!("\\sqrt{{{prime}}}");
        extended.symbols.push(constant(root_name(prime), Quantity::Number, latex, Some(value)));
    }
    for symbol in &chain.symbols {
        let is_angle = symbol.quantity == Quantity::Angle
            && matches!(symbol.kind, SymbolKind::Joint | SymbolKind::Constant | SymbolKind::Input);
        if is_angle {
            let latex = format!("\\frac{{{}}}{{2}}", symbol.latex);
            let value = symbol.value.map(|value| value / 2.0);
            extended.symbols.push(constant(half_name(&symbol.name), Quantity::Angle, latex, value));
        }
    }
    extended
}

fn half_name(name: &str) -> String {
    format!("{name}/2")
}

/// The symbol of half an angle, in an extended chain.
pub(super) fn half_of(chain: &Chain, angle: SymbolId) -> Option<SymbolId> {
    chain.find_symbol(&half_name(&chain.symbol(angle).name))
}

/// The angles of which halves occur, each with its half.
pub(super) fn halved(chain: &Chain, poly: &Poly) -> Vec<(SymbolId, SymbolId)> {
    let whole = |half: SymbolId| {
        let name = chain.symbol(half).name.strip_suffix("/2")?;
        Some((chain.find_symbol(name)?, half))
    };
    poly.symbols().into_iter().filter_map(whole).collect()
}

/// Every angle of a list in terms of its half.
pub(super) fn in_halves(poly: &Poly, halves: &[(SymbolId, SymbolId)]) -> Result<Poly, AlgebraError> {
    let mut result = poly.clone();
    for &(angle, half) in halves {
        if result.symbols().contains(&angle) {
            result = result.substitute(angle, &Poly::symbol(half).scale(&Rational::from(2)))?;
        }
    }
    Ok(result)
}

/// Even multiples of half angles as multiples of the angles, for printing.
pub(super) fn in_wholes(poly: &Poly, chain: &Chain) -> Poly {
    let halves = halved(chain, poly);
    if halves.is_empty() {
        return poly.clone();
    }
    poly.terms().fold(Poly::zero(), |sum, term| {
        let mut rest = Term { waves: Vec::new(), ..term.clone() };
        let mut product = Poly::one();
        for &wave in &term.waves {
            let angle = halves.iter().find(|(_, half)| *half == wave.symbol && wave.harmonic % 2 == 0);
            match angle.and_then(|(angle, _)| AngleSum::symbol(*angle).times(wave.harmonic / 2).ok()) {
                Some(angle) => {
                    let function = if wave.wave == Wave::Cos { Poly::cos } else { Poly::sin };
                    product = &product * &function(&angle);
                }
                None => rest.waves.push(wave),
            }
        }
        &sum + &(&product * &of_term(&rest))
    })
}

/// A term as a polynomial.
fn of_term(term: &Term) -> Poly {
    let mut product = Poly::constant(term.coefficient.clone());
    for &(symbol, power) in &term.powers {
        product = (0..power).fold(product, |product, _| &product * &Poly::symbol(symbol));
    }
    for wave in &term.waves {
        if let Ok(angle) = AngleSum::symbol(wave.symbol).times(wave.harmonic) {
            let function = if wave.wave == Wave::Cos { Poly::cos } else { Poly::sin };
            product = &product * &function(&angle);
        }
    }
    for pole in &term.poles {
        let angle = AngleSum::symbol(pole.symbol);
        let (base, power) = if pole.cos_power > 0 {
            (Poly::cos(&angle), pole.cos_power)
        } else {
            (Poly::sin(&angle), pole.sin_power)
        };
        if let Some(inverse) = base.recip() {
            product = (0..power).fold(product, |product, _| &product * &inverse);
        }
    }
    product
}

/// The primes whose roots the chain has symbols for.
fn roots(chain: &Chain) -> Vec<(SymbolId, i64)> {
    ROOTS.iter().filter_map(|&prime| Some((chain.find_symbol(&root_name(prime))?, prime))).collect()
}

/// Squares of roots as the numbers that they are.
pub(super) fn reduced(poly: &Poly, chain: &Chain) -> Poly {
    let roots = roots(chain);
    let is_root = |symbol: SymbolId| roots.iter().any(|(root, _)| *root == symbol);
    if !poly.symbols().into_iter().any(is_root) {
        return poly.clone();
    }
    poly.collect_by(is_root).into_iter().fold(Poly::zero(), |sum, (monomial, factor)| {
        let mut product = factor;
        for (symbol, power) in monomial {
            let prime = roots.iter().find(|(root, _)| *root == symbol).map_or(1, |(_, prime)| *prime);
            for _ in 0..power / 2 {
                product = product.scale(&Rational::from(prime));
            }
            if power % 2 == 1 {
                product = &product * &Poly::symbol(symbol);
            }
        }
        &sum + &product
    })
}

/// The same function with the roots of numbers multiplied out.
pub(super) fn reduced_fraction(value: Fraction, chain: &Chain) -> Fraction {
    let [above, below] = [&value.above, &value.below].map(|poly| reduced(poly, chain));
    Fraction::new(above, below).unwrap_or(value)
}

/// Whether roots of numbers occur.
pub(super) fn has_roots(poly: &Poly, chain: &Chain) -> bool {
    let roots = roots(chain);
    poly.symbols().into_iter().any(|symbol| roots.iter().any(|(root, _)| *root == symbol))
}

/// Cosine and sine of a twelfth part of π times `steps`; `None` without symbols for the roots of 2 and 3.
pub(super) fn special(chain: &Chain, steps: i64) -> Option<(Poly, Poly)> {
    let [two, three] = [2, 3].map(|prime| chain.find_symbol(&root_name(prime)).map(Poly::symbol));
    let (two, three) = (two?, three?);
    let quarter = Rational::new(1, 4)?;
    let half = Rational::half();
    let six = &two * &three;
    // The cosines of 0°, 15°, 30°, 45°, 60°, 75°, 90°.
    let cosines = [
        Poly::one(),
        (&six + &two).scale(&quarter),
        three.scale(&half),
        two.scale(&half),
        Poly::constant(half.clone()),
        (&six - &two).scale(&quarter),
        Poly::zero(),
    ];
    let cosine = |steps: i64| -> Option<Poly> {
        let steps = steps.rem_euclid(24);
        let steps = if steps > 12 { 24 - steps } else { steps };
        let index = usize::try_from(if steps > 6 { 12 - steps } else { steps }).ok()?;
        let value = cosines.get(index)?.clone();
        Some(if steps > 6 { -&value } else { value })
    };
    Some((cosine(steps)?, cosine(6 - steps)?))
}

/// The declared constant as a number of twelfths of π, if it is one to the last digit.
fn twelfths(symbol: &Symbol) -> Option<i64> {
    let value =
        symbol.value.filter(|_| symbol.kind == SymbolKind::Constant && symbol.quantity == Quantity::Angle)?;
    let steps = (value * 12.0 / std::f64::consts::PI).round();
    let exact = steps * std::f64::consts::PI / 12.0;
    ((value - exact).abs() <= 4.0 * f64::EPSILON * exact.abs()).then_some(steps as i64)
}

/// Sines and cosines of constants that are declared as multiples of 15° as the numbers that they are.
pub(super) fn with_special_constants(poly: &Poly, chain: &Chain) -> Poly {
    let known: Vec<(SymbolId, i64)> = poly
        .symbols()
        .into_iter()
        .filter(|id| !chain.symbol(*id).name.ends_with("/2"))
        .filter_map(|id| Some((id, twelfths(chain.symbol(id))?)))
        .collect();
    if known.is_empty() {
        return poly.clone();
    }
    poly.terms().fold(Poly::zero(), |sum, term| {
        let mut rest = Term { waves: Vec::new(), poles: Vec::new(), ..term.clone() };
        let mut product = Poly::one();
        let steps_of = |symbol| known.iter().find(|(id, _)| *id == symbol).map(|(_, steps)| *steps);
        for &wave in &term.waves {
            match steps_of(wave.symbol).and_then(|steps| special(chain, steps * i64::from(wave.harmonic))) {
                Some((cosine, sine)) => {
                    product = &product * if wave.wave == Wave::Cos { &cosine } else { &sine };
                }
                None => rest.waves.push(wave),
            }
        }
        for &pole in &term.poles {
            // 1/sin φ is 1/cos(90° − φ).
            let steps = steps_of(pole.symbol).map(|steps| if pole.cos_power > 0 { steps } else { 6 - steps });
            match steps.and_then(|steps| secant(chain, steps)) {
                Some(secant) => {
                    let power = pole.cos_power.max(pole.sin_power);
                    product = (0..power).fold(product, |product, _| &product * &secant);
                }
                None => rest.poles.push(pole),
            }
        }
        &sum + &(&product * &of_term(&rest))
    })
}

/// One over the cosine of a twelfth part of π times `steps`; `None` where it has none.
fn secant(chain: &Chain, steps: i64) -> Option<Poly> {
    let [two, three] = [2, 3].map(|prime| chain.find_symbol(&root_name(prime)).map(Poly::symbol));
    let (two, three) = (two?, three?);
    let six = &two * &three;
    let steps = steps.rem_euclid(24);
    let steps = if steps > 12 { 24 - steps } else { steps };
    let value = match if steps > 6 { 12 - steps } else { steps } {
        0 => Poly::one(),
        1 => &six - &two,
        2 => three.scale(&Rational::new(2, 3)?),
        3 => two,
        4 => Poly::constant(Rational::from(2)),
        5 => &six + &two,
        _ => return None,
    };
    Some(if steps > 6 { -&value } else { value })
}
