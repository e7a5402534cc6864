//! Matrices that papers name: rotations about an axis, shifts, the matrix of a vector product, of a screw, inverses and
//! exponentials.

use std::ops::Range;

use super::value::{added, is_number, multiplied, negated};
use super::{Formula, Matrix};
use crate::latex::Unreadable;
use model_core::algebra::Rational;
use model_core::expr::{Expr, Function, Node};
use model_core::mistake::Mistake;

/// A whole number at a place.
pub(super) fn number(value: i64, place: &Range<usize>) -> Formula {
    Expr { node: Node::Number(Rational::from(value)), place: place.clone() }
}

/// A function of an angle at a place.
pub(super) fn call(function: Function, angle: &Formula, place: &Range<usize>) -> Formula {
    Expr { node: Node::Call(function, Box::new(angle.clone())), place: place.clone() }
}

/// The turn by an angle about axis 0, 1 or 2, of vectors; of axes it is the transpose.
pub(super) fn rotation(axis: usize, angle: &Formula, place: &Range<usize>) -> Matrix {
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut entries = vec![number(0, place); 9];
    entries[axis * 3 + axis] = number(1, place);
    let (cosine, sine) = (call(Function::Cos, angle, place), call(Function::Sin, angle, place));
    entries[j * 3 + j] = cosine.clone();
    entries[k * 3 + k] = cosine;
    entries[j * 3 + k] = negated(sine.clone());
    entries[k * 3 + j] = sine;
    Matrix { turns: true, ..Matrix::new(3, entries, place.clone()) }
}

/// The homogeneous matrix of a shift along axis 0, 1 or 2.
pub(super) fn shift(axis: usize, amount: &Formula, place: &Range<usize>) -> Matrix {
    let mut matrix = Matrix::diagonal(vec![number(1, place); 4], place.clone());
    matrix.entries[axis * 4 + 3] = amount.clone();
    matrix
}

/// A rotation as a homogeneous matrix.
pub(super) fn homogeneous(rotation: &Matrix) -> Matrix {
    let place = &rotation.place;
    let mut entries = Vec::with_capacity(16);
    for row in rotation.entries.chunks(3) {
        entries.extend_from_slice(row);
        entries.push(number(0, place));
    }
    entries.extend([0, 0, 0, 1].map(|value| number(value, place)));
    Matrix::new(4, entries, place.clone())
}

/// The matrix that multiplies a vector as the vector product with this one does.
pub(super) fn skew(vector: &[Formula], place: &Range<usize>) -> Option<Matrix> {
    let [x, y, z] = vector else { return None };
    let zero = || number(0, place);
    let minus = |entry: &Formula| negated(entry.clone());
    let entries = vec![zero(), minus(z), y.clone(), z.clone(), zero(), minus(x), minus(y), x.clone(), zero()];
    let generator = Some(Box::new((vector.to_vec(), number(1, place))));
    Some(Matrix { generator, ..Matrix::new(3, entries, place.clone()) })
}

/// The matrix of a screw: angular velocity, then linear velocity.
pub(super) fn screw(components: &[Formula], place: &Range<usize>) -> Option<Matrix> {
    let (angular, linear) = components.split_at_checked(3)?;
    let turned = skew(angular, place)?;
    let mut entries = Vec::with_capacity(16);
    for (row, velocity) in turned.entries.chunks(3).zip(linear) {
        entries.extend_from_slice(row);
        entries.push(velocity.clone());
    }
    entries.extend([0; 4].map(|value| number(value, place)));
    let generator = Some(Box::new((components.to_vec(), number(1, place))));
    Some(Matrix { generator, ..Matrix::new(4, entries, place.clone()) })
}

/// The inverse of a square matrix of up to four rows: its adjugate over its determinant.
pub(super) fn inverse(matrix: &Matrix) -> Result<Matrix, Unreadable> {
    let size = matrix.rows;
    if !matrix.is_square() || size > 4 {
        return Err(Mistake::new(matrix.place.clone(), format!("{} has no inverse", matrix.shape()))
            .with_help("square matrices of up to four rows are inverted"));
    }
    // A motion is inverted by its transpose, which keeps formulas small; whether it is one only the algebra can tell.
    let all: Vec<usize> = (0..size).collect();
    let determinant = minor(matrix, &all, &all);
    let is_one = is_number(&determinant, &Rational::ONE);
    let mut entries = Vec::with_capacity(size * size);
    for row in 0..size {
        for column in 0..size {
            let without =
                |index: usize| all.iter().copied().filter(|&other| other != index).collect::<Vec<_>>();
            let cofactor = minor(matrix, &without(column), &without(row));
            let cofactor = if (row + column) % 2 == 1 { negated(cofactor) } else { cofactor };
            let place = cofactor.place.clone();
            entries.push(if is_one || is_number(&cofactor, &Rational::ZERO) {
                cofactor
            } else {
                Expr { node: Node::Div(Box::new(cofactor), Box::new(determinant.clone())), place }
            });
        }
    }
    Ok(Matrix::new(size, entries, matrix.place.clone()))
}

/// The determinant of a square matrix of up to four rows.
pub(super) fn determinant(matrix: &Matrix) -> Result<Formula, Unreadable> {
    if !matrix.is_square() || matrix.rows > 4 {
        return Err(Mistake::new(matrix.place.clone(), format!("{} has no determinant", matrix.shape()))
            .with_help("square matrices of up to four rows have one here"));
    }
    let all: Vec<usize> = (0..matrix.rows).collect();
    let determinant = Matrix::new(1, vec![minor(matrix, &all, &all)], matrix.place.clone());
    determinant.checked_size()?;
    match <[Formula; 1]>::try_from(determinant.entries) {
        Ok([only]) => Ok(Expr { node: only.node, place: determinant.place }),
        Err(_) => unreachable!("a matrix of one entry"),
    }
}

/// The determinant of some rows and columns, along the first row.
fn minor(matrix: &Matrix, rows: &[usize], columns: &[usize]) -> Formula {
    let Some((first, rest)) = rows.split_first() else { return number(1, &matrix.place) };
    let mut sum = number(0, &matrix.place);
    for (at, &column) in columns.iter().enumerate() {
        let entry = &matrix.entries[first * matrix.columns + column];
        if is_number(entry, &Rational::ZERO) {
            continue;
        }
        let others: Vec<usize> = columns.iter().copied().filter(|&other| other != column).collect();
        let term = multiplied(entry.clone(), minor(matrix, rest, &others));
        sum = added(sum, if at % 2 == 1 { negated(term) } else { term });
    }
    sum
}

/// The exponential of the matrix of a unit axis or screw times an amount; of what is small, its series to third order.
pub(super) fn exponential(
    matrix: &Matrix,
    is_small: impl Fn(&Formula) -> bool,
) -> Result<(Matrix, bool), Unreadable> {
    let refuse = |why: &str| {
        Mistake::new(matrix.place.clone(), why.to_owned()).with_help(
            r"the exponential is of `\hat\omega\theta` or `\hat\xi\theta`, with a unit axis of numbers",
        )
    };
    let Some((components, amount)) = matrix.generator.as_deref() else {
        return Err(refuse("the exponential of this matrix is not known"));
    };
    let place = &matrix.place;
    let numbers: Option<Vec<Rational>> = components.iter().take(3).map(value_of).collect();
    if let Some(axis) = numbers {
        let square = axis.iter().fold(Rational::ZERO, |sum, part| &sum + &(part * part));
        if square == Rational::ONE {
            return Ok((turn(matrix, components, amount), false));
        }
        if square == Rational::ZERO && components.len() == 6 {
            let identity = Matrix::diagonal(vec![number(1, place); 4], place.clone());
            let mut moved = identity;
            for (row, velocity) in components[3..].iter().enumerate() {
                moved.entries[row * 4 + 3] = multiplied(velocity.clone(), amount.clone());
            }
            return Ok((moved, false));
        }
        if !is_small(amount) {
            return Err(refuse("the axis of this exponential has not the length 1"));
        }
    } else if !components.iter().all(|part| is_small(part) || value_of(part).is_some()) && !is_small(amount) {
        return Err(refuse("the axis of this exponential is neither of numbers nor small"));
    }
    // 1 + M + M²/2 + M³/6
    let mut sum = Matrix::diagonal(vec![number(1, place); matrix.rows], place.clone());
    let mut power = Matrix { generator: None, ..matrix.clone() };
    for factorial in [1, 2, 6] {
        for (entry, term) in sum.entries.iter_mut().zip(&power.entries) {
            let term = match factorial {
                1 => term.clone(),
                _ if is_number(term, &Rational::ZERO) => continue,
                n => Expr {
                    node: Node::Div(Box::new(term.clone()), Box::new(number(n, place))),
                    place: place.clone(),
                },
            };
            *entry = added(entry.clone(), term);
        }
        power = super::value::product(&power, matrix, place.clone());
    }
    Ok((sum, true))
}

/// The exponential of a unit axis, or of a screw with one, times an angle: 1 + sin θ Ω + (1 − cos θ) Ω².
///
/// Source: Murray, Li, Sastry, A Mathematical Introduction to Robotic Manipulation (1994), sections 2.2 and 2.3.
fn turn(matrix: &Matrix, components: &[Formula], amount: &Formula) -> Matrix {
    let place = &matrix.place;
    let sine = call(Function::Sin, amount, place);
    let versine = added(number(1, place), negated(call(Function::Cos, amount, place)));
    let Some(axis) = skew(&components[..3], place) else { unreachable!("an axis has three components") };
    let square = super::value::product(&axis, &axis, place.clone());
    let mut rotation = Matrix::diagonal(vec![number(1, place); 3], place.clone());
    for (at, entry) in rotation.entries.iter_mut().enumerate() {
        let odd = multiplied(axis.entries[at].clone(), sine.clone());
        let even = multiplied(square.entries[at].clone(), versine.clone());
        *entry = added(added(entry.clone(), odd), even);
    }
    if components.len() == 3 {
        return rotation;
    }
    // (1 − R) (ω × v) + ω ωᵀ v θ
    let velocity = Matrix::column(components[3..].to_vec(), place.clone());
    let across = super::value::product(&axis, &velocity, place.clone());
    let moved = super::value::product(&rotation, &across, place.clone());
    let along = components[..3]
        .iter()
        .zip(&components[3..])
        .map(|(a, b)| multiplied(a.clone(), b.clone()))
        .fold(number(0, place), added);
    let mut matrix = homogeneous(&rotation);
    for (row, component) in components.iter().enumerate().take(3) {
        let shift = added(across.entries[row].clone(), negated(moved.entries[row].clone()));
        let slide = multiplied(multiplied(component.clone(), along.clone()), amount.clone());
        matrix.entries[row * 4 + 3] = added(shift, slide);
    }
    matrix
}

/// The number that a formula is.
fn value_of(formula: &Formula) -> Option<Rational> {
    Some(match &formula.node {
        Node::Number(value) => value.clone(),
        Node::Neg(inside) => -&value_of(inside)?,
        Node::Div(above, below) => &value_of(above)? * &value_of(below)?.recip()?,
        _ => return None,
    })
}
