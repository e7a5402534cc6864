//! `|\vec r|^2`, `\lVert p \rVert^2`, `\norm{p}^2`: lengths of vectors, which only as squares are sums of products.

use super::powers::raised;
use super::value::added;
use super::{Formula, Parser, Value};
use crate::latex::Unreadable;
use crate::latex::token::Kind;
use model_core::mistake::Mistake;

/// What opens a length, and what closes it. `|` closes what it opened.
const BARS: [(&str, &str); 6] =
    [("lvert", "rvert"), ("lVert", "rVert"), ("vert", "vert"), ("Vert", "Vert"), ("|", "|"), ("‖", "‖")];

fn name_of(kind: &Kind) -> String {
    match kind {
        Kind::Command(command) => command.clone(),
        Kind::Mark(mark) => mark.to_string(),
        _ => String::new(),
    }
}

impl Parser<'_> {
    /// Whether a length begins here: a bar that closes none that is open.
    pub(super) fn starts_length(&self) -> bool {
        let Some(token) = self.peek() else { return false };
        let name = name_of(&token.kind);
        let opens = BARS.iter().any(|(open, _)| *open == name) || matches!(name.as_str(), "norm" | "abs");
        opens && self.bars.last() != Some(&name)
    }

    /// The square of a length with its power, `|\vec r|^2` or `|\vec r|^4`.
    pub(super) fn length(&mut self) -> Result<Formula, Unreadable> {
        let start = self.here().start;
        let square = self.square_of_length()?;
        let place = start..self.tokens[self.at - 1].place.end;
        let odd = || {
            Mistake::new(place.clone(), "a length is a root, and no sum of products")
                .with_help(r"claim its square, `|\vec r|^2`; two lengths are compared by `equal = ['|\vec r|', '\sqrt{…}']`")
        };
        if !self.is_at_mark('^') {
            return Err(odd());
        }
        self.advance();
        let (power, end) = self.power()?;
        if power < 2 || power % 2 != 0 {
            return Err(odd());
        }
        let square = Formula { place: place.start..end, ..square };
        Ok(if power == 2 { square } else { raised(square, power / 2, end) })
    }

    /// What stands below the root that a length is.
    pub(super) fn square_of_length(&mut self) -> Result<Formula, Unreadable> {
        let (open, bar) = (self.peek().map_or(String::new(), |token| name_of(&token.kind)), self.here());
        self.deeper()?;
        self.advance();
        let inside = match BARS.iter().find(|(own, _)| *own == open) {
            None => self.group()?,
            Some((_, close)) => {
                self.bars.push((*close).to_owned());
                let inside = self.formula()?;
                let is_closed = self.peek().is_some_and(|token| name_of(&token.kind) == *close);
                if !is_closed {
                    let message =
                        "an absolute value or a length begins here, and the bar that closes it is missing";
                    return Err(Mistake::new(bar, message));
                }
                self.bars.pop();
                self.advance();
                inside
            }
        };
        self.depth -= 1;
        let place = inside.place();
        match inside {
            Value::Matrix(matrix) if matrix.is_vector() => {
                let squares = matrix.entries.into_iter().map(|entry| {
                    let end = entry.place.end;
                    raised(entry, 2, end)
                });
                squares.reduce(added).ok_or_else(|| Mistake::new(place, "an empty vector"))
            }
            Value::Scalar(amount) => {
                let end = amount.place.end;
                Ok(raised(amount, 2, end))
            }
            _ => Err(Mistake::new(place, "the length of a matrix is not known")),
        }
    }
}
