//! The lexer: LaTeX text → tokens with their byte ranges.
//!
//! What has no meaning in a formula is dropped here: spaces of any kind, comments, labels and tags, `\left` and `\right`
//! and their relatives, changes of typeface. What was typed or pasted as one character becomes what LaTeX has for it
//! (`typed`). Digits stay single, because TeX's indices and fractions take single ones: `\frac12`, `x_1`.

mod control;
mod words;

use std::ops::Range;

use super::commands::{FUNCTIONS, is_inverse};
use super::{Unreadable, typed};
use model_core::mistake::Mistake;

pub(crate) use control::closing;

/// One token and where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Token {
    pub kind: Kind,
    pub place: Range<usize>,
    /// Set in bold type.
    pub bold: bool,
}

/// What a token is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Kind {
    /// A control word without its backslash: `theta`, `frac`, `sin`.
    Command(String),
    /// A letter, or a word set in upright type: `x`, `\mathrm{range}`.
    Word(String),
    /// One decimal digit.
    Digit(char),
    /// One of `+ - * × / ^ _ { } ( ) [ ] , ; . & = '`, and what else is typed as one character.
    Mark(char),
    /// `\{` and `\}`, brackets that show.
    OpenBrace,
    /// See [`Kind::OpenBrace`].
    CloseBrace,
    /// `\\`, the end of a row.
    Row,
    /// `\begin{…}`
    Begin(String),
    /// `\end{…}`
    End(String),
    /// A wide space, `\quad`.
    Wide,
    /// `$`, `\[` and the like: where mathematics begins or ends.
    Math,
    /// In front of indices that stand on the left of their letter: `{}^0 p`.
    Left,
    /// A name of a declaration, as programs have it.
    Name(String),
}

/// Splits a text into tokens as they stand.
pub(super) fn tokens(text: &str) -> Result<Vec<Token>, Unreadable> {
    let mut lexer = Lexer { text, at: 0, tokens: Vec::new(), bold: 0..0, closers: Vec::new() };
    while let Some(next) = lexer.peek() {
        lexer.token(next)?;
    }
    Ok(lexer.tokens)
}

struct Lexer<'a> {
    text: &'a str,
    at: usize,
    tokens: Vec<Token>,
    /// What is set in bold type.
    bold: Range<usize>,
    /// Where braces close that only a typeface opened.
    closers: Vec<usize>,
}

impl Lexer<'_> {
    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    fn push(&mut self, kind: Kind, start: usize) {
        self.tokens.push(Token { kind, place: start..self.at, bold: self.bold.contains(&start) });
    }

    fn token(&mut self, next: char) -> Result<(), Unreadable> {
        let start = self.at;
        if next.is_ascii_alphabetic() {
            self.letters(start);
            return Ok(());
        }
        self.at += next.len_utf8();
        if typed::raised(next).is_some() {
            self.script('^', typed::raised, start);
            return Ok(());
        }
        if typed::lowered(next).is_some() {
            self.script('_', typed::lowered, start);
            return Ok(());
        }
        if let Some((above, below)) = typed::fraction(next) {
            if matches!(self.tokens.last(), Some(Token { kind: Kind::Digit(_), place, .. }) if place.end == start)
            {
                let message = "a whole number and a fraction next to each other";
                return Err(
                    Mistake::new(start..self.at, message).with_help("write `+` or `\\cdot` between them")
                );
            }
            for kind in
                [Kind::Mark('{'), Kind::Digit(above), Kind::Mark('/'), Kind::Digit(below), Kind::Mark('}')]
            {
                self.push(kind, start);
            }
            return Ok(());
        }
        match typed::normal(next) {
            '\\' => return self.command(start),
            '%' => self.skip_while(|c| c != '\n'),
            '~' => {}
            '$' => {
                self.skip_while(|c| c == '$');
                self.push(Kind::Math, start);
            }
            '`' if self.text[start..].starts_with("```") => self.fence(start),
            '}' if self.closers.last() == Some(&start) => {
                self.closers.pop();
            }
            ':' if self.peek() == Some('=') => {}
            c if typed::is_invisible(c) => {}
            c if c.is_ascii_digit() => self.push(Kind::Digit(c), start),
            '{' if self.switched(start) => {}
            c => {
                let kind = match typed::command(c) {
                    Some(command) => Kind::Command(command.to_owned()),
                    None if c.is_alphabetic() => Kind::Word(c.to_string()),
                    None => Kind::Mark(c),
                };
                self.push(kind, start);
            }
        }
        Ok(())
    }

    fn skip_while(&mut self, keep: impl Fn(char) -> bool) {
        while self.peek().is_some_and(&keep) {
            self.at += self.peek().map_or(0, char::len_utf8);
        }
    }

    /// Letters are symbols of their own; a run of letters that is the name of a function is the function.
    fn letters(&mut self, start: usize) {
        self.skip_while(|c| c.is_ascii_alphabetic());
        let run = &self.text[start..self.at];
        if FUNCTIONS.contains(&run) || is_inverse(run) {
            let function = Kind::Command(run.to_owned());
            return self.push(function, start);
        }
        for (offset, letter) in run.char_indices() {
            let place = start + offset..start + offset + 1;
            let bold = self.bold.contains(&place.start);
            self.tokens.push(Token { kind: Kind::Word(letter.to_string()), place, bold });
        }
    }

    /// Raised or lowered characters, as an index in braces.
    fn script(&mut self, mark: char, meaning: fn(char) -> Option<&'static str>, start: usize) {
        self.skip_while(|c| meaning(c).is_some());
        let place = start..self.at;
        let mut push = |kind| self.tokens.push(Token { kind, place: place.clone(), bold: false });
        push(Kind::Mark(mark));
        push(Kind::Mark('{'));
        for c in self.text[place.clone()].chars().filter_map(meaning).flat_map(str::chars) {
            push(match typed::command(c) {
                Some(command) => Kind::Command(command.to_owned()),
                None if c.is_ascii_digit() => Kind::Digit(c),
                None if c == '-' => Kind::Mark(c),
                None => Kind::Word(c.to_string()),
            });
        }
        push(Kind::Mark('}'));
    }

    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn braced(&mut self) -> Option<String> {
        self.skip_while(char::is_whitespace);
        let inside = self.text[self.at..].strip_prefix('{')?;
        let length = inside.find('}')?;
        self.at += length + 2;
        Some(inside[..length].trim().to_owned())
    }
}
