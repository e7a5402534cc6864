//! Words: letters that stand upright and are one symbol, `\text{cross elevation}`.

use super::super::commands::{DETERMINANT, FUNCTIONS, RAMP, SWITCHES, is_inverse, other_word};
use super::super::typed;
use super::{Kind, Lexer};

impl Lexer<'_> {
    /// `{\rm sin}`: a change of typeface at the start of a group, and the word behind it.
    pub(super) fn switched(&mut self, start: usize) -> bool {
        let inside = self.text[self.at..].trim_start();
        let Some(command) = inside.strip_prefix('\\') else { return false };
        let Some(switch) = SWITCHES.iter().find(|switch| {
            command.strip_prefix(**switch).is_some_and(|rest| rest.starts_with(char::is_whitespace))
        }) else {
            return false;
        };
        let after_brace = self.at;
        self.at = self.text.len() - command.len() + switch.len();
        let is_word = self.word(start);
        if !is_word {
            self.at = after_brace;
        }
        is_word
    }

    /// Whether what follows is an index: there several words are a name, `s_{\text{cross elevation}}`, and no remark.
    fn is_index(&self) -> bool {
        let kinds: Vec<&Kind> = self.tokens.iter().rev().take(2).map(|token| &token.kind).collect();
        let is_mark = |kind: Option<&&Kind>| matches!(kind, Some(Kind::Mark('_' | '^')));
        match kinds.first() {
            Some(Kind::Mark('{')) => is_mark(kinds.get(1)),
            first => is_mark(first),
        }
    }

    /// Letters up to the end of the group, as one symbol.
    pub(super) fn word(&mut self, start: usize) -> bool {
        let word_start = self.at;
        self.skip_while(|c| c.is_alphanumeric() || c == ' ');
        // A name with an underscore and digits, `\text{from\_1st}`.
        while self.text[self.at..].starts_with(r"\_") {
            self.at += 2;
            self.skip_while(|c| c.is_alphanumeric() || c == ' ');
        }
        let word = self.text[word_start..self.at].trim().replace(r"\_", "_");
        let is_name = word.starts_with(char::is_alphabetic) && (self.is_index() || !word.contains(' '));
        if self.peek() != Some('}') || !is_name {
            return false;
        }
        let mut letters = word.chars().map(typed::normal);
        let typed = match (letters.next(), letters.next()) {
            (Some(letter), None) => typed::command(letter),
            _ => None,
        };
        let kind = match typed {
            Some(command) => Kind::Command(command.to_owned()),
            None if FUNCTIONS.contains(&word.as_str())
                || [RAMP, DETERMINANT].contains(&word.as_str())
                || is_inverse(&word) =>
            {
                Kind::Command(word)
            }
            None => match other_word(&word) {
                Some(function) => Kind::Command(function.to_owned()),
                None => Kind::Word(word),
            },
        };
        self.at += 1;
        self.push(kind, start);
        true
    }
}
