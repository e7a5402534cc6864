//! The declaration as written: every statement in its order, every name with its place. What it means is the
//! business of [`crate::validate`].

use proc_macro2::{Ident, Span};

use crate::chain::image::INTRINSICS;
use crate::expr::Expr;

/// `chain Name { … }`.
#[derive(Debug, Clone)]
pub struct Declaration {
    /// The `///` lines above it.
    pub documentation: String,
    /// The name.
    pub name: Ident,
    /// What stands between the braces, in order.
    pub statements: Vec<Statement>,
    /// The braces around the statements.
    pub braces: Braces,
}

/// A pair of braces.
#[derive(Debug, Clone, Copy)]
pub struct Braces {
    /// `{`
    pub open: Span,
    /// `}`
    pub close: Span,
}

/// One statement of a chain.
#[derive(Debug, Clone)]
pub enum Statement {
    /// `body middle on outer { … }`
    Body(BodyStatement),
    /// `const arm: length = 0.25;`
    Constant(ConstantStatement),
    /// `input ambient: temperature;`
    Input(InputStatement),
    /// `symbol dg2 = r"\Delta\gamma_2";`
    Symbol(SymbolStatement),
    /// `observe pointing: direction(0, 0, 1) of device;`
    Observe(ObserveStatement),
    /// `gravity: (0, 0, -1);`
    Gravity(GravityStatement),
}

/// `body middle on outer { … }`
#[derive(Debug, Clone)]
pub struct BodyStatement {
    /// The `///` lines above it.
    pub documentation: String,
    /// The name of the body.
    pub name: Ident,
    /// The name of its lower body, or `ground`.
    pub lower: Ident,
    /// The lists of factors, in order.
    pub groups: Vec<FactorGroup>,
    /// The braces around the groups.
    pub braces: Braces,
}

/// `motion_error: Tx(dx2), Ry(db2);`
#[derive(Debug, Clone)]
pub struct FactorGroup {
    /// The `///` lines above it.
    pub documentation: String,
    /// `position`, `position_error`, `motion` or `motion_error`, as written.
    pub role: Ident,
    /// The factors, in order.
    pub factors: Vec<FactorTerm>,
    /// The `;` that ends the list.
    pub semicolon: Span,
}

/// `Ry(db2)`
#[derive(Debug, Clone)]
pub struct FactorTerm {
    /// The `///` lines above it.
    pub documentation: String,
    /// `Rx` to `Tz`, as written.
    pub axis: Ident,
    /// The amount; `None` if it could not be read.
    pub amount: Option<Expr<Span>>,
    /// The parenthesis that ends the factor.
    pub close: Span,
}

/// `const arm: length = 0.25;`
#[derive(Debug, Clone)]
pub struct ConstantStatement {
    /// The `///` lines above it.
    pub documentation: String,
    /// The name.
    pub name: Ident,
    /// `angle` or `length`, as written.
    pub quantity: Option<Ident>,
    /// The value in SI; `None` if none is stated, or one that cannot be read.
    pub value: Option<Expr<Span>>,
    /// Whether none is stated.
    pub is_open: bool,
}

/// `input ambient: temperature;`
#[derive(Debug, Clone)]
pub struct InputStatement {
    /// The `///` lines above it.
    pub documentation: String,
    /// The name.
    pub name: Ident,
    /// `length`, `temperature` and so on, as written.
    pub meaning: Option<Ident>,
    /// The joint or length that it is of, as written: `beta` of `direction of beta`.
    pub of: Option<Ident>,
    /// What it is the angle between, where it is derived and not measured.
    pub between: Option<BetweenTerm>,
}

/// `between(sky, up)`
#[derive(Debug, Clone)]
pub struct BetweenTerm {
    /// The observable.
    pub sight: Ident,
    /// `up`, as written.
    pub up: Ident,
}

/// `symbol dg2 = r"\Delta\gamma_2";`
#[derive(Debug, Clone)]
pub struct SymbolStatement {
    /// The `///` lines above it.
    pub documentation: String,
    /// The name that gets a printed form.
    pub name: Ident,
    /// The printed form, in LaTeX.
    pub latex: String,
}

/// `observe pointing: direction(0, 0, 1) of device;`, `observe sky: azimuth(x, -y), elevation of direction(0, 0, 1) of
/// device in mount;`
#[derive(Debug, Clone)]
pub struct ObserveStatement {
    /// The `///` lines above it.
    pub documentation: String,
    /// The name.
    pub name: Ident,
    /// What is read of the vector, in order; nothing for the vector itself.
    pub readings: Vec<ReadingTerm>,
    /// `direction`, `point`, `orientation` or `image`, as written.
    pub kind: Ident,
    /// The components; `None` for one that could not be read.
    pub components: [Option<Expr<Span>>; 3],
    /// The name of the body that carries it.
    pub body: Ident,
    /// The name of the body in whose frame it is seen, if one is given.
    pub frame: Option<Ident>,
    /// What is said of the camera, where an image point is observed.
    pub image: Option<Box<ImageTerm>>,
    /// How its line of sight is bent.
    pub bent: Option<Box<BentTerm>>,
    /// The last word before the `;`.
    pub last: Span,
}

/// `of flange; fx, fy, cx, cy, k1, k2, p1, p2`
#[derive(Debug, Clone)]
pub struct ImageTerm {
    /// The body that carries the point, if one is given.
    pub target: Option<Ident>,
    /// The numbers of the camera; `None` for one that could not be read.
    pub intrinsics: [Option<Expr<Span>>; INTRINSICS],
}

/// `bent up by refraction*tan(zenith)`
#[derive(Debug, Clone)]
pub struct BentTerm {
    /// The word `bent`.
    pub keyword: Span,
    /// By how much; `None` if it could not be read.
    pub amount: Option<Expr<Span>>,
}

/// `azimuth(x, -y)`
#[derive(Debug, Clone)]
pub struct ReadingTerm {
    /// The word.
    pub word: Ident,
    /// The axes behind it; `None` without parentheses.
    pub axes: Option<Vec<AxisTerm>>,
}

/// `x` or `-x`
#[derive(Debug, Clone)]
pub struct AxisTerm {
    /// Whether a minus stands before it.
    pub is_negative: bool,
    /// The axis, as written.
    pub axis: Ident,
}

/// `gravity: (0, 0, -1);`
#[derive(Debug, Clone)]
pub struct GravityStatement {
    /// The word itself.
    pub keyword: Span,
    /// The components; `None` for one that could not be read.
    pub components: [Option<Expr<Span>>; 3],
}

impl Declaration {
    /// The statements of bodies, in order.
    pub fn bodies(&self) -> impl Iterator<Item = &BodyStatement> {
        self.statements.iter().filter_map(|statement| match statement {
            Statement::Body(body) => Some(body),
            _ => None,
        })
    }

    /// The `const` statements, in order.
    pub fn constants(&self) -> impl Iterator<Item = &ConstantStatement> {
        self.statements.iter().filter_map(|statement| match statement {
            Statement::Constant(constant) => Some(constant),
            _ => None,
        })
    }

    /// The `input` statements, in order.
    pub fn inputs(&self) -> impl Iterator<Item = &InputStatement> {
        self.statements.iter().filter_map(|statement| match statement {
            Statement::Input(input) => Some(input),
            _ => None,
        })
    }

    /// The `symbol` statements, in order.
    pub fn printed_symbols(&self) -> impl Iterator<Item = &SymbolStatement> {
        self.statements.iter().filter_map(|statement| match statement {
            Statement::Symbol(symbol) => Some(symbol),
            _ => None,
        })
    }

    /// The `observe` statements, in order.
    pub fn observables(&self) -> impl Iterator<Item = &ObserveStatement> {
        self.statements.iter().filter_map(|statement| match statement {
            Statement::Observe(observe) => Some(observe),
            _ => None,
        })
    }

    /// Every amount of a factor, an observable or gravity, in order, as far as it could be read.
    pub fn amounts(&self) -> impl Iterator<Item = &Expr<Span>> {
        self.statements.iter().flat_map(|statement| -> Vec<&Expr<Span>> {
            match statement {
                Statement::Body(body) => {
                    let factors = body.groups.iter().flat_map(|group| &group.factors);
                    factors.filter_map(|factor| factor.amount.as_ref()).collect()
                }
                Statement::Observe(observe) => {
                    let bent = observe.bent.iter().flat_map(|bent| &bent.amount);
                    let intrinsics = observe.image.iter().flat_map(|image| image.intrinsics.iter().flatten());
                    observe.components.iter().flatten().chain(intrinsics).chain(bent).collect()
                }
                Statement::Gravity(gravity) => gravity.components.iter().flatten().collect(),
                Statement::Constant(_) | Statement::Input(_) | Statement::Symbol(_) => Vec::new(),
            }
        })
    }

    /// The `gravity` statements, in order; the rules allow one.
    pub fn gravities(&self) -> impl Iterator<Item = &GravityStatement> {
        self.statements.iter().filter_map(|statement| match statement {
            Statement::Gravity(gravity) => Some(gravity),
            _ => None,
        })
    }
}
