//! From an expression as written to the canonical form.

mod angles;
mod ramps;

use crate::algebra::{AlgebraError, AngleSum, Budget, Poly};
use crate::chain::Chain;
use crate::expr::{Expr, Function, Node};
use crate::symbol::{Quantity, SymbolId, SymbolKind};

pub(crate) use angles::AngleNumber;

/// Why an expression as written has no canonical form, and where.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LowerError<S> {
    /// A name that nothing declares.
    #[error("unknown name `{name}`")]
    UnknownSymbol {
        /// The name as written.
        name: String,
        /// Where it stands.
        place: S,
    },
    /// The sine or cosine of a symbol that is no angle by its nature: an error, or a measured number.
    #[error("`{name}` cannot stand inside a sine or cosine: only joints and constant or measured angles can")]
    SineOf {
        /// The name as written.
        name: String,
        /// Where the argument of the sine or cosine stands.
        place: S,
    },
    /// A ramp that the chain does not use, or of something other than a joint or input.
    #[error(
        "the chain has no such ramp: write `ramp(joint, from, to)` with the thresholds that its declaration has"
    )]
    UnknownRamp {
        /// Where it stands.
        place: S,
    },
    /// A division by zero.
    #[error("division by zero")]
    DivisionByZero {
        /// Where the divisor stands.
        place: S,
    },
    /// What the algebra refuses.
    #[error("{error}")]
    Algebra {
        /// Why.
        error: AlgebraError,
        /// Where.
        place: S,
    },
}

impl<S> LowerError<S> {
    /// Where the mistake stands.
    pub fn place(&self) -> &S {
        match self {
            Self::UnknownSymbol { place, .. }
            | Self::SineOf { place, .. }
            | Self::UnknownRamp { place }
            | Self::DivisionByZero { place }
            | Self::Algebra { place, .. } => place,
        }
    }
}

impl Poly {
    /// The canonical form of an expression without ramps. `resolve` finds a name, `is_angle` says what may stand in a
    /// sine.
    ///
    /// # Errors
    /// The first [`LowerError`] from the left.
    pub fn from_expr<S: Clone>(
        expression: &Expr<S>,
        resolve: impl Fn(&str) -> Option<SymbolId>,
        is_angle: impl Fn(SymbolId) -> bool,
    ) -> Result<Self, LowerError<S>> {
        Self::from_expr_with_ramps(expression, resolve, is_angle, |_, _, _| None)
    }

    /// The canonical form of an expression; `ramp` finds the symbol of a ramp by its variable and its thresholds.
    ///
    /// # Errors
    /// The first [`LowerError`] from the left.
    pub fn from_expr_with_ramps<S: Clone>(
        expression: &Expr<S>,
        resolve: impl Fn(&str) -> Option<SymbolId>,
        is_angle: impl Fn(SymbolId) -> bool,
        ramp: impl Fn(SymbolId, &Self, &Self) -> Option<SymbolId>,
    ) -> Result<Self, LowerError<S>> {
        Lowering { resolve, is_angle, ramp, budget: Budget::new() }.value(expression)
    }
}

impl Chain {
    /// The canonical form of an expression in the chain's names and ramps. Sines can be taken of its angles, errors
    /// excepted.
    ///
    /// # Errors
    /// The first [`LowerError`] from the left.
    pub fn amount<S: Clone>(&self, expression: &Expr<S>) -> Result<Poly, LowerError<S>> {
        let is_angle = |id: SymbolId| {
            let symbol = self.symbol(id);
            symbol.quantity == Quantity::Angle && symbol.kind != SymbolKind::Error
        };
        Poly::from_expr_with_ramps(
            expression,
            |name| self.find_symbol(name),
            is_angle,
            |of, from, to| self.find_ramp(of, from, to),
        )
    }
}

struct Lowering<R, A, F> {
    resolve: R,
    is_angle: A,
    ramp: F,
    budget: Budget,
}

impl<R, A, F> Lowering<R, A, F>
where
    R: Fn(&str) -> Option<SymbolId>,
    A: Fn(SymbolId) -> bool,
    F: Fn(SymbolId, &Poly, &Poly) -> Option<SymbolId>,
{
    fn value<S: Clone>(&self, expression: &Expr<S>) -> Result<Poly, LowerError<S>> {
        let refuse = |error| LowerError::Algebra { error, place: expression.place.clone() };
        match &expression.node {
            Node::Number(value) => Ok(Poly::constant(value.clone())),
            Node::Measured(value, unit) => Ok(unit.amount(value)),
            Node::Pi => Ok(Poly::symbol(SymbolId::PI)),
            Node::Ramp(parts) => self.ramp(parts, expression),
            Node::Symbol(name) => (self.resolve)(name).map(Poly::symbol).ok_or_else(|| {
                LowerError::UnknownSymbol { name: name.clone(), place: expression.place.clone() }
            }),
            Node::Neg(inner) => Ok(-&self.value(inner)?),
            Node::Add(_, _) => self.sum(expression),
            Node::Mul(..) | Node::Div(..) => self.product(expression, false),
            Node::Pow(base, exponent) => {
                let base = if *exponent < 0 { self.reciprocal(base)? } else { self.value(base)? };
                base.pow_within(exponent.unsigned_abs(), &self.budget).map_err(refuse)
            }
            Node::Call(function, argument) => self.call(*function, argument, expression),
        }
    }

    /// A sum; typed sums are deep on the left, so the left spine is walked, not recursed into.
    fn sum<S: Clone>(&self, expression: &Expr<S>) -> Result<Poly, LowerError<S>> {
        let mut addends = Vec::new();
        let mut spine = expression;
        while let Node::Add(left, right) = &spine.node {
            addends.push(&**right);
            spine = left;
        }
        addends.push(spine);
        let addends: Vec<Poly> =
            addends.into_iter().rev().map(|addend| self.value(addend)).collect::<Result<_, _>>()?;
        Ok(Poly::sum(&addends))
    }

    /// A product or quotient, or one over it; the left spine is walked as in a sum.
    fn product<S: Clone>(&self, expression: &Expr<S>, inverted: bool) -> Result<Poly, LowerError<S>> {
        let mut factors = Vec::new();
        let mut spine = expression;
        while let Node::Mul(left, right) | Node::Div(left, right) = &spine.node {
            factors.push((&**right, inverted != matches!(spine.node, Node::Div(..))));
            spine = left;
        }
        factors.push((spine, inverted));
        let mut result = Poly::one();
        for (factor, below) in factors.into_iter().rev() {
            let factor = if below { self.reciprocal(factor)? } else { self.value(factor)? };
            result = result
                .mul_within(&factor, &self.budget)
                .map_err(|error| LowerError::Algebra { error, place: expression.place.clone() })?;
        }
        Ok(result)
    }

    /// One over an expression. Products and powers are taken apart as written, because multiplied out they are sums.
    fn reciprocal<S: Clone>(&self, expression: &Expr<S>) -> Result<Poly, LowerError<S>> {
        let refuse = |error| LowerError::Algebra { error, place: expression.place.clone() };
        match &expression.node {
            Node::Neg(inner) => Ok(-&self.reciprocal(inner)?),
            Node::Mul(..) | Node::Div(..) => self.product(expression, true),
            Node::Pow(base, exponent) if *exponent >= 0 => {
                self.reciprocal(base)?.pow_within(exponent.unsigned_abs(), &self.budget).map_err(refuse)
            }
            Node::Pow(base, exponent) => {
                self.value(base)?.pow_within(exponent.unsigned_abs(), &self.budget).map_err(refuse)
            }
            _ => {
                let value = self.value(expression)?;
                if value.is_zero() {
                    return Err(LowerError::DivisionByZero { place: expression.place.clone() });
                }
                value.recip().ok_or_else(|| refuse(AlgebraError::NotDivisible))
            }
        }
    }

    fn call<S: Clone>(
        &self,
        function: Function,
        argument: &Expr<S>,
        whole: &Expr<S>,
    ) -> Result<Poly, LowerError<S>> {
        let place = || argument.place.clone();
        let mut angle = self.value(argument)?;
        if let Some(number) = AngleNumber::in_amount(&angle)
            && let Some(symbol) = (self.resolve)(&number.name)
        {
            angle = number.replaced(symbol);
        }
        let angle =
            AngleSum::from_poly(&angle).map_err(|error| LowerError::Algebra { error, place: place() })?;
        for &(symbol, _) in angle.multiples() {
            if !(self.is_angle)(symbol) {
                return Err(match self.name_of(symbol, argument) {
                    Some(name) => LowerError::SineOf { name, place: place() },
                    // A ramp has no name, and is no angle.
                    None => LowerError::Algebra { error: AlgebraError::NotAnAngle, place: place() },
                });
            }
        }
        let (cosine, sine) = angle.cos_sin();
        let over = |divisor: &Poly| {
            if divisor.is_zero() {
                return Err(LowerError::DivisionByZero { place: place() });
            }
            let error = AlgebraError::NotDivisible;
            divisor.recip().ok_or_else(|| LowerError::Algebra { error, place: whole.place.clone() })
        };
        Ok(match function {
            Function::Sin => sine,
            Function::Cos => cosine,
            Function::Tan => &sine * &over(&cosine)?,
            Function::Cot => &cosine * &over(&sine)?,
            Function::Sec => over(&cosine)?,
            Function::Csc => over(&sine)?,
        })
    }

    /// The symbol of a ramp.
    fn ramp<S: Clone>(&self, [of, from, to]: &[Expr<S>; 3], whole: &Expr<S>) -> Result<Poly, LowerError<S>> {
        let unknown = || LowerError::UnknownRamp { place: whole.place.clone() };
        let Node::Symbol(name) = &of.node else { return Err(unknown()) };
        let symbol = (self.resolve)(name)
            .ok_or_else(|| LowerError::UnknownSymbol { name: name.clone(), place: of.place.clone() })?;
        let (from, to) = (self.value(from)?, self.value(to)?);
        (self.ramp)(symbol, &from, &to).map(Poly::symbol).ok_or_else(unknown)
    }

    /// The name by which an expression calls a symbol.
    fn name_of<S>(&self, symbol: SymbolId, expression: &Expr<S>) -> Option<String> {
        match &expression.node {
            Node::Symbol(name) => ((self.resolve)(name) == Some(symbol)).then(|| name.clone()),
            Node::Number(_) | Node::Measured(..) | Node::Pi | Node::Ramp(_) => None,
            Node::Neg(a) | Node::Pow(a, _) | Node::Call(_, a) => self.name_of(symbol, a),
            Node::Add(a, b) | Node::Mul(a, b) | Node::Div(a, b) => {
                self.name_of(symbol, a).or_else(|| self.name_of(symbol, b))
            }
        }
    }
}
