//! Witnesses: values at which a formula is a number other than zero, exactly.

use std::collections::BTreeMap;

use super::condition::Condition;
use super::expanded::{Expanded, Key, Part};
use model_core::algebra::{Rational, Wave};
use model_core::symbol::SymbolId;

/// Values that are tried before the search is given up.
const TRIES_LIMIT: usize = 20_000;

/// A value of a symbol.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Value {
    /// In Coq's syntax; `None` for an angle of which only cosine and sine are known.
    pub text: Option<String>,
    /// As a rational number, or as a rational multiple of π; `None` if it is neither.
    pub number: Option<(Rational, bool)>,
    /// Cosine and sine; `None` if they are not rational.
    pub wave: Option<(Rational, Rational)>,
}

impl Value {
    /// A whole number.
    pub(super) fn whole(n: i64) -> Self {
        let text = if n < 0 { format!("- {}", n.unsigned_abs()) } else { n.to_string() };
        let wave = (n == 0).then_some((Rational::ONE, Rational::ZERO));
        Self { text: Some(text), number: Some((Rational::from(n), false)), wave }
    }

    /// Some quarter turns, 1 to 3.
    fn quarters(n: i64) -> Self {
        let (text, number, cosine, sine) = match n {
            1 => ("PI / 2", Rational::half(), 0, 1),
            2 => ("PI", Rational::ONE, -1, 0),
            _ => ("- (PI / 2)", -&Rational::half(), 0, -1),
        };
        let wave = Some((Rational::from(cosine), Rational::from(sine)));
        Self { text: Some(text.to_owned()), number: Some((number, true)), wave }
    }

    /// The angle whose half has the tangent `p / q`: its cosine and sine are rational.
    fn circle((p, q): (i64, i64)) -> Self {
        let ratio = |above| match Rational::new(above, p * p + q * q) {
            Some(ratio) => ratio,
            None => unreachable!("a sum of squares of numbers other than zero"),
        };
        Self { text: None, number: None, wave: Some((ratio(q * q - p * p), ratio(2 * p * q))) }
    }

    /// What is said of a symbol of this value: what is equal to what.
    pub(super) fn equations(&self, name: &str) -> Vec<(String, String)> {
        match (&self.text, self.point()) {
            (Some(text), _) => vec![(name.to_owned(), text.clone())],
            (None, Some([cosine, sine])) => {
                vec![(format!("cos {name}"), cosine), (format!("sin {name}"), sine)]
            }
            (None, None) => unreachable!("a value is a number or a point of the circle"),
        }
    }

    /// Cosine and sine, where only those are known.
    pub(super) fn point(&self) -> Option<[String; 2]> {
        let write = |number: &Rational| number.to_string().replace('-', "- ").replace('/', " / ");
        let (cosine, sine) = self.wave.as_ref().filter(|_| self.text.is_none())?;
        Some([write(cosine), write(sine)])
    }
}

/// What is tried: quarter turns before anything else for an angle, small whole numbers.
fn candidates(is_angle: bool) -> Vec<Value> {
    if is_angle {
        let circle = [(1, 2), (1, 3), (2, 1), (3, 1), (2, 3), (1, 4), (3, 2), (1, 5)].map(Value::circle);
        let quarters = [Value::whole(0)].into_iter().chain((1..=3).map(Value::quarters));
        quarters.chain(circle).collect()
    } else {
        [1, 0, 2, -1, 3, -2, 5].map(Value::whole).to_vec()
    }
}

/// The formula with a value put in for a symbol; `None` if it has none there.
pub(super) fn substitute(formula: &Expanded, symbol: SymbolId, value: &Value) -> Option<Expanded> {
    let mut result: BTreeMap<Key, Rational> = BTreeMap::new();
    for (key, coefficient) in &formula.0 {
        let mut coefficient = coefficient.clone();
        let mut rest: Key = Vec::new();
        let mut turns = 0;
        for &(other, part, power) in key {
            if other != symbol {
                rest.push((other, part, power));
                continue;
            }
            let base = match part {
                Part::Value => {
                    let (number, of_pi) = value.number.clone()?;
                    turns += if of_pi { power } else { 0 };
                    number
                }
                Part::Cos => value.wave.clone()?.0,
                Part::Sin => value.wave.clone()?.1,
                Part::OverCos => value.wave.clone()?.0.recip()?,
                Part::OverSin => value.wave.clone()?.1.recip()?,
            };
            coefficient = (0..power).fold(coefficient, |product, _| &product * &base);
        }
        if turns > 0 {
            match rest.iter_mut().find(|(other, ..)| *other == SymbolId::PI) {
                Some((_, _, power)) => *power += turns,
                None => rest.push((SymbolId::PI, Part::Value, turns)),
            }
            rest.sort_unstable();
        }
        let sum = result.remove(&rest).map_or_else(|| coefficient.clone(), |before| &before + &coefficient);
        if !sum.is_zero() {
            result.insert(rest, sum);
        }
    }
    Some(Expanded(result))
}

/// Whether a number, a polynomial in π, is seen not to be zero from 0 < π ≤ 4: Coq's library proves that much by its axioms
/// of real numbers alone.
fn is_seen(number: &Expanded) -> bool {
    let (mut at_0, mut at_4) = (Rational::ZERO, Rational::ZERO);
    for (key, coefficient) in &number.0 {
        match key.as_slice() {
            [] => (at_0, at_4) = (&at_0 + coefficient, &at_4 + coefficient),
            [(SymbolId::PI, Part::Value, 1)] => at_4 = &at_4 + &(coefficient * &Rational::from(4)),
            _ => return false,
        }
    }
    !at_4.is_zero() && (at_0.is_zero() || at_0.is_negative() == at_4.is_negative())
}

/// A search for values of some symbols, others staying as they are given.
pub(super) struct Search<'a> {
    /// Where the formulas are defined.
    pub conditions: &'a [Condition],
    /// Which symbols are angles in some formula.
    pub is_angle: &'a dyn Fn(SymbolId) -> bool,
    /// Which symbols stand in some formula as they are.
    pub is_number: &'a dyn Fn(SymbolId) -> bool,
}

impl Search<'_> {
    /// What may be put in for a symbol.
    pub(super) fn values(&self, symbol: SymbolId) -> Vec<Value> {
        let is_angle = (self.is_angle)(symbol);
        let is_number = (self.is_number)(symbol);
        let mut values = candidates(is_angle);
        values.retain(|value| {
            let wave = |wanted| match (&value.wave, wanted) {
                (Some((cosine, _)), Wave::Cos) => !cosine.is_zero(),
                (Some((_, sine)), Wave::Sin) => !sine.is_zero(),
                (None, _) => false,
            };
            let defined = self.conditions.iter().all(|condition| match condition {
                Condition::Wave(other, wanted) if *other == symbol => wave(*wanted),
                _ => true,
            });
            defined && (!is_number || value.number.is_some())
        });
        values
    }

    /// Values of these symbols at which the formula is a number that is seen not to be zero.
    pub(super) fn find(&self, formula: &Expanded, symbols: &[SymbolId]) -> Option<Vec<(SymbolId, Value)>> {
        let mut tries = 0;
        let mut found = Vec::new();
        self.go_on(formula, symbols, &mut found, &mut tries).then_some(found)
    }

    fn go_on(
        &self,
        formula: &Expanded,
        symbols: &[SymbolId],
        found: &mut Vec<(SymbolId, Value)>,
        tries: &mut usize,
    ) -> bool {
        let Some((&symbol, rest)) = symbols.split_first() else {
            return is_seen(formula) && self.conditions.iter().all(|condition| condition.is_satisfied(found));
        };
        for value in self.values(symbol) {
            *tries += 1;
            if *tries > TRIES_LIMIT {
                return false;
            }
            let Some(there) = substitute(formula, symbol, &value) else { continue };
            if there.0.is_empty() {
                continue;
            }
            found.push((symbol, value));
            if self.go_on(&there, rest, found, tries) {
                return true;
            }
            found.pop();
        }
        false
    }
}

impl Condition {
    /// Whether values satisfy it; `None` where they do not say.
    pub(super) fn is_satisfied(&self, values: &[(SymbolId, Value)]) -> bool {
        let (Self::NonZero(amount) | Self::Positive(amount)) = self else { return true };
        let Ok(amount) = Expanded::new(amount) else { return false };
        let there = values
            .iter()
            .try_fold(amount, |amount, (symbol, value)| substitute(&amount, *symbol, value))
            .and_then(|amount| amount.as_constant());
        there.is_some_and(|there: Rational| {
            !there.is_zero() && (matches!(self, Self::NonZero(_)) || !there.is_negative())
        })
    }
}
