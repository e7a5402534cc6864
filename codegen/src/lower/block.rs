//! A block of rows: the evaluated stage as loops, which compilers turn into vector code.
//!
//! First come the angles: each column of angles, or angle computed from columns, goes through the vector sine and
//! cosine into arrays of its own. What is left is one loop without calls or branches. Where that loop does little but
//! store, sines and cosines are part of it, so that their arithmetic goes on while results are stored. A product that
//! only one sum reads is fused with that sum on processors that can; that is all that keeps the bits from being the
//! interpreter's.

use model_core::SymbolId;

use super::tree::{Angle, Expr, Function, Infix, Name, Statement, Target, Wave};
use crate::program::{NodeId, Op, Program, Stage};

/// The last loop takes sines and cosines in if it has at most so many operations for each value that it stores: about as
/// many as a processor does in the time of a store. One that computes more is faster alone, for its values and the
/// constants of sine and cosine do not fit into the registers together.
const OPERATIONS_A_STORE: usize = 2;

/// A program's evaluated stage for a block of rows.
pub(crate) struct Block {
    /// The columns that are read.
    pub(crate) columns: Vec<SymbolId>,
    /// The columns of which the last loop takes sines and cosines itself: the loop is written for angles of any size, and
    /// once more for angles that are all small.
    pub(crate) angles_in_loop: Vec<SymbolId>,
    pub(crate) body: Vec<Statement>,
    /// Values that are the same number in every row and for all errors, by their places.
    pub(crate) fixed: Vec<(usize, f64)>,
    /// How many different values come out.
    pub(crate) distinct: usize,
    /// For each output of the program, which of the different values it is.
    pub(crate) places: Vec<usize>,
}

/// Who writes the values that are fixed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fixed {
    /// The last loop, row by row.
    InLoop,
    /// Whoever makes the block, once.
    Before,
}

/// Lowers a program.
pub(crate) fn block(program: &Program, fixed: Fixed) -> Block {
    let mut lowering = Lowering::new(program);
    lowering.in_one_loop = lowering.is_little_but_stores();
    lowering.block(fixed)
}

struct Lowering<'a> {
    program: &'a Program,
    /// How often each node is read, outputs included.
    readers: Vec<usize>,
    /// By node: its place among what the prepared stage keeps.
    kept: Vec<Option<usize>>,
    /// The different values that come out.
    distinct: Vec<NodeId>,
    /// For each output, which of the different values it is.
    places: Vec<usize>,
    /// By node: which of the different values it is.
    place_of: Vec<Option<usize>>,
    in_one_loop: bool,
}

impl<'a> Lowering<'a> {
    fn new(program: &'a Program) -> Self {
        let count = program.nodes().len();
        let mut readers = vec![0; count];
        let operands = program.stage(Stage::Evaluated).flat_map(|(_, op)| op.operands());
        for node in operands.chain(program.outputs().iter().copied()) {
            readers[node.index()] += 1;
        }
        let mut kept = vec![None; count];
        for (place, node) in program.carried().into_iter().enumerate() {
            kept[node.index()] = Some(place);
        }
        let mut distinct = Vec::new();
        let mut place_of = vec![None; count];
        let places = program.outputs().iter().map(|&output| {
            *place_of[output.index()].get_or_insert_with(|| {
                distinct.push(output);
                distinct.len() - 1
            })
        });
        let places = places.collect();
        Self { program, readers, kept, distinct, places, place_of, in_one_loop: false }
    }

    /// The nodes whose sine or cosine is read.
    fn angles(&self) -> Vec<NodeId> {
        let mut angles = Vec::new();
        for (_, op) in self.program.stage(Stage::Evaluated) {
            match op {
                Op::Sin(angle) | Op::Cos(angle) if !angles.contains(&angle) => angles.push(angle),
                _ => {}
            }
        }
        angles
    }

    /// Whether the last loop stores nearly as much as it computes, and can take in sines and cosines.
    fn is_little_but_stores(&self) -> bool {
        let angles = self.angles();
        let stores = self.distinct.iter().filter(|&&node| !matches!(self.op(node), Op::Constant(_))).count();
        let is_operation = |node| !matches!(self.op(node), Op::Sin(_) | Op::Cos(_) | Op::Input(_));
        let operations = self.statements(&self.distinct).filter(|&(node, _)| is_operation(node)).count();
        !angles.is_empty()
            && angles.iter().all(|&angle| matches!(self.op(angle), Op::Input(_)))
            && operations <= OPERATIONS_A_STORE * stores
    }

    fn block(&self, fixed_values: Fixed) -> Block {
        let columns = self.program.stage(Stage::Evaluated).filter_map(|(_, op)| match op {
            Op::Input(symbol) => Some(symbol),
            _ => None,
        });
        let mut body = Vec::new();
        let mut in_loop = Vec::new();
        let mut angles_in_loop = Vec::new();
        for node in self.angles() {
            let angle = self.angle(node);
            match angle {
                Angle::Symbol(symbol) if self.in_one_loop => {
                    angles_in_loop.push(symbol);
                    in_loop.push(Statement::SinCos {
                        angle: Expr::Symbol(symbol),
                        sine: Some(Name::Wave(Wave::Sine, angle)),
                        cosine: Some(Name::Wave(Wave::Cosine, angle)),
                    });
                }
                Angle::Symbol(_) => body.push(Statement::SinCosOfRows(angle)),
                Angle::Node(node) => {
                    let mut each: Vec<Statement> = self.statements(&[node]).map(|(_, line)| line).collect();
                    each.push(Statement::Store(Target::Angle(node), self.read(node)));
                    let room = Statement::Angles(node);
                    body.extend([room, Statement::EachRow(each), Statement::SinCosOfRows(angle)]);
                }
            }
        }

        let mut outputs_of = vec![Vec::new(); self.distinct.len()];
        for (output, &place) in self.places.iter().enumerate() {
            outputs_of[place].push(output);
        }
        let is_jacobian = self.program.layout().forms.iter().any(|form| form.is_jacobian());
        let store = |node: NodeId| -> Vec<Statement> {
            let Some(place) = self.place_of[node.index()] else { return Vec::new() };
            let value = self.read(node);
            if is_jacobian {
                return vec![Statement::Store(Target::Column(place), value)];
            }
            let stores = outputs_of[place].iter();
            stores.map(|&output| Statement::Store(Target::Output(output), value.clone())).collect()
        };
        let mut fixed = Vec::new();
        let mut prepared = Vec::new();
        for (place, &node) in self.distinct.iter().enumerate() {
            match (self.op(node), self.program.stage_of(node)) {
                (Op::Constant(literal), _) => {
                    fixed.push((place, literal.value()));
                    if fixed_values == Fixed::InLoop {
                        in_loop.extend(store(node));
                    }
                }
                (_, Stage::Prepared) => prepared.extend(store(node)),
                (_, Stage::Evaluated) => {}
            }
        }
        in_loop.extend(prepared);
        for (node, statement) in self.statements(&self.distinct) {
            in_loop.push(statement);
            // As soon as it is known, so that it need not be kept.
            in_loop.extend(store(node));
        }
        body.push(Statement::EachRow(in_loop));
        let (distinct, places) = (self.distinct.len(), self.places.clone());
        Block { columns: columns.collect(), angles_in_loop, body, fixed, distinct, places }
    }

    /// The statements that some nodes need, in order, sines and cosines by their names.
    fn statements(&self, roots: &[NodeId]) -> impl Iterator<Item = (NodeId, Statement)> {
        let mut needed = vec![false; self.program.nodes().len()];
        for root in roots {
            needed[root.index()] = true;
        }
        let evaluated: Vec<(NodeId, Op)> = self.program.stage(Stage::Evaluated).collect();
        let mut lines = Vec::new();
        for &(node, op) in evaluated.iter().rev() {
            if !needed[node.index()] {
                continue;
            }
            let (value, reads) = self.value(op);
            for read in reads {
                needed[read.index()] = true;
            }
            lines.push((node, Statement::Let(Name::Node(node), value)));
        }
        lines.into_iter().rev()
    }

    /// What a node is in a row, and the nodes that must be there before.
    fn value(&self, op: Op) -> (Expr, Vec<NodeId>) {
        let fused = |[x, y]: [NodeId; 2], sum: Expr, rest: NodeId, is_negative: bool| {
            let first = if is_negative { self.read(x).neg() } else { self.read(x) };
            (Expr::MulAdd(Box::new([first, self.read(y), sum])), vec![x, y, rest])
        };
        let plain = |infix, a, b| (Expr::infix(infix, self.read(a), self.read(b)), vec![a, b]);
        let wave = |wave, angle| (Expr::Named(Name::Wave(wave, self.angle(angle))), vec![]);
        match op {
            Op::Add(a, b) => match (self.product(a), self.product(b)) {
                (Some(product), _) => fused(product, self.read(b), b, false),
                (None, Some(product)) => fused(product, self.read(a), a, false),
                (None, None) => plain(Infix::Add, a, b),
            },
            Op::Sub(a, b) => match (self.product(a), self.product(b)) {
                (_, Some(product)) => fused(product, self.read(a), a, true),
                (Some(product), None) => fused(product, self.read(b).neg(), b, false),
                (None, None) => plain(Infix::Sub, a, b),
            },
            Op::Mul(a, b) => plain(Infix::Mul, a, b),
            Op::Div(a, b) => plain(Infix::Div, a, b),
            Op::Neg(a) => (self.read(a).neg(), vec![a]),
            Op::Saturate(a) => (Expr::Call(Function::Saturate, Box::new(self.read(a))), vec![a]),
            Op::Step(a) => (Expr::Call(Function::Step, Box::new(self.read(a))), vec![a]),
            Op::Root(a) => (Expr::Call(Function::Root, Box::new(self.read(a))), vec![a]),
            Op::ArcTangent(a, b) => (Expr::arc_tangent(self.read(a), self.read(b)), vec![a, b]),
            Op::Sin(angle) => wave(Wave::Sine, angle),
            Op::Cos(angle) => wave(Wave::Cosine, angle),
            Op::Input(symbol) => (Expr::Symbol(symbol), vec![]),
            Op::Constant(literal) => (Expr::Number(literal.value()), vec![]),
        }
    }

    /// The factors of an evaluated product that is read once.
    fn product(&self, node: NodeId) -> Option<[NodeId; 2]> {
        match self.op(node) {
            Op::Mul(a, b)
                if self.readers[node.index()] == 1 && self.program.stage_of(node) == Stage::Evaluated =>
            {
                Some([a, b])
            }
            _ => None,
        }
    }

    fn op(&self, node: NodeId) -> Op {
        self.program.nodes()[node.index()]
    }

    fn angle(&self, node: NodeId) -> Angle {
        match self.op(node) {
            Op::Input(symbol) => Angle::Symbol(symbol),
            _ => Angle::Node(node),
        }
    }

    /// A node as an operand.
    fn read(&self, node: NodeId) -> Expr {
        match (self.op(node), self.kept[node.index()]) {
            (Op::Constant(literal), _) => Expr::Number(literal.value()),
            (_, Some(place)) => Expr::Named(Name::Kept(place)),
            (_, None) => Expr::Named(Name::Node(node)),
        }
    }
}
