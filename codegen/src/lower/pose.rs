//! One pose: which nodes get a name, and which stand inside the expression that reads them.

use super::tree::{Angle, Expr, Function, Infix, Name, Statement, Wave};
use crate::program::{NodeId, Op, Program, Stage};

/// Expressions with more leaves than this get a name, even if they are read once.
const MOST_LEAVES: usize = 8;

/// A program in statements.
pub(crate) struct Pose {
    /// Done once for a set of errors.
    pub(crate) prepared: Vec<Statement>,
    /// What the prepared stage keeps, in the order of [`Name::Kept`].
    pub(crate) kept: Vec<Expr>,
    /// Done once for a pose.
    pub(crate) evaluated: Vec<Statement>,
    /// What comes out, in the order of the program's outputs.
    pub(crate) outputs: Vec<Expr>,
}

impl Pose {
    /// What comes out component by component, each with its columns.
    pub(crate) fn components(&self, columns: usize) -> impl Iterator<Item = &[Expr]> {
        self.outputs.chunks(columns.max(1))
    }
}

/// Lowers a program.
pub(crate) fn pose(program: &Program) -> Pose {
    let mut lowering = Lowering::new(program);
    let prepared = lowering.stage(Stage::Prepared);
    let carried = program.carried();
    let kept = carried.iter().map(|&node| lowering.read(node)).collect();
    for (place, node) in carried.into_iter().enumerate() {
        lowering.values[node.index()] = Some(Expr::Named(Name::Kept(place)));
    }
    let evaluated = lowering.stage(Stage::Evaluated);
    let outputs = program.outputs().iter().map(|&node| lowering.read(node)).collect();
    Pose { prepared, kept, evaluated, outputs }
}

struct Lowering<'a> {
    program: &'a Program,
    /// What reads a node writes; nothing before the node's turn.
    values: Vec<Option<Expr>>,
    readers: Vec<usize>,
    /// Sine and cosine of each angle, by the angle's node, until their statement is written.
    waves: Vec<[Option<NodeId>; 2]>,
}

impl<'a> Lowering<'a> {
    fn new(program: &'a Program) -> Self {
        let count = program.nodes().len();
        let mut readers = vec![0; count];
        let mut waves = vec![[None; 2]; count];
        for (id, op) in program.stage(Stage::Prepared).chain(program.stage(Stage::Evaluated)) {
            for operand in op.operands() {
                readers[operand.index()] += 1;
            }
            match op {
                Op::Sin(angle) => waves[angle.index()][0] = Some(id),
                Op::Cos(angle) => waves[angle.index()][1] = Some(id),
                _ => {}
            }
        }
        for output in program.outputs() {
            readers[output.index()] += 1;
        }
        Self { program, values: vec![None; count], readers, waves }
    }

    fn read(&self, node: NodeId) -> Expr {
        match &self.values[node.index()] {
            Some(value) => value.clone(),
            None => unreachable!("a program computes {node:?} before it is read"),
        }
    }

    fn stage(&mut self, stage: Stage) -> Vec<Statement> {
        let mut statements = Vec::new();
        for (id, op) in self.program.stage(stage) {
            if let Op::Sin(angle) | Op::Cos(angle) = op {
                statements.extend(self.sin_cos(angle));
                continue;
            }
            let value = self.value(op);
            let is_leaf = matches!(op, Op::Constant(_) | Op::Input(_));
            let is_short = self.readers[id.index()] <= 1 && value.leaves() <= MOST_LEAVES;
            self.values[id.index()] = Some(if is_leaf || is_short {
                value
            } else {
                statements.push(Statement::Let(Name::Node(id), value));
                Expr::Named(Name::Node(id))
            });
        }
        statements
    }

    /// The statement for sine and cosine of an angle, when the first of them is due.
    fn sin_cos(&mut self, angle: NodeId) -> Option<Statement> {
        let nodes = std::mem::take(&mut self.waves[angle.index()]);
        if nodes == [None; 2] {
            return None;
        }
        let names: [Option<Name>; 2] = std::array::from_fn(|index| {
            let node = nodes[index]?;
            let name = match self.program.nodes()[angle.index()] {
                Op::Input(symbol) => Name::Wave([Wave::Sine, Wave::Cosine][index], Angle::Symbol(symbol)),
                _ => Name::Node(node),
            };
            self.values[node.index()] = Some(Expr::Named(name));
            Some(name)
        });
        let [sine, cosine] = names;
        Some(Statement::SinCos { angle: self.read(angle), sine, cosine })
    }

    fn value(&self, op: Op) -> Expr {
        let infix = |infix, a, b| Expr::infix(infix, self.read(a), self.read(b));
        match op {
            Op::Constant(literal) => Expr::Number(literal.value()),
            Op::Input(symbol) => Expr::Symbol(symbol),
            Op::Neg(a) => self.read(a).neg(),
            Op::Add(a, b) => infix(Infix::Add, a, b),
            Op::Sub(a, b) => infix(Infix::Sub, a, b),
            Op::Mul(a, b) => infix(Infix::Mul, a, b),
            Op::Div(a, b) => infix(Infix::Div, a, b),
            Op::Saturate(a) => Expr::Call(Function::Saturate, Box::new(self.read(a))),
            Op::Step(a) => Expr::Call(Function::Step, Box::new(self.read(a))),
            Op::Root(a) => Expr::Call(Function::Root, Box::new(self.read(a))),
            Op::ArcTangent(a, b) => Expr::arc_tangent(self.read(a), self.read(b)),
            Op::Sin(_) | Op::Cos(_) => unreachable!("sines and cosines have a statement of their own"),
        }
    }
}
