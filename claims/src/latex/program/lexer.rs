//! The lexer of lines of programs.

mod words;

use std::ops::Range;

use super::super::Unreadable;
use super::super::token::{Kind, Token};
use model_core::mistake::Mistake;

/// What only lines of programs have.
const CUES: [&str; 25] = [
    "np.", "numpy.", "math.", "Math.", "std::", "**", ".*", "./", ".^", "@", "pow(", "M_PI", "sinf(",
    "cosf(", "tanf(", "double ", "float ", "//", "#", "cross(", "dot(", "inv(", "eye(", "[", "...",
];
/// What only Python has.
const PYTHON: [&str; 5] = ["np.", "numpy.", "math.", "**", "@"];
/// What only C and its relatives have.
const C: [&str; 8] = ["std::", "pow(", "M_PI", "sinf(", "cosf(", "double ", "float ", "Math."];

/// Whether a text can only be lines of a program, several that each give a name included.
#[must_use]
pub fn is_line_of_program(text: &str) -> bool {
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let names = |line: &str| line.matches('=').count() == 1 && !line.trim_start().starts_with('=');
    CUES.iter().any(|cue| text.contains(cue))
        || text.trim_end().ends_with(';')
        || (lines.clone().count() > 1 && lines.all(names))
}

/// The tokens of lines; `is_declared` tells names that are not the language's.
pub(super) fn tokens(text: &str, is_declared: impl Fn(&str) -> bool) -> Result<Vec<Token>, Unreadable> {
    let has = |cues: &[&str]| cues.iter().any(|cue| text.contains(cue));
    let mut lexer = Lexer {
        text,
        at: 0,
        open: Vec::new(),
        lists: Vec::new(),
        tokens: Vec::new(),
        is_python: has(&PYTHON),
        is_c: has(&C) || (text.contains(';') && !has(&PYTHON) && !has(&["[", ".*", "./", ".^", "%"])),
        says_c: has(&C),
    };
    while let Some(next) = lexer.peek() {
        lexer.token(next, &is_declared)?;
    }
    Ok(lexer.tokens)
}

struct Lexer<'a> {
    text: &'a str,
    at: usize,
    /// The brackets that are open.
    open: Vec<char>,
    /// Where those of lists are.
    lists: Vec<usize>,
    tokens: Vec<Token>,
    is_python: bool,
    /// Whether whole numbers may be divided as C divides them.
    is_c: bool,
    /// Whether the line is C without doubt.
    says_c: bool,
}

impl Lexer<'_> {
    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn push(&mut self, kind: Kind, start: usize) {
        self.tokens.push(Token { kind, place: start..self.at, bold: false });
    }

    fn skip_while(&mut self, keep: impl Fn(char) -> bool) {
        while self.peek().is_some_and(&keep) {
            self.at += self.peek().map_or(0, char::len_utf8);
        }
    }

    fn token(&mut self, next: char, is_declared: &impl Fn(&str) -> bool) -> Result<(), Unreadable> {
        let start = self.at;
        if next.is_ascii_alphabetic() || next == '_' {
            return self.word(start, is_declared);
        }
        if next.is_ascii_digit()
            || (next == '.' && self.rest()[1..].starts_with(|c: char| c.is_ascii_digit()))
        {
            self.refuse_neighbour(start)?;
            return self.number(start);
        }
        for sign in ["...", "**", ".*", "./", ".^", ".'", "//"] {
            if self.rest().starts_with(sign) {
                self.at += sign.len();
                return self.sign(sign, start);
            }
        }
        if next == '.' && self.ends_operand() && self.method(start) {
            return Ok(());
        }
        self.at += next.len_utf8();
        match next {
            '\n' if self.open.is_empty() => self.push(Kind::Row, start),
            ';' => {
                let kind = if self.open.is_empty() { Kind::Row } else { Kind::Mark(';') };
                self.push(kind, start);
            }
            '#' | '%' => self.skip_while(|c| c != '\n'),
            c if c.is_whitespace() => return self.blank(c == '\n', start),
            '\\' => {}
            '^' if self.is_python || self.says_c => {
                return Err(Mistake::new(start..self.at, "in this language `^` is no power")
                    .with_help("write `**2` in Python, a product in C"));
            }
            '^' => return self.power(start),
            '*' => self.push(Kind::Mark(if self.is_python { '⊙' } else { '*' }), start),
            '@' => self.push(Kind::Mark('*'), start),
            '/' => {
                self.refuse_whole_division(start)?;
                self.push(Kind::Mark('/'), start);
            }
            '(' | '[' => {
                if next == '(' {
                    self.refuse_neighbour(start)?;
                }
                self.open.push(next);
                self.lists.extend((next == '[').then_some(start));
                self.push(Kind::Mark(next), start);
            }
            ')' | ']' => {
                if self.open.pop() == Some('[') {
                    self.lists.pop();
                }
                self.push(Kind::Mark(next), start);
            }
            ',' if self.open.is_empty() && self.says_c && self.gives_name() => self.push(Kind::Row, start),
            '+' | '-' | '=' | ',' => {
                if next != ',' && self.peek() == Some('=') {
                    return Err(Mistake::new(start..self.at + 1, "only `=` gives a name to a formula"));
                }
                self.push(Kind::Mark(next), start);
            }
            '\'' if self.ends_operand() => self.push(Kind::Mark('\''), start),
            _ => {
                let message = format!("`{next}` has no meaning in a line of a program here");
                return Err(Mistake::new(start..self.at, message));
            }
        }
        Ok(())
    }

    /// Blanks between the entries of a list part them in MATLAB: `[cos(h) -sin(h) 0]`; so do ends of lines its rows.
    fn blank(&mut self, mut is_row: bool, start: usize) -> Result<(), Unreadable> {
        is_row |= self.rest().chars().take_while(|c| c.is_whitespace()).any(|c| c == '\n');
        self.skip_while(char::is_whitespace);
        if self.open.last() != Some(&'[') || self.is_python || self.says_c || !self.ends_operand() {
            return Ok(());
        }
        let mut rest = self.rest().chars();
        let (next, behind) = (rest.next(), rest.next());
        let is_sign = matches!(next, Some('+' | '-')) && behind.is_some_and(|c| !c.is_whitespace());
        let begins = next.is_some_and(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '(' | '['))
            || (next == Some('.') && behind.is_some_and(|c| c.is_ascii_digit()));
        if is_sign && self.has_commas() {
            return Err(Mistake::new(self.at..self.at + 1, "does a new entry begin with this sign?")
                .with_help("write a comma before it, or blanks on both sides of it"));
        }
        if begins || is_sign {
            self.push(Kind::Mark(if is_row { ';' } else { ',' }), start);
        }
        Ok(())
    }

    /// Whether commas part the entries of the innermost open list.
    fn has_commas(&self) -> bool {
        let Some(&open) = self.lists.last() else { return false };
        let mut depth = 0;
        for c in self.text[open..].chars() {
            match c {
                '(' | '[' => depth += 1,
                ')' | ']' if depth == 1 => return false,
                ')' | ']' => depth -= 1,
                ',' if depth == 1 => return true,
                _ => {}
            }
        }
        false
    }

    fn sign(&mut self, sign: &str, start: usize) -> Result<(), Unreadable> {
        match sign {
            "..." => self.skip_while(|c| c.is_whitespace()),
            "**" | ".^" => return self.power(start),
            ".*" => self.push(Kind::Mark('⊙'), start),
            ".'" => self.push(Kind::Mark('\''), start),
            "./" => self.push(Kind::Mark('/'), start),
            _ => self.skip_while(|c| c != '\n'),
        }
        Ok(())
    }

    /// A whole power behind its sign.
    fn power(&mut self, start: usize) -> Result<(), Unreadable> {
        self.skip_while(|c| c == ' ');
        if self.peek() == Some('T') && self.ends_operand() {
            self.at += 1;
            self.push(Kind::Mark('\''), start);
            return Ok(());
        }
        let bracketed = self.peek() == Some('(');
        self.at += usize::from(bracketed);
        let from = self.at;
        self.skip_while(|c| c == '-' || c == '.' || c.is_ascii_digit());
        let written = self.text[from..self.at].to_owned();
        let value = written.parse::<f64>().ok().filter(|value| value.fract() == 0.0 && value.abs() < 100.0);
        let closed = !bracketed || self.peek() == Some(')');
        let Some(value) = value.filter(|_| closed) else {
            return Err(Mistake::new(start..self.at.max(start + 1), "a power has to be a whole number"));
        };
        self.at += usize::from(bracketed);
        let digits = format!("{{{value}}}");
        self.push(Kind::Mark('^'), start);
        for digit in digits.chars() {
            self.push(if digit.is_ascii_digit() { Kind::Digit(digit) } else { Kind::Mark(digit) }, from);
        }
        Ok(())
    }

    fn number(&mut self, start: usize) -> Result<(), Unreadable> {
        self.skip_while(|c| c.is_ascii_digit());
        let is_point = self.peek() == Some('.')
            && !["*", "/", "^", "'"].iter().any(|sign| self.rest()[1..].starts_with(sign));
        if is_point {
            self.at += 1;
            self.skip_while(|c| c.is_ascii_digit());
        }
        let digits = start..self.at;
        let mut exponent = String::new();
        if self.peek().is_some_and(|c| matches!(c, 'e' | 'E')) {
            let rest = &self.rest()[1..];
            let signed = rest.trim_start_matches(['+', '-']);
            let length = signed.find(|c: char| !c.is_ascii_digit()).unwrap_or(signed.len());
            if length > 0 && rest.len() - signed.len() <= 1 {
                let sign = if rest.starts_with('-') { "-" } else { "" };
                exponent = format!("{sign}{}", &signed[..length]);
                self.at += 1 + rest.len() - signed.len() + length;
            }
        }
        if self.peek().is_some_and(|c| matches!(c, 'f' | 'F' | 'L' | 'l')) && !self.is_python {
            self.at += 1;
        }
        if self.peek().is_some_and(|c| c.is_ascii_alphanumeric() || c == '_') {
            return Err(Mistake::new(start..self.at + 1, "a number with letters behind it"));
        }
        let mark = |kind, place: Range<usize>| Token { kind, place, bold: false };
        let whole = start..self.at;
        let scaled = !exponent.is_empty();
        if scaled {
            self.tokens.push(mark(Kind::Mark('('), whole.clone()));
        }
        let text: Vec<(usize, char)> = self.text[digits.clone()].char_indices().collect();
        for (offset, c) in text {
            let place = start + offset..start + offset + 1;
            self.tokens.push(mark(if c == '.' { Kind::Mark('.') } else { Kind::Digit(c) }, place));
        }
        if scaled {
            for c in format!("*10^{{{exponent}}})").chars() {
                let kind = if c.is_ascii_digit() { Kind::Digit(c) } else { Kind::Mark(c) };
                let from = if c == '0' { whole.end } else { whole.start };
                self.tokens.push(mark(kind, from..whole.end));
            }
        }
        Ok(())
    }

    fn ends_operand(&self) -> bool {
        self.tokens.last().is_some_and(|token| {
            matches!(token.kind, Kind::Name(_) | Kind::Digit(_) | Kind::Mark(')' | ']' | '}' | '\''))
                || matches!(&token.kind, Kind::Command(name) if name == "pi")
        })
    }

    /// Two operands without a sign between them: a product in print, nothing in a program.
    fn refuse_neighbour(&self, start: usize) -> Result<(), Unreadable> {
        if self.ends_operand() {
            let place = self.tokens.last().map_or(start, |token| token.place.start)..self.at.max(start + 1);
            return Err(Mistake::new(place, "nothing stands between these two")
                .with_help("write `*` for a product, `,` between the entries of a list"));
        }
        Ok(())
    }

    /// `1/2`, which is 0 in C.
    fn refuse_whole_division(&self, start: usize) -> Result<(), Unreadable> {
        if !self.is_c {
            return Ok(());
        }
        let whole_before = {
            let digits =
                self.tokens.iter().rev().take_while(|token| matches!(token.kind, Kind::Digit(_))).count();
            let before = self.tokens.len().checked_sub(digits + 1).and_then(|at| self.tokens.get(at));
            digits > 0
                && !before
                    .is_some_and(|token| matches!(token.kind, Kind::Mark('.' | '*' | '⊙' | '/' | '^' | '}')))
        };
        let rest = self.rest().trim_start();
        let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        let whole_behind = digits > 0 && !rest[digits..].starts_with(['.', 'e', 'E', 'f']);
        if whole_before && whole_behind {
            return Err(Mistake::new(
                start..self.at,
                "in C the quotient of two whole numbers is cut to a whole number",
            )
            .with_help("write `1.0/2`, or `0.5`"));
        }
        Ok(())
    }
}
