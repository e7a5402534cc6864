//! From a text to tokens, and a reader over tokens that says what it expected.
//!
//! Tokens come from a `.chain` text or from the compiler in a macro; the reader is the same.

use std::borrow::Cow;
use std::str::FromStr;

use proc_macro2::{Delimiter, Ident, Literal, Span, TokenStream, TokenTree};
use syn::buffer::Cursor;

use super::declaration::Braces;
use super::unreadable;
use crate::mistake::{Mistake, Mistakes};

/// Parentheses and braces deeper than this are refused, so that no text can exhaust the stack.
pub const MAX_NESTING: usize = 32;

/// The tokens of a text; byte ranges of their spans are those of the text.
pub fn tokenize(text: &str) -> Result<TokenStream, Mistakes> {
    // The lexer would drop a byte order mark and count from behind it.
    let counted = match text.strip_prefix('\u{feff}') {
        Some(rest) => Cow::Owned(format!("   {rest}")),
        None => Cow::Borrowed(text),
    };
    TokenStream::from_str(&counted)
        .map_err(|error| Mistakes::locate(text, [unreadable::why(&counted, error.span().byte_range())]))
}

/// Refuses groups nested deeper than [`MAX_NESTING`]; works without recursion.
pub fn check_nesting(tokens: &TokenStream) -> Result<(), Mistake<Span>> {
    let mut open = vec![tokens.clone().into_iter()];
    while let Some(last) = open.last_mut() {
        match last.next() {
            Some(TokenTree::Group(group)) => {
                if open.len() > MAX_NESTING {
                    return Err(Mistake::new(
                        group.span_open(),
                        format!("more than {MAX_NESTING} pairs of parentheses inside each other"),
                    )
                    .with_help("write the amount with fewer parentheses"));
                }
                open.push(group.stream().into_iter());
            }
            Some(_) => {}
            None => {
                open.pop();
            }
        }
    }
    Ok(())
}

/// A place among tokens, with the mistakes found so far.
pub struct Reader<'a, 'm> {
    /// What comes next.
    pub cursor: Cursor<'a>,
    /// Where the last token that was read stands; where the input ends if nothing follows.
    pub last: Span,
    /// The mistakes found so far.
    pub mistakes: &'m mut Vec<Mistake<Span>>,
}

impl<'a> Reader<'a, '_> {
    /// Whether nothing is left between the surrounding delimiters.
    pub fn is_at_end(&self) -> bool {
        self.cursor.eof()
    }

    /// Where the next token stands, or where the input ends.
    pub fn here(&self) -> Span {
        match self.cursor.token_tree() {
            Some((TokenTree::Group(group), _)) => group.span_open(),
            Some((tree, _)) => tree.span(),
            None => self.last,
        }
    }

    /// What the next token is, for a message.
    pub fn found(&self) -> String {
        match self.cursor.token_tree() {
            Some((TokenTree::Group(group), _)) => match group.delimiter() {
                Delimiter::Parenthesis => "`(`".to_owned(),
                Delimiter::Brace => "`{`".to_owned(),
                Delimiter::Bracket => "`[`".to_owned(),
                Delimiter::None => format!("`{}`", shortened(&group.stream().to_string())),
            },
            Some((tree, _)) => format!("`{}`", shortened(&tree.to_string())),
            None => "the end".to_owned(),
        }
    }

    /// The mistake that something else stands here.
    pub fn expected(&self, what: &str) -> Mistake<Span> {
        Mistake::new(self.here(), format!("expected {what}, found {}", self.found()))
    }

    /// The next token if it is an identifier; it is not consumed.
    pub fn peek_word(&self) -> Option<Ident> {
        self.cursor.ident().map(|(ident, _)| ident)
    }

    /// The next token if it is an identifier.
    pub fn word(&mut self) -> Option<Ident> {
        let (ident, rest) = self.cursor.ident()?;
        self.cursor = rest;
        self.last = ident.span();
        Some(ident)
    }

    /// A name, described by `what` if something else stands here.
    pub fn name(&mut self, what: &str) -> Result<Ident, Mistake<Span>> {
        self.word().ok_or_else(|| self.expected(what))
    }

    /// One of the language's own words.
    pub fn keyword(&mut self, word: &str, help: &str) -> Result<Span, Mistake<Span>> {
        match self.peek_word() {
            Some(ident) if ident == word => {
                self.word();
                Ok(ident.span())
            }
            _ => Err(self.expected(&format!("`{word}`")).with_help(help)),
        }
    }

    /// The next token if it is this punctuation mark.
    pub fn mark(&mut self, mark: char) -> Option<Span> {
        let (punct, rest) = self.cursor.punct()?;
        if punct.as_char() != mark {
            return None;
        }
        self.cursor = rest;
        self.last = punct.span();
        Some(punct.span())
    }

    /// Whether the next token is this punctuation mark.
    pub fn is_mark(&self, mark: char) -> bool {
        self.cursor.punct().is_some_and(|(punct, _)| punct.as_char() == mark)
    }

    /// This punctuation mark, or a mistake with advice.
    pub fn expect_mark(&mut self, mark: char, help: &str) -> Result<Span, Mistake<Span>> {
        self.mark(mark).ok_or_else(|| self.expected(&format!("`{mark}`")).with_help(help))
    }

    /// The next token if it is a literal.
    pub fn literal(&mut self) -> Option<Literal> {
        let (literal, rest) = self.cursor.literal()?;
        self.cursor = rest;
        self.last = literal.span();
        Some(literal)
    }

    /// What stands between the delimiters that come next, and where they are.
    pub fn group(&mut self, delimiter: Delimiter) -> Option<(Cursor<'a>, Braces)> {
        let (inside, span, rest) = self.cursor.group(delimiter)?;
        self.cursor = rest;
        self.last = span.close();
        Some((inside, Braces { open: span.open(), close: span.close() }))
    }

    /// Reads what stands between delimiters with the same list of mistakes.
    pub fn inside<T>(
        &mut self,
        inside: Cursor<'a>,
        close: Span,
        read: impl FnOnce(&mut Reader<'a, '_>) -> T,
    ) -> T {
        let mut reader = Reader { cursor: inside, last: close, mistakes: &mut *self.mistakes };
        read(&mut reader)
    }

    /// The end of a statement. A missing `;` is reported where it is due; reading goes on with the next word.
    pub fn end_of_statement(&mut self) -> Result<Span, Mistake<Span>> {
        if let Some(span) = self.mark(';') {
            return Ok(span);
        }
        if self.is_at_end() || self.peek_word().is_some() {
            self.mistakes
                .push(Mistake::new(self.last, "no `;` after this").with_help("end the statement with `;`"));
            return Ok(self.last);
        }
        Err(self.expected("`;`").with_help("end the statement with `;`"))
    }

    /// Skips what is left of a statement: up to a `;` or a pair of braces, that included.
    pub fn skip_statement(&mut self) {
        while let Some((tree, rest)) = self.cursor.token_tree() {
            self.cursor = rest;
            self.last = tree.span();
            match tree {
                TokenTree::Punct(punct) if punct.as_char() == ';' => return,
                TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => return,
                _ => {}
            }
        }
    }
}

/// A token's text, cut where it would fill a message.
fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    let start: String = text.chars().take(LONGEST).collect();
    format!("{start}…")
}

/// From the first place to the last, where the compiler lets us say so.
pub fn join(first: Span, last: Span) -> Span {
    first.join(last).unwrap_or(first)
}
