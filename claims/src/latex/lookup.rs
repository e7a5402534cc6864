//! Printed symbols found in formulas: the longest that is known, with what stands above it.

use std::ops::Range;

use super::glyph::{self, Glyph, ReadGlyph};
use super::printed::{Entry, Meaning, PrintedSymbols};
use super::token::Token;
use super::unknown::{self, Known};
use super::{Unreadable, left};
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;
use model_core::symbol::SymbolKind;

/// A printed symbol found in a formula.
pub(super) struct Found<'a> {
    pub meaning: &'a Meaning,
    /// Byte range in the text, the power left out.
    pub place: Range<usize>,
    /// Number of tokens it takes, what is done to it included.
    pub tokens: usize,
    /// What is done to it.
    pub after: Option<After>,
}

/// What an upper or lower index does to a symbol.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum After {
    /// `x^2`
    Power(i32),
    /// `R^T`
    Transposed,
    /// `R^{-1}`, and transposed `R^{-T}`.
    Inverse(bool),
    /// `\hat\omega`, `\omega^\times`: the matrix of the vector product.
    Skew,
}

impl After {
    /// What an upper index does, if it is none.
    pub fn of(upper: &str) -> Option<Self> {
        Some(match upper {
            "T" | "\\top" | "\\intercal" | "'" | "t" => Self::Transposed,
            "-1" => Self::Inverse(false),
            "-T" | "-\\top" => Self::Inverse(true),
            "×" | "\\wedge" | "∧" => Self::Skew,
            // Nobody prints the powers 0 and 1: there it is an index, and the symbol unknown.
            number => Self::Power(number.parse().ok().filter(|power| !(0..=1).contains(power))?),
        })
    }
}

/// What stands below a hat: `\hat{\omega}`.
fn hatted(base: &str) -> Option<&str> {
    let hats = ["\\hat{", "\\widehat{", "\\tilde{"];
    hats.iter().find_map(|hat| base.strip_prefix(hat)?.strip_suffix('}'))
}

impl PrintedSymbols {
    /// The longest known symbol at the start of `tokens`, which starts one.
    pub(super) fn find(&self, text: &str, tokens: &[Token]) -> Result<Found<'_>, Unreadable> {
        let mut read: Vec<ReadGlyph> = Vec::new();
        let mut used = 0;
        while read.len() < self.longest.max(3) {
            match glyph::read(&tokens[used..]) {
                Ok(Some(next)) => {
                    used += next.tokens;
                    read.push(next);
                }
                Ok(None) => break,
                Err(error) if read.is_empty() => return Err(error),
                Err(_) => break,
            }
        }
        for count in (1..=read.len()).rev() {
            let glyphs: Vec<Glyph> = read[..count].iter().map(|read| read.glyph.clone()).collect();
            let taken: usize = read[..count].iter().map(|read| read.tokens).sum();
            let arguments = glyph::arguments(&tokens[taken..]);
            let place = read[0].place.start..read[count - 1].place.end;
            if let Some((arguments, length)) = &arguments
                && let Some(entry) = self.entry(&glyphs, arguments)
            {
                let place = place.start..tokens[taken + length - 1].place.end;
                return entry.found(place, taken + length, None);
            }
            let whole = self.entry(&glyphs, &[]).map(|entry| (entry, None));
            let known = whole.or_else(|| self.changed(&glyphs));
            match (known, arguments) {
                (Some((entry, after)), None) => return entry.found(place, taken, after),
                (Some((entry, after)), Some((arguments, length))) => {
                    let inside = place.start..tokens[taken + length - 1].place.end;
                    let is_function = match &entry.meaning {
                        _ if after.is_some() => false,
                        Meaning::Matrix { .. } => self.is_matrix_of(&arguments, text, inside)?,
                        _ => self.is_function_of(entry, &arguments, text, inside)?,
                    };
                    let length = if is_function { length } else { 0 };
                    return entry.found(place, taken + length, after);
                }
                (None, Some((_, length))) if self.has_arguments(&glyphs) => {
                    let place = place.start..tokens[taken + length - 1].place.end;
                    let message = format!("unknown symbol `{}`", &text[place.clone()]);
                    let others = self.entries.iter().filter(|(key, _)| key.glyphs == glyphs);
                    let known: Vec<String> =
                        others.map(|(_, entry)| format!("`{}`", entry.printed)).collect();
                    return Err(
                        Mistake::new(place, message).with_help(format!("known are {}", known.join(", ")))
                    );
                }
                (None, _) => {}
            }
        }
        let known: Vec<Known<'_>> = self
            .entries
            .iter()
            .map(|(key, entry)| Known { glyphs: &key.glyphs, printed: &entry.printed, name: entry.name() })
            .collect();
        Err(unknown::symbol(&known, |name| self.names.contains_key(name), text, &read))
    }

    /// A known symbol with something done to it: a power, a transposition, the matrix of its vector product.
    fn changed(&self, glyphs: &[Glyph]) -> Option<(&Entry, Option<After>)> {
        let last = glyphs.last()?;
        let with = |last: Glyph, after: After| {
            let glyphs = [&glyphs[..glyphs.len() - 1], &[last]].concat();
            let entry = self.entry(&glyphs, &[])?;
            let fits = match (&entry.meaning, after) {
                (Meaning::Matrix { rows: 3, columns: 1, .. } | Meaning::Twist(_), After::Skew) => true,
                (Meaning::Matrix { rows, columns, .. }, After::Power(_) | After::Inverse(_)) => {
                    rows == columns
                }
                (Meaning::Matrix { .. }, After::Transposed) => true,
                (Meaning::Amount(_) | Meaning::Ambiguous(_), After::Power(_)) => true,
                (Meaning::Amount(_), After::Inverse(false)) => return Some((entry, Some(After::Power(-1)))),
                _ => false,
            };
            fits.then_some((entry, Some(after)))
        };
        if let Some(inside) = hatted(&last.base) {
            let tokens = left::tokens(inside).ok()?;
            let mut bare = glyph::read(&tokens).ok()??.glyph;
            for (own, outer) in [(&mut bare.lower, &last.lower), (&mut bare.upper, &last.upper)] {
                if own.is_empty() {
                    own.clone_from(outer);
                }
            }
            if let Some(found) = with(bare, After::Skew) {
                return Some(found);
            }
        }
        if matches!(last.lower.as_str(), "×" | "\\wedge") {
            return with(Glyph { lower: String::new(), ..last.clone() }, After::Skew);
        }
        let after = After::of(&last.upper)?;
        if let Some(found) = with(Glyph { upper: String::new(), ..last.clone() }, after) {
            return Some(found);
        }
        // `R_b^{mT}`
        let own = last.upper.strip_suffix('T').or_else(|| last.upper.strip_suffix("\\top"))?;
        with(Glyph { upper: own.to_owned(), ..last.clone() }, After::Transposed)
    }

    /// Whether a symbol is known with other arguments.
    fn has_arguments(&self, glyphs: &[Glyph]) -> bool {
        self.entries.keys().any(|key| key.glyphs == glyphs && !key.arguments.is_empty())
    }

    /// Whether `R(\psi)` says what a matrix depends on: behind it stand joints and inputs only.
    fn is_matrix_of(
        &self,
        arguments: &[Vec<Glyph>],
        text: &str,
        place: Range<usize>,
    ) -> Result<bool, Unreadable> {
        let mut moves = 0;
        for argument in arguments {
            let kind = match self.entry(argument, &[]).map(|entry| (&entry.meaning, entry.name())) {
                Some((Meaning::Amount(_), Some(name))) => self.names.get(name),
                Some((Meaning::Amount(_) | Meaning::Ambiguous(_), None)) => None,
                _ => return Ok(false),
            };
            moves += usize::from(matches!(kind, Some(SymbolKind::Joint | SymbolKind::Input)));
        }
        if moves == arguments.len() {
            return Ok(true);
        }
        let message = "is this matrix a function of what follows, or multiplied by it?";
        Err(Mistake::new(place.clone(), message).with_help(format!(
            "for a product write `\\cdot` before the parenthesis; for a name of its own: '{}' = \"…\" under [symbols]",
            &text[place]
        )))
    }

    /// Whether `e(\alpha)` says that an error is a function of its joint. A product is only read where the parentheses
    /// cannot mean an argument.
    fn is_function_of(
        &self,
        entry: &Entry,
        arguments: &[Vec<Glyph>],
        text: &str,
        place: Range<usize>,
    ) -> Result<bool, Unreadable> {
        // Several factors in parentheses are no argument.
        if arguments.iter().any(|argument| argument.len() > 1 && self.entry(argument, &[]).is_none()) {
            return Ok(false);
        }
        let mut names = Vec::new();
        for argument in arguments {
            let name = match self.entry(argument, &[]).map(|entry| &entry.meaning) {
                Some(Meaning::Amount(Expr { node: Node::Symbol(name), .. })) => Some(name),
                _ => None,
            };
            names.push(name);
        }
        let varies = |name: &Option<&String>| {
            name.is_none_or(|name| {
                self.names.get(name).is_none_or(|kind| matches!(kind, SymbolKind::Joint | SymbolKind::Input))
            })
        };
        if arguments.len() == 1 && !names.iter().any(varies) {
            return Ok(false);
        }
        let ambiguous = |message: String| {
            Err(Mistake::new(place.clone(), message).with_help(format!(
                "for a product write `\\cdot` before the parenthesis; for a name of its own: '{}' = \"…\" under [symbols]",
                &text[place.clone()]
            )))
        };
        let Meaning::Amount(Expr { node: Node::Symbol(error), .. }) = &entry.meaning else {
            return ambiguous("is this a function of its argument, or a product?".to_owned());
        };
        if self.names.get(error) != Some(&SymbolKind::Error) {
            return ambiguous(format!("is this `{error}` as a function, or a product?"));
        }
        let own = self.joints.get(error).map_or(&[][..], Vec::as_slice);
        match names.iter().find(|name| name.is_none_or(|name| !own.contains(name))) {
            None => Ok(true),
            Some(other) => {
                let of = other.map_or("this", String::as_str);
                let moved = match own {
                    [] => "no joint moves its body".to_owned(),
                    own => format!("its body is moved by {}", own.join(" and ")),
                };
                ambiguous(format!("`{error}` is no function of {of}: {moved}"))
            }
        }
    }
}

impl Entry {
    fn found(
        &self,
        place: Range<usize>,
        tokens: usize,
        after: Option<After>,
    ) -> Result<Found<'_>, Unreadable> {
        match &self.meaning {
            Meaning::Ambiguous(names) => {
                let message = format!("`{}` is the printed form of {}", self.printed, names.join(" and "));
                Err(Mistake::new(place, message)
                    .with_help(format!("say which under [symbols]: '{}' = \"{}\"", self.printed, names[0])))
            }
            meaning => Ok(Found { meaning, place, tokens, after }),
        }
    }
}
