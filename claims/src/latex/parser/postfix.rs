//! What stands behind and above a matrix: transposition, inversion, powers, the cross that makes a vector its matrix.

use super::transforms;
use super::value::Product;
use super::{Matrix, Parser, Value};
use crate::latex::Unreadable;
use crate::latex::lookup::After;
use crate::latex::token::Kind;
use model_core::algebra::Rational;
use model_core::expr::Node;
use model_core::mistake::Mistake;

/// The highest power of a matrix that is written out.
const HIGHEST: i32 = 6;

impl Parser<'_> {
    pub(super) fn powered_value(&mut self, value: Value) -> Result<Value, Unreadable> {
        match value {
            Value::Scalar(formula) => {
                if matches!(&formula.node, Node::Number(number) if *number == Rational::ZERO) {
                    self.skip_shape();
                }
                self.powered(formula).map(Value::Scalar)
            }
            Value::Identity(scale) => {
                while self.skip_transposition() || self.skip_inversion().is_some() {}
                Ok(Value::Identity(scale))
            }
            Value::Matrix(mut matrix) => {
                loop {
                    // A list in brackets is a column either way.
                    let is_row = matrix.rows == 1 && matrix.columns > 1;
                    let after = if self.skip_cross() {
                        After::Skew
                    } else if self.skip_transposition() {
                        if matrix.is_vector() && !is_row {
                            continue;
                        }
                        After::Transposed
                    } else if let Some(transposed) = self.skip_inversion() {
                        After::Inverse(transposed)
                    } else if self.is_at_mark('^') {
                        self.advance();
                        After::Power(self.power()?.0)
                    } else {
                        return Ok(Value::Matrix(matrix));
                    };
                    matrix = self.changed(matrix, after)?;
                }
            }
        }
    }

    /// A matrix with something done to it.
    pub(super) fn changed(&mut self, matrix: Matrix, after: After) -> Result<Matrix, Unreadable> {
        let place = matrix.place.clone();
        match after {
            After::Transposed => Ok(matrix.transposed()),
            After::Skew => transforms::skew(&matrix.entries, &place).ok_or_else(|| {
                Mistake::new(place, "the cross that makes a matrix stands at a vector of three components")
            }),
            After::Inverse(transposed) => {
                self.notes.truncates |= matrix.entries.iter().any(|entry| self.has_error(entry));
                let inverse = transforms::inverse(&matrix)?;
                inverse.checked_size()?;
                Ok(if transposed { inverse.transposed() } else { inverse })
            }
            After::Power(power) => {
                if !matrix.is_square() || !(1..=HIGHEST).contains(&power) {
                    let message = format!("{} has no power {power} here", matrix.shape());
                    return Err(Mistake::new(place, message).with_help("write the product out"));
                }
                let mut product = Value::Matrix(matrix.clone());
                for _ in 1..power {
                    product = self.multiplied(product, Value::Matrix(matrix.clone()), Product::Plain)?;
                }
                match product {
                    Value::Matrix(product) => Ok(product),
                    _ => Err(Mistake::new(place, "a matrix of one entry")),
                }
            }
        }
    }

    /// The product of two values. One of matrices that both have errors in them is a product that nobody multiplied out.
    pub(super) fn multiplied(
        &mut self,
        left: Value,
        right: Value,
        how: Product,
    ) -> Result<Value, Unreadable> {
        let (left, right) = match (left, right) {
            (Value::Matrix(left), Value::Matrix(right)) => {
                let small = |matrix: &Matrix| matrix.entries.iter().any(|entry| self.has_error(entry));
                self.notes.truncates |= small(&left) && small(&right);
                match (left, right) {
                    (left, right) if left.turns && left.rows == 3 && right.rows == 4 && right.is_square() => {
                        (transforms::homogeneous(&left), right)
                    }
                    (left, right)
                        if right.turns && right.rows == 3 && left.columns == 4 && left.is_square() =>
                    {
                        let right = transforms::homogeneous(&right);
                        (left, right)
                    }
                    both => both,
                }
            }
            (left, right) => return Value::product(left, right, how),
        };
        Value::product(Value::Matrix(left), Value::Matrix(right), how)
    }

    /// The product that multiplies entry by entry, where one side has no entries.
    pub(super) fn elementwise(&mut self, left: Value, right: Value) -> Result<Value, Unreadable> {
        if let (Value::Matrix(left), Value::Matrix(right)) = (&left, &right) {
            let place = left.place.start..right.place.end;
            return Err(Mistake::new(place, "in Python `*` multiplies matrices entry by entry")
                .with_help("write `@` for the product of matrices"));
        }
        self.multiplied(left, right, Product::Dot)
    }

    /// `^T`, `^{\mathrm{T}}`, `^\top`, `'`, and `{}^T`.
    pub(super) fn skip_transposition(&mut self) -> bool {
        if self.is_at_mark('\'') {
            self.advance();
            return true;
        }
        let start = self.at;
        let is_left = self.is_at(&Kind::Left);
        if is_left && self.symbols.find(self.text, &self.tokens[self.at..]).is_ok() {
            return false;
        }
        self.at += usize::from(is_left);
        if let Some(upper) = self.upper()
            && After::of(&upper) == Some(After::Transposed)
        {
            return true;
        }
        self.at = start;
        false
    }

    /// `^{-1}`, or `^{-T}` with its transposition.
    pub(super) fn skip_inversion(&mut self) -> Option<bool> {
        let start = self.at;
        if let Some(upper) = self.upper()
            && let Some(After::Inverse(transposed)) = After::of(&upper)
        {
            return Some(transposed);
        }
        self.at = start;
        None
    }

    /// `_\times`, `^\times`, `^\wedge`
    fn skip_cross(&mut self) -> bool {
        let start = self.at;
        if self.is_at_mark('_') || self.is_at_mark('^') {
            self.advance();
            if let Some(index) = self.index()
                && matches!(index.as_str(), "×" | "\\wedge" | "∧")
            {
                return true;
            }
        }
        self.at = start;
        false
    }

    /// The shape behind a zero: `0_{1\times 3}`, `0^T`.
    fn skip_shape(&mut self) {
        loop {
            let start = self.at;
            let is_lower = self.is_at_mark('_');
            self.at += usize::from(is_lower);
            let is_shape = is_lower
                && self.index().is_some_and(|index| index.chars().all(|c| c.is_ascii_digit() || c == '×'));
            if is_shape {
                continue;
            }
            self.at = start;
            if !self.skip_transposition() {
                return;
            }
        }
    }

    /// What stands above, as text.
    fn upper(&mut self) -> Option<String> {
        if !self.is_at_mark('^') {
            return None;
        }
        self.advance();
        self.index()
    }

    /// An index as text: one token, or a group.
    fn index(&mut self) -> Option<String> {
        let text = |kind: &Kind| match kind {
            Kind::Word(word) => Some(word.clone()),
            Kind::Command(command) => Some(format!("\\{command}")),
            Kind::Digit(digit) => Some(digit.to_string()),
            Kind::Mark(mark) => Some(mark.to_string()),
            _ => None,
        };
        if !self.is_at_mark('{') {
            let found = text(&self.peek()?.kind)?;
            self.advance();
            return Some(found);
        }
        self.advance();
        let mut found = String::new();
        while !self.is_at_mark('}') {
            found.push_str(&text(&self.peek()?.kind)?);
            self.advance();
        }
        self.advance();
        Some(found)
    }
}
