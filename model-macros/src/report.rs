//! Mistakes as compiler errors.

use model_core::Mistake;
use proc_macro2::{Span, TokenStream};
use quote::quote_spanned;

/// One compiler error for each mistake, at its token.
pub fn at_tokens(mistakes: &[Mistake<Span>]) -> TokenStream {
    mistakes
        .iter()
        .map(|mistake| {
            let message = match &mistake.help {
                Some(help) => format!("{}: {help}", mistake.message),
                None => mistake.message.clone(),
            };
            at(mistake.place, &message)
        })
        .collect()
}

/// A compiler error.
pub fn at(span: Span, message: &str) -> TokenStream {
    quote_spanned! { span => ::core::compile_error! { #message } }
}
