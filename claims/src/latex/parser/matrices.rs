//! Matrices as LaTeX environments, and the unit vectors of the axes.

use std::ops::Range;

use super::{Formula, Matrix, Parser, Value, transforms};
use crate::latex::layout::MATRICES;
use crate::latex::lookup::After;
use crate::latex::token::Kind;
use crate::latex::{Unreadable, glyph};
use model_core::algebra::Rational;
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;

impl Parser<'_> {
    /// `\begin{bmatrix} a & b \\ c & d \end{bmatrix}`
    pub(super) fn matrix(&mut self) -> Result<Matrix, Unreadable> {
        let start = self.here();
        let Some(Kind::Begin(name)) = self.peek().map(|token| &token.kind) else {
            return Err(self.unexpected("a matrix"));
        };
        if !MATRICES.contains(&name.as_str()) {
            return Err(Mistake::new(start, format!("`{name}` is no matrix, and stands within a formula"))
                .with_help(r"write `\begin{bmatrix}`"));
        }
        let closer = Kind::End(name.clone());
        self.advance();
        let mut rows: Vec<Vec<Value>> = vec![Vec::new()];
        loop {
            if self.is_at(&closer) && rows.last().is_some_and(Vec::is_empty) {
                rows.pop();
                break;
            }
            let entry = self.formula()?;
            if let Some(row) = rows.last_mut() {
                row.push(entry);
            }
            let comma = self.is_at_mark(',') || self.is_at_mark(';');
            if comma || self.is_at_mark('&') || self.is_at(&Kind::Row) {
                if self.is_at(&Kind::Row) {
                    rows.push(Vec::new());
                }
                self.advance();
            } else {
                break;
            }
        }
        let end = self.here().end;
        self.expect_closer(&closer)?;
        let place = start.start..end;
        let columns = rows.first().map_or(0, Vec::len);
        if columns == 0 || rows.iter().any(|row| row.len() != columns) {
            return Err(Mistake::new(place, "the rows of this matrix are not equally long"));
        }
        assembled(&rows, place)
    }

    /// `\hat{x}`, `\mathbf{e}_x`, `\hat{\imath}`, `\mathbf{i}` beside `\mathbf{j}`: one of the axes, where no symbol of that name is declared.
    pub(super) fn unit_vector(&mut self) -> Option<Result<Value, Unreadable>> {
        let read = glyph::read(&self.tokens[self.at..]).ok()??;
        let glyph = read.glyph;
        let hatted = ["hat", "vec", "widehat"]
            .iter()
            .find_map(|accent| glyph.base.strip_prefix(&format!("\\{accent}{{"))?.strip_suffix('}'));
        let axis = |letter: &str| match letter {
            "x" | "i" | "\\imath" | "1" => Some(0),
            "y" | "j" | "\\jmath" | "2" => Some(1),
            "z" | "k" | "3" => Some(2),
            _ => None,
        };
        let transposed = After::of(&glyph.upper) == Some(After::Transposed);
        let index = match (hatted, glyph.base.as_str()) {
            _ if !glyph.upper.is_empty() && !transposed => None,
            (Some(letter), _) if glyph.lower.is_empty() => axis(letter),
            (Some("e" | "u" | "n"), _) | (None, "e") => axis(&glyph.lower),
            (None, letter @ ("i" | "j" | "k"))
                if glyph.bold && glyph.lower.is_empty() && self.symbols.has_unit_letters =>
            {
                axis(letter)
            }
            _ => None,
        }?;
        let declared = format!("e{}", glyph.lower);
        if glyph.base == "e" && !glyph.bold && self.symbols.declares(&declared) {
            let shown = &self.text[read.place.clone()];
            let message = format!("is `{shown}` the declared `{declared}`, or a unit vector?");
            return Some(Err(Mistake::new(read.place.clone(), message).with_help(format!(
                "for the first write under [symbols]: '{shown}' = \"{declared}\"; for the second, `\\mathbf{{e}}_{}`",
                glyph.lower
            ))));
        }
        self.at += read.tokens;
        let number = |value| Expr { node: Node::Number(value), place: read.place.clone() };
        let entries = (0..3).map(|other| number(if other == index { Rational::ONE } else { Rational::ZERO }));
        let column = Matrix::column(entries.collect(), read.place.clone());
        Some(Ok(Value::Matrix(if transposed { column.transposed() } else { column })))
    }
}

/// A matrix of blocks: each row of blocks has one height, each column one width.
fn assembled(rows: &[Vec<Value>], place: Range<usize>) -> Result<Matrix, Unreadable> {
    let columns = rows.first().map_or(0, Vec::len);
    let matrix = |block: &Value| {
        if let Value::Matrix(Matrix { rows, columns, .. }) = block { Some([*rows, *columns]) } else { None }
    };
    let heights: Vec<Option<usize>> =
        rows.iter().map(|row| row.iter().find_map(matrix).map(|[high, _]| high)).collect();
    let widths: Vec<Option<usize>> = (0..columns)
        .map(|column| rows.iter().find_map(|row| matrix(&row[column])).map(|[_, wide]| wide))
        .collect();
    // An identity is as high as it is wide.
    let shape = |row: usize, column: usize| {
        let is_identity = matches!(rows[row][column], Value::Identity(_));
        let square = if is_identity { heights[row].or(widths[column]) } else { None };
        (heights[row].or(square).unwrap_or(1), widths[column].or(square).unwrap_or(1))
    };
    let mut entries = Vec::new();
    for (row, blocks) in rows.iter().enumerate() {
        let height = (0..columns).map(|column| shape(row, column).0).max().unwrap_or(1);
        for line in 0..height {
            for (column, block) in blocks.iter().enumerate() {
                let width = (0..rows.len()).map(|row| shape(row, column).1).max().unwrap_or(1);
                entries.extend(line_of(block, line, [height, width])?);
            }
        }
    }
    let heights =
        (0..rows.len()).map(|row| (0..columns).map(|column| shape(row, column).0).max().unwrap_or(1));
    Ok(Matrix::new(heights.sum(), entries, place))
}

/// One line of a block that has to be this high and wide.
fn line_of(block: &Value, line: usize, [height, width]: [usize; 2]) -> Result<Vec<Formula>, Unreadable> {
    let misfit = |place: Range<usize>, shape: String| {
        Err(Mistake::new(place, format!("{shape} stands where a block of {height} × {width} belongs")))
    };
    match block {
        Value::Matrix(matrix) if [matrix.rows, matrix.columns] == [height, width] => {
            Ok(matrix.entries[line * width..(line + 1) * width].to_vec())
        }
        Value::Matrix(matrix) => misfit(matrix.place.clone(), matrix.shape()),
        Value::Identity(scale) if height == width => {
            let zero = transforms::number(0, &scale.place);
            Ok((0..width).map(|column| if column == line { scale.clone() } else { zero.clone() }).collect())
        }
        Value::Identity(scale) => misfit(scale.place.clone(), "an identity matrix".to_owned()),
        Value::Scalar(formula) if [height, width] == [1, 1] => Ok(vec![formula.clone()]),
        Value::Scalar(formula) if matches!(&formula.node, Node::Number(number) if *number == Rational::ZERO) => {
            Ok(vec![formula.clone(); width])
        }
        Value::Scalar(formula) => misfit(formula.place.clone(), "an amount".to_owned()),
    }
}
