//! Names that papers use without defining them: identity matrices, rotations about an axis, the matrix of a vector product,
//! exponentials, diagonals. A symbol that is declared comes first.

use std::ops::Range;

use super::transforms::{self, number};
use super::{Formula, Matrix, Parser, Value};
use crate::latex::Unreadable;
use crate::latex::glyph::{self, Glyph, ReadGlyph};
use crate::latex::lookup::After;
use crate::latex::printed::Turned;
use crate::latex::token::Kind;
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;
use model_core::symbol::SymbolKind;

impl Parser<'_> {
    /// The value of a name that nobody declared; `None` if it is none of these.
    pub(super) fn named(&mut self) -> Option<Result<Value, Unreadable>> {
        let read = glyph::read(self.tokens.get(self.at..)?).ok()??;
        self.identity(&read)
            .or_else(|| self.rotation(&read))
            .or_else(|| self.shift(&read))
            .or_else(|| self.function_of_matrix(&read))
            .or_else(|| self.exponential(&read))
            .or_else(|| self.abbreviation(&read))
            .or_else(|| self.usual_sum(&read))
    }

    /// `\mathbf I`, `I_3`, `I_{3\times 3}`
    fn identity(&mut self, read: &ReadGlyph) -> Option<Result<Value, Unreadable>> {
        let Glyph { base, lower, upper, left, .. } = &read.glyph;
        if !matches!(base.as_str(), "I" | "\\mathbb{I}" | "\\mathds{1}") || !left.is_empty() {
            return None;
        }
        if !matches!(After::of(upper), None | Some(After::Transposed | After::Inverse(_) | After::Power(_)))
            || (After::of(upper).is_none() && !upper.is_empty())
        {
            return None;
        }
        let size = lower.split('×').next().unwrap_or_default();
        let one = number(1, &read.place);
        let value = match size {
            "" | "n" | "N" => Value::Identity(one),
            size => {
                let size = size.parse::<usize>().ok().filter(|size| (1..=6).contains(size))?;
                if lower.contains('×') && *lower != format!("{size}×{size}") {
                    return None;
                }
                Value::Matrix(Matrix::diagonal(vec![one; size], read.place.clone()))
            }
        };
        self.at += read.tokens;
        Some(Ok(value))
    }

    /// `R_z(\psi)`, `R_{z,\psi}`, `\mathrm{Rot}(z, \psi)`
    fn rotation(&mut self, read: &ReadGlyph) -> Option<Result<Value, Unreadable>> {
        if !matches!(read.glyph.base.as_str(), "R" | "Rot" | "rot" | "\\mathcal{R}" | "C") {
            return None;
        }
        let (axis, angle, after) = match self.axis_and_amount(read, "C")? {
            Ok(found) => found,
            Err(mistake) => return Some(Err(mistake)),
        };
        let place = read.place.start..self.tokens[self.at - 1].place.end;
        self.notes.turned = true;
        let matrix = transforms::rotation(axis, &angle, &place);
        let transposed = (self.symbols.turned == Turned::Axes)
            != matches!(after, Some(After::Transposed | After::Inverse(false)));
        if self.is_small(&angle) {
            self.notes.truncates = true;
        }
        Some(Ok(Value::Matrix(if transposed { matrix.transposed() } else { matrix })))
    }

    /// `T_x(a)`, `\mathrm{Trans}(x, a)`
    fn shift(&mut self, read: &ReadGlyph) -> Option<Result<Value, Unreadable>> {
        if !matches!(read.glyph.base.as_str(), "T" | "Trans" | "trans" | "Transl" | "D") {
            return None;
        }
        let (axis, amount, after) = match self.axis_and_amount(read, "")? {
            Ok(found) => found,
            Err(mistake) => return Some(Err(mistake)),
        };
        let place = read.place.start..self.tokens[self.at - 1].place.end;
        let matrix = transforms::shift(axis, &amount, &place);
        Some(match after {
            None => Ok(Value::Matrix(matrix)),
            Some(After::Inverse(false)) => transforms::inverse(&matrix).map(Value::Matrix),
            Some(_) => Err(Mistake::new(place, "the transpose of a shift is no motion")),
        })
    }

    /// The axis in the index or first in parentheses, the amount behind it, and what stands above.
    #[allow(clippy::type_complexity, reason = "three parts of one thing, used twice")]
    fn axis_and_amount(
        &mut self,
        read: &ReadGlyph,
        only_numbered: &str,
    ) -> Option<Result<(usize, Formula, Option<After>), Unreadable>> {
        let Glyph { base, lower, upper, left, .. } = &read.glyph;
        let after = After::of(upper);
        if !left.is_empty()
            || (!upper.is_empty() && after.is_none())
            || matches!(after, Some(After::Power(_) | After::Skew))
        {
            return None;
        }
        let axis_of = |letter: &str| match letter {
            "x" | "X" | "1" => Some(0),
            "y" | "Y" | "2" => Some(1),
            "z" | "Z" | "3" => Some(2),
            _ => None,
        };
        let start = self.at;
        let (letter, inside) = lower.split_once(',').unwrap_or((lower, ""));
        if !lower.is_empty() {
            let axis = axis_of(letter)?;
            if base == only_numbered && !letter.starts_with(|c: char| c.is_ascii_digit()) {
                return None;
            }
            if !inside.is_empty() {
                let place = read.place.clone();
                let amount = self.inner(inside, &place)?;
                self.at += read.tokens;
                return Some(amount.map(|amount| (axis, amount, after)));
            }
            let open = self.tokens.get(start + read.tokens).map(|token| &token.kind);
            let is_group = matches!(open, Some(Kind::Mark('(' | '[' | '{') | Kind::OpenBrace));
            let is_symbol = open.is_some_and(glyph::starts);
            if !is_group && !is_symbol {
                return None;
            }
            self.at += read.tokens;
            // `R_z\psi` would be a product with a matrix as well.
            if !is_group {
                self.at = start;
                return None;
            }
            let amount = self.group().and_then(Value::scalar);
            return match amount {
                // `C_1 (a_2 C_2 + …)` is a cosine times a length, and no turn.
                Ok(amount) if base == only_numbered && has_functions(&amount) => {
                    self.at = start;
                    None
                }
                Ok(amount) => {
                    let after = after.or_else(|| self.after_group());
                    Some(Ok((axis, amount, after)))
                }
                Err(mistake) => {
                    self.at = start;
                    // A vector in the parentheses: the matrix is multiplied, and nobody said what it is.
                    if mistake.message.contains("stands where one amount is wanted") {
                        None
                    } else {
                        Some(Err(mistake))
                    }
                }
            };
        }
        if base.len() < 3 && base != "R" {
            return None;
        }
        // `\mathrm{Rot}(z, \psi)`, `\mathrm{Rot}(\hat{z}, \psi)`
        let [open, rest @ ..] = self.tokens.get(start + read.tokens..)? else { return None };
        let letter = glyph::read(rest).ok()??;
        let comma = rest.get(letter.tokens)?;
        if open.kind != Kind::Mark('(') || comma.kind != Kind::Mark(',') {
            return None;
        }
        let bare = letter.glyph.base.strip_prefix("\\hat{").and_then(|base| base.strip_suffix('}'));
        let axis = axis_of(bare.unwrap_or(&letter.glyph.base))?;
        self.at = start + read.tokens + 2 + letter.tokens;
        let amount = self.formula().and_then(Value::scalar);
        let closed = amount.and_then(|amount| {
            self.expect_closer(&Kind::Mark(')'))?;
            Ok((axis, amount, after.or_else(|| self.after_group())))
        });
        Some(closed)
    }

    /// A transposition or an inversion behind a closed bracket.
    fn after_group(&mut self) -> Option<After> {
        if self.skip_transposition() {
            return Some(After::Transposed);
        }
        let inverted = self.skip_inversion()?;
        Some(After::Inverse(inverted))
    }

    /// `S(\omega)`, `\mathrm{skew}(\omega)`, `\operatorname{diag}(a, b, c)`
    fn function_of_matrix(&mut self, read: &ReadGlyph) -> Option<Result<Value, Unreadable>> {
        let Glyph { base, lower, upper, .. } = &read.glyph;
        let is_diagonal = base == "diag";
        let is_skew = matches!(base.as_str(), "S" | "skew" | "Skew" | "sk" | "SK" | "cross");
        if !(is_diagonal || is_skew) || !lower.is_empty() || !upper.is_empty() {
            return None;
        }
        let open = self.tokens.get(self.at + read.tokens)?;
        if !matches!(open.kind, Kind::Mark('(' | '[')) {
            return None;
        }
        let start = self.at;
        self.at += read.tokens;
        let inside = match self.group() {
            Ok(Value::Matrix(inside)) if inside.is_vector() => inside,
            Ok(_) => {
                self.at = start;
                return None;
            }
            Err(mistake) => return Some(Err(mistake)),
        };
        let place = read.place.start..inside.place.end;
        let matrix = if is_diagonal {
            Some(Matrix::diagonal(inside.entries, place.clone()))
        } else {
            transforms::skew(&inside.entries, &place)
        };
        let matrix = matrix.ok_or_else(|| Mistake::new(place, "a vector of three components is wanted"));
        Some(matrix.and_then(|matrix| self.powered_value(Value::Matrix(matrix))))
    }

    /// `e^{\hat\xi\theta}`, `\exp(\hat\omega\theta)`
    fn exponential(&mut self, read: &ReadGlyph) -> Option<Result<Value, Unreadable>> {
        let start = self.at;
        match &self.tokens.get(start)?.kind {
            Kind::Word(word) if word == "e" => {
                if self.tokens.get(start + 1)?.kind != Kind::Mark('^') {
                    return None;
                }
                self.at += 2;
            }
            Kind::Word(word) if word == "exp" || word == "expm" => self.at += 1,
            _ => return None,
        }
        Some(self.exponential_of_group(read.place.start))
    }

    /// What stands in the brackets of an exponential.
    pub(super) fn exponential_of_group(&mut self, start: usize) -> Result<Value, Unreadable> {
        let inside = self.group()?;
        let Value::Matrix(matrix) = inside else {
            return Err(Mistake::new(inside.place(), "only exponentials of matrices are known")
                .with_help(r"`e^{\hat\xi\theta}`, with the screw under [symbols]"));
        };
        let (mut matrix, is_series) = transforms::exponential(&matrix, |formula| self.is_small(formula))?;
        self.notes.truncates |= is_series;
        matrix.place.start = start;
        self.powered_value(Value::Matrix(matrix))
    }

    /// The determinant of the matrix behind its name: in brackets, or one symbol.
    pub(super) fn determinant(&mut self, start: usize) -> Result<Value, Unreadable> {
        let is_bare = self.peek().is_some_and(|token| glyph::starts(&token.kind));
        let inside = self.operand()?;
        if is_bare && self.starts_operand() {
            let message = "does the determinant end before this factor, or behind it?";
            return Err(Mistake::new(self.here(), message).with_help(r"write `\det(…)`"));
        }
        let Value::Matrix(matrix) = inside else {
            return Err(Mistake::new(inside.place(), "only matrices have a determinant"));
        };
        let determinant = self.determinant_of(&matrix)?;
        let place = start..matrix.place.end;
        Ok(Value::Scalar(Expr { node: determinant.node, place }))
    }

    /// The determinant of a matrix; one of small turns has terms that a print drops.
    pub(super) fn determinant_of(&mut self, matrix: &Matrix) -> Result<Formula, Unreadable> {
        self.notes.truncates |= matrix.entries.iter().any(|entry| self.has_error(entry));
        transforms::determinant(matrix)
    }

    /// Whether every term of an amount has an error in it, as far as one can see: a product with an error, or a sum of such.
    pub(super) fn is_small(&self, formula: &Formula) -> bool {
        match &formula.node {
            Node::Symbol(name) => self.symbols.names.get(name) == Some(&SymbolKind::Error),
            Node::Neg(inside) => self.is_small(inside),
            Node::Div(inside, _) => self.is_small(inside),
            Node::Pow(inside, power) => *power > 0 && self.is_small(inside),
            Node::Add(a, b) => self.is_small(a) && self.is_small(b),
            Node::Mul(a, b) => self.is_small(a) || self.is_small(b),
            _ => false,
        }
    }

    /// Whether an error occurs in an amount.
    pub(super) fn has_error(&self, formula: &Formula) -> bool {
        formula.names().iter().any(|(name, _)| self.symbols.names.get(*name) == Some(&SymbolKind::Error))
    }

    /// A formula in the text of an index.
    pub(super) fn inner(&self, text: &str, place: &Range<usize>) -> Option<Result<Formula, Unreadable>> {
        let tokens = crate::latex::left::tokens(text).ok()?;
        let moved: Vec<_> = tokens
            .into_iter()
            .map(|token| crate::latex::token::Token { place: place.clone(), ..token })
            .collect();
        let end = place.end..place.end;
        let mut parser = Parser::new(self.text, &moved, end, self.symbols);
        let read = parser.formula().and_then(|value| {
            parser.expect_end()?;
            value.scalar()
        });
        Some(read.map(|formula| Expr { node: formula.node, place: place.clone() }))
    }
}

/// Whether sines or cosines stand in an amount.
fn has_functions(formula: &Formula) -> bool {
    let mut found = Vec::new();
    formula.arguments(&mut found);
    !found.is_empty()
}
