//! Expressions as text: parentheses keep the order of operations, so that every language rounds as the interpreter
//! does. What differs between languages is in [`Notation`].

use model_core::SymbolId;

use super::names::Names;
use crate::lower::tree::{Angle, Expr, Function, Infix, Name, Wave};

/// How a language writes names and numbers.
pub(crate) trait Notation {
    /// The value of a symbol.
    fn symbol(&self, symbol: SymbolId) -> String;

    /// A value that has a name.
    fn name(&self, name: Name) -> String;

    /// A number.
    fn number(&self, value: f64) -> String {
        format!("{value:?}")
    }

    /// A product of two expressions, already in parentheses where they need them.
    fn product(&self, a: &str, b: &str) -> String {
        format!("{a} * {b}")
    }

    /// A quotient of two expressions, already in parentheses where they need them.
    fn quotient(&self, a: &str, b: &str) -> String {
        format!("{a} / {b}")
    }

    /// A function of an expression.
    fn call(&self, function: Function, a: &str) -> String;

    /// The angle of the point (x, y).
    fn arc_tangent(&self, y: &str, x: &str) -> String;

    /// What a·b + c is called, up to the first operand, if it is not written as product and sum.
    fn mul_add(&self) -> Option<&'static str> {
        None
    }

    /// An expression.
    fn text(&self, expr: &Expr) -> String {
        self.bound(expr).text
    }

    /// An expression and how tightly it binds.
    fn bound(&self, expr: &Expr) -> Bound {
        let at_least = |expr: &Expr, binding| self.bound(expr).at_least(binding);
        match expr {
            Expr::Number(value) => Bound::of_number(self.number(*value)),
            Expr::Symbol(symbol) => Bound::of_number(self.symbol(*symbol)),
            Expr::Named(name) => Bound { text: self.name(*name), binding: Binding::Atom },
            Expr::Neg(a) => {
                Bound { text: format!("-{}", at_least(a, Binding::Atom)), binding: Binding::Sign }
            }
            Expr::Infix(infix, operands) => {
                let [a, b] = operands.as_ref();
                let sum = |sign| Bound {
                    text: format!("{} {sign} {}", at_least(a, Binding::Sum), at_least(b, Binding::Product)),
                    binding: Binding::Sum,
                };
                let (left, right) = (Binding::Product, Binding::Atom);
                match infix {
                    Infix::Add => sum("+"),
                    Infix::Sub => sum("-"),
                    Infix::Mul => Bound {
                        text: self.product(&at_least(a, left), &at_least(b, right)),
                        binding: Binding::Product,
                    },
                    Infix::Div => Bound {
                        text: self.quotient(&at_least(a, left), &at_least(b, right)),
                        binding: Binding::Product,
                    },
                }
            }
            Expr::ArcTangent(operands) => {
                let [y, x] = operands.as_ref();
                let text = self.arc_tangent(&self.text(y), &self.text(x));
                Bound { text, binding: Binding::Atom }
            }
            Expr::Call(function, a) => {
                Bound { text: self.call(*function, &self.text(a)), binding: Binding::Atom }
            }
            Expr::MulAdd(operands) => {
                let [a, b, c] = operands.as_ref();
                match self.mul_add() {
                    Some(call) => Bound {
                        text: format!("{call}{}, {}, {})", self.text(a), self.text(b), self.text(c)),
                        binding: Binding::Atom,
                    },
                    None => {
                        let product = Expr::infix(Infix::Mul, a.clone(), b.clone());
                        self.bound(&Expr::infix(Infix::Add, product, c.clone()))
                    }
                }
            }
        }
    }
}

/// An expression and how tightly it binds.
pub(crate) struct Bound {
    text: String,
    binding: Binding,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Sign,
    Atom,
}

impl Bound {
    /// A number or what may be written as one: a sign makes it bind less.
    fn of_number(text: String) -> Self {
        let binding = if text.starts_with('-') { Binding::Sign } else { Binding::Atom };
        Self { text, binding }
    }

    /// In parentheses unless it binds at least as tightly as this.
    fn at_least(self, binding: Binding) -> String {
        if self.binding >= binding { self.text } else { format!("({})", self.text) }
    }
}

/// Where code stands that Rust, C, JavaScript and Python write with the same names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scope {
    /// A function of one pose.
    Pose,
    /// A loop over rows; sines and cosines lie in arrays.
    Row,
    /// A loop over rows that takes sines and cosines itself.
    RowWithWaves,
}

impl Scope {
    /// What a value is called there.
    pub(crate) fn name(self, name: Name, names: &Names) -> String {
        match (self, name) {
            (Self::Pose, Name::Kept(place)) => format!("p[{place}]"),
            (Self::Row | Self::RowWithWaves, Name::Kept(place)) => format!("p{place}"),
            (Self::Pose, Name::Node(node)) => format!("t{}", node.index()),
            (Self::Row | Self::RowWithWaves, Name::Node(node)) => format!("v{}", node.index()),
            (Self::Pose, Name::Wave(Wave::Sine, angle)) => format!("sin_{}", self::angle(angle, names)),
            (Self::Pose, Name::Wave(Wave::Cosine, angle)) => format!("cos_{}", self::angle(angle, names)),
            (Self::Row, Name::Wave(wave, angle)) => format!("{}[row]", waves(wave, angle, names)),
            (Self::RowWithWaves, Name::Wave(wave, angle)) => waves(wave, angle, names),
        }
    }
}

/// The sines or cosines of an angle in a block of rows.
pub(crate) fn waves(wave: Wave, angle: Angle, names: &Names) -> String {
    let angle = self::angle(angle, names);
    match wave {
        Wave::Sine => format!("sine_{angle}"),
        Wave::Cosine => format!("cosine_{angle}"),
    }
}

/// What an angle is called in the names of what belongs to it.
pub(crate) fn angle(angle: Angle, names: &Names) -> String {
    match angle {
        Angle::Symbol(symbol) => names.symbol(symbol).to_owned(),
        Angle::Node(node) => node.index().to_string(),
    }
}
