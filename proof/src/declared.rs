//! A declaration as written and what it means, side by side: a certificate states amounts as the user wrote them.

use model_core::algebra::{Poly, Rational};
use model_core::chain::reading::COMPONENTS;
use model_core::chain::{Axis, BodyId, Chain, Observable, ObservableId, ObservableKind, Role, TransformKind};
use model_core::expr::{Expr, Node};
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
    /// The constants whose values are numbers or multiples of π.
    constants: Vec<(SymbolId, Poly)>,
    /// Joints, each with the error that stands for its small change.
    changes: Vec<(SymbolId, SymbolId)>,
    /// Bodies in frames, each with the first of the observables that are its three axes and its origin.
    columns: Vec<(BodyId, Option<BodyId>, usize)>,
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
        let constants = declaration
            .constants()
            .filter_map(|constant| {
                let symbol = chain.find_symbol(&constant.name.to_string())?;
                let value = Poly::from_expr(constant.value.as_ref()?, |_| None, |_| false).ok()?;
                Some((symbol, value))
            })
            .collect();
        Ok(Self { chain, bodies, observables, constants, changes: Vec::new(), columns: Vec::new() })
    }

    /// The same declaration with a small change behind every motion of some joints: an error `change_of_q` for a joint `q`. What it
    /// alone does to first order is the derivative by the joint.
    #[must_use]
    pub fn with_changes(mut self, joints: &[SymbolId]) -> Self {
        for &joint in joints {
            if self.change_of(joint).is_some() || self.chain.symbol(joint).kind != SymbolKind::Joint {
                continue;
            }
            let Ok(change) = u16::try_from(self.chain.symbols.len()).map(SymbolId) else { continue };
            let mut symbol = self.chain.symbol(joint).clone();
            symbol.name = format!("change_of_{}", symbol.name);
            while self.chain.find_symbol(&symbol.name).is_some() {
                symbol.name.push('_');
            }
            symbol.kind = SymbolKind::Error;
            symbol.latex = format!("\\mathrm{{d}}{}", symbol.latex);
            for (body, written) in self.chain.bodies.iter_mut().zip(&mut self.bodies) {
                let moved: Vec<(usize, Rational)> = (0..body.factors.len())
                    .filter(|&at| body.factors[at].role == Role::Motion)
                    .filter_map(|at| Some((at, body.factors[at].amount.derivative(joint).as_constant()?)))
                    .filter(|(_, rate)| *rate != Rational::ZERO)
                    .collect();
                for (at, rate) in moved.into_iter().rev() {
                    let amount = &Poly::constant(rate.clone()) * &Poly::symbol(change);
                    let mut factor = body.factors[at].clone();
                    (factor.role, factor.amount) = (Role::MotionError, amount.clone());
                    let name = Expr { node: Node::Symbol(symbol.name.clone()), place: () };
                    let number = Expr { node: Node::Number(rate), place: () };
                    let product = Expr { node: Node::Mul(Box::new(number), Box::new(name)), place: () };
                    let (role, kind, axis) = (factor.role, factor.kind, factor.axis);
                    body.factors.insert(at + 1, factor);
                    written.insert(at + 1, WrittenFactor { role, kind, axis, written: product, amount });
                }
            }
            self.chain.symbols.push(symbol);
            self.changes.push((joint, change));
        }
        self
    }

    /// The error that stands for a small change of a joint.
    #[must_use]
    pub fn change_of(&self, joint: SymbolId) -> Option<SymbolId> {
        self.changes.iter().find(|(own, _)| *own == joint).map(|(_, change)| *change)
    }

    /// Adds the axes and the origin of a body as observables, seen in a frame.
    pub(super) fn add_columns(&mut self, body: BodyId, frame: Option<BodyId>) {
        let first = self.chain.observables.len();
        if self.columns_of(body, frame).is_some() || u16::try_from(first + 4).is_err() {
            return;
        }
        self.columns.push((body, frame, first));
        let stands = &self.chain.body(body).name;
        let names = ["x axis", "y axis", "z axis", "origin"].map(|what| format!("the {what} of {stands}"));
        for (at, name) in names.into_iter().enumerate() {
            let entries = [0, 1, 2].map(|axis| Rational::from(i64::from(axis == at)));
            let number = |value: &Rational| Expr { node: Node::Number(value.clone()), place: () };
            self.observables.push(entries.each_ref().map(number));
            self.chain.observables.push(Observable {
                name,
                documentation: String::new(),
                kind: if at == 3 { ObservableKind::Point } else { ObservableKind::Direction },
                components: entries.map(Poly::constant),
                body,
                frame,
                shown: COMPONENTS.to_vec(),
                image: None,
                bend: None,
            });
        }
    }

    /// The three axes and the origin of a body as it is seen in a frame.
    pub(super) fn columns_of(&self, body: BodyId, frame: Option<BodyId>) -> Option<[ObservableId; 4]> {
        let found = self.columns.iter().find(|(own, seen, _)| (*own, *seen) == (body, frame));
        let first = u16::try_from(found?.2).ok()?;
        Some([0, 1, 2, 3].map(|at| ObservableId(first + at)))
    }

    /// What the declaration means.
    #[must_use]
    pub fn chain(&self) -> &Chain {
        &self.chain
    }

    /// The declared value of a constant, exactly.
    pub(super) fn constant(&self, symbol: SymbolId) -> Option<&Poly> {
        self.constants.iter().find(|(own, _)| *own == symbol).map(|(_, value)| value)
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
