//! Every amount of a declaration with what it is for and its canonical form.

use proc_macro2::Span;

use super::scope::Scope;
use super::words;
use crate::algebra::{AlgebraError, Poly};
use crate::amount::{AngleNumber, LowerError};
use crate::chain::{Axis, Role, TransformKind};
use crate::expr::Expr;
use crate::mistake::Mistake;
use crate::syntax::Declaration;
use crate::syntax::declaration::{BodyStatement, FactorGroup, FactorTerm, ObserveStatement, Statement};

/// What an amount is for.
pub enum Purpose<'a> {
    /// How far a factor turns or shifts.
    Factor {
        /// The body it belongs to.
        body: &'a BodyStatement,
        /// The list it stands in.
        group: &'a FactorGroup,
        /// The factor as written.
        factor: &'a FactorTerm,
        /// What the factor is for.
        role: Role,
        /// Rotation or shift.
        kind: TransformKind,
        /// About or along which axis.
        axis: Axis,
    },
    /// A component of an observable.
    Component(&'a ObserveStatement),
    /// A number of the camera of an observable.
    Intrinsic(&'a ObserveStatement),
    /// A component of the direction of gravity.
    Gravity,
    /// By how much a line of sight is bent.
    Bend(&'a ObserveStatement),
}

/// One amount.
pub struct Amount<'a> {
    /// As written.
    pub written: &'a Expr<Span>,
    /// What it is for.
    pub purpose: Purpose<'a>,
    /// Its canonical form; `None` if it has none, which some rule reports.
    pub value: Option<Poly>,
}

/// The amounts in the order of the text. Factors with an unknown role or axis are left out.
pub fn collect<'a>(
    declaration: &'a Declaration,
    scope: &Scope,
    mistakes: &mut Vec<Mistake<Span>>,
) -> Vec<Amount<'a>> {
    let mut amounts = Vec::new();
    let mut add = |written: Option<&'a Expr<Span>>, purpose| {
        if let Some(written) = written {
            let value = canonical(written, scope, mistakes).map(|value| turned(value, &purpose, scope));
            amounts.push(Amount { written, purpose, value });
        }
    };
    for statement in &declaration.statements {
        match statement {
            Statement::Body(body) => {
                for group in &body.groups {
                    for factor in &group.factors {
                        let role = words::meaning(&words::ROLES, &group.role);
                        if let (Some(role), Some((kind, axis))) = (role, words::transform(&factor.axis)) {
                            let purpose = Purpose::Factor { body, group, factor, role, kind, axis };
                            add(factor.amount.as_ref(), purpose);
                        }
                    }
                }
            }
            Statement::Observe(observe) => {
                for component in &observe.components {
                    add(component.as_ref(), Purpose::Component(observe));
                }
                for number in observe.image.iter().flat_map(|image| &image.intrinsics) {
                    add(number.as_ref(), Purpose::Intrinsic(observe));
                }
                let bent = observe.bent.as_ref();
                add(bent.and_then(|bent| bent.amount.as_ref()), Purpose::Bend(observe));
            }
            Statement::Gravity(gravity) => {
                for component in &gravity.components {
                    add(component.as_ref(), Purpose::Gravity);
                }
            }
            Statement::Constant(_) | Statement::Input(_) | Statement::Symbol(_) => {}
        }
    }
    amounts
}

/// An amount that turns by design, with the constant that a number in it stands for.
fn turned(value: Poly, purpose: &Purpose<'_>, scope: &Scope) -> Poly {
    let (role, TransformKind::Rotation) = (match purpose {
        Purpose::Factor { role, kind, .. } => (*role, *kind),
        Purpose::Component(_) | Purpose::Intrinsic(_) | Purpose::Gravity | Purpose::Bend(_) => return value,
    }) else {
        return value;
    };
    if !matches!(role, Role::Position | Role::Motion) {
        return value;
    }
    let named = AngleNumber::in_amount(&value).and_then(|number| Some((scope.find(&number.name)?, number)));
    named.map_or(value, |(symbol, number)| number.replaced(symbol))
}

/// The canonical form of an amount. Unknown names and wrong arguments of functions have rules of their own.
fn canonical(written: &Expr<Span>, scope: &Scope, mistakes: &mut Vec<Mistake<Span>>) -> Option<Poly> {
    let lowered = Poly::from_expr_with_ramps(
        written,
        |name| scope.find(name),
        |id| scope.is_angle(id),
        |of, from, to| scope.find_ramp(of, from, to),
    );
    let error = match lowered {
        Ok(value) => return Some(value),
        Err(error) => error,
    };
    match error {
        LowerError::UnknownSymbol { .. } | LowerError::SineOf { .. } | LowerError::UnknownRamp { .. } => {}
        LowerError::DivisionByZero { place } => {
            mistakes.push(Mistake::new(place, "division by zero"));
        }
        LowerError::Algebra { error, place } => mistakes.push(match error {
            AlgebraError::NotAnAngle => Mistake::new(
                place,
                "a sine or cosine can be taken of numbers and of whole multiples of angles only",
            )
            .with_help("declare any other angle: `const tilt: angle = pi/6;`, and write `tilt` here"),
            AlgebraError::NotDivisible => {
                Mistake::new(place, "only numbers, and sines and cosines of one angle, can be divided by")
                    .with_help(
                        "declare the reciprocal as a constant: `const inverse = 4;`, and multiply by it",
                    )
            }
            AlgebraError::TooLarge => Mistake::new(place, "the amount is too large when multiplied out")
                .with_help("write it with lower powers"),
        }),
    }
    None
}
