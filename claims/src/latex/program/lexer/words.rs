//! Words in lines of programs: names, functions of libraries, methods, types, and components by number.

use super::Lexer;
use crate::latex::Unreadable;
use crate::latex::token::Kind;
use model_core::mistake::Mistake;

/// Libraries whose functions are known by their own names.
const LIBRARIES: [&str; 7] = ["np.", "numpy.", "math.", "Math.", "std::", "linalg.", "cmath."];
/// Words that say of what type a value is.
const TYPES: [&str; 9] = ["double", "float", "const", "auto", "let", "var", "return", "static", "final"];

impl Lexer<'_> {
    pub(super) fn word(
        &mut self,
        start: usize,
        is_declared: &impl Fn(&str) -> bool,
    ) -> Result<(), Unreadable> {
        while let Some(library) = LIBRARIES.iter().find(|library| self.rest().starts_with(**library)) {
            self.at += library.len();
        }
        let from = self.at;
        self.skip_while(|c| c.is_ascii_alphanumeric() || c == '_');
        let word = self.text[from..self.at].to_owned();
        let begins_line = self.tokens.last().is_none_or(|token| token.kind == Kind::Row);
        if begins_line && matches!(word.as_str(), "import" | "from" | "using") && self.peek() == Some(' ') {
            self.skip_while(|c| c != '\n');
            return Ok(());
        }
        if word.is_empty() {
            return Err(Mistake::new(start..self.at, "a function is missing behind its library"));
        }
        if begins_line && let Some(length) = index_length(self.rest()) {
            self.at += length;
            let name = self.text[from..self.at].chars().filter(|c| !c.is_whitespace()).collect();
            self.push(Kind::Name(name), start);
            return Ok(());
        }
        let is_called = self.rest().trim_start().starts_with('(');
        if TYPES.contains(&word.as_str()) && !is_called && !is_declared(&word) {
            return Ok(());
        }
        self.refuse_neighbour(start)?;
        let bare = word.strip_suffix('f').filter(|_| is_called).unwrap_or(&word);
        match bare {
            "sin" | "cos" | "tan" | "cot" | "sec" | "csc" | "sqrt" if is_called => {
                self.push(Kind::Command(bare.to_owned()), start);
            }
            "pi" | "PI" | "M_PI" if !is_declared(&word) => self.push(Kind::Command("pi".to_owned()), start),
            _ if is_called && !is_declared(&word) => self.push(Kind::Command(format!("call {word}")), start),
            _ => self.push(Kind::Name(word), start),
        }
        Ok(())
    }

    /// Whether a name and its `=` follow: `double c = cos(h), s = sin(h);`.
    pub(super) fn gives_name(&self) -> bool {
        let rest = self.rest().trim_start();
        let behind = rest.trim_start_matches(|c: char| c.is_ascii_alphanumeric() || c == '_');
        behind.len() < rest.len() && behind.trim_start().starts_with('=')
    }

    /// What Python writes behind an operand: `.T`, `.dot(b)`, `.flatten()`. The length is skipped where it is one.
    pub(super) fn method(&mut self, start: usize) -> bool {
        for shape in [".flatten()", ".ravel()", ".squeeze()"] {
            if self.rest().starts_with(shape) {
                self.at += shape.len();
                return true;
            }
        }
        for (written, mark) in [(".transpose()", '\''), (".T", '\''), (".dot", '*')] {
            let Some(behind) = self.rest().strip_prefix(written) else { continue };
            let is_whole = if mark == '*' {
                behind.starts_with('(')
            } else {
                !behind.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_')
            };
            if is_whole {
                self.at += written.len();
                self.push(Kind::Mark(mark), start);
                return true;
            }
        }
        false
    }
}

/// The length of `[0]` or `(1)` where a line gives this component of a vector its value.
fn index_length(rest: &str) -> Option<usize> {
    let close = match rest.chars().next()? {
        '[' => ']',
        '(' => ')',
        _ => return None,
    };
    let (digits, behind) = rest[1..].split_once(close)?;
    let is_number = !digits.is_empty() && digits.chars().all(|c| c.is_ascii_digit());
    let value = behind.trim_start().strip_prefix('=')?;
    (is_number && !value.starts_with('=')).then_some(digits.len() + 2)
}
