//! Operands: numbers, groups, fractions, symbols, each with the power behind it.

use super::functions::function;
use super::powers::raised;
use super::{Formula, Matrix, Parser, Value, is_fraction, transforms};
use crate::latex::commands::{DETERMINANT, RAMP};
use crate::latex::lookup::After;
use crate::latex::printed::Meaning;
use crate::latex::token::Kind;
use crate::latex::{Unreadable, glyph};
use model_core::algebra::Rational;
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;
use model_core::names;

/// Groups within groups that are read; print never comes near it.
const DEEPEST: usize = 100;

impl Parser<'_> {
    /// A number, symbol, function, fraction, matrix or group, with the power behind it.
    pub(super) fn operand(&mut self) -> Result<Value, Unreadable> {
        let Some(token) = self.peek() else {
            return Err(self.unexpected("a term"));
        };
        match &token.kind {
            _ if self.starts_length() => self.length().map(Value::Scalar),
            Kind::Digit(_) | Kind::Mark('.') => {
                let number = self.number()?;
                self.powered_value(Value::Scalar(number))
            }
            Kind::Name(name) => self.declared(name),
            Kind::OpenBrace | Kind::Mark('(' | '[' | '{') => {
                let group = self.group()?;
                self.powered_value(group)
            }
            Kind::Begin(name) => {
                let matrix = self.matrix()?;
                // Bars around entries are the determinant.
                if name == "vmatrix" {
                    let determinant = self.determinant_of(&matrix)?;
                    return self.powered(determinant).map(Value::Scalar);
                }
                self.powered_value(Value::Matrix(matrix))
            }
            Kind::Command(name) => {
                if let Some(function) = function(name) {
                    return self.function(function, name).map(Value::Scalar);
                }
                if is_fraction(name) {
                    let fraction = self.fraction()?;
                    return self.powered_value(fraction);
                }
                if name == "sqrt" {
                    let root = self.root()?;
                    return self.powered(root).map(Value::Scalar);
                }
                if name == "sum" {
                    return self.sum();
                }
                if name == "exp" {
                    let start = self.here().start;
                    self.advance();
                    return self.exponential_of_group(start);
                }
                if name == DETERMINANT {
                    let start = self.here().start;
                    self.advance();
                    return self.determinant(start);
                }
                if name == RAMP {
                    return self.ramp().map(Value::Scalar);
                }
                if let Some(refusal) = self.refusal() {
                    return Err(refusal);
                }
                self.symbol()
            }
            kind if glyph::starts(kind) => self.symbol(),
            Kind::Mark('+' | '-') => {
                Err(self.unexpected("a term").with_help("put parentheses around a signed factor"))
            }
            _ => Err(self.unexpected("a term")),
        }
    }

    pub(super) fn number(&mut self) -> Result<Formula, Unreadable> {
        let start = self.here().start;
        let mut end = start;
        let mut digits = String::new();
        while let Some(token) = self.peek() {
            let digit = match token.kind {
                Kind::Digit(digit) => digit,
                Kind::Mark('.') => '.',
                _ => break,
            };
            if token.place.start != end {
                break;
            }
            digits.push(digit);
            end = token.place.end;
            self.advance();
        }
        let place = start..end;
        if self.peek().is_some_and(|token| matches!(token.kind, Kind::Digit(_))) {
            return Err(Mistake::new(place.start..self.here().end, "two numbers next to each other")
                .with_help(r"write `\cdot` between them"));
        }
        match Rational::parse_decimal(&digits) {
            Ok(value) => Ok(Expr { node: Node::Number(value), place }),
            Err(error) => Err(Mistake::new(place, error.to_string())),
        }
    }

    pub(super) fn group(&mut self) -> Result<Value, Unreadable> {
        let start = self.here();
        let closer = match self.peek().map(|token| &token.kind) {
            Some(Kind::Mark('(')) => Kind::Mark(')'),
            Some(Kind::Mark('[')) => Kind::Mark(']'),
            Some(Kind::Mark('{')) => Kind::Mark('}'),
            Some(Kind::OpenBrace) => Kind::CloseBrace,
            _ => return Err(self.unexpected("a group")),
        };
        self.deeper()?;
        self.advance();
        let mut inside = self.formula()?;
        // `{a \over b}` divides all of its group.
        if closer == Kind::Mark('}') && self.is_at_command("over") {
            self.advance();
            inside = Value::quotient(inside, self.formula()?)?;
        }
        if self.is_at_mark(',') || self.is_at_mark(';') {
            let mut entries = vec![inside.scalar()?];
            while self.is_at_mark(',') || self.is_at_mark(';') {
                self.advance();
                if self.is_at(&closer) {
                    break;
                }
                entries.push(self.formula()?.scalar()?);
            }
            inside = Value::Matrix(Matrix::column(entries, start.clone()));
        }
        let end = self.here().end;
        self.expect_closer(&closer)?;
        self.depth -= 1;
        Ok(inside.at(start.start..end))
    }

    /// One group deeper.
    pub(super) fn deeper(&mut self) -> Result<(), Unreadable> {
        if self.depth == DEEPEST {
            let message = format!("more than {DEEPEST} groups within each other");
            return Err(Mistake::new(self.here(), message));
        }
        self.depth += 1;
        Ok(())
    }

    /// A group in braces, or a single digit or symbol: what TeX takes as an argument.
    pub(super) fn argument(&mut self) -> Result<Value, Unreadable> {
        match self.peek().map(|token| &token.kind) {
            Some(Kind::Mark('{')) => self.group(),
            // `√(2)` as it is typed.
            Some(Kind::Mark('(')) if self.text[..self.here().start].trim_end().ends_with('√') => {
                self.group()
            }
            Some(Kind::Digit(digit)) => {
                let place = self.here();
                self.advance();
                let value = Rational::from(i64::from(digit.to_digit(10).unwrap_or_default()));
                Ok(Value::Scalar(Expr { node: Node::Number(value), place }))
            }
            Some(kind) if glyph::starts(kind) => self.symbol(),
            _ => Err(self.unexpected("a group in braces")),
        }
    }

    pub(super) fn fraction(&mut self) -> Result<Value, Unreadable> {
        let start = self.here().start;
        self.advance();
        let above = self.argument()?;
        let below = self.argument()?;
        let place = start..below.place().end;
        Ok(Value::quotient(above, below)?.at(place))
    }

    pub(super) fn symbol(&mut self) -> Result<Value, Unreadable> {
        if let Some(abbreviation) = self.abbreviation_of_declared() {
            return abbreviation;
        }
        let found = match self.symbols.find(self.text, &self.tokens[self.at..]) {
            Ok(found) => found,
            Err(_) if self.is_at_command("pi") => {
                let place = self.here();
                self.advance();
                return self.powered(Expr { node: Node::Pi, place }).map(Value::Scalar);
            }
            Err(mistake) => {
                if let Some(vector) = self.unit_vector() {
                    return vector;
                }
                return self.named().unwrap_or_else(|| Err(self.likely_abbreviation(mistake)));
            }
        };
        let place = found.place.clone();
        let entries =
            |entries: &[Expr<()>]| entries.iter().map(|entry| entry.map_place(&|()| place.clone())).collect();
        let (meaning, after, tokens) = (found.meaning, found.after, found.tokens);
        self.at += tokens;
        let amount = match meaning {
            Meaning::Amount(amount) => amount.map_place(&|()| place.clone()),
            Meaning::Matrix { rows, entries: own, .. } => {
                let mut matrix = Matrix::new(*rows, entries(own), place.clone());
                if let Some(after) = after {
                    self.refuse_product_of_hat(after)?;
                    matrix = self.changed(matrix, after)?;
                }
                return self.powered_value(Value::Matrix(matrix));
            }
            Meaning::Twist(components) if after == Some(After::Skew) => {
                let components: Vec<Formula> = entries(components.as_slice());
                let screw = transforms::screw(&components, &place);
                return match screw {
                    Some(screw) => self.powered_value(Value::Matrix(screw)),
                    None => Err(Mistake::new(place, "a screw has six components")),
                };
            }
            Meaning::Twist(_) => {
                return Err(Mistake::new(place, "a screw stands in formulas as its matrix")
                    .with_help(r"write `\hat{\xi}`"));
            }
            Meaning::Ambiguous(_) => return Err(self.unexpected("a symbol of one meaning")),
        };
        let symbol = match after {
            Some(After::Power(power)) => raised(amount, power, place.end),
            _ => amount,
        };
        self.powered(symbol).map(Value::Scalar)
    }

    /// A hat over a vector is its matrix; before a dot or a cross it would be a unit vector, which nobody declared.
    fn refuse_product_of_hat(&self, after: After) -> Result<(), Unreadable> {
        let is_product = |token: Option<&Kind>| matches!(token, Some(Kind::Mark('*' | '×')));
        if after == After::Skew && is_product(self.peek().map(|token| &token.kind)) {
            return Err(Mistake::new(self.here(), "is the hat before this sign a matrix, or a unit vector?")
                .with_help(
                    r"write the matrix as `[\omega]_\times`, or name the unit vector under [symbols]",
                ));
        }
        Ok(())
    }

    /// A name as programs have it.
    fn declared(&mut self, name: &str) -> Result<Value, Unreadable> {
        let place = self.here();
        let amount = match self.symbols.entry_written(name).map(|entry| &entry.meaning) {
            _ if self.symbols.declares(name) => {
                Expr { node: Node::Symbol(name.to_owned()), place: place.clone() }
            }
            Some(Meaning::Amount(amount)) => amount.map_place(&|()| place.clone()),
            Some(Meaning::Matrix { rows, entries, .. }) => {
                let entries = entries.iter().map(|entry| entry.map_place(&|()| place.clone())).collect();
                self.advance();
                return self.powered_value(Value::Matrix(Matrix::new(*rows, entries, place)));
            }
            _ => {
                let mistake = Mistake::new(place, format!("unknown name `{name}`"));
                let near = names::nearest(name, self.symbols.names.keys().map(String::as_str));
                return Err(match near {
                    Some(near) => mistake.with_help(format!("did you mean `{near}`?")),
                    None => mistake.with_help(format!("name it under [symbols]: '{name}' = \"…\"")),
                });
            }
        };
        self.advance();
        self.powered(amount).map(Value::Scalar)
    }
}
