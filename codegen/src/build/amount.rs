//! From an amount of the declaration to nodes: exact polynomials of sines and cosines become arithmetic.
//!
//! Sines and cosines of a multiple of an angle come from those of the angle itself, so that each angle costs
//! one sine and one cosine however many harmonics an amount has.

use model_core::SymbolId;
use model_core::algebra::{Poly, Rational, Term, Wave};
use model_core::chain::sight::SightAngle;
use model_core::ramp::Ramp;

use super::vectors::Turn;
use crate::builder::{Builder, Value};
use crate::program::Stage;

/// Above this multiple of an angle, sine and cosine are computed afresh: each doubling loses about one bit.
const HIGHEST_DERIVED_HARMONIC: u32 = 16;

/// The value of an amount.
///
/// Terms that differ only in what is prepared share what is evaluated: `a cos β + b cos β` is `(a + b) cos β`.
pub(super) fn lower(b: &mut Builder, amount: &Poly) -> Value {
    let mut sums: Vec<(Value, Value)> = Vec::new();
    for term in amount.terms() {
        let (prepared, evaluated) = factors_by_stage(b, &term);
        match sums.iter_mut().find(|(_, factor)| *factor == evaluated) {
            Some((sum, _)) => *sum = b.add(*sum, prepared),
            None => sums.push((prepared, evaluated)),
        }
    }
    b.dot(sums)
}

/// Sine and cosine of an amount as an angle; whole quarter turns are exact.
pub(super) fn turn(b: &mut Builder, amount: &Poly) -> Turn {
    let (quarters, rest) = split_quarters(amount);
    let turn = match single_multiple(&rest) {
        Some((symbol, multiple)) => {
            let turn = harmonic(b, symbol, multiple.unsigned_abs());
            if multiple < 0 { turn.back() } else { turn }
        }
        None => {
            let angle = lower(b, &rest);
            let (sin, cos) = b.sin_cos(angle);
            Turn { sin, cos }
        }
    };
    match quarters {
        0 => turn,
        1 => Turn { sin: turn.cos, cos: -turn.sin },
        2 => Turn { sin: -turn.sin, cos: -turn.cos },
        _ => Turn { sin: -turn.cos, cos: turn.sin },
    }
}

/// A small turn: its sine, and one minus its cosine without cancellation, from the sine and cosine of half of it.
pub(super) struct SmallTurn {
    pub(super) sin: Value,
    pub(super) versine: Value,
}

/// The small turn by an amount: `sin ε = 2 sin(ε/2) cos(ε/2)` and `1 − cos ε = 2 sin²(ε/2)`.
pub(super) fn small_turn(b: &mut Builder, amount: &Poly) -> SmallTurn {
    let half = lower(b, &amount.scale(&Rational::half()));
    let (sin, cos) = b.sin_cos(half);
    let two = b.constant(2.0);
    let twice = b.mul(two, sin);
    SmallTurn { sin: b.mul(twice, cos), versine: b.mul(twice, sin) }
}

/// The whole quarter turns in an amount, 0 to 3, and what is left.
fn split_quarters(amount: &Poly) -> (i64, Poly) {
    let pi = Poly::symbol(SymbolId::PI);
    let of_pi = amount.coefficient_of(&[(SymbolId::PI, 1)], |symbol| symbol == SymbolId::PI);
    let quarters = of_pi.as_constant().and_then(|turns| (&turns * &Rational::from(2)).to_integer());
    match quarters {
        Some(quarters) => {
            let turned = pi.scale(&(&Rational::from(quarters) * &Rational::half()));
            (quarters.rem_euclid(4), amount - &turned)
        }
        None => (0, amount.clone()),
    }
}

/// The symbol and its whole multiple, if the amount is just that.
fn single_multiple(amount: &Poly) -> Option<(SymbolId, i32)> {
    let mut terms = amount.terms();
    let term = terms.next()?;
    match (terms.next(), term.powers.as_slice(), term.waves.as_slice(), term.poles.as_slice()) {
        (None, &[(symbol, 1)], [], []) if symbol != SymbolId::PI => {
            Some((symbol, i32::try_from(term.coefficient.to_integer()?).ok()?))
        }
        _ => None,
    }
}

/// A term as a product of what is prepared and what is evaluated.
fn factors_by_stage(b: &mut Builder, term: &Term) -> (Value, Value) {
    let mut prepared = b.constant(term.coefficient.to_f64());
    let mut evaluated = Builder::ONE;
    let mut multiply = |b: &mut Builder, factor: Value| match b.stage(factor) {
        Stage::Prepared => prepared = b.mul(prepared, factor),
        Stage::Evaluated => evaluated = b.mul(evaluated, factor),
    };
    for &(symbol, exponent) in &term.powers {
        let base = self::symbol(b, symbol);
        let factor = power(b, base, exponent);
        multiply(b, factor);
    }
    for wave in &term.waves {
        let turn = harmonic(b, wave.symbol, wave.harmonic);
        multiply(
            b,
            match wave.wave {
                Wave::Sin => turn.sin,
                Wave::Cos => turn.cos,
            },
        );
    }
    for pole in &term.poles {
        let turn = harmonic(b, pole.symbol, 1);
        let sin = power(b, turn.sin, pole.sin_power);
        let cos = power(b, turn.cos, pole.cos_power);
        let below = b.mul(sin, cos);
        let factor = b.div(Builder::ONE, below);
        multiply(b, factor);
    }
    (prepared, evaluated)
}

/// A whole power, by squaring.
fn power(b: &mut Builder, base: Value, exponent: u32) -> Value {
    if exponent == 0 {
        return Builder::ONE;
    }
    let half = power(b, base, exponent / 2);
    let square = b.mul(half, half);
    if exponent.is_multiple_of(2) { square } else { b.mul(square, base) }
}

/// Sine and cosine of a whole multiple of a symbol.
fn harmonic(b: &mut Builder, symbol: SymbolId, multiple: u32) -> Turn {
    if multiple <= 1
        && let Some(angle) = b.sight_angle(symbol)
    {
        return sight_turn(b, &angle);
    }
    let angle = self::symbol(b, symbol);
    if multiple <= 1 || multiple > HIGHEST_DERIVED_HARMONIC {
        let factor = b.constant(f64::from(multiple));
        let angle = b.mul(factor, angle);
        let (sin, cos) = b.sin_cos(angle);
        return Turn { sin, cos };
    }
    if multiple.is_multiple_of(2) {
        let half = harmonic(b, symbol, multiple / 2);
        let two = b.constant(2.0);
        let twice = b.mul(two, half.sin);
        let square = b.mul(twice, half.sin);
        Turn { sin: b.mul(twice, half.cos), cos: b.sub(Builder::ONE, square) }
    } else {
        let one = harmonic(b, symbol, 1);
        let rest = harmonic(b, symbol, multiple - 1);
        Turn {
            sin: b.dot([(one.sin, rest.cos), (one.cos, rest.sin)]),
            cos: b.dot([(one.cos, rest.cos), (-one.sin, rest.sin)]),
        }
    }
}

/// A symbol; one that stands for a ramp or for the angle of a line of sight is computed from what that is a function of.
fn symbol(b: &mut Builder, symbol: SymbolId) -> Value {
    if let Some(ramp) = b.ramp(symbol) {
        return self::ramp(b, &ramp);
    }
    match b.sight_angle(symbol) {
        Some(angle) => {
            let turn = sight_turn(b, &angle);
            b.arc_tangent(turn.sin, turn.cos)
        }
        None => b.symbol(symbol),
    }
}

/// Sine and cosine of the angle between a line of sight and up.
pub(super) fn sight_turn(b: &mut Builder, angle: &SightAngle) -> Turn {
    let cos = lower(b, &angle.cosine);
    let across = angle.across.each_ref().map(|part| lower(b, part));
    let square = b.dot(across.map(|part| (part, part)));
    Turn { sin: b.root(square), cos }
}

/// The value of a ramp.
fn ramp(b: &mut Builder, ramp: &Ramp) -> Value {
    let fraction = ramp_fraction(b, ramp);
    if ramp.is_step() { b.step(fraction) } else { b.saturate(fraction) }
}

/// How far the variable is from the first threshold to the second; for a step, how far it is beyond its threshold.
pub(super) fn ramp_fraction(b: &mut Builder, ramp: &Ramp) -> Value {
    let (at, from) = (b.symbol(ramp.of), lower(b, &ramp.from));
    let distance = b.sub(at, from);
    if ramp.is_step() {
        return distance;
    }
    let width = ramp_width(b, ramp);
    b.div(distance, width)
}

/// How far apart the thresholds are.
pub(super) fn ramp_width(b: &mut Builder, ramp: &Ramp) -> Value {
    let (from, to) = (lower(b, &ramp.from), lower(b, &ramp.to));
    b.sub(to, from)
}
