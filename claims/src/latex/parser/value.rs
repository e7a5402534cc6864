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
}

/// Amounts in rows and columns.
#[derive(Debug, Clone)]
pub(in crate::latex) struct Matrix {
    pub rows: usize,
    pub columns: usize,
    /// Row after row.
    pub entries: Vec<Formula>,
    pub place: Range<usize>,
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
            Self::Scalar(formula) => formula.place.clone(),
            Self::Matrix(matrix) => matrix.place.clone(),
        }
    }

    /// The amount, where no vector may stand.
    pub fn scalar(self) -> Result<Formula, Unreadable> {
        match self {
            Self::Scalar(formula) => Ok(formula),
            Self::Matrix(matrix) => Err(Mistake::new(
                matrix.place.clone(),
                format!("{} stands where one amount is wanted", matrix.shape()),
            )),
        }
    }

    pub fn at(self, place: Range<usize>) -> Self {
        match self {
            Self::Scalar(formula) => Self::Scalar(Expr { node: formula.node, place }),
            Self::Matrix(matrix) => Self::Matrix(Matrix { place, ..matrix }),
        }
    }

    /// The same with the other sign; `place` is that of sign and value.
    pub fn negated(self, place: Range<usize>) -> Self {
        match self {
            Self::Scalar(formula) => Self::Scalar(Expr { node: Node::Neg(Box::new(formula)), place }),
            Self::Matrix(matrix) => {
                let entries = matrix.entries.into_iter().map(negated).collect();
                Self::Matrix(Matrix { entries, place, ..matrix })
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
                Ok(Self::Matrix(Matrix { rows: left.rows, columns: left.columns, entries, place }))
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
            (Self::Scalar(factor), Self::Matrix(matrix)) => {
                let entries =
                    matrix.entries.into_iter().map(|entry| multiplied(factor.clone(), entry)).collect();
                Matrix { entries, place, ..matrix }
            }
            (Self::Matrix(matrix), Self::Scalar(factor)) => {
                let entries =
                    matrix.entries.into_iter().map(|entry| multiplied(entry, factor.clone())).collect();
                Matrix { entries, place, ..matrix }
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
        let nodes: usize = product.entries.iter().map(size).sum();
        if nodes > LARGEST {
            return Err(Mistake::new(
                product.place,
                "this product of matrices is too large when written out",
            ));
        }
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
            Self::Matrix(matrix) => {
                let entries = matrix.entries.into_iter().map(|entry| {
                    let place = entry.place.clone();
                    if is_number(&entry, &Rational::ZERO) { entry } else { over(entry, place) }
                });
                Self::Matrix(Matrix { entries: entries.collect(), place, ..matrix })
            }
        })
    }

    fn shape(&self) -> String {
        match self {
            Self::Scalar(_) => "an amount".to_owned(),
            Self::Matrix(matrix) => matrix.shape(),
        }
    }
}

impl Matrix {
    /// A column.
    pub fn column(entries: Vec<Formula>, place: Range<usize>) -> Self {
        Self { rows: entries.len(), columns: 1, entries, place }
    }

    pub fn is_vector(&self) -> bool {
        self.rows == 1 || self.columns == 1
    }

    pub fn transposed(self) -> Self {
        let Self { rows, columns, entries, place } = self;
        let entries = (0..columns)
            .flat_map(|column| (0..rows).map(move |row| row * columns + column))
            .map(|index| entries[index].clone())
            .collect();
        Self { rows: columns, columns: rows, entries, place }
    }

    pub fn shape(&self) -> String {
        if self.is_vector() {
            format!("a vector of {}", self.entries.len())
        } else {
            format!("a {} × {} matrix", self.rows, self.columns)
        }
    }
}

fn product(left: &Matrix, right: &Matrix, place: Range<usize>) -> Matrix {
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
    Matrix { rows: left.rows, columns: right.columns, entries, place }
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

fn is_number(formula: &Formula, value: &Rational) -> bool {
    matches!(&formula.node, Node::Number(number) if number == value)
}

/// A product without the zeros and ones of matrices; its place is that of the part that says more.
fn multiplied(a: Formula, b: Formula) -> Formula {
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

fn added(a: Formula, b: Formula) -> Formula {
    if is_number(&a, &Rational::ZERO) {
        return b;
    }
    if is_number(&b, &Rational::ZERO) {
        return a;
    }
    let place = a.place.start.min(b.place.start)..a.place.end.max(b.place.end);
    Expr { node: Node::Add(Box::new(a), Box::new(b)), place }
}

fn negated(a: Formula) -> Formula {
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
