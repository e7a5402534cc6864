//! `c\psi`, `\mathrm c_\psi`, `s_{23}`: cosines and sines as robotics abbreviates them. They are read where a print has both
//! letters and declares neither.

use std::borrow::Cow;

use super::powers::raised;
use super::{Formula, Parser, Value};
use crate::latex::Unreadable;
use crate::latex::glyph::{self, Glyph, ReadGlyph};
use crate::latex::left;
use crate::latex::lookup::After;
use crate::latex::printed::{Meaning, PrintedSymbols};
use crate::latex::token::{Kind, Token};
use model_core::expr::{Expr, Function, Node};
use model_core::mistake::Mistake;
use model_core::symbol::SymbolKind;

/// Whether a text abbreviates both cosines and sines.
fn abbreviates(texts: &[&str]) -> bool {
    let mut found = [false; 2];
    for tokens in texts.iter().filter_map(|text| left::tokens(text).ok()) {
        for pair in tokens.windows(2) {
            let [Token { kind: Kind::Word(word), .. }, next] = pair else { continue };
            let follows = next.kind == Kind::Mark('_')
                || next.kind == Kind::Mark('^')
                || next.kind == Kind::Mark('(')
                || glyph::starts(&next.kind);
            match word.as_str() {
                "c" | "C" if follows => found[0] = true,
                "s" | "S" if follows => found[1] = true,
                _ => {}
            }
        }
    }
    found == [true; 2]
}

/// Whether at least two of bold `i`, `j` and `k` stand in a text.
fn has_unit_letters(texts: &[&str]) -> bool {
    let tokens: Vec<Token> = texts.iter().filter_map(|text| left::tokens(text).ok()).flatten().collect();
    let has =
        |letter: &str| tokens.iter().any(|token| token.bold && token.kind == Kind::Word(letter.to_owned()));
    ["i", "j", "k"].into_iter().filter(|letter| has(letter)).count() > 1
}

impl PrintedSymbols {
    /// The same table for texts that abbreviate cosines and sines, or have unit vectors as bold letters, if these do.
    #[must_use]
    pub fn reading(&self, texts: &[&str]) -> Cow<'_, Self> {
        let abbreviates = self.abbreviates || abbreviates(texts);
        let has_unit_letters = self.has_unit_letters || has_unit_letters(texts);
        if [abbreviates, has_unit_letters] == [self.abbreviates, self.has_unit_letters] {
            return Cow::Borrowed(self);
        }
        let mut own = self.clone();
        (own.abbreviates, own.has_unit_letters) = (abbreviates, has_unit_letters);
        Cow::Owned(own)
    }
}

impl Parser<'_> {
    /// An abbreviation that the declaration also prints for an error or constant: `c_1` of `c1` beside joint 1. Where the claims
    /// file prints that name in another way, it is the cosine; elsewhere it could be either.
    pub(super) fn abbreviation_of_declared(&mut self) -> Option<Result<Value, Unreadable>> {
        if !self.symbols.abbreviates {
            return None;
        }
        let read = glyph::read(self.tokens.get(self.at..)?).ok()??;
        let Glyph { base, lower, upper, .. } = &read.glyph;
        let is_numbered = lower.starts_with(|c: char| c.is_ascii_digit());
        if !is_numbered || !matches!(base.as_str(), "c" | "C" | "s" | "S") {
            return None;
        }
        let is_power = matches!(After::of(upper), Some(After::Power(_)));
        let bare =
            Glyph { upper: if is_power { String::new() } else { upper.clone() }, ..read.glyph.clone() };
        let entry = self.symbols.entry(&[bare], &[]).filter(|entry| entry.is_declared)?;
        let name = entry.name()?.to_owned();
        let angle = self.angle_of_index(lower, &read)?.ok()?;
        if self.symbols.renames(&name) {
            return self.abbreviation(&read);
        }
        let function = if base.eq_ignore_ascii_case("c") { "cos" } else { "sin" };
        let printed = &entry.printed;
        let joints: Vec<&str> = angle.names().into_iter().map(|(joint, _)| joint).collect();
        let joints = joints.join(" + ");
        let message = format!("is `{printed}` the declared `{name}`, or {function}({joints})?");
        Some(Err(Mistake::new(read.place.clone(), message).with_help(format!(
            "say which under [symbols]: '{printed}' = \"{name}\", or '{printed}' = \"{function}({joints})\""
        ))))
    }

    pub(super) fn abbreviation(&mut self, read: &ReadGlyph) -> Option<Result<Value, Unreadable>> {
        if !self.symbols.abbreviates {
            return None;
        }
        let Glyph { base, lower, upper, left, .. } = &read.glyph;
        let function = match base.as_str() {
            "c" | "C" => Function::Cos,
            "s" | "S" => Function::Sin,
            _ => return None,
        };
        let power = match After::of(upper) {
            Some(After::Power(power)) if power > 0 => Some(power),
            None if upper.is_empty() => None,
            _ => return None,
        };
        if !left.is_empty() {
            return None;
        }
        let start = self.at;
        let angle = if lower.is_empty() {
            self.at += read.tokens;
            if !self.peek().is_some_and(|token| glyph::starts(&token.kind) || token.kind == Kind::Mark('(')) {
                self.at = start;
                return None;
            }
            self.function_argument()
        } else {
            let angle = self.angle_of_index(lower, read)?;
            self.at += read.tokens;
            angle
        };
        let angle = match angle {
            Ok(angle) => angle,
            Err(mistake) => return Some(Err(mistake)),
        };
        let end = if lower.is_empty() { angle.place.end } else { read.place.end };
        let place = read.place.start..end;
        let call = Expr { node: Node::Call(function, Box::new(angle)), place };
        Some(match power {
            Some(power) => Ok(Value::Scalar(raised(call, power, end))),
            None => self.powered(call).map(Value::Scalar),
        })
    }

    /// The angle that an index names: a symbol, a sum of symbols, or numbers of joints.
    fn angle_of_index(&self, lower: &str, read: &ReadGlyph) -> Option<Result<Formula, Unreadable>> {
        let place = read.place.clone();
        if !lower.chars().all(|c| c.is_ascii_digit() || c == ',') {
            return self.inner(lower, &place);
        }
        let joint = |number: &str| joint_numbered(self.symbols, number);
        let parts: Vec<String> = if lower.contains(',') {
            lower.split(',').map(str::to_owned).collect()
        } else {
            lower.chars().map(String::from).collect()
        };
        let single = parts.iter().map(|number| joint(number)).collect::<Option<Vec<Vec<String>>>>()?;
        let whole = joint(lower).filter(|_| parts.len() > 1).unwrap_or_default();
        let doubtful = |why: String| {
            Some(Err(Mistake::new(place.clone(), why)
                .with_help("name it under [symbols]: 's_{12}' = \"sin(q1 + q2)\"")))
        };
        if !whole.is_empty() && single.iter().all(|found| !found.is_empty()) {
            return doubtful(format!("is {lower} the number of one joint, or of {} joints?", parts.len()));
        }
        let single = if whole.is_empty() { single } else { vec![whole] };
        let mut sum: Option<Formula> = None;
        for (found, number) in single.iter().zip(&parts) {
            let [name] = found.as_slice() else {
                return match found.len() {
                    0 => None,
                    _ => doubtful(format!("{number} is the number of {}", found.join(" and "))),
                };
            };
            let joint = Expr { node: Node::Symbol(name.clone()), place: place.clone() };
            sum = Some(match sum {
                None => joint,
                Some(sum) => Expr { node: Node::Add(Box::new(sum), Box::new(joint)), place: place.clone() },
            });
        }
        sum.map(Ok)
    }
}

/// The joints that are printed as one letter with this number.
fn joint_numbered(symbols: &PrintedSymbols, number: &str) -> Option<Vec<String>> {
    let mut found: Vec<String> = Vec::new();
    for (key, entry) in &symbols.entries {
        let Meaning::Amount(Expr { node: Node::Symbol(name), .. }) = &entry.meaning else { continue };
        let is_joint = symbols.names.get(name) == Some(&SymbolKind::Joint);
        let [glyph] = key.glyphs.as_slice() else { continue };
        if is_joint && key.arguments.is_empty() && glyph.lower == number && !found.contains(name) {
            found.push(name.clone());
        }
    }
    Some(found)
}
