//! What stands in a certificate for a name of the declaration, for a number with a unit, and for a ramp.

use super::declared::Declared;
use super::expanded::Expanded;
use super::expression::{Level, Term};
use model_core::algebra::Poly;
use model_core::expr::{Expr, Node};
use model_core::ramp::Ramp;
use model_core::symbol::SymbolId;

/// What stands for an expression that is no sum, product or function; `symbol` says what stands for a symbol.
pub(super) fn leaf(declared: &Declared, expression: &Expr<()>, symbol: &dyn Fn(SymbolId) -> Term) -> Term {
    match &expression.node {
        Node::Measured(value, unit) => Term::new(polynomial(&unit.amount(value), symbol), Level::Sum),
        Node::Ramp(_) => match declared.ramp(expression) {
            Some(found) => ramp(found, symbol),
            None => unreachable!("a formula with a ramp that the chain lacks is refused when it is read"),
        },
        Node::Symbol(name) => match declared.chain().find_symbol(name) {
            Some(id) => symbol(id),
            None => unreachable!("a formula with a name that the chain lacks is refused when it is read"),
        },
        _ => unreachable!("everything else is written out by its parts"),
    }
}

/// `ramp alpha (PI / 6) (PI / 3)`
pub(super) fn ramp(ramp: &Ramp, symbol: &dyn Fn(SymbolId) -> Term) -> Term {
    let of = symbol(ramp.of).at(Level::Atom);
    let [from, to] = [&ramp.from, &ramp.to].map(|threshold| polynomial(threshold, symbol));
    Term::new(format!("ramp {of} ({from}) ({to})"), Level::Application)
}

/// The value that is put in for a constant.
pub(super) fn value(value: &Poly, symbol: &dyn Fn(SymbolId) -> Term) -> Term {
    if value.is_zero() { Term::word("0") } else { Term::new(polynomial(value, symbol), Level::Sum) }
}

/// A formula without angles.
fn polynomial(poly: &Poly, symbol: &dyn Fn(SymbolId) -> Term) -> String {
    match Expanded::new(poly) {
        Ok(expanded) => expanded.write(&|id| symbol(id).at(Level::Atom)),
        Err(_) => unreachable!("thresholds and units have no sines in them"),
    }
}
