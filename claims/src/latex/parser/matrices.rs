//! Matrices as LaTeX environments, and the unit vectors of the axes.

use super::{Matrix, Parser, Value};
use crate::latex::layout::MATRICES;
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
        let mut rows: Vec<Vec<_>> = vec![Vec::new()];
        loop {
            if self.is_at(&closer) && rows.last().is_some_and(Vec::is_empty) {
                rows.pop();
                break;
            }
            let entry = self.formula()?.scalar()?;
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
        Ok(Matrix { rows: rows.len(), columns, entries: rows.into_iter().flatten().collect(), place })
    }

    /// `\hat{x}`, `\mathbf{e}_x`, `\hat{\imath}`: one of the axes, where no symbol of that name is declared.
    pub(super) fn unit_vector(&mut self) -> Option<Value> {
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
        let index = match (hatted, glyph.base.as_str()) {
            _ if !glyph.upper.is_empty() => None,
            (Some(letter), _) if glyph.lower.is_empty() => axis(letter),
            (Some("e" | "u" | "n"), _) | (None, "e") => axis(&glyph.lower),
            _ => None,
        }?;
        self.at += read.tokens;
        let number = |value| Expr { node: Node::Number(value), place: read.place.clone() };
        let entries = (0..3).map(|other| number(if other == index { Rational::ONE } else { Rational::ZERO }));
        Some(Value::Matrix(Matrix::column(entries.collect(), read.place.clone())))
    }
}
