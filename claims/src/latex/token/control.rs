//! Control words and control symbols: what follows a backslash, and what it takes along.

use super::super::Unreadable;
use super::super::commands::{
    BOLD, DISTANCES, NOTES, RELATIONS, SIZES, TYPEFACES, WIDE, WITHOUT_MEANING, other_word,
};
use super::{Kind, Lexer};
use model_core::mistake::Mistake;

/// Units in which TeX measures a distance.
const UNITS: [&str; 11] = ["pt", "mm", "cm", "in", "ex", "em", "bp", "pc", "dd", "cc", "sp"];

impl Lexer<'_> {
    /// What follows a backslash.
    pub(super) fn command(&mut self, start: usize) -> Result<(), Unreadable> {
        let name_start = self.at;
        self.skip_while(|c| c.is_ascii_alphabetic());
        let name = self.text[name_start..self.at].to_owned();
        if name.is_empty() {
            return self.control_symbol(start);
        }
        match name.as_str() {
            name if WITHOUT_MEANING.contains(&name) => {
                if SIZES.contains(&name) {
                    self.skip_while(char::is_whitespace);
                    // `\left.` is no bracket.
                    self.at += usize::from(self.peek() == Some('.'));
                }
            }
            name if WIDE.contains(&name) => self.push(Kind::Wide, start),
            name if NOTES.contains(&name) => {
                self.note(start, name)?;
            }
            name if DISTANCES.contains(&name) => {
                self.note(start, name)?;
                self.push(Kind::Wide, start);
            }
            "boxed" => self.framed(),
            "stackrel" | "overset" | "underset" if self.remark_on_relation() => {
                self.push(Kind::Mark('='), start);
            }
            "phantom" | "hphantom" | "vphantom" | "color" => self.note(start, &name)?,
            name if TYPEFACES.contains(&name) => self.typeface(start, BOLD.contains(&name)),
            name if RELATIONS.contains(&name) => self.push(Kind::Mark('='), start),
            "begin" | "end" => self.environment(start, name == "begin")?,
            "cdot" | "ast" | "bullet" => self.push(Kind::Mark('*'), start),
            "times" => self.push(Kind::Mark('×'), start),
            "div" => self.push(Kind::Mark('/'), start),
            "lbrack" => self.push(Kind::Mark('['), start),
            "rbrack" => self.push(Kind::Mark(']'), start),
            "lbrace" => self.push(Kind::OpenBrace, start),
            "rbrace" => self.push(Kind::CloseBrace, start),
            "prime" => self.push(Kind::Mark('\''), start),
            "circ" | "textdegree" => self.push(Kind::Command("degree".to_owned()), start),
            "cr" | "newline" => self.push(Kind::Row, start),
            _ => self.push(Kind::Command(other_word(&name).map_or(name, str::to_owned)), start),
        }
        Ok(())
    }

    /// `\boxed{a = b}`: the braces of a group that only a frame is drawn around.
    fn framed(&mut self) {
        self.skip_while(char::is_whitespace);
        if let Some(close) = closing(self.text, self.at)
            && !has_over(&self.text[self.at..close])
        {
            self.closers.push(close);
            self.at += 1;
        }
    }

    /// `\stackrel{\mathrm{def}}{=}`: a relation with a remark over it; passed over if it is one.
    fn remark_on_relation(&mut self) -> bool {
        let start = self.at;
        for part in [false, true] {
            self.skip_while(char::is_whitespace);
            let Some(close) = closing(self.text, self.at) else { break };
            let inside = self.text[self.at + 1..close].trim();
            let is_relation = inside == "="
                || inside.strip_prefix('\\').is_some_and(|command| RELATIONS.contains(&command));
            self.at = close + 1;
            if part && is_relation {
                return true;
            }
        }
        self.at = start;
        false
    }

    /// The argument of a command that is dropped with it.
    fn note(&mut self, start: usize, command: &str) -> Result<(), Unreadable> {
        let end = self.at;
        self.at += usize::from(self.peek() == Some('*'));
        self.braced().map(|_| ()).ok_or_else(|| {
            Mistake::new(start..end, format!("`\\{command}` without braces"))
                .with_help(format!("`\\{command}{{…}}`"))
        })
    }

    /// A backslash and one character that is no letter.
    fn control_symbol(&mut self, start: usize) -> Result<(), Unreadable> {
        let Some(symbol) = self.peek() else {
            return Err(Mistake::new(start..self.at, "a backslash with nothing behind it"));
        };
        self.at += symbol.len_utf8();
        match symbol {
            '\\' => return self.row(start),
            '{' => self.push(Kind::OpenBrace, start),
            '}' => self.push(Kind::CloseBrace, start),
            '|' => self.push(Kind::Mark('‖'), start),
            '[' | ']' | '(' | ')' => self.push(Kind::Math, start),
            ',' | ';' | ':' | '!' | '>' | '/' => {}
            c if c.is_whitespace() => {}
            c => {
                let message = format!("`\\{c}` has no meaning in a formula");
                return Err(Mistake::new(start..self.at, message));
            }
        }
        Ok(())
    }

    /// `\\`, `\\*`, `\\[2pt]`.
    fn row(&mut self, start: usize) -> Result<(), Unreadable> {
        self.at += usize::from(self.peek() == Some('*'));
        let end = self.at;
        self.skip_while(char::is_whitespace);
        if self.peek() == Some('[') {
            let open = self.at;
            let inside = self.text[open + 1..].split(']').next().unwrap_or_default();
            if !is_distance(inside) {
                let place = start..(open + inside.len() + 2).min(self.text.len());
                let message = format!("TeX takes `[{inside}]` behind `\\\\` for a distance, and it is none");
                return Err(Mistake::new(place, message)
                    .with_help(r"write `\\[2pt]`, or `\\{}` if the bracket begins the next row"));
            }
            self.at = open + inside.len() + 2;
            self.push(Kind::Row, start);
            return Ok(());
        }
        self.at = end;
        self.push(Kind::Row, start);
        self.skip_while(char::is_whitespace);
        if self.text[self.at..].starts_with("{}") {
            self.at += 2;
        }
        Ok(())
    }

    /// A typeface is dropped; a word that it sets is one symbol, or the function of that name.
    fn typeface(&mut self, start: usize, bold: bool) {
        let after_command = self.at;
        self.skip_while(char::is_whitespace);
        let inside = self.at + 1;
        if self.peek() != Some('{') {
            // Of a letter without braces, `\mathbf r`.
            if bold {
                self.bold = start..self.at + 1;
            }
            self.at = after_command;
            return;
        }
        let close = closing(self.text, self.at);
        if bold {
            self.bold = start..close.unwrap_or(inside);
        }
        self.at = inside;
        if self.word(start) {
            return;
        }
        // Braces around letters with their indices take no ink.
        let only_letters = |text: &str| {
            text.trim_start().starts_with(|c: char| c == '\\' || c.is_alphabetic())
                && !text.contains(['+', '-', '=', '*', '/', '&', '(', ')', '[', ']', ',', '$', '%'])
                && !has_over(text)
        };
        match close.filter(|&close| only_letters(&self.text[inside..close])) {
            Some(close) => self.closers.push(close),
            None => self.at = after_command,
        }
    }

    /// Three backquotes, and what kind of text they open.
    pub(super) fn fence(&mut self, start: usize) {
        self.skip_while(|c| c == '`');
        for word in ["math", "latex", "tex"] {
            if self.text[self.at..].starts_with(word) {
                self.at += word.len();
                break;
            }
        }
        self.push(Kind::Math, start);
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
        // How columns are laid out: `{rCl}`, `{2}`, and `[r]` of a matrix with a star.
        let bare = name.trim_end_matches('*');
        if begins && matches!(bare, "IEEEeqnarray" | "alignat" | "alignedat") {
            self.braced();
        }
        let is_starred = bare.ends_with("matrix") && bare != name;
        if begins && is_starred && self.rest().starts_with('[') {
            self.at += self.rest().find(']').map_or(0, |close| close + 1);
        }
        let name = if is_starred { bare.to_owned() } else { name };
        self.push(if begins { Kind::Begin(name) } else { Kind::End(name) }, start);
        Ok(())
    }
}

/// Where the brace at `open` closes; nothing where none is there.
pub(crate) fn closing(text: &str, open: usize) -> Option<usize> {
    let mut depth = 0usize;
    let mut escaped = false;
    for (at, c) in text[open..].char_indices() {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '{' => depth += 1,
            '}' => depth = depth.checked_sub(1)?,
            _ => {}
        }
        if depth == 0 {
            return Some(open + at).filter(|_| c == '}');
        }
    }
    None
}

/// Whether a text divides what stands before `\over` by what stands behind it: then its braces hold both together.
fn has_over(text: &str) -> bool {
    text.match_indices("\\over").any(|(at, over)| !text[at + over.len()..].starts_with(char::is_alphabetic))
}

/// `2pt`, `-.5ex`, `1.2 em`.
fn is_distance(text: &str) -> bool {
    let text = text.trim();
    let Some(unit) = UNITS.iter().find(|unit| text.ends_with(**unit)) else { return false };
    let number = text[..text.len() - unit.len()].trim().trim_start_matches(['+', '-']);
    !number.is_empty() && number.parse::<f64>().is_ok_and(f64::is_finite)
}
