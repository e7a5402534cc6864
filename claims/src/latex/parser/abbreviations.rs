//! `c\psi`, `\mathrm c_\psi`, `s_{23}`: cosines and sines as robotics abbreviates them. They are read where a print has both
//! letters and declares neither.

use std::borrow::Cow;

use super::powers::raised;
use super::value::{added, negated};
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
use model_core::syntax::FUNCTIONS;

/// Whether texts abbreviate both cosines and sines, in letters of one case.
fn abbreviates(texts: &[&str]) -> bool {
    let mut found: Vec<String> = Vec::new();
    for tokens in texts.iter().filter_map(|text| left::tokens(text).ok()) {
        for pair in tokens.windows(2) {
            let [Token { kind: Kind::Word(word), .. }, next] = pair else { continue };
            let follows = next.kind == Kind::Mark('_')
                || next.kind == Kind::Mark('^')
                || next.kind == Kind::Mark('(')
                || glyph::starts(&next.kind);
            if follows {
                found.push(word.clone());
            }
        }
    }
    let has = |letter: &str| found.iter().any(|word| word == letter);
    (has("c") && has("s")) || (has("C") && has("S"))
}

/// Whether at least two of bold `i`, `j` and `k` stand in a text.
fn has_unit_letters(texts: &[&str]) -> bool {
    let tokens: Vec<Token> = texts.iter().filter_map(|text| left::tokens(text).ok()).flatten().collect();
    let has =
        |letter: &str| tokens.iter().any(|token| token.bold && token.kind == Kind::Word(letter.to_owned()));
    ["i", "j", "k"].into_iter().filter(|letter| has(letter)).count() > 1
}

impl PrintedSymbols {
    /// The same table where symbols that nobody defines are read as they usually are: a lone `s_2` as a sine, `\theta_{23}` as a sum.
    pub(crate) fn guessing(&self) -> Self {
        let mut own = self.clone();
        own.guesses = true;
        own
    }

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

    /// What is said of an unknown `s_2` or `\theta_{23}`: it is likely a sine of joint 2, or the sum of two joints.
    pub(super) fn likely_abbreviation(&self, mistake: Unreadable) -> Unreadable {
        let likely = || {
            let read = glyph::read(self.tokens.get(self.at..)?).ok()??;
            let shown = glyph::normal_text(&[Glyph { upper: String::new(), ..read.glyph.clone() }]);
            let meant = if let Some(sum) = self.sum_of_joints(&read) {
                plain_sum(&sum)?
            } else {
                let meant = function_of(&read.glyph.base)?;
                let (function, _) = FUNCTIONS.iter().find(|(_, function)| *function == meant)?;
                let angle = self.angle_of_index(&read.glyph.lower, &read)?.ok()?;
                let is_joint = |name: &str| self.symbols.names.get(name) == Some(&SymbolKind::Joint);
                let sum =
                    plain_sum(&angle).filter(|_| angle.names().iter().all(|(name, _)| is_joint(name)))?;
                format!("{function}({sum})")
            };
            Some(format!("name it under [symbols]: '{shown}' = \"{meant}\""))
        };
        match likely() {
            Some(help) => mistake.with_help(help),
            None => mistake,
        }
    }

    pub(super) fn abbreviation(&mut self, read: &ReadGlyph) -> Option<Result<Value, Unreadable>> {
        if !self.symbols.abbreviates && !self.symbols.guesses {
            return None;
        }
        let Glyph { base, lower, upper, left, .. } = &read.glyph;
        let function = function_of(base)?;
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
        if !lower.chars().all(|c| c.is_ascii_digit() || matches!(c, ',' | '+' | '-')) {
            return self.inner(lower, &place);
        }
        let joint = |number: &str| joint_numbered(self.symbols, number);
        let parts = numbers_of_index(lower)?;
        let single = parts.iter().map(|(_, number)| joint(number)).collect::<Option<Vec<Vec<String>>>>()?;
        let whole = joint(lower).filter(|_| parts.len() > 1).unwrap_or_default();
        let doubtful = |why: String| {
            Some(Err(Mistake::new(place.clone(), why)
                .with_help("name it under [symbols]: 's_{12}' = \"sin(q1 + q2)\"")))
        };
        if !whole.is_empty() && single.iter().all(|found| !found.is_empty()) {
            return doubtful(format!("is {lower} the number of one joint, or of {} joints?", parts.len()));
        }
        let single = if whole.is_empty() { single } else { vec![whole] };
        let mut joints = Vec::with_capacity(single.len());
        for (found, (is_negative, number)) in single.into_iter().zip(&parts) {
            let [name] = found.as_slice() else {
                return match found.len() {
                    0 => None,
                    _ => doubtful(format!("{number} is the number of {}", found.join(" and "))),
                };
            };
            let joint = Expr { node: Node::Symbol(name.clone()), place: place.clone() };
            joints.push(if *is_negative { negated(joint) } else { joint });
        }
        joints.into_iter().reduce(added).map(Ok)
    }

    /// The sum of the joints that a symbol numbers: `\theta_{23}` beside joints `\theta_2` and `\theta_3`.
    fn sum_of_joints(&self, read: &ReadGlyph) -> Option<Formula> {
        let numbers = &read.glyph.lower;
        if numbers.len() < 2 || !numbers.chars().all(|c| c.is_ascii_digit()) {
            return None;
        }
        let joint = |number: char| {
            let glyph = Glyph { lower: number.to_string(), ..read.glyph.clone() };
            let name = self.symbols.entry(&[glyph], &[])?.name()?;
            let is_joint = self.symbols.names.get(name) == Some(&SymbolKind::Joint);
            is_joint.then(|| Expr { node: Node::Symbol(name.to_owned()), place: read.place.clone() })
        };
        numbers.chars().map(joint).collect::<Option<Vec<Formula>>>()?.into_iter().reduce(added)
    }

    /// The same as a value, where symbols that nobody defines are read as they usually are.
    pub(super) fn usual_sum(&mut self, read: &ReadGlyph) -> Option<Result<Value, Unreadable>> {
        let sum = self.sum_of_joints(read).filter(|_| self.symbols.guesses)?;
        self.at += read.tokens;
        Some(self.powered(sum).map(Value::Scalar))
    }
}

/// The numbers in an index, each with whether it is subtracted: `23`, `2,3`, `2+3`.
fn numbers_of_index(lower: &str) -> Option<Vec<(bool, String)>> {
    let digits = |text: &str| !text.is_empty() && text.chars().all(|c| c.is_ascii_digit());
    if digits(lower) {
        return Some(lower.chars().map(|digit| (false, digit.to_string())).collect());
    }
    let (mut parts, mut is_negative, mut rest) = (Vec::new(), false, lower);
    loop {
        let (number, behind) = rest.split_at(rest.find([',', '+', '-']).unwrap_or(rest.len()));
        parts.push((is_negative, Some(number.to_owned()).filter(|number| digits(number))?));
        let Some(sign) = behind.chars().next() else { return Some(parts) };
        is_negative = sign == '-';
        rest = &behind[1..];
    }
}

/// What a letter abbreviates.
fn function_of(letter: &str) -> Option<Function> {
    match letter {
        "c" | "C" => Some(Function::Cos),
        "s" | "S" => Some(Function::Sin),
        _ => None,
    }
}

/// A sum of names in the plain syntax; nothing for any other amount.
fn plain_sum(formula: &Formula) -> Option<String> {
    match &formula.node {
        Node::Symbol(name) => Some(name.clone()),
        Node::Add(a, b) => match &b.node {
            Node::Neg(b) => Some(format!("{} - {}", plain_sum(a)?, plain_sum(b)?)),
            _ => Some(format!("{} + {}", plain_sum(a)?, plain_sum(b)?)),
        },
        _ => None,
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
