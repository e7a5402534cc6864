//! What a program is lowered to: expressions, statements and loops. Writers format this and decide nothing.

use model_core::SymbolId;

use crate::program::NodeId;

/// A value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Expr {
    /// A number.
    Number(f64),
    /// The value of a symbol; in a loop over rows, in this row.
    Symbol(SymbolId),
    /// What a statement has given a name, or the first stage has kept.
    Named(Name),
    /// `-a`
    Neg(Box<Expr>),
    /// `a + b` and the like.
    Infix(Infix, Box<[Expr; 2]>),
    /// A function of one value.
    Call(Function, Box<Expr>),
    /// The angle of the point (b, a).
    ArcTangent(Box<[Expr; 2]>),
    /// `a * b + c`, rounded once on processors that can.
    MulAdd(Box<[Expr; 3]>),
}

impl Expr {
    pub(crate) fn neg(self) -> Self {
        Self::Neg(Box::new(self))
    }

    pub(crate) fn arc_tangent(a: Self, b: Self) -> Self {
        Self::ArcTangent(Box::new([a, b]))
    }

    pub(crate) fn infix(infix: Infix, a: Self, b: Self) -> Self {
        Self::Infix(infix, Box::new([a, b]))
    }

    /// How many numbers, symbols and names it is made of.
    pub(crate) fn leaves(&self) -> usize {
        match self {
            Self::Number(_) | Self::Symbol(_) | Self::Named(_) => 1,
            Self::Neg(a) | Self::Call(_, a) => a.leaves(),
            Self::ArcTangent(operands) => operands.iter().map(Self::leaves).sum(),
            Self::Infix(_, operands) => operands.iter().map(Self::leaves).sum(),
            Self::MulAdd(operands) => operands.iter().map(Self::leaves).sum(),
        }
    }
}

/// An operation between two values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Infix {
    Add,
    Sub,
    Mul,
    Div,
}

/// A function of one value that every language has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Function {
    /// `a` between 0 and 1, and the nearer of the two outside; NaN stays NaN.
    Saturate,
    /// 1 from `a = 0` on, 0 below; NaN stays NaN.
    Step,
    /// The square root; NaN below zero.
    Root,
}

/// What a value is called.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Name {
    /// What the prepared stage keeps for the evaluated one, by its place.
    Kept(usize),
    /// A node of the program.
    Node(NodeId),
    /// Sine or cosine of an angle.
    Wave(Wave, Angle),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wave {
    Sine,
    Cosine,
}

/// What a sine or cosine is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Angle {
    Symbol(SymbolId),
    Node(NodeId),
}

/// One statement.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Statement {
    /// `name = value`
    Let(Name, Expr),
    /// Sine and cosine of an angle; at least one of them is wanted.
    SinCos { angle: Expr, sine: Option<Name>, cosine: Option<Name> },
    /// Room for an angle in every row of a block.
    Angles(NodeId),
    /// Sines and cosines of an angle in every row of a block, into arrays.
    SinCosOfRows(Angle),
    /// The same for every row of a block.
    EachRow(Vec<Statement>),
    /// A value of this row goes somewhere.
    Store(Target, Expr),
}

/// Where a value of one row goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Target {
    /// The array of one output.
    Output(usize),
    /// A column of a Jacobian's block.
    Column(usize),
    /// The array of an angle.
    Angle(NodeId),
}
