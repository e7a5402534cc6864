//! The evaluated stage over blocks of rows: each instruction does one operation on a whole block, so that
//! deciding what to do costs little beside doing it, and the loop over a block can be vectorised.
//!
//! Blocks live in *slots*. A slot is given back when its last reader has run, so that the working memory of
//! a long program stays in the nearest cache.

use std::cell::Cell;
use std::collections::BTreeMap;

use model_core::SymbolId;

use crate::program::{NodeId, Op, Program, Stage};
use crate::vector::{self, Arithmetic, Portable, ROWS, arc_tangent, root, saturate, sin_cos_rows, step};

/// Rows that are loaded before any is stored.
const LANES: usize = 8;

type Slot = [Cell<f64>; ROWS];

/// One operation on blocks; the numbers are slots.
#[derive(Debug, Clone, Copy)]
enum Instruction {
    /// Fills a slot from a symbol's column.
    Load {
        symbol: SymbolId,
        to: usize,
    },
    Neg {
        a: usize,
        to: usize,
    },
    Saturate {
        a: usize,
        to: usize,
    },
    Step {
        a: usize,
        to: usize,
    },
    Root {
        a: usize,
        to: usize,
    },
    ArcTangent {
        a: usize,
        b: usize,
        to: usize,
    },
    Add {
        a: usize,
        b: usize,
        to: usize,
    },
    Sub {
        a: usize,
        b: usize,
        to: usize,
    },
    Mul {
        a: usize,
        b: usize,
        to: usize,
    },
    Div {
        a: usize,
        b: usize,
        to: usize,
    },
    SinCos {
        angle: usize,
        sin: usize,
        cos: usize,
    },
    /// Writes a slot out.
    Store {
        from: usize,
        output: usize,
    },
}

/// Instructions and slots.
#[derive(Debug, Clone)]
pub(super) struct Tape {
    instructions: Vec<Instruction>,
    /// Prepared nodes and the slots that hold them in every row.
    broadcast: Vec<(NodeId, usize)>,
    /// Outputs that are prepared: the same in every row.
    uniform: Vec<(NodeId, usize)>,
    slots: Vec<Slot>,
}

impl Tape {
    pub(super) fn new(program: &Program) -> Self {
        Planner::new(program).plan()
    }

    /// Runs every block. `prepared` holds the value of each prepared node; the caller has checked that all
    /// columns and outputs have `rows` rows and that symbols without column have a constant.
    pub(super) fn run(
        &mut self,
        prepared: &[f64],
        columns: &[(SymbolId, &[f64])],
        constants: &[f64],
        rows: usize,
        out: &mut [&mut [f64]],
    ) {
        for &(node, output) in &self.uniform {
            out[output].fill(prepared[node.index()]);
        }
        for &(node, slot) in &self.broadcast {
            fill(&self.slots[slot], prepared[node.index()]);
        }
        let work = Blocks { tape: self, columns, constants, rows, out };
        vector::run(vector::path(), work);
    }
}

/// The blocks of one call.
struct Blocks<'a, 'o> {
    tape: &'a Tape,
    columns: &'a [(SymbolId, &'a [f64])],
    constants: &'a [f64],
    rows: usize,
    out: &'a mut [&'o mut [f64]],
}

impl vector::Work for Blocks<'_, '_> {
    /// On the widest registers of the processor but with nothing fused, so that each row has the same bits on every
    /// processor, and those of one pose.
    #[inline(always)]
    fn run<A: Arithmetic>(mut self, _: A) {
        for start in (0..self.rows).step_by(ROWS) {
            let end = self.rows.min(start + ROWS);
            for instruction in &self.tape.instructions {
                self.step(*instruction, start, end);
            }
        }
    }
}

impl Blocks<'_, '_> {
    #[inline(always)]
    fn step(&mut self, instruction: Instruction, start: usize, end: usize) {
        let slot = |index: usize| &self.tape.slots[index];
        match instruction {
            Instruction::Load { symbol, to } => match self.columns.iter().find(|&&(id, _)| id == symbol) {
                Some((_, column)) => {
                    for (cell, value) in slot(to).iter().zip(&column[start..end]) {
                        cell.set(*value);
                    }
                }
                None => fill(slot(to), self.constants[symbol.index()]),
            },
            Instruction::Neg { a, to } => map(slot(a), slot(a), slot(to), |a, _| -a),
            Instruction::Saturate { a, to } => map(slot(a), slot(a), slot(to), |a, _| saturate(a)),
            Instruction::Step { a, to } => map(slot(a), slot(a), slot(to), |a, _| step(a)),
            Instruction::Root { a, to } => map(slot(a), slot(a), slot(to), |a, _| root(a)),
            Instruction::ArcTangent { a, b, to } => map(slot(a), slot(b), slot(to), arc_tangent),
            Instruction::Add { a, b, to } => map(slot(a), slot(b), slot(to), |a, b| a + b),
            Instruction::Sub { a, b, to } => map(slot(a), slot(b), slot(to), |a, b| a - b),
            Instruction::Mul { a, b, to } => map(slot(a), slot(b), slot(to), |a, b| a * b),
            Instruction::Div { a, b, to } => map(slot(a), slot(b), slot(to), |a, b| a / b),
            Instruction::SinCos { angle, sin, cos } => {
                let angles = slot(angle).each_ref().map(Cell::get);
                let mut waves = vector::Waves::NEW;
                let (sines, cosines) = sin_cos_rows(Portable, &angles, &mut waves);
                slot(sin).iter().zip(sines).for_each(|(cell, &sine)| cell.set(sine));
                slot(cos).iter().zip(cosines).for_each(|(cell, &cosine)| cell.set(cosine));
            }
            Instruction::Store { from, output } => {
                for (value, cell) in self.out[output][start..end].iter_mut().zip(slot(from)) {
                    *value = cell.get();
                }
            }
        }
    }
}

fn fill(slot: &Slot, value: f64) {
    for cell in slot {
        cell.set(value);
    }
}

/// One operation on two blocks. Whole groups of lanes are read before they are written, so that a slot may be
/// its own operand and the compiler can use vectors.
#[inline(always)]
fn map(a: &Slot, b: &Slot, to: &Slot, f: impl Fn(f64, f64) -> f64) {
    let (a, _) = a.as_chunks::<LANES>();
    let (b, _) = b.as_chunks::<LANES>();
    let (to, _) = to.as_chunks::<LANES>();
    for ((a, b), to) in a.iter().zip(b).zip(to) {
        let result: [f64; LANES] = std::array::from_fn(|lane| f(a[lane].get(), b[lane].get()));
        for (cell, value) in to.iter().zip(result) {
            cell.set(value);
        }
    }
}

/// Gives each node a slot and takes it back after the last reader.
struct Planner<'p> {
    program: &'p Program,
    slot_of: Vec<Option<usize>>,
    /// How many reads of each node are still to come.
    readers: Vec<usize>,
    /// Sine and cosine of each angle, by the angle's node.
    waves: BTreeMap<NodeId, Waves>,
    free: Vec<usize>,
    slots: usize,
    instructions: Vec<Instruction>,
}

/// The nodes that are sine and cosine of one angle.
#[derive(Default)]
struct Waves {
    sin: Option<NodeId>,
    cos: Option<NodeId>,
}

impl<'p> Planner<'p> {
    fn new(program: &'p Program) -> Self {
        let mut readers = vec![0; program.nodes.len()];
        let mut waves: BTreeMap<NodeId, Waves> = BTreeMap::new();
        for (node, op) in program.stage(Stage::Evaluated) {
            for operand in op.operands() {
                readers[operand.index()] += 1;
            }
            match op {
                Op::Sin(angle) => waves.entry(angle).or_default().sin = Some(node),
                Op::Cos(angle) => waves.entry(angle).or_default().cos = Some(node),
                _ => {}
            }
        }
        let slot_of = vec![None; program.nodes.len()];
        let (free, instructions) = (Vec::new(), Vec::new());
        Self { program, slot_of, readers, waves, free, slots: 0, instructions }
    }

    fn plan(mut self) -> Tape {
        let mut broadcast = Vec::new();
        for (node, _) in self.program.stage(Stage::Prepared) {
            if self.readers[node.index()] > 0 {
                let slot = self.take();
                self.slot_of[node.index()] = Some(slot);
                broadcast.push((node, slot));
            }
        }
        let mut stores: Vec<Vec<usize>> = vec![Vec::new(); self.program.nodes.len()];
        let mut uniform = Vec::new();
        for (output, &node) in self.program.outputs.iter().enumerate() {
            match self.program.stage_of(node) {
                Stage::Prepared => uniform.push((node, output)),
                Stage::Evaluated => stores[node.index()].push(output),
            }
        }
        for (node, op) in self.program.stage(Stage::Evaluated) {
            let from = self.compute(node, op);
            let outputs = &stores[node.index()];
            self.instructions.extend(outputs.iter().map(|&output| Instruction::Store { from, output }));
            if self.readers[node.index()] == 0 {
                self.free.push(from);
            }
        }
        let slots = (0..self.slots).map(|_| [const { Cell::new(0.0) }; ROWS]).collect();
        Tape { instructions: self.instructions, broadcast, uniform, slots }
    }

    /// Adds the instruction of a node; the slot where its value is.
    fn compute(&mut self, node: NodeId, op: Op) -> usize {
        if let Op::Sin(angle) | Op::Cos(angle) = op {
            return self.sin_cos(node, angle);
        }
        let operands: Vec<usize> = op.operands().map(|operand| self.slot(operand)).collect();
        for operand in op.operands() {
            self.release(operand);
        }
        let to = self.take();
        self.slot_of[node.index()] = Some(to);
        self.instructions.push(match (op, operands.as_slice()) {
            (Op::Input(symbol), []) => Instruction::Load { symbol, to },
            (Op::Neg(_), &[a]) => Instruction::Neg { a, to },
            (Op::Saturate(_), &[a]) => Instruction::Saturate { a, to },
            (Op::Step(_), &[a]) => Instruction::Step { a, to },
            (Op::Root(_), &[a]) => Instruction::Root { a, to },
            (Op::ArcTangent(..), &[a, b]) => Instruction::ArcTangent { a, b, to },
            (Op::Add(..), &[a, b]) => Instruction::Add { a, b, to },
            (Op::Sub(..), &[a, b]) => Instruction::Sub { a, b, to },
            (Op::Mul(..), &[a, b]) => Instruction::Mul { a, b, to },
            (Op::Div(..), &[a, b]) => Instruction::Div { a, b, to },
            _ => unreachable!(
                "{op:?}: numbers are prepared, and sines and cosines have instructions of their own"
            ),
        });
        to
    }

    /// Sine and cosine of one angle come together, when the first of them is due.
    fn sin_cos(&mut self, node: NodeId, angle: NodeId) -> usize {
        if let Some(slot) = self.slot_of[node.index()] {
            return slot;
        }
        let Some(waves) = self.waves.remove(&angle) else {
            unreachable!("the first sine or cosine of an angle gives both their slots")
        };
        let from = self.slot(angle);
        let (sin, cos) = (self.take(), self.take());
        for (wave, slot) in [(waves.sin, sin), (waves.cos, cos)] {
            match wave {
                Some(wave) => {
                    self.release(angle);
                    self.slot_of[wave.index()] = Some(slot);
                }
                None => self.free.push(slot),
            }
        }
        self.instructions.push(Instruction::SinCos { angle: from, sin, cos });
        self.slot(node)
    }

    /// Where a node is; every operand has been computed before it is read.
    fn slot(&self, node: NodeId) -> usize {
        let Some(slot) = self.slot_of[node.index()] else {
            unreachable!("a node is read only after it has been computed")
        };
        slot
    }

    /// Counts one read of a node; its slot is free after the last, unless every block reads it.
    fn release(&mut self, node: NodeId) {
        let readers = &mut self.readers[node.index()];
        *readers -= 1;
        if *readers == 0 && self.program.stage_of(node) == Stage::Evaluated {
            self.free.extend(self.slot_of[node.index()]);
        }
    }

    fn take(&mut self) -> usize {
        self.free.pop().unwrap_or_else(|| {
            self.slots += 1;
            self.slots - 1
        })
    }
}
