//! The evaluated stage of a program as loops over a block of rows, in words that Rust and C share.
//!
//! First come the angles: each column of angles, or angle computed from columns, goes through the vector sine and
//! cosine into arrays of its own. What is left is one loop without calls or branches, which compilers turn into vector
//! code. Where that loop does little but store, sines and cosines are part of it, so that their arithmetic goes on while
//! results are stored. A product that only one sum reads is fused with that sum on processors that can; that is all
//! that keeps the bits from being the interpreter's.

use model_core::SymbolId;

use crate::program::{NodeId, Op, Program, Stage};

/// The last loop takes sines and cosines in if it has at most so many operations for each value that it stores: about as
/// many as a processor does in the time of a store. One that computes more is faster alone, for its values and the
/// constants of sine and cosine do not fit into the registers together.
const OPERATIONS_A_STORE: usize = 2;

/// How a language writes what stands in the loops.
pub(crate) struct Dialect<'a> {
    /// A symbol's name.
    pub(crate) name: &'a dyn Fn(SymbolId) -> String,
    /// What stands before the name of a new value: `let`.
    pub(crate) binding: &'static str,
    /// The call of a·b + c up to the first operand.
    pub(crate) mul_add: &'static str,
    /// The call that puts a value between 0 and 1, up to the value.
    pub(crate) saturate: &'static str,
    /// The call that is 1 from 0 on and 0 below, up to the value.
    pub(crate) step: &'static str,
}

/// One angle whose sine or cosine is read.
pub(crate) struct Angle {
    /// Its name in those of its arrays: `sine_alpha`, `cosine_alpha`.
    pub(crate) name: String,
    /// The statements that compute it in a row, the last of them the value, if it is no column.
    pub(crate) computed: Option<(Vec<String>, String)>,
}

/// A program's evaluated stage. In statements, `row` is the row, `column_alpha` a column, `p3` the third carried
/// value, and `sine_alpha` an angle's array, or its value in this row if sines and cosines are in the last loop.
pub(crate) struct Rows {
    /// The columns that are read.
    pub(crate) columns: Vec<SymbolId>,
    /// Angles, each after those that it depends on.
    pub(crate) angles: Vec<Angle>,
    /// Whether sines and cosines belong into the last loop. All angles are columns then.
    pub(crate) in_one_loop: bool,
    /// Values that are the same number in every row and for all errors.
    pub(crate) fixed: Vec<Line>,
    /// Statements of the last loop.
    pub(crate) statements: Vec<Line>,
    /// How many different values come out.
    pub(crate) distinct: usize,
    /// For each output of the program, which of the different values it is.
    pub(crate) places: Vec<usize>,
}

/// One statement of the last loop.
pub(crate) enum Line {
    /// A new value.
    Bind(String),
    /// A value that comes out.
    Store {
        /// Which of the different values.
        place: usize,
        /// The value.
        value: String,
    },
}

impl Rows {
    /// What lines of the last loop say in a row, in Rust and C alike: values of a Jacobian are stored in its block, others
    /// in the array of each output.
    pub(crate) fn in_row<'a>(
        &self,
        lines: impl IntoIterator<Item = &'a Line>,
        is_jacobian: bool,
    ) -> Vec<String> {
        let mut statements = Vec::new();
        for line in lines {
            match line {
                Line::Bind(statement) => statements.push(statement.clone()),
                Line::Store { place, value } if is_jacobian => {
                    statements.push(format!("out[{place}][row] = {value};"));
                }
                Line::Store { place, value } => {
                    let outputs = self.places.iter().enumerate().filter(|&(_, at)| at == place);
                    statements.extend(outputs.map(|(index, _)| format!("out{index}[row] = {value};")));
                }
            }
        }
        statements
    }
}

/// Lists a program.
pub(crate) fn rows(program: &Program, dialect: &Dialect<'_>) -> Rows {
    let lister = Lister::new(program, dialect);
    let in_one_loop = lister.is_little_but_stores();
    Lister { in_one_loop, ..lister }.list()
}

struct Lister<'a> {
    program: &'a Program,
    dialect: &'a Dialect<'a>,
    /// How often each node is read, outputs included.
    readers: Vec<usize>,
    carried: Vec<NodeId>,
    in_one_loop: bool,
}

impl<'a> Lister<'a> {
    fn new(program: &'a Program, dialect: &'a Dialect<'a>) -> Self {
        let mut readers = vec![0; program.nodes().len()];
        let operands = program.stage(Stage::Evaluated).flat_map(|(_, op)| op.operands());
        for node in operands.chain(program.outputs().iter().copied()) {
            readers[node.index()] += 1;
        }
        Self { program, dialect, readers, carried: program.carried(), in_one_loop: false }
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

    /// The different values that come out, and for each output, which of them it is.
    fn outputs(&self) -> (Vec<NodeId>, Vec<usize>) {
        let mut distinct: Vec<NodeId> = Vec::new();
        let mut places = Vec::new();
        for &output in self.program.outputs() {
            let place = distinct.iter().position(|&node| node == output).unwrap_or(distinct.len());
            if place == distinct.len() {
                distinct.push(output);
            }
            places.push(place);
        }
        (distinct, places)
    }

    /// Whether the last loop stores nearly as much as it computes, and can take in sines and cosines.
    fn is_little_but_stores(&self) -> bool {
        let angles = self.angles();
        let (distinct, _) = self.outputs();
        let stores = distinct.iter().filter(|&&node| !matches!(self.op(node), Op::Constant(_))).count();
        let is_operation = |node| !matches!(self.op(node), Op::Sin(_) | Op::Cos(_) | Op::Input(_));
        let operations = self.statements(&distinct).filter(|&(node, _)| is_operation(node)).count();
        !angles.is_empty()
            && angles.iter().all(|&angle| matches!(self.op(angle), Op::Input(_)))
            && operations <= OPERATIONS_A_STORE * stores
    }

    fn list(&self) -> Rows {
        let columns = self.program.stage(Stage::Evaluated).filter_map(|(_, op)| match op {
            Op::Input(symbol) => Some(symbol),
            _ => None,
        });
        let angles = self
            .angles()
            .into_iter()
            .map(|angle| {
                let computed = match self.op(angle) {
                    Op::Input(_) => None,
                    _ => Some((self.statements(&[angle]).map(|(_, text)| text).collect(), self.text(angle))),
                };
                Angle { name: self.angle_name(angle), computed }
            })
            .collect();

        let (distinct, places) = self.outputs();
        let store = |node: NodeId| {
            let place = distinct.iter().position(|&output| output == node)?;
            Some(Line::Store { place, value: self.text(node) })
        };
        let (fixed, prepared): (Vec<NodeId>, Vec<NodeId>) = distinct
            .iter()
            .filter(|&&node| self.program.stage_of(node) == Stage::Prepared)
            .partition(|&&node| matches!(self.op(node), Op::Constant(_)));
        let fixed = fixed.into_iter().filter_map(store).collect();
        let mut statements: Vec<Line> = prepared.into_iter().filter_map(store).collect();
        for (node, text) in self.statements(&distinct) {
            statements.push(Line::Bind(text));
            // As soon as it is known, so that it need not be kept.
            statements.extend(store(node));
        }
        Rows {
            columns: columns.collect(),
            angles,
            in_one_loop: self.in_one_loop,
            fixed,
            statements,
            distinct: distinct.len(),
            places,
        }
    }

    /// The statements that some nodes need, in order, sines and cosines by their names.
    fn statements(&self, roots: &[NodeId]) -> impl Iterator<Item = (NodeId, String)> {
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
            lines.push((node, format!("{} {} = {value};", self.dialect.binding, self.text(node))));
        }
        lines.into_iter().rev()
    }

    /// What a node is in a row, and the nodes that must be there before.
    fn value(&self, op: Op) -> (String, Vec<NodeId>) {
        let fused = |[x, y]: [NodeId; 2], sign: &str, sum: String, rest: NodeId| {
            let text = format!("{}{sign}{}, {}, {sum})", self.dialect.mul_add, self.text(x), self.text(y));
            (text, vec![x, y, rest])
        };
        let plain = |sign: &str, a: NodeId, b: NodeId| {
            (format!("{} {sign} {}", self.text(a), self.text(b)), vec![a, b])
        };
        match op {
            Op::Add(a, b) => match (self.product(a), self.product(b)) {
                (Some(product), _) => fused(product, "", self.text(b), b),
                (None, Some(product)) => fused(product, "", self.text(a), a),
                (None, None) => plain("+", a, b),
            },
            Op::Sub(a, b) => match (self.product(a), self.product(b)) {
                (_, Some(product)) => fused(product, "-", self.text(a), a),
                (Some(product), None) => fused(product, "", format!("-{}", self.text(b)), b),
                (None, None) => plain("-", a, b),
            },
            Op::Mul(a, b) => plain("*", a, b),
            Op::Div(a, b) => plain("/", a, b),
            Op::Neg(a) => (format!("-{}", self.text(a)), vec![a]),
            Op::Saturate(a) => (format!("{}{})", self.dialect.saturate, self.text(a)), vec![a]),
            Op::Step(a) => (format!("{}{})", self.dialect.step, self.text(a)), vec![a]),
            Op::Sin(angle) => (format!("sine_{}{}", self.angle_name(angle), self.of_row()), vec![]),
            Op::Cos(angle) => (format!("cosine_{}{}", self.angle_name(angle), self.of_row()), vec![]),
            Op::Input(symbol) => (format!("column_{}[row]", (self.dialect.name)(symbol)), vec![]),
            Op::Constant(literal) => (format!("{:?}", literal.value()), vec![]),
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

    /// What follows the name of a sine or cosine.
    fn of_row(&self) -> &'static str {
        if self.in_one_loop { "" } else { "[row]" }
    }

    fn angle_name(&self, angle: NodeId) -> String {
        match self.op(angle) {
            Op::Input(symbol) => (self.dialect.name)(symbol),
            _ => angle.index().to_string(),
        }
    }

    /// A node as an operand.
    fn text(&self, node: NodeId) -> String {
        match (self.op(node), self.carried.iter().position(|&carried| carried == node)) {
            (Op::Constant(literal), _) if literal.value().is_sign_negative() => {
                format!("({:?})", literal.value())
            }
            (Op::Constant(literal), _) => format!("{:?}", literal.value()),
            (_, Some(index)) => format!("p{index}"),
            (_, None) => format!("v{}", node.index()),
        }
    }
}
