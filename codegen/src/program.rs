//! The straight-line program: one list of operations, each used by its place in the list, no branches.
//!
//! A program has two stages. What depends on errors and constants alone is *prepared*, once for a set of
//! errors; what depends on joints or inputs is *evaluated*, once for a pose. Prepared nodes come first.
//! How a program comes about is the business of [`mod@crate::build`]; here is only what it is.

use std::fmt;

use model_core::{ObservableId, SymbolId};

/// A node of one program: its place in [`Program::nodes`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub(crate) u32);

impl NodeId {
    /// Place in [`Program::nodes`].
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A number written into a program, compared by its bits so that nodes can be shared by value.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Literal(u64);

impl Literal {
    pub(crate) fn new(value: f64) -> Self {
        Self(value.to_bits())
    }

    /// The number.
    #[must_use]
    pub fn value(self) -> f64 {
        f64::from_bits(self.0)
    }
}

impl fmt::Debug for Literal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.value())
    }
}

/// One operation on f64, IEEE double precision, each rounded once: no operation is ever fused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Op {
    /// A number.
    Constant(Literal),
    /// The value of a symbol, in SI.
    Input(SymbolId),
    /// `-a`
    Neg(NodeId),
    /// `a + b`
    Add(NodeId, NodeId),
    /// `a - b`
    Sub(NodeId, NodeId),
    /// `a * b`
    Mul(NodeId, NodeId),
    /// `a / b`
    Div(NodeId, NodeId),
    /// Sine of an angle in radians.
    Sin(NodeId),
    /// Cosine of an angle in radians.
    Cos(NodeId),
    /// `a` between 0 and 1, and the nearer of the two outside; NaN stays NaN.
    Saturate(NodeId),
    /// 1 from `a = 0` on, 0 below; NaN stays NaN.
    Step(NodeId),
    /// The square root; NaN below zero.
    Root(NodeId),
    /// The angle of the point (b, a), in (−π, π]: 0 where b > 0 and a = 0, a quarter turn where a > 0 and b = 0.
    ArcTangent(NodeId, NodeId),
}

impl Op {
    /// The nodes that this one reads, none, one or two.
    pub fn operands(self) -> impl Iterator<Item = NodeId> {
        let (first, second) = match self {
            Self::Constant(_) | Self::Input(_) => (None, None),
            Self::Neg(a)
            | Self::Sin(a)
            | Self::Cos(a)
            | Self::Saturate(a)
            | Self::Step(a)
            | Self::Root(a) => (Some(a), None),
            Self::Add(a, b)
            | Self::Sub(a, b)
            | Self::Mul(a, b)
            | Self::Div(a, b)
            | Self::ArcTangent(a, b) => (Some(a), Some(b)),
        };
        first.into_iter().chain(second)
    }

    /// The same operation on other nodes.
    pub(crate) fn map(self, f: impl Fn(NodeId) -> NodeId) -> Self {
        match self {
            Self::Constant(_) | Self::Input(_) => self,
            Self::Neg(a) => Self::Neg(f(a)),
            Self::Sin(a) => Self::Sin(f(a)),
            Self::Cos(a) => Self::Cos(f(a)),
            Self::Saturate(a) => Self::Saturate(f(a)),
            Self::Step(a) => Self::Step(f(a)),
            Self::Add(a, b) => Self::Add(f(a), f(b)),
            Self::Sub(a, b) => Self::Sub(f(a), f(b)),
            Self::Mul(a, b) => Self::Mul(f(a), f(b)),
            Self::Div(a, b) => Self::Div(f(a), f(b)),
            Self::Root(a) => Self::Root(f(a)),
            Self::ArcTangent(a, b) => Self::ArcTangent(f(a), f(b)),
        }
    }
}

/// When a node is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Once for a set of errors and constants.
    Prepared,
    /// Once for a pose: joints and inputs.
    Evaluated,
}

/// What is computed of an observable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Form {
    /// What the observable shows with errors, no approximation: its components, or its readings.
    ExactValue,
    /// What it shows with errors minus without, no approximation and no cancellation.
    ExactError,
    /// The part of that which is linear in the errors.
    FirstOrderError,
    /// Derivatives of the exact value at the errors given: a row for each number shown, a column for each symbol.
    ExactJacobian,
    /// Derivatives of the exact value where every error is zero: as many rows, a column for each symbol. With
    /// respect to an error these are the coefficients of the first-order error.
    FirstOrderJacobian,
    /// The standard uncertainty of each number of the exact value, by the covariance of estimates at the errors given.
    Uncertainty,
}

impl Form {
    /// Whether the form has a column for each of a list of symbols.
    #[must_use]
    pub fn is_jacobian(self) -> bool {
        matches!(self, Self::ExactJacobian | Self::FirstOrderJacobian)
    }
}

/// Which numbers a program puts out, in order: form by form, observable by observable, number shown by number shown (x, y,
/// z, or readings), and for Jacobians column by column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Layout {
    /// The forms, in order.
    pub forms: Vec<Form>,
    /// The observables of each form, in order.
    pub observables: Vec<ObservableId>,
    /// How many numbers each observable shows.
    pub shown: Vec<usize>,
    /// The symbols of a Jacobian's columns, in order.
    pub wrt: Vec<SymbolId>,
}

impl Layout {
    /// How many numbers one form puts out.
    #[must_use]
    pub fn len_of(&self, form: Form) -> usize {
        self.shown.iter().sum::<usize>() * if form.is_jacobian() { self.wrt.len() } else { 1 }
    }
}

/// A straight-line program.
#[derive(Debug, Clone, PartialEq)]
pub struct Program {
    /// What it puts out.
    pub(crate) layout: Layout,
    /// Operations; each reads nodes before it only, and no two are equal.
    pub(crate) nodes: Vec<Op>,
    /// How many of the nodes, from the first, are prepared.
    pub(crate) prepared: usize,
    /// The node of each output. Equal outputs share a node.
    pub(crate) outputs: Vec<NodeId>,
}

impl Program {
    /// Which numbers it puts out.
    #[must_use]
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The operations in an order in which they can be computed: prepared ones first.
    #[must_use]
    pub fn nodes(&self) -> &[Op] {
        &self.nodes
    }

    /// The node of each output, in the order of [`Program::layout`].
    #[must_use]
    pub fn outputs(&self) -> &[NodeId] {
        &self.outputs
    }

    /// Every node of one stage with its operation, in order.
    pub fn stage(&self, stage: Stage) -> impl Iterator<Item = (NodeId, Op)> + '_ {
        self.ids().filter(move |&(id, _)| self.stage_of(id) == stage)
    }

    /// When a node is computed.
    #[must_use]
    pub fn stage_of(&self, id: NodeId) -> Stage {
        if id.index() < self.prepared { Stage::Prepared } else { Stage::Evaluated }
    }

    /// The symbols that the program reads, with the stage that reads them, in the order of their ids.
    #[must_use]
    pub fn inputs(&self) -> Vec<(SymbolId, Stage)> {
        let mut inputs: Vec<(SymbolId, Stage)> = self
            .ids()
            .filter_map(|(id, op)| match op {
                Op::Input(symbol) => Some((symbol, self.stage_of(id))),
                _ => None,
            })
            .collect();
        inputs.sort_unstable();
        inputs
    }

    /// The prepared nodes that the second stage or an output reads, numbers written into the program apart:
    /// what a caller keeps between poses.
    #[must_use]
    pub fn carried(&self) -> Vec<NodeId> {
        let mut read = vec![false; self.nodes.len()];
        let later = self.nodes.iter().skip(self.prepared).flat_map(|op| op.operands());
        for id in later.chain(self.outputs.iter().copied()) {
            read[id.index()] = true;
        }
        self.stage(Stage::Prepared)
            .filter(|&(id, op)| read[id.index()] && !matches!(op, Op::Constant(_)))
            .map(|(id, _)| id)
            .collect()
    }

    /// How many operations each stage costs.
    #[must_use]
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        for (id, op) in self.ids() {
            let tally = match self.stage_of(id) {
                Stage::Prepared => &mut counts.prepared,
                Stage::Evaluated => &mut counts.evaluated,
            };
            match op {
                Op::Constant(_) | Op::Input(_) => {}
                Op::Neg(_)
                | Op::Add(..)
                | Op::Sub(..)
                | Op::Mul(..)
                | Op::Div(..)
                | Op::Saturate(_)
                | Op::Step(_)
                | Op::Root(_)
                | Op::ArcTangent(..) => tally.operations += 1,
                Op::Sin(_) | Op::Cos(_) => tally.sines_and_cosines += 1,
            }
        }
        counts
    }

    /// Whether every operand is computed before it is read and in time for its stage, every output exists, and
    /// no node is there twice.
    ///
    /// # Errors
    /// The first rule that does not hold. Programs from [`mod@crate::build`] hold them all.
    pub fn check(&self) -> Result<(), Broken> {
        for (id, op) in self.ids() {
            for operand in op.operands() {
                if operand >= id {
                    return Err(Broken::Order { node: id, operand });
                }
                if self.stage_of(operand) > self.stage_of(id) {
                    return Err(Broken::Stage { node: id, operand });
                }
            }
        }
        if let Some(&output) = self.outputs.iter().find(|output| output.index() >= self.nodes.len()) {
            return Err(Broken::Output { output });
        }
        let expected: usize = self.layout.forms.iter().map(|&form| self.layout.len_of(form)).sum();
        if self.outputs.len() != expected {
            return Err(Broken::Length { expected, found: self.outputs.len() });
        }
        let mut seen = std::collections::HashMap::new();
        for (id, op) in self.ids() {
            if let Some(first) = seen.insert(op, id) {
                return Err(Broken::Twice { first, second: id });
            }
        }
        Ok(())
    }

    fn ids(&self) -> impl Iterator<Item = (NodeId, Op)> + '_ {
        (0u32..).map(NodeId).zip(self.nodes.iter().copied())
    }
}

/// What is wrong with a program that does not hold together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Broken {
    /// An operand is not computed before it is read.
    #[error("node {node:?} reads {operand:?}, which does not come before it")]
    Order {
        /// Who reads.
        node: NodeId,
        /// What is read.
        operand: NodeId,
    },
    /// A prepared node reads an evaluated one.
    #[error("node {node:?} is prepared but reads {operand:?}, which is not")]
    Stage {
        /// Who reads.
        node: NodeId,
        /// What is read.
        operand: NodeId,
    },
    /// An output is no node.
    #[error("output {output:?} does not exist")]
    Output {
        /// The missing node.
        output: NodeId,
    },
    /// The outputs are not those of the layout.
    #[error("the layout has {expected} outputs, the program {found}")]
    Length {
        /// Of the layout.
        expected: usize,
        /// Of the program.
        found: usize,
    },
    /// Two nodes are the same operation.
    #[error("nodes {first:?} and {second:?} are equal")]
    Twice {
        /// The earlier.
        first: NodeId,
        /// The later.
        second: NodeId,
    },
}

/// How much a program computes, stage by stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Once for a set of errors.
    pub prepared: Tally,
    /// Once for a pose.
    pub evaluated: Tally,
}

/// How much one stage computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Tally {
    /// Additions, subtractions, multiplications, divisions, changes of sign, roots and arc tangents.
    pub operations: usize,
    /// Sines and cosines, each counted as one.
    pub sines_and_cosines: usize,
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "prepared {}, evaluated {}", self.prepared, self.evaluated)
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} operations + {} sines and cosines", self.operations, self.sines_and_cosines)
    }
}
