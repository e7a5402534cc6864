//! What a part of a formula is: one amount, or a matrix of amounts. Sums and products of matrices are carried out here,
//! entry by entry, so that a printed vector is three amounts in the end.

use std::ops::Range;

use super::Formula;
use crate::latex::Unreadable;
use model_core::algebra::Rational;
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;

/// One amount, or several in rows and columns.
#[derive(Debug, Clone)]
pub(in crate::latex) enum Value {
    Scalar(Formula),
    Matrix(Matrix),
    /// A multiple of an identity matrix of no stated size.
    Identity(Formula),
}

/// Amounts in rows and columns.
#[derive(Debug, Clone)]
pub(in crate::latex) struct Matrix {
    pub rows: usize,
    pub columns: usize,
    /// Row after row.
    pub entries: Vec<Formula>,
    pub place: Range<usize>,
    /// Of the matrix of a vector product or a screw: the components, and the amount that they are multiplied by.
    pub generator: Option<Box<(Vec<Formula>, Formula)>>,
    /// Whether it is a named rotation, or a product of such: it may stand for the homogeneous matrix as well.
    pub turns: bool,
}

/// How two parts are multiplied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::latex) enum Product {
    /// Side by side.
    Plain,
    /// With a dot.
    Dot,
    /// With a cross.
    Cross,
}

/// Nodes that one product of matrices may lead to; print never comes near it.
const LARGEST: usize = 20_000;

impl Value {
    pub fn place(&self) -> Range<usize> {
        match self {
            Self::Scalar(formula) | Self::Identity(formula) => formula.place.clone(),
            Self::Matrix(matrix) => matrix.place.clone(),
        }
    }

    /// The amount, where no vector may stand.
    pub fn scalar(self) -> Result<Formula, Unreadable> {
        match self {
            Self::Scalar(formula) => Ok(formula),
            Self::Identity(formula) => {
                Err(Mistake::new(formula.place, "an identity matrix stands where one amount is wanted"))
            }
            Self::Matrix(matrix) => Err(Mistake::new(
                matrix.place.clone(),
                format!("{} stands where one amount is wanted", matrix.shape()),
            )),
        }
    }

    pub fn at(self, place: Range<usize>) -> Self {
        match self {
            Self::Scalar(formula) => Self::Scalar(Expr { node: formula.node, place }),
            Self::Identity(formula) => Self::Identity(Expr { node: formula.node, place }),
            Self::Matrix(matrix) => Self::Matrix(Matrix { place, ..matrix }),
        }
    }

    /// The same with the other sign; `place` is that of sign and value.
    pub fn negated(self, place: Range<usize>) -> Self {
        match self {
            Self::Scalar(formula) => Self::Scalar(Expr { node: Node::Neg(Box::new(formula)), place }),
            Self::Identity(formula) => Self::Identity(Expr { node: Node::Neg(Box::new(formula)), place }),
            Self::Matrix(matrix) => {
                let entries = matrix.entries.into_iter().map(negated).collect();
                let generator = matrix.generator.map(|inside| Box::new((inside.0, negated(inside.1))));
                Self::Matrix(Matrix { entries, generator, place, turns: false, ..matrix })
            }
        }
    }

    /// `left + right`
    pub fn sum(left: Self, right: Self) -> Result<Self, Unreadable> {
        let place = left.place().start..right.place().end;
        match (left, right) {
            (Self::Scalar(left), Self::Scalar(right)) => {
                Ok(Self::Scalar(Expr { node: Node::Add(Box::new(left), Box::new(right)), place }))
            }
            (Self::Matrix(left), Self::Matrix(right))
                if left.rows == right.rows && left.columns == right.columns =>
            {
                let entries = left.entries.into_iter().zip(right.entries).map(|(a, b)| added(a, b)).collect();
                Ok(Self::Matrix(Matrix::new(left.rows, entries, place)))
            }
            (Self::Identity(left), Self::Identity(right)) => {
                Ok(Self::Identity(Expr { node: added(left, right).node, place }))
            }
            (Self::Identity(scale), Self::Matrix(matrix)) if matrix.is_square() => {
                let identity = Matrix::diagonal(vec![scale; matrix.rows], place);
                Self::sum(Self::Matrix(identity), Self::Matrix(matrix))
            }
            (Self::Matrix(matrix), Self::Identity(scale)) if matrix.is_square() => {
                let identity = Matrix::diagonal(vec![scale; matrix.rows], place);
                Self::sum(Self::Matrix(matrix), Self::Matrix(identity))
            }
            (left, right) => {
                Err(Mistake::new(place, format!("{} and {} cannot be added", left.shape(), right.shape())))
            }
        }
    }

    /// `left · right`
    pub fn product(left: Self, right: Self, how: Product) -> Result<Self, Unreadable> {
        let place = left.place().start..right.place().end;
        let refuse = |left: &Self, right: &Self, help: &str| {
            let message = format!("{} and {} cannot be multiplied", left.shape(), right.shape());
            Err(Mistake::new(place.clone(), message).with_help(help.to_owned()))
        };
        let product = match (left, right) {
            (Self::Scalar(left), Self::Scalar(right)) => {
                return Ok(Self::Scalar(Expr { node: Node::Mul(Box::new(left), Box::new(right)), place }));
            }
            (Self::Identity(left), Self::Identity(right) | Self::Scalar(right))
            | (Self::Scalar(left), Self::Identity(right)) => {
                return Ok(Self::Identity(Expr { node: multiplied(left, right).node, place }));
            }
            (Self::Scalar(factor) | Self::Identity(factor), Self::Matrix(matrix)) => {
                let entries =
                    matrix.entries.into_iter().map(|entry| multiplied(factor.clone(), entry)).collect();
                let generator =
                    matrix.generator.map(|inside| Box::new((inside.0, multiplied(factor, inside.1))));
                Matrix { entries, place, generator, turns: false, ..matrix }
            }
            (Self::Matrix(matrix), Self::Scalar(factor) | Self::Identity(factor)) => {
                let entries =
                    matrix.entries.into_iter().map(|entry| multiplied(entry, factor.clone())).collect();
                let generator =
                    matrix.generator.map(|inside| Box::new((inside.0, multiplied(inside.1, factor))));
                Matrix { entries, place, generator, turns: false, ..matrix }
            }
            (Self::Matrix(left), Self::Matrix(right)) => match how {
                Product::Cross if left.is_vector() && right.is_vector() => cross(&left, &right, place),
                Product::Dot if left.is_vector() && right.is_vector() && left.columns == right.columns => {
                    let pairs = left.entries.into_iter().zip(right.entries);
                    let sum = pairs.map(|(a, b)| multiplied(a, b)).reduce(added);
                    return match sum {
                        Some(sum) => Ok(Self::Scalar(Expr { node: sum.node, place })),
                        None => Err(Mistake::new(place, "an empty vector")),
                    };
                }
                Product::Plain | Product::Dot if left.columns == right.rows => product(&left, &right, place),
                _ => {
                    return refuse(
                        &Self::Matrix(left),
                        &Self::Matrix(right),
                        r"a scalar product has `\cdot`, a vector product `\times`",
                    );
                }
            },
        };
        product.checked_size()?;
        match product.entries.as_slice() {
            [only] if product.rows == 1 && product.columns == 1 => {
                Ok(Self::Scalar(Expr { node: only.node.clone(), place: product.place }))
            }
            _ => Ok(Self::Matrix(product)),
        }
    }

    /// `left / right`
    pub fn quotient(left: Self, right: Self) -> Result<Self, Unreadable> {
        let place = left.place().start..right.place().end;
        let right = right.scalar()?;
        let over = |above: Formula, place| {
            let node = Node::Div(Box::new(above), Box::new(right.clone()));
            Expr { node, place }
        };
        Ok(match left {
            Self::Scalar(above) => Self::Scalar(over(above, place)),
            Self::Identity(above) => Self::Identity(over(above, place)),
            Self::Matrix(matrix) => {
                let entries = matrix.entries.into_iter().map(|entry| {
                    let place = entry.place.clone();
                    if is_number(&entry, &Rational::ZERO) { entry } else { over(entry, place) }
                });
                Self::Matrix(Matrix::new(matrix.rows, entries.collect(), place))
            }
        })
    }

    fn shape(&self) -> String {
        match self {
            Self::Scalar(_) => "an amount".to_owned(),
            Self::Identity(_) => "an identity matrix".to_owned(),
            Self::Matrix(matrix) => matrix.shape(),
        }
    }
}

impl Matrix {
    /// Entries row after row, in this many rows.
    pub fn new(rows: usize, entries: Vec<Formula>, place: Range<usize>) -> Self {
        Self { rows, columns: entries.len() / rows.max(1), entries, place, generator: None, turns: false }
    }

    /// A column.
    pub fn column(entries: Vec<Formula>, place: Range<usize>) -> Self {
        Self::new(entries.len(), entries, place)
    }

    /// Zeros beside a diagonal.
    pub fn diagonal(diagonal: Vec<Formula>, place: Range<usize>) -> Self {
        let size = diagonal.len();
        let zero = Expr { node: Node::Number(Rational::ZERO), place: place.clone() };
        let mut entries = vec![zero; size * size];
        for (at, entry) in diagonal.into_iter().enumerate() {
            entries[at * size + at] = entry;
        }
        Self::new(size, entries, place)
    }

    /// That the entries are not larger than print ever is.
    pub fn checked_size(&self) -> Result<(), Unreadable> {
        let nodes: usize = self.entries.iter().map(size).sum();
        if nodes > LARGEST {
            let message = "this product of matrices is too large when written out";
            return Err(Mistake::new(self.place.clone(), message));
        }
        Ok(())
    }

    pub fn is_square(&self) -> bool {
        self.rows == self.columns
    }

    pub fn is_vector(&self) -> bool {
        self.rows == 1 || self.columns == 1
    }

    pub fn transposed(self) -> Self {
        let Self { rows, columns, entries, place, turns, .. } = self;
        let entries = (0..columns)
            .flat_map(|column| (0..rows).map(move |row| row * columns + column))
            .map(|index| entries[index].clone())
            .collect();
        Self { turns, ..Self::new(columns, entries, place) }
    }

    pub fn shape(&self) -> String {
        if self.is_vector() {
            format!("a vector of {}", self.entries.len())
        } else {
            format!("a {} × {} matrix", self.rows, self.columns)
        }
    }
}

pub(super) fn product(left: &Matrix, right: &Matrix, place: Range<usize>) -> Matrix {
    let entry = |row: usize, column: usize| {
        let terms = (0..left.columns).map(|inner| {
            let a = left.entries[row * left.columns + inner].clone();
            multiplied(a, right.entries[inner * right.columns + column].clone())
        });
        terms.reduce(added)
    };
    let entries = (0..left.rows)
        .flat_map(|row| (0..right.columns).filter_map(move |column| entry(row, column)))
        .collect();
    Matrix { turns: left.turns && right.turns, ..Matrix::new(left.rows, entries, place) }
}

fn cross(left: &Matrix, right: &Matrix, place: Range<usize>) -> Matrix {
    let [a, b] = [left, right].map(|vector| &vector.entries);
    let entries = (0..3).filter_map(|axis| {
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        let minus = multiplied(a.get(k)?.clone(), b.get(j)?.clone());
        Some(added(multiplied(a.get(j)?.clone(), b.get(k)?.clone()), negated(minus)))
    });
    Matrix::column(entries.collect(), place)
}

pub(super) fn is_number(formula: &Formula, value: &Rational) -> bool {
    matches!(&formula.node, Node::Number(number) if number == value)
}

/// A product without the zeros and ones of matrices; its place is that of the part that says more.
pub(super) fn multiplied(a: Formula, b: Formula) -> Formula {
    let (zero, one) = (Rational::ZERO, Rational::ONE);
    if is_number(&a, &zero) || is_number(&b, &one) {
        return a;
    }
    if is_number(&b, &zero) || is_number(&a, &one) {
        return b;
    }
    let place = b.place.clone();
    Expr { node: Node::Mul(Box::new(a), Box::new(b)), place }
}

pub(super) fn added(a: Formula, b: Formula) -> Formula {
    if is_number(&a, &Rational::ZERO) {
        return b;
    }
    if is_number(&b, &Rational::ZERO) {
        return a;
    }
    let place = a.place.start.min(b.place.start)..a.place.end.max(b.place.end);
    Expr { node: Node::Add(Box::new(a), Box::new(b)), place }
}

pub(super) fn negated(a: Formula) -> Formula {
    if is_number(&a, &Rational::ZERO) {
        return a;
    }
    let place = a.place.clone();
    Expr { node: Node::Neg(Box::new(a)), place }
}

fn size(formula: &Formula) -> usize {
    1 + match &formula.node {
        Node::Number(_) | Node::Measured(..) | Node::Pi | Node::Symbol(_) => 0,
        Node::Ramp(parts) => parts.iter().map(size).sum(),
        Node::Neg(a) | Node::Pow(a, _) | Node::Call(_, a) => size(a),
        Node::Add(a, b) | Node::Mul(a, b) | Node::Div(a, b) => size(a) + size(b),
    }
}
