//! Random expressions, their value in plain floating point, and random rewriting by true identities.

use model_core::algebra::{AlgebraError, Poly, Rational};
use model_core::amount::LowerError;
use model_core::expr::{Expr, Function, Node};
use model_core::symbol::SymbolId;
use proptest::prelude::*;

pub type E = Expr<()>;

/// Two plain symbols and three angles, after π.
pub const NAMES: [&str; 6] = ["pi", "a", "b", "t", "u", "v"];
const FIRST_ANGLE: u16 = 3;

pub fn resolve(name: &str) -> Option<SymbolId> {
    NAMES.iter().position(|known| *known == name).map(|index| SymbolId(index as u16))
}

pub fn canonical(expression: &E) -> Poly {
    lowered(expression).unwrap()
}

fn lowered(expression: &E) -> Result<Poly, LowerError<()>> {
    Poly::from_expr(expression, resolve, |symbol| symbol.0 >= FIRST_ANGLE)
}

/// The form of a random expression; those that are refused as too large when multiplied out say nothing.
pub fn form(expression: &E) -> Result<Poly, TestCaseError> {
    lowered(expression).map_err(|error| match error {
        LowerError::Algebra { error: AlgebraError::TooLarge, .. } => TestCaseError::reject("too large"),
        other => TestCaseError::fail(other.to_string()),
    })
}

/// The value as written, without the algebra.
pub fn value(expression: &E, values: &[f64]) -> f64 {
    match &expression.node {
        Node::Number(number) => number.to_f64(),
        Node::Measured(..) | Node::Ramp(_) => unreachable!("no test of the algebra makes one"),
        Node::Pi => std::f64::consts::PI,
        Node::Symbol(name) => values[resolve(name).unwrap().index()],
        Node::Neg(x) => -value(x, values),
        Node::Add(x, y) => value(x, values) + value(y, values),
        Node::Mul(x, y) => value(x, values) * value(y, values),
        Node::Div(x, y) => value(x, values) / value(y, values),
        Node::Pow(x, n) => value(x, values).powi(*n),
        Node::Call(function, x) => {
            let angle = value(x, values);
            match function {
                Function::Sin => angle.sin(),
                Function::Cos => angle.cos(),
                Function::Tan => angle.tan(),
                Function::Cot => angle.tan().recip(),
                Function::Sec => angle.cos().recip(),
                Function::Csc => angle.sin().recip(),
            }
        }
    }
}

fn node(node: Node<()>) -> E {
    Expr { node, place: () }
}
pub fn number(numerator: i64, denominator: i64) -> E {
    node(Node::Number(Rational::new(numerator, denominator).unwrap()))
}
pub fn symbol(name: &str) -> E {
    node(Node::Symbol(name.to_owned()))
}
pub fn neg(x: E) -> E {
    node(Node::Neg(Box::new(x)))
}
pub fn add(x: E, y: E) -> E {
    node(Node::Add(Box::new(x), Box::new(y)))
}
pub fn mul(x: E, y: E) -> E {
    node(Node::Mul(Box::new(x), Box::new(y)))
}
pub fn div(x: E, y: E) -> E {
    node(Node::Div(Box::new(x), Box::new(y)))
}
pub fn pow(x: E, n: i32) -> E {
    node(Node::Pow(Box::new(x), n))
}
pub fn call(function: Function, x: E) -> E {
    node(Node::Call(function, Box::new(x)))
}
fn quarter_turns(count: i64) -> E {
    mul(number(count, 2), node(Node::Pi))
}

fn single_angle() -> impl Strategy<Value = E> {
    prop::sample::select(vec!["t", "u", "v"]).prop_map(symbol)
}

/// `m·t + n·u + q·π/2`, as one may write it.
fn angle() -> impl Strategy<Value = E> {
    (single_angle(), single_angle(), -3i64..4, -2i64..3, -3i64..4)
        .prop_map(|(x, y, m, n, q)| add(add(mul(number(m, 1), x), mul(number(n, 1), y)), quarter_turns(q)))
}

pub fn expression() -> impl Strategy<Value = E> {
    let wave = prop::sample::select(vec![Function::Sin, Function::Cos]);
    let pole = prop::sample::select(vec![Function::Tan, Function::Cot, Function::Sec, Function::Csc]);
    let leaf = prop_oneof![
        2 => (-9i64..10, 1i64..5).prop_map(|(n, d)| number(n, d)),
        2 => prop::sample::select(vec!["a", "b", "t"]).prop_map(symbol),
        1 => Just(node(Node::Pi)),
        4 => (wave, angle()).prop_map(|(function, x)| call(function, x)),
        2 => (pole, single_angle()).prop_map(|(function, x)| call(function, x)),
    ];
    leaf.prop_recursive(4, 12, 2, |inner| {
        prop_oneof![
            inner.clone().prop_map(neg),
            (inner.clone(), inner.clone()).prop_map(|(x, y)| add(x, y)),
            (inner.clone(), inner.clone()).prop_map(|(x, y)| mul(x, y)),
            (inner, 2i32..4).prop_map(|(x, n)| pow(x, n)),
        ]
    })
}

/// Rewrites an expression by one true identity wherever the choices say so; `choices` is used up from the end.
pub fn rewritten(expression: &E, choices: &mut Vec<u8>) -> E {
    let mut again = |x: &E| rewritten(x, choices);
    let same = match &expression.node {
        Node::Neg(x) => neg(again(x)),
        Node::Add(x, y) => add(again(x), again(y)),
        Node::Mul(x, y) => mul(again(x), again(y)),
        Node::Div(x, y) => div(again(x), again(y)),
        Node::Pow(x, n) => pow(again(x), *n),
        Node::Call(..)
        | Node::Number(_)
        | Node::Measured(..)
        | Node::Pi
        | Node::Symbol(_)
        | Node::Ramp(_) => expression.clone(),
    };
    let choice = choices.pop().unwrap_or(0);
    apply(same, choice)
}

fn apply(x: E, choice: u8) -> E {
    use Function::{Cos, Cot, Csc, Sec, Sin, Tan};
    let t = || symbol("t");
    let sin_cos = |function, x: &E| call(function, x.clone());
    match (choice % 12, &x.node) {
        // Of anything: x (sin² + cos²), (x + y) − y, x tan cot, x sec² − x tan²
        (1, _) => mul(x, add(pow(call(Sin, t()), 2), pow(call(Cos, t()), 2))),
        (2, _) => add(add(x, call(Sin, symbol("u"))), neg(call(Sin, symbol("u")))),
        (3, _) => mul(mul(x, call(Tan, t())), call(Cot, t())),
        (4, _) => {
            add(mul(x.clone(), pow(call(Sec, symbol("v")), 2)), neg(mul(x, pow(call(Tan, symbol("v")), 2))))
        }
        (5, _) => mul(mul(x, call(Csc, symbol("u"))), call(Sin, symbol("u"))),
        // Commuting, distributing, powers written out
        (6 | 7, Node::Add(a, b)) => add((**b).clone(), (**a).clone()),
        (6, Node::Mul(a, b)) => mul((**b).clone(), (**a).clone()),
        (7 | 8, Node::Mul(a, b)) => match &a.node {
            Node::Add(c, d) => add(mul((**c).clone(), (**b).clone()), mul((**d).clone(), (**b).clone())),
            _ => neg(mul(neg((**a).clone()), (**b).clone())),
        },
        (6..=8, Node::Pow(a, n)) => mul(pow((**a).clone(), n - 1), (**a).clone()),
        // Sines and cosines
        (6, Node::Call(Sin, a)) => call(Cos, add((**a).clone(), quarter_turns(-1))),
        (6, Node::Call(Cos, a)) => neg(call(Cos, add((**a).clone(), quarter_turns(6)))),
        (7, Node::Call(Sin, a)) => neg(call(Sin, neg((**a).clone()))),
        (8, Node::Call(Sin, a)) => {
            // sin a = sin (a + t) cos t − cos (a + t) sin t
            let sum = add((**a).clone(), t());
            add(mul(sin_cos(Sin, &sum), call(Cos, t())), neg(mul(sin_cos(Cos, &sum), call(Sin, t()))))
        }
        (9, Node::Call(Sin, a)) => {
            // sin (a + 2u) + sin (a − 2u) = 2 sin a (1 − 2 sin² u)
            let twice = mul(number(2, 1), symbol("u"));
            let sum =
                add(call(Sin, add((**a).clone(), twice.clone())), call(Sin, add((**a).clone(), neg(twice))));
            let square = pow(call(Sin, symbol("u")), 2);
            add(mul(number(1, 2), sum), mul(mul(number(2, 1), square), sin_cos(Sin, a)))
        }
        (8, Node::Call(Cos, a)) => {
            let sum = add((**a).clone(), t());
            add(mul(sin_cos(Cos, &sum), call(Cos, t())), mul(sin_cos(Sin, &sum), call(Sin, t())))
        }
        (6 | 9, Node::Call(Tan, a)) => div(sin_cos(Sin, a), sin_cos(Cos, a)),
        (7 | 8, Node::Call(Tan, a)) => pow(sin_cos(Cot, a), -1),
        (6..=9, Node::Call(Cot, a)) => div(sin_cos(Csc, a), sin_cos(Sec, a)),
        (6..=9, Node::Call(Sec, a)) => {
            // 1/cos = cos + sin tan
            add(sin_cos(Cos, a), mul(sin_cos(Sin, a), sin_cos(Tan, a)))
        }
        (6..=9, Node::Call(Csc, a)) => div(number(1, 1), sin_cos(Sin, a)),
        _ => x,
    }
}

/// Changes one leaf, the `index`-th from the left, so that the expression means something else (nearly always).
pub fn perturbed(expression: &E, index: &mut usize) -> E {
    let mut again = |x: &E| Box::new(perturbed(x, index));
    let changed = match &expression.node {
        Node::Neg(x) => Node::Neg(again(x)),
        Node::Add(x, y) => Node::Add(again(x), again(y)),
        Node::Mul(x, y) => Node::Mul(again(x), again(y)),
        Node::Div(x, y) => Node::Div(again(x), again(y)),
        Node::Pow(x, n) => Node::Pow(again(x), *n),
        leaf => {
            let here = *index == 0;
            *index = index.wrapping_sub(1);
            match (here, leaf) {
                (false, _) => leaf.clone(),
                (true, Node::Number(value)) => {
                    Node::Number(value + &Rational::parse_decimal("1e-30").unwrap())
                }
                (true, Node::Call(Function::Sin, x)) => Node::Call(Function::Cos, x.clone()),
                (true, Node::Call(_, x)) => Node::Call(Function::Sin, x.clone()),
                (true, _) => Node::Symbol("b".to_owned()),
            }
        }
    };
    node(changed)
}
