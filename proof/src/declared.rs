//! A declaration as written and what it means, side by side: a certificate states amounts as the user wrote them.

use model_core::algebra::Poly;
use model_core::chain::{Axis, BodyId, Chain, ObservableId, Role, TransformKind};
use model_core::expr::Expr;
use model_core::mistake::Mistakes;
use model_core::ramp::Ramp;
use model_core::symbol::{SymbolId, SymbolKind};
use model_core::validate;

/// A declaration with its chain.
#[derive(Debug, Clone)]
pub struct Declared {
    chain: Chain,
    bodies: Vec<Vec<WrittenFactor>>,
    observables: Vec<[Expr<()>; 3]>,
}

/// A factor as written.
#[derive(Debug, Clone)]
pub(super) struct WrittenFactor {
    pub role: Role,
    pub kind: TransformKind,
    pub axis: Axis,
    /// As the user wrote it.
    pub written: Expr<()>,
    /// What it says.
    pub amount: Poly,
}

impl Declared {
    /// Reads and checks the text of a `.chain` file.
    ///
    /// # Errors
    /// Every mistake in it, sorted by place.
    pub fn from_text(text: &str) -> Result<Self, Mistakes> {
        let (declaration, chain) = validate::read_symbolic_text(text)?;
        let mut bodies = Vec::with_capacity(chain.bodies.len());
        for body in &chain.bodies {
            let statement = declaration.bodies().find(|statement| statement.name == body.name);
            let amounts = statement
                .into_iter()
                .flat_map(|statement| &statement.groups)
                .flat_map(|group| &group.factors);
            let factors = body.factors.iter().zip(amounts.filter_map(|factor| factor.amount.as_ref()));
            bodies.push(
                factors
                    .map(|(factor, written)| WrittenFactor {
                        role: factor.role,
                        kind: factor.kind,
                        axis: factor.axis,
                        written: without_places(written),
                        amount: factor.amount.clone(),
                    })
                    .collect(),
            );
        }
        let observables = declaration
            .observables()
            .filter_map(|observe| match &observe.components {
                [Some(x), Some(y), Some(z)] => Some([x, y, z].map(without_places)),
                _ => None,
            })
            .collect();
        Ok(Self { chain, bodies, observables })
    }

    /// What the declaration means.
    #[must_use]
    pub fn chain(&self) -> &Chain {
        &self.chain
    }

    /// The factors of a body.
    pub(super) fn body(&self, body: BodyId) -> &[WrittenFactor] {
        &self.bodies[usize::from(body.0)]
    }

    /// The components of an observable.
    pub(super) fn observable(&self, observable: ObservableId) -> &[Expr<()>; 3] {
        &self.observables[usize::from(observable.0)]
    }

    /// Whether a symbol is an error.
    pub(super) fn is_error(&self, symbol: SymbolId) -> bool {
        self.chain.symbol(symbol).kind == SymbolKind::Error
    }

    /// The canonical form of an expression; `None` if it has none.
    pub(super) fn lower(&self, expression: &Expr<()>) -> Option<Poly> {
        let ramp = |of, from: &Poly, to: &Poly| self.chain.find_ramp(of, from, to);
        Poly::from_expr_with_ramps(expression, |name| self.chain.find_symbol(name), |_| true, ramp).ok()
    }

    /// The ramp that an expression is, if it is one of the chain's.
    pub(super) fn ramp(&self, expression: &Expr<()>) -> Option<&Ramp> {
        self.lower(expression)?.symbols().into_iter().find_map(|symbol| self.chain.ramp(symbol))
    }

    /// The symbols in an expression, in order, each once.
    pub(super) fn symbols_of(&self, expression: &Expr<()>) -> Vec<SymbolId> {
        let names = expression.names();
        let mut found: Vec<SymbolId> =
            names.iter().filter_map(|(name, ())| self.chain.find_symbol(name)).collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

/// An expression without its places.
pub(super) fn without_places<S>(expression: &Expr<S>) -> Expr<()> {
    expression.map_place(&|_| ())
}
