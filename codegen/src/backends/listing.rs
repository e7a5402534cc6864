//! A program as statements: which nodes get a name and which stand inside the expression that reads them.
//!
//! What differs between languages with infix arithmetic is in [`Words`]. Parentheses keep the order of
//! operations, so that every language rounds as the interpreter does.

use model_core::SymbolId;

use crate::program::{NodeId, Op, Program, Stage};

/// Expressions longer than this get a name, even if they are read once.
const LONGEST_EXPRESSION: usize = 72;

/// How a language writes names and numbers.
pub(crate) trait Words {
    /// The value of a symbol.
    fn symbol(&self, symbol: SymbolId) -> String;

    /// The name of the sine (`wave` is `sin`) or cosine (`cos`) of a symbol.
    fn wave_of_symbol(&self, wave: &str, symbol: SymbolId) -> String;

    /// A node that the prepared stage leaves for the evaluated one, by its place among them.
    fn carried(&self, index: usize) -> String;

    /// A node inside one stage, by its place among the nodes.
    fn local(&self, index: usize) -> String;

    /// A number.
    fn number(&self, value: f64) -> String {
        format!("{value:?}")
    }

    /// An expression between 0 and 1, and the nearer of the two outside.
    fn saturate(&self, a: &str) -> String;

    /// 1 where an expression is at least 0, else 0.
    fn step(&self, a: &str) -> String;

    /// A product of two expressions, already in parentheses where they need them.
    fn product(&self, a: &str, b: &str) -> String {
        format!("{a} * {b}")
    }

    /// A quotient of two expressions, already in parentheses where they need them.
    fn quotient(&self, a: &str, b: &str) -> String {
        format!("{a} / {b}")
    }
}

/// One statement.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Statement {
    /// `name = value`
    Let { name: String, value: String },
    /// `sin, cos = sine and cosine of angle`; at least one of them is wanted.
    SinCos { angle: String, sin: Option<String>, cos: Option<String> },
}

/// A program in statements.
pub(crate) struct Listing {
    /// Done once for a set of errors.
    pub(crate) prepared: Vec<Statement>,
    /// What the prepared stage leaves, in the order of [`Words::carried`].
    pub(crate) carried: Vec<String>,
    /// Done once for a pose.
    pub(crate) evaluated: Vec<Statement>,
    /// What comes out, in the order of the program's outputs.
    pub(crate) outputs: Vec<String>,
}

impl Listing {
    /// What comes out component by component, each with its columns.
    pub(crate) fn components(&self, columns: usize) -> impl Iterator<Item = &[String]> {
        self.outputs.chunks(columns.max(1))
    }
}

/// Lists a program.
pub(crate) fn list(program: &Program, words: &impl Words) -> Listing {
    let mut lister = Lister::new(program, words);
    let prepared = lister.stage(Stage::Prepared);
    let carried_nodes = program.carried();
    let carried = carried_nodes.iter().map(|&node| lister.text(node)).collect();
    for (index, node) in carried_nodes.into_iter().enumerate() {
        lister.texts[node.index()] = Text::atom(words.carried(index));
    }
    let evaluated = lister.stage(Stage::Evaluated);
    let outputs = program.outputs().iter().map(|&node| lister.text(node)).collect();
    Listing { prepared, carried, evaluated, outputs }
}

/// An expression and how tightly it binds.
#[derive(Debug, Clone, Default)]
struct Text {
    text: String,
    binding: Binding,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
enum Binding {
    Sum,
    Product,
    Sign,
    #[default]
    Atom,
}

impl Text {
    fn atom(text: String) -> Self {
        Self { text, binding: Binding::Atom }
    }

    /// In parentheses unless it binds at least as tightly as this.
    fn at_least(&self, binding: Binding) -> String {
        if self.binding >= binding { self.text.clone() } else { format!("({})", self.text) }
    }
}

struct Lister<'a, W> {
    program: &'a Program,
    words: &'a W,
    texts: Vec<Text>,
    readers: Vec<usize>,
    /// Sine and cosine of each angle, by the angle's node.
    waves: Vec<(Option<NodeId>, Option<NodeId>)>,
}

impl<'a, W: Words> Lister<'a, W> {
    fn new(program: &'a Program, words: &'a W) -> Self {
        let count = program.nodes().len();
        let mut readers = vec![0; count];
        let mut waves = vec![(None, None); count];
        for (id, op) in program.stage(Stage::Prepared).chain(program.stage(Stage::Evaluated)) {
            for operand in op.operands() {
                readers[operand.index()] += 1;
            }
            match op {
                Op::Sin(angle) => waves[angle.index()].0 = Some(id),
                Op::Cos(angle) => waves[angle.index()].1 = Some(id),
                _ => {}
            }
        }
        for output in program.outputs() {
            readers[output.index()] += 1;
        }
        Self { program, words, texts: vec![Text::default(); count], readers, waves }
    }

    fn text(&self, node: NodeId) -> String {
        self.texts[node.index()].text.clone()
    }

    fn stage(&mut self, stage: Stage) -> Vec<Statement> {
        let mut statements = Vec::new();
        for (id, op) in self.program.stage(stage) {
            if let Op::Sin(angle) | Op::Cos(angle) = op {
                statements.extend(self.sin_cos(angle));
                continue;
            }
            let text = self.expression(op);
            let is_leaf = matches!(op, Op::Constant(_) | Op::Input(_));
            let is_short = self.readers[id.index()] <= 1 && text.text.len() <= LONGEST_EXPRESSION;
            self.texts[id.index()] = if is_leaf || is_short {
                text
            } else {
                let name = self.words.local(id.index());
                statements.push(Statement::Let { name: name.clone(), value: text.text });
                Text::atom(name)
            };
        }
        statements
    }

    /// The statement for sine and cosine of an angle, when the first of them is due.
    fn sin_cos(&mut self, angle: NodeId) -> Option<Statement> {
        let (sin, cos) = std::mem::take(&mut self.waves[angle.index()]);
        if sin.is_none() && cos.is_none() {
            return None;
        }
        let mut name = |wave: &str, node: Option<NodeId>| {
            let node = node?;
            let name = match self.program.nodes()[angle.index()] {
                Op::Input(symbol) => self.words.wave_of_symbol(wave, symbol),
                _ => self.words.local(node.index()),
            };
            self.texts[node.index()] = Text::atom(name.clone());
            Some(name)
        };
        let (sin, cos) = (name("sin", sin), name("cos", cos));
        Some(Statement::SinCos { angle: self.text(angle), sin, cos })
    }

    fn expression(&self, op: Op) -> Text {
        let at = |node: NodeId, binding| self.texts[node.index()].at_least(binding);
        match op {
            Op::Constant(literal) => Text {
                text: self.words.number(literal.value()),
                binding: if literal.value() < 0.0 { Binding::Sign } else { Binding::Atom },
            },
            Op::Input(symbol) => Text::atom(self.words.symbol(symbol)),
            Op::Neg(a) => Text { text: format!("-{}", at(a, Binding::Atom)), binding: Binding::Sign },
            Op::Add(a, b) => Text {
                text: format!("{} + {}", at(a, Binding::Sum), at(b, Binding::Product)),
                binding: Binding::Sum,
            },
            Op::Sub(a, b) => Text {
                text: format!("{} - {}", at(a, Binding::Sum), at(b, Binding::Product)),
                binding: Binding::Sum,
            },
            Op::Mul(a, b) => Text {
                text: self.words.product(&at(a, Binding::Product), &at(b, Binding::Sign)),
                binding: Binding::Product,
            },
            Op::Div(a, b) => Text {
                text: self.words.quotient(&at(a, Binding::Product), &at(b, Binding::Sign)),
                binding: Binding::Product,
            },
            Op::Saturate(a) => Text::atom(self.words.saturate(&self.text(a))),
            Op::Step(a) => Text::atom(self.words.step(&self.text(a))),
            // Named by `sin_cos`.
            Op::Sin(a) | Op::Cos(a) => self.texts[a.index()].clone(),
        }
    }
}
