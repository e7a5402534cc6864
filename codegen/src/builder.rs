//! Where nodes are made: equal nodes are shared, numbers folded, zeros and ones gone, signs pulled out.
//!
//! A [`Value`] is a node with a sign, so that a change of sign costs nothing and `a - b` and `b - a` are one
//! node. Signs turn into operations only at the outputs, where they cannot be helped.

use std::collections::HashMap;

use model_core::chain::sight::SightAngle;
use model_core::ramp::Ramp;
use model_core::{Chain, SymbolId, SymbolKind};

use crate::program::{Layout, Literal, NodeId, Op, Program, Stage};
use crate::vector::{arc_tangent, root, sin_cos};

/// A node or its negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Value {
    node: NodeId,
    negative: bool,
}

impl std::ops::Neg for Value {
    type Output = Self;

    /// Zero has no sign, so that what is structurally zero stays recognisable.
    fn neg(self) -> Self {
        if self == Builder::ZERO { self } else { Self { negative: !self.negative, ..self } }
    }
}

/// Nodes made so far.
pub(crate) struct Builder {
    nodes: Vec<Op>,
    stages: Vec<Stage>,
    shared: HashMap<Op, NodeId>,
    symbol_stages: Vec<Stage>,
    ramps: Vec<Ramp>,
    sight_angles: Vec<SightAngle>,
    /// Symbols that are numbers, by their index.
    numbers: Vec<Option<f64>>,
}

impl Builder {
    /// Structurally zero: the first node of every builder.
    pub(crate) const ZERO: Value = Value { node: NodeId(0), negative: false };
    /// One: the second node of every builder.
    pub(crate) const ONE: Value = Value { node: NodeId(1), negative: false };

    /// No nodes but zero and one, for the symbols of a chain. Symbols with a value are numbers; so are all
    /// constants then.
    pub(crate) fn new(chain: &Chain, values: &[(SymbolId, f64)]) -> Self {
        let symbol_stages = chain
            .symbols
            .iter()
            .map(|symbol| match symbol.kind {
                SymbolKind::Pi | SymbolKind::Error | SymbolKind::Constant => Stage::Prepared,
                SymbolKind::Joint | SymbolKind::Input | SymbolKind::Ramp | SymbolKind::SightAngle => {
                    Stage::Evaluated
                }
            })
            .collect();
        let mut numbers: Vec<Option<f64>> = vec![None; chain.symbols.len()];
        numbers[SymbolId::PI.index()] = Some(std::f64::consts::PI);
        if !values.is_empty() {
            for id in chain.symbols_of(SymbolKind::Constant) {
                numbers[id.index()] = chain.symbol(id).value;
            }
        }
        for &(id, value) in values {
            numbers[id.index()] = Some(value);
        }
        let (nodes, stages, shared) = (Vec::new(), Vec::new(), HashMap::new());
        let (ramps, sight_angles) = (chain.ramps.clone(), chain.sight_angles.clone());
        let mut builder = Self { nodes, stages, shared, symbol_stages, ramps, sight_angles, numbers };
        builder.constant(0.0);
        builder.constant(1.0);
        builder
    }

    /// When a value is computed.
    pub(crate) fn stage(&self, value: Value) -> Stage {
        self.stages[value.node.index()]
    }

    pub(crate) fn constant(&mut self, number: f64) -> Value {
        let node = self.node(Op::Constant(Literal::new(number.abs())));
        Value { node, negative: number < 0.0 }
    }

    pub(crate) fn symbol(&mut self, symbol: SymbolId) -> Value {
        if let Some(number) = self.numbers[symbol.index()] {
            return self.constant(number);
        }
        let node = self.node(Op::Input(symbol));
        Value { node, negative: false }
    }

    /// The ramp that a symbol stands for.
    pub(crate) fn ramp(&self, symbol: SymbolId) -> Option<Ramp> {
        self.ramps.iter().find(|ramp| ramp.symbol == symbol).cloned()
    }

    /// The angle of a line of sight that a symbol stands for.
    pub(crate) fn sight_angle(&self, symbol: SymbolId) -> Option<SightAngle> {
        self.sight_angles.iter().find(|angle| angle.symbol == symbol).cloned()
    }

    /// The angles of lines of sight that depend on a symbol.
    pub(crate) fn sight_angles_of(&self, symbol: SymbolId) -> Vec<SightAngle> {
        let depends = |angle: &&SightAngle| angle.depends_on().any(|id| id == symbol);
        self.sight_angles.iter().filter(depends).cloned().collect()
    }

    /// The ramps that depend on a symbol.
    pub(crate) fn ramps_of(&self, symbol: SymbolId) -> Vec<Ramp> {
        self.ramps.iter().filter(|ramp| ramp.depends_on().any(|id| id == symbol)).cloned().collect()
    }

    /// A value between 0 and 1, and the nearer of the two outside.
    pub(crate) fn saturate(&mut self, a: Value) -> Value {
        let a = self.unsigned(a);
        let node = self.node(Op::Saturate(a));
        Value { node, negative: false }
    }

    /// 1 from zero on, 0 below.
    pub(crate) fn step(&mut self, a: Value) -> Value {
        let a = self.unsigned(a);
        let node = self.node(Op::Step(a));
        Value { node, negative: false }
    }

    /// The square root of what is not negative.
    pub(crate) fn root(&mut self, a: Value) -> Value {
        if let Some(number) = self.number(a) {
            return self.constant(root(number));
        }
        let a = self.unsigned(a);
        let node = self.node(Op::Root(a));
        Value { node, negative: false }
    }

    /// The angle of the point (x, y).
    pub(crate) fn arc_tangent(&mut self, y: Value, x: Value) -> Value {
        if let (Some(y), Some(x)) = (self.number(y), self.number(x)) {
            return self.constant(arc_tangent(y, x));
        }
        let x = self.unsigned(x);
        let node = self.node(Op::ArcTangent(y.node, x));
        Value { node, negative: y.negative }
    }

    /// The node of a value with its sign applied.
    fn unsigned(&mut self, a: Value) -> NodeId {
        if a.negative { self.node(Op::Neg(a.node)) } else { a.node }
    }

    pub(crate) fn add(&mut self, a: Value, b: Value) -> Value {
        if a == Self::ZERO {
            return b;
        }
        if b == Self::ZERO {
            return a;
        }
        if a == -b {
            return Self::ZERO;
        }
        if let (Some(x), Some(y)) = (self.number(a), self.number(b)) {
            return self.constant(x + y);
        }
        let (first, second) = if a.node <= b.node { (a, b) } else { (b, a) };
        let op = if first.negative == second.negative {
            Op::Add(first.node, second.node)
        } else {
            Op::Sub(first.node, second.node)
        };
        let node = self.node(op);
        Value { node, negative: first.negative }
    }

    pub(crate) fn sub(&mut self, a: Value, b: Value) -> Value {
        self.add(a, -b)
    }

    pub(crate) fn mul(&mut self, a: Value, b: Value) -> Value {
        if a == Self::ZERO || b == Self::ZERO {
            return Self::ZERO;
        }
        let negative = a.negative != b.negative;
        if let (Some(x), Some(y)) = (self.number(a), self.number(b)) {
            return self.constant(x * y);
        }
        if a.node == Self::ONE.node {
            return Value { node: b.node, negative };
        }
        if b.node == Self::ONE.node {
            return Value { node: a.node, negative };
        }
        let node = self.node(Op::Mul(a.node.min(b.node), a.node.max(b.node)));
        Value { node, negative }
    }

    pub(crate) fn div(&mut self, a: Value, b: Value) -> Value {
        if a == Self::ZERO {
            return Self::ZERO;
        }
        let negative = a.negative != b.negative;
        if b.node == Self::ONE.node {
            return Value { node: a.node, negative };
        }
        if let (Some(x), Some(y)) = (self.number(a), self.number(b)) {
            return self.constant(x / y);
        }
        let node = self.node(Op::Div(a.node, b.node));
        Value { node, negative }
    }

    /// Sine and cosine of an angle; opposite angles share theirs.
    pub(crate) fn sin_cos(&mut self, angle: Value) -> (Value, Value) {
        if angle == Self::ZERO {
            return (Self::ZERO, Self::ONE);
        }
        if let Some(angle) = self.number(angle) {
            let (sin, cos) = sin_cos(angle);
            return (self.constant(sin), self.constant(cos));
        }
        let sin = self.node(Op::Sin(angle.node));
        let cos = self.node(Op::Cos(angle.node));
        (Value { node: sin, negative: angle.negative }, Value { node: cos, negative: false })
    }

    /// A sum of products, `Σ aᵢ bᵢ`.
    pub(crate) fn dot(&mut self, pairs: impl IntoIterator<Item = (Value, Value)>) -> Value {
        pairs.into_iter().fold(Self::ZERO, |sum, (a, b)| {
            let product = self.mul(a, b);
            self.add(sum, product)
        })
    }

    /// What the nodes are worth as a program with these outputs: only what an output needs, prepared first.
    pub(crate) fn finish(mut self, layout: Layout, outputs: &[Value]) -> Program {
        let outputs = self.apply_signs(outputs);
        let needed = self.needed(&outputs);
        let mut place = vec![NodeId(0); self.nodes.len()];
        let mut nodes = Vec::new();
        let mut prepared = 0;
        for stage in [Stage::Prepared, Stage::Evaluated] {
            let mut order: Vec<usize> =
                (0..self.nodes.len()).filter(|&index| needed[index] && self.stages[index] == stage).collect();
            if stage == Stage::Evaluated {
                order = crate::order::order(&self.nodes, &outputs, &order);
            }
            for index in order {
                place[index] = next_id(&nodes);
                nodes.push(self.nodes[index].map(|operand| place[operand.index()]));
            }
            if stage == Stage::Prepared {
                prepared = nodes.len();
            }
        }
        let outputs = outputs.iter().map(|output| place[output.index()]).collect();
        Program { layout, nodes, prepared, outputs }
    }

    /// The number that a value is, if it is one.
    fn number(&self, value: Value) -> Option<f64> {
        match self.nodes[value.node.index()] {
            Op::Constant(literal) => Some(if value.negative { -literal.value() } else { literal.value() }),
            _ => None,
        }
    }

    /// The node of an operation, shared with an equal one.
    fn node(&mut self, op: Op) -> NodeId {
        if let Some(&id) = self.shared.get(&op) {
            return id;
        }
        let stage = match op {
            Op::Input(symbol) => self.symbol_stages[symbol.index()],
            _ => op.operands().map(|id| self.stages[id.index()]).max().unwrap_or(Stage::Prepared),
        };
        let id = next_id(&self.nodes);
        self.nodes.push(op);
        self.stages.push(stage);
        self.shared.insert(op, id);
        id
    }

    /// The node of each output, its sign applied: by turning a difference round if nothing else reads it, else
    /// by a change of sign.
    fn apply_signs(&mut self, outputs: &[Value]) -> Vec<NodeId> {
        let plain: Vec<NodeId> = outputs.iter().map(|output| output.node).collect();
        let mut read = vec![false; self.nodes.len()];
        let needed = self.needed(&plain);
        for (op, _) in self.nodes.iter().zip(&needed).filter(|&(_, &needed)| needed) {
            for operand in op.operands() {
                read[operand.index()] = true;
            }
        }
        for output in outputs.iter().filter(|output| !output.negative) {
            read[output.node.index()] = true;
        }
        outputs
            .iter()
            .map(|output| {
                if !output.negative {
                    return output.node;
                }
                match self.nodes[output.node.index()] {
                    Op::Constant(literal) => self.node(Op::Constant(Literal::new(-literal.value()))),
                    Op::Sub(a, b) if !read[output.node.index()] => self.node(Op::Sub(b, a)),
                    _ => self.node(Op::Neg(output.node)),
                }
            })
            .collect()
    }

    /// Which nodes these outputs depend on.
    fn needed(&self, outputs: &[NodeId]) -> Vec<bool> {
        let mut needed = vec![false; self.nodes.len()];
        for output in outputs {
            needed[output.index()] = true;
        }
        for index in (0..self.nodes.len()).rev() {
            if needed[index] {
                for operand in self.nodes[index].operands() {
                    needed[operand.index()] = true;
                }
            }
        }
        needed
    }
}

/// A program has fewer nodes than fit memory, far fewer than 2³².
fn next_id(nodes: &[Op]) -> NodeId {
    NodeId(u32::try_from(nodes.len()).unwrap_or(u32::MAX))
}
