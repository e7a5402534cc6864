//! The lexer: LaTeX text → tokens with their byte ranges.
//!
//! What has no meaning in a formula is dropped here: spaces of any kind, comments, `\left` and `\right` and their
//! relatives, changes of typeface. Greek letters and signs that were typed as such become their commands. Digits stay
//! single, because TeX's indices and fractions take single ones: `\frac12`, `x_1`.

use std::ops::Range;

use super::Unreadable;
use crate::mistake::Mistake;

/// One token and where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Token {
    pub kind: Kind,
    pub place: Range<usize>,
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
    /// One of `+ - * / ^ _ { } ( ) [ ] , ; . & = '`, and what else is typed as one character.
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
}

/// Control words that only move ink, or that size the bracket behind them.
const WITHOUT_MEANING: [&str; 27] = [
    "left",
    "right",
    "big",
    "Big",
    "bigg",
    "Bigg",
    "bigl",
    "bigr",
    "Bigl",
    "Bigr",
    "biggl",
    "biggr",
    "Biggl",
    "Biggr",
    "quad",
    "qquad",
    "thinspace",
    "enspace",
    "displaystyle",
    "textstyle",
    "nonumber",
    "limits",
    "rm",
    "it",
    "bf",
    "hfill",
    "allowbreak",
];

/// Control words that set what follows in another typeface.
const TYPEFACES: [&str; 10] = [
    "mathrm",
    "mathit",
    "mathbf",
    "mathsf",
    "mathnormal",
    "boldsymbol",
    "bm",
    "text",
    "textrm",
    "operatorname",
];

/// The functions of the language of amounts, as control words.
pub(super) const FUNCTIONS: [&str; 6] = ["sin", "cos", "tan", "cot", "sec", "csc"];

/// The function of three arguments, `\operatorname{ramp}(x, from, to)`.
pub(super) const RAMP: &str = "ramp";

/// Characters that may be typed in place of a control word.
pub(super) const TYPED: [(char, &str); 34] = [
    ('α', "alpha"),
    ('β', "beta"),
    ('γ', "gamma"),
    ('δ', "delta"),
    ('ε', "varepsilon"),
    ('ϵ', "epsilon"),
    ('ζ', "zeta"),
    ('η', "eta"),
    ('θ', "theta"),
    ('ϑ', "vartheta"),
    ('ι', "iota"),
    ('κ', "kappa"),
    ('λ', "lambda"),
    ('μ', "mu"),
    ('ν', "nu"),
    ('ξ', "xi"),
    ('π', "pi"),
    ('ρ', "rho"),
    ('σ', "sigma"),
    ('τ', "tau"),
    ('υ', "upsilon"),
    ('φ', "varphi"),
    ('ϕ', "phi"),
    ('χ', "chi"),
    ('ψ', "psi"),
    ('ω', "omega"),
    ('Γ', "Gamma"),
    ('Δ', "Delta"),
    ('Θ', "Theta"),
    ('Λ', "Lambda"),
    ('Φ', "Phi"),
    ('Ψ', "Psi"),
    ('Ω', "Omega"),
    ('°', "degree"),
];

/// Splits a text into tokens.
pub(super) fn tokens(text: &str) -> Result<Vec<Token>, Unreadable> {
    let mut lexer = Lexer { text, at: 0, tokens: Vec::new() };
    while let Some(next) = lexer.peek() {
        lexer.token(next)?;
    }
    Ok(lexer.tokens)
}

struct Lexer<'a> {
    text: &'a str,
    at: usize,
    tokens: Vec<Token>,
}

impl Lexer<'_> {
    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    fn push(&mut self, kind: Kind, start: usize) {
        self.tokens.push(Token { kind, place: start..self.at });
    }

    fn token(&mut self, next: char) -> Result<(), Unreadable> {
        let start = self.at;
        self.at += next.len_utf8();
        match next {
            '\\' => return self.command(start),
            '%' => self.skip_while(|c| c != '\n'),
            '~' => {}
            c if c.is_whitespace() => {}
            '−' | '–' => self.push(Kind::Mark('-'), start),
            '·' | '⋅' | '×' => self.push(Kind::Mark('*'), start),
            '′' => self.push(Kind::Mark('\''), start),
            c if c.is_ascii_digit() => self.push(Kind::Digit(c), start),
            c => {
                let kind = match TYPED.iter().find(|(typed, _)| *typed == c) {
                    Some((_, command)) => Kind::Command((*command).to_owned()),
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

    /// What follows a backslash.
    fn command(&mut self, start: usize) -> Result<(), Unreadable> {
        let name_start = self.at;
        self.skip_while(|c| c.is_ascii_alphabetic());
        let name = self.text[name_start..self.at].to_owned();
        if name.is_empty() {
            return self.control_symbol(start);
        }
        match name.as_str() {
            name if WITHOUT_MEANING.contains(&name) => {}
            name if TYPEFACES.contains(&name) => self.typeface(start),
            "begin" | "end" => self.environment(start, name == "begin")?,
            "cdot" | "times" | "ast" => self.push(Kind::Mark('*'), start),
            "div" => self.push(Kind::Mark('/'), start),
            "lbrack" => self.push(Kind::Mark('['), start),
            "rbrack" => self.push(Kind::Mark(']'), start),
            "prime" => self.push(Kind::Mark('\''), start),
            "circ" => self.push(Kind::Command("degree".to_owned()), start),
            _ => self.push(Kind::Command(name), start),
        }
        Ok(())
    }

    /// A backslash and one character that is no letter.
    fn control_symbol(&mut self, start: usize) -> Result<(), Unreadable> {
        let Some(symbol) = self.peek() else {
            return Err(Mistake::new(start..self.at, "a backslash with nothing behind it"));
        };
        self.at += symbol.len_utf8();
        match symbol {
            '\\' => self.push(Kind::Row, start),
            '{' => self.push(Kind::OpenBrace, start),
            '}' => self.push(Kind::CloseBrace, start),
            ',' | ';' | ':' | '!' | '>' => {}
            c if c.is_whitespace() => {}
            c => {
                let message = format!("`\\{c}` has no meaning in a formula");
                return Err(Mistake::new(start..self.at, message));
            }
        }
        Ok(())
    }

    /// A typeface is dropped; a word that it sets is one symbol, or the function of that name.
    fn typeface(&mut self, start: usize) {
        let after_command = self.at;
        self.skip_while(char::is_whitespace);
        if self.peek() == Some('{') {
            let word_start = self.at + 1;
            self.at = word_start;
            self.skip_while(|c| c.is_alphanumeric() || c == ' ');
            let word = self.text[word_start..self.at].trim();
            if self.peek() == Some('}') && word.chars().all(char::is_alphabetic) && !word.is_empty() {
                let kind = if FUNCTIONS.contains(&word) || word == RAMP {
                    Kind::Command(word.to_owned())
                } else {
                    Kind::Word(word.to_owned())
                };
                self.at += 1;
                self.push(kind, start);
                return;
            }
        }
        self.at = after_command;
    }

    /// `\begin{bmatrix}`, `\begin{array}{c}`, `\end{…}`.
    fn environment(&mut self, start: usize, begins: bool) -> Result<(), Unreadable> {
        let name = self.braced().ok_or_else(|| {
            let command = if begins { "begin" } else { "end" };
            Mistake::new(start..self.at, format!("`\\{command}` without a name in braces"))
                .with_help(format!("`\\{command}{{bmatrix}}`"))
        })?;
        if begins && name == "array" && self.braced().is_none() {
            return Err(Mistake::new(start..self.at, "`array` without its columns").with_help("`{c}`"));
        }
        self.push(if begins { Kind::Begin(name) } else { Kind::End(name) }, start);
        Ok(())
    }

    fn braced(&mut self) -> Option<String> {
        self.skip_while(char::is_whitespace);
        let inside = self.text[self.at..].strip_prefix('{')?;
        let length = inside.find('}')?;
        self.at += length + 2;
        Some(inside[..length].trim().to_owned())
    }
}
