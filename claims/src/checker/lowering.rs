//! From a printed expression to what it says: a quotient of canonical forms.
//!
//! What the algebra of declarations can hold goes its way. What only print has (divisions by sums and distances, half
//! angles, angles of 15° and their multiples) is carried out here.

use std::ops::Range;

use super::algebraic;
use model_core::algebra::{AlgebraError, AngleSum, Fraction, Poly, Rational};
use model_core::amount::LowerError;
use model_core::chain::Chain;
use model_core::expr::{Expr, Function, Node};
use model_core::mistake::Mistake;
use model_core::names;
use model_core::symbol::{Quantity, SymbolId, SymbolKind};

type Written = Expr<Range<usize>>;
type Refusal = Mistake<Range<usize>>;

/// What may stand inside a sine or cosine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sines {
    /// Joints, constants, inputs.
    Angles,
    /// Errors, too: the exact form.
    Errors,
    /// Errors, which may stand in divisors as well: what is expanded afterwards.
    Series,
}

/// What an expression over the symbols of an extended chain says.
pub(super) fn fraction(chain: &Chain, expression: &Written, sines: Sines) -> Result<Fraction, Refusal> {
    let lowering = Lowering { chain, sines };
    let value = match lowering.poly(expression) {
        Ok(poly) => Fraction::whole(poly),
        Err(LowerError::Algebra { error: AlgebraError::NotDivisible | AlgebraError::NotAnAngle, .. }) => {
            lowering.value(expression)?
        }
        Err(error) => return Err(explained(chain, &error)),
    };
    Ok(algebraic::reduced_fraction(value, chain))
}

/// The canonical form of an expression over the symbols of a chain.
///
/// # Errors
/// A name that the chain does not have, with the nearest one, or what the algebra refuses.
pub fn lower(chain: &Chain, expression: &Written) -> Result<Poly, Refusal> {
    let lowering = Lowering { chain, sines: Sines::Angles };
    lowering.poly(expression).map_err(|error| explained(chain, &error))
}

/// The mistake in words.
fn explained(chain: &Chain, error: &LowerError<Range<usize>>) -> Refusal {
    let mistake = Mistake::new(error.place().clone(), error.to_string());
    match error {
        LowerError::UnknownSymbol { name, .. } => {
            match names::nearest(name, chain.symbols.iter().map(|symbol| symbol.name.as_str())) {
                Some(near) => mistake.with_help(format!("did you mean `{near}`?")),
                None => mistake,
            }
        }
        LowerError::SineOf { name, .. }
            if chain.find_symbol(name).is_some_and(|id| chain.symbol(id).kind == SymbolKind::Error) =>
        {
            mistake.with_help("in a form of order 1 the sine of an error is the error, its cosine 1")
        }
        _ => mistake,
    }
}

struct Lowering<'a> {
    chain: &'a Chain,
    sines: Sines,
}

impl Lowering<'_> {
    fn is_angle(&self, id: SymbolId) -> bool {
        let symbol = self.chain.symbol(id);
        symbol.quantity == Quantity::Angle
            && (symbol.kind != SymbolKind::Error || self.sines != Sines::Angles)
    }

    fn poly(&self, expression: &Written) -> Result<Poly, LowerError<Range<usize>>> {
        let ramp = |of, from: &Poly, to: &Poly| self.chain.find_ramp(of, from, to);
        let find = |name: &str| self.chain.find_symbol(name);
        Poly::from_expr_with_ramps(expression, find, |id| self.is_angle(id), ramp)
    }

    fn value(&self, expression: &Written) -> Result<Fraction, Refusal> {
        let refuse = |error: AlgebraError| Mistake::new(expression.place.clone(), error.to_string());
        match &expression.node {
            Node::Number(_) | Node::Measured(..) | Node::Pi | Node::Symbol(_) | Node::Ramp(_) => {
                self.poly(expression).map(Fraction::whole).map_err(|error| explained(self.chain, &error))
            }
            Node::Neg(inside) => Ok(self.value(inside)?.negated()),
            Node::Add(..) | Node::Mul(..) | Node::Div(..) => self.spine(expression),
            Node::Pow(base, power) => {
                let base = self.value(base)?;
                let base = if *power < 0 { self.inverted(&base, expression)? } else { base };
                let [above, below] = [&base.above, &base.below].map(|poly| poly.pow(power.unsigned_abs()));
                let powered = Fraction::new(above.map_err(refuse)?, below.map_err(refuse)?);
                powered.ok_or_else(|| Mistake::new(expression.place.clone(), "division by zero"))
            }
            Node::Call(function, angle) => self.call(*function, angle, expression),
        }
    }

    /// Sums and products are deep on the left, where they are walked, not recursed into.
    fn spine(&self, expression: &Written) -> Result<Fraction, Refusal> {
        let mut steps = Vec::new();
        let mut spine = expression;
        while let Node::Add(left, right) | Node::Mul(left, right) | Node::Div(left, right) = &spine.node {
            steps.push((spine, right));
            spine = left;
        }
        let mut result = self.value(spine)?;
        for (whole, right) in steps.into_iter().rev() {
            let refuse = |error: AlgebraError| Mistake::new(whole.place.clone(), error.to_string());
            let right_value = self.value(right)?;
            result = match &whole.node {
                Node::Add(..) => result.sum(&right_value),
                Node::Div(..) => result.product(&self.inverted(&right_value, right)?),
                _ => result.product(&right_value),
            }
            .map_err(refuse)?;
        }
        Ok(result)
    }

    fn inverted(&self, value: &Fraction, expression: &Written) -> Result<Fraction, Refusal> {
        let is_error = |id: SymbolId| self.chain.symbol(id).kind == SymbolKind::Error;
        if self.sines != Sines::Series && value.above.symbols().into_iter().any(is_error) {
            return Err(Mistake::new(expression.place.clone(), "an error stands in a divisor")
                .with_help("expand the quotient up to the order of the form"));
        }
        value.inverse().ok_or_else(|| Mistake::new(expression.place.clone(), "division by zero"))
    }

    fn call(&self, function: Function, angle: &Written, whole: &Written) -> Result<Fraction, Refusal> {
        let (cosine, sine) = self.cos_sin(angle)?;
        let [cosine, sine] = [cosine, sine].map(Fraction::whole);
        let over = |above: Fraction, below: &Fraction| {
            let inverse =
                below.inverse().ok_or_else(|| Mistake::new(angle.place.clone(), "division by zero"))?;
            above.product(&inverse).map_err(|error| Mistake::new(whole.place.clone(), error.to_string()))
        };
        let one = Fraction::whole(Poly::one());
        match function {
            Function::Sin => Ok(sine),
            Function::Cos => Ok(cosine),
            Function::Tan => over(sine, &cosine),
            Function::Cot => over(cosine, &sine),
            Function::Sec => over(one, &cosine),
            Function::Csc => over(one, &sine),
        }
    }

    /// Cosine and sine of whole and half multiples of angles, and multiples of 15°.
    fn cos_sin(&self, angle: &Written) -> Result<(Poly, Poly), Refusal> {
        let refuse = || {
            Mistake::new(angle.place.clone(), "the angle of a sine or cosine must be a sum of multiples of angles, of their halves and of 15°")
                .with_help("declare a constant for any other angle")
        };
        let value = self.value(angle)?;
        if !value.is_whole() {
            return Err(refuse());
        }
        let mut sum = Poly::zero();
        let mut steps = 0;
        for term in value.above.terms() {
            let ([(symbol, 1)], [], []) =
                (term.powers.as_slice(), term.waves.as_slice(), term.poles.as_slice())
            else {
                return Err(refuse());
            };
            if *symbol == SymbolId::PI {
                let twelfths = (&term.coefficient * &Rational::from(12)).to_integer().ok_or_else(refuse)?;
                steps = twelfths.rem_euclid(24);
                continue;
            }
            if !self.is_angle(*symbol) {
                let name = self.chain.symbol(*symbol).name.clone();
                return Err(explained(self.chain, &LowerError::SineOf { name, place: angle.place.clone() }));
            }
            let addend = match term.coefficient.to_integer() {
                Some(_) => Poly::symbol(*symbol).scale(&term.coefficient),
                None => {
                    let doubled = &term.coefficient * &Rational::from(2);
                    let half =
                        algebraic::half_of(self.chain, *symbol).filter(|_| doubled.to_integer().is_some());
                    Poly::symbol(half.ok_or_else(refuse)?).scale(&doubled)
                }
            };
            sum = &sum + &addend;
        }
        let (cosine, sine) = AngleSum::from_poly(&sum)
            .map_err(|error| Mistake::new(angle.place.clone(), error.to_string()))?
            .cos_sin();
        if steps == 0 {
            return Ok((cosine, sine));
        }
        let (c, s) = algebraic::special(self.chain, steps).ok_or_else(refuse)?;
        let reduced = |poly: Poly| algebraic::reduced(&poly, self.chain);
        Ok((reduced(&(&cosine * &c) - &(&sine * &s)), reduced(&(&sine * &c) + &(&cosine * &s))))
    }
}
