//! The language: text → tokens → [`Declaration`], and amounts by themselves.
//!
//! `chain!` and `.chain` files share this parser. It says what stands where and nothing of what it means:
//! whether names exist and amounts make sense is decided in [`crate::validate`].

mod amount;
pub mod declaration;
mod documentation;
mod factors;
mod image;
mod number;
mod print;
mod statements;
mod tokens;
mod unreadable;

use std::ops::Range;

use proc_macro2::{Span, TokenStream};
use syn::buffer::TokenBuffer;

pub use amount::{FUNCTIONS, RAMP};
pub use declaration::Declaration;
pub use image::IMAGE;
pub use statements::ORIENTATION;

use crate::expr::Expr;
use crate::mistake::{Mistake, Mistakes};
use tokens::Reader;

/// Reads a declaration and collects every mistake of form on the way. What could not be read is left out of the
/// declaration; `None` if not even its outline could be read.
pub fn read(tokens: TokenStream, mistakes: &mut Vec<Mistake<Span>>) -> Option<Declaration> {
    read_with(tokens, mistakes, statements::declaration)
}

impl Declaration {
    /// Reads the text of a `.chain` file; the places of the result are byte ranges of the text
    /// (`Span::byte_range`).
    ///
    /// # Errors
    ///
    /// Every mistake of form.
    pub fn from_text(text: &str) -> Result<Self, Mistakes> {
        read_text(text, statements::declaration)
    }
}

/// Reads one amount in the plain syntax: `dtheta_y1*cos(beta) + 2*delta_x2`.
///
/// # Errors
///
/// Every mistake of form, with its place in `text`.
pub fn parse_amount(text: &str) -> Result<Expr<Range<usize>>, Mistakes> {
    read_text(text, amount::whole).map(|amount| amount.map_place(&Span::byte_range))
}

/// The tokens of a text.
///
/// # Errors
///
/// A sign that is none of the language, or that has no other one.
pub(crate) fn tokens_of(text: &str) -> Result<TokenStream, Mistakes> {
    tokens::tokenize(text)
}

/// Mistakes at spans become mistakes at lines and columns of the text that was read.
pub(crate) fn located(text: &str, mistakes: Vec<Mistake<Span>>) -> Mistakes {
    Mistakes::locate(
        text,
        mistakes.into_iter().map(|Mistake { place, message, help }| Mistake {
            place: place.byte_range(),
            message,
            help,
        }),
    )
}

fn read_text<T>(text: &str, read: impl FnOnce(&mut Reader<'_, '_>) -> Option<T>) -> Result<T, Mistakes> {
    let mut mistakes = Vec::new();
    match read_with(tokens_of(text)?, &mut mistakes, read) {
        Some(result) if mistakes.is_empty() => Ok(result),
        _ => Err(located(text, mistakes)),
    }
}

fn read_with<T>(
    tokens: TokenStream,
    mistakes: &mut Vec<Mistake<Span>>,
    read: impl FnOnce(&mut Reader<'_, '_>) -> Option<T>,
) -> Option<T> {
    if let Err(mistake) = tokens::check_nesting(&tokens) {
        mistakes.push(mistake);
        return None;
    }
    let buffer = TokenBuffer::new2(tokens);
    let mut reader = Reader { cursor: buffer.begin(), last: Span::call_site(), mistakes };
    read(&mut reader)
}
