//! The texts of a printed formula as expressions: LaTeX, the plain syntax of amounts, or lines of a program.

use std::ops::Range;

use crate::latex::program as code;
use crate::latex::{self, NameOf, Notes, PrintedSymbols};
use model_core::expr::Expr;
use model_core::mistake::Mistake;
use model_core::syntax;

/// Where a printed vector cannot be read: in which text, and where in it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextPlace {
    /// Which of the texts.
    pub text_index: usize,
    /// Byte range in it.
    pub bytes: Range<usize>,
}

/// A component as written, and which of the texts it stands in.
pub(super) type Written = (usize, Expr<Range<usize>>);

/// Components as written, and what reading them took for granted.
#[derive(Debug)]
pub(super) struct Read {
    pub components: Vec<Written>,
    pub notes: Notes,
}

/// The components as written.
pub(super) fn expressions(
    symbols: &PrintedSymbols,
    names: &[NameOf],
    texts: &[&str],
) -> Result<Read, Vec<Mistake<TextPlace>>> {
    if let ([text], [_, _, ..]) = (texts, names) {
        let as_latex = || latex::read_vector(text, symbols, names);
        let is_program = !is_latex(text)
            && (code::is_line_of_program(text) || words(text).all(|word| symbols.declares(word)));
        let read = if is_program {
            code::read_vector(text, symbols, names).or_else(|mistake| as_latex().map_err(|_| mistake))
        } else {
            as_latex()
        };
        let (components, notes) = read.map_err(|mistake| vec![in_text(0, mistake)])?;
        let components = components.into_iter().map(|component| (0, component)).collect();
        return Ok(Read { components, notes });
    }
    let mut read = Read { components: Vec::new(), notes: Notes::default() };
    let mut mistakes = Vec::new();
    for (index, text) in texts.iter().enumerate() {
        // A fourth component stands behind z.
        match component(symbols, index, text, names.get(index).copied().unwrap_or(NameOf::Component(index))) {
            Ok(one) => {
                read.components.extend(one.components);
                read.notes.join(&one.notes);
            }
            Err(found) => mistakes.extend(found),
        }
    }
    if mistakes.is_empty() { Ok(read) } else { Err(mistakes) }
}

/// One component: in LaTeX, in the plain syntax, or as a line of a program.
pub(super) fn component(
    symbols: &PrintedSymbols,
    text_index: usize,
    text: &str,
    name_of: NameOf,
) -> Result<Read, Vec<Mistake<TextPlace>>> {
    let as_latex = || latex::read_component(text, symbols, name_of);
    let one = |(expression, notes)| Read { components: vec![(text_index, expression)], notes };
    if is_latex(text) {
        return as_latex().map(one).map_err(|mistake| vec![in_text(text_index, mistake)]);
    }
    if code::is_line_of_program(text) {
        let read = code::read_component(text, symbols, name_of);
        return read.map(one).map_err(|mistake| vec![in_text(text_index, mistake)]);
    }
    let (name_length, amount) = bare(text);
    let moved = |place: &Range<usize>| place.start + name_length..place.end + name_length;
    let plain = syntax::parse_amount(amount);
    // `-x_3`, `R x_2` and `c_1^2` are LaTeX too, where each letter is a symbol.
    let is_known = |word: &str| symbols.declares(word) || is_of_language(word);
    let is_plain = plain.is_ok() && words(amount).all(is_known);
    if !is_plain
        && prints_letters(amount, symbols)
        && let Ok(read) = as_latex()
    {
        return Ok(one(read));
    }
    // `a·b` and `a − b` as they are pasted.
    if plain.is_err()
        && !text.is_ascii()
        && let Ok(read) = as_latex()
    {
        return Ok(one(read));
    }
    match plain {
        Ok(expression) => Ok(one((expression.map_place(&moved), Notes::default()))),
        Err(found) => Err(found
            .iter()
            .map(|mistake| Mistake {
                place: TextPlace { text_index, bytes: moved(&mistake.place.bytes) },
                message: mistake.message.clone(),
                help: mistake.help.clone(),
            })
            .collect()),
    }
}

/// A plain amount without the name before `=` and the punctuation behind it, and where it begins.
fn bare(text: &str) -> (usize, &str) {
    let start = match text.split_once('=') {
        Some((name, rest)) if !rest.contains('=') && is_name(name.trim()) => name.len() + 1,
        _ => 0,
    };
    // A sign in front of the first term says nothing.
    let inside = text[start..].trim_start();
    let signed = inside.strip_prefix('+').filter(|rest| !rest.trim_start().starts_with(['+', '-']));
    let start = signed.map_or(start, |rest| text.len() - rest.len());
    (start, text[start..].trim_end().trim_end_matches(['.', ',', ';']))
}

fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic())
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// Letters with digits and underscores behind them.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    words.filter(|word| word.starts_with(|c: char| c.is_ascii_alphabetic()))
}

/// Whether each word of a text is a printed symbol, or a letter with one index: what LaTeX would not take for a product of letters.
pub(crate) fn prints_letters(text: &str, symbols: &PrintedSymbols) -> bool {
    let is_letter = |word: &str| {
        let (letter, index) = word.split_once('_').unwrap_or((word, "0"));
        letter.len() == 1 && index.len() == 1
    };
    words(text).next().is_some()
        && words(text).all(|word| is_letter(word) || is_of_language(word) || symbols.prints(word))
}

/// Words that the language of amounts has.
fn is_of_language(word: &str) -> bool {
    syntax::FUNCTIONS.iter().any(|(name, _)| *name == word) || [syntax::RAMP, "pi"].contains(&word)
}

fn is_latex(text: &str) -> bool {
    text.chars().any(|c| matches!(c, '\\' | '{' | '}') || (c.is_alphabetic() && !c.is_ascii()))
}

pub(super) fn in_text(text_index: usize, mistake: Mistake<Range<usize>>) -> Mistake<TextPlace> {
    Mistake {
        place: TextPlace { text_index, bytes: mistake.place },
        message: mistake.message,
        help: mistake.help,
    }
}
