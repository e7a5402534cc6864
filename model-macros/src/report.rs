//! Mistakes as compiler errors, and what is doubtful as warnings.

use model_core::caution::cautions;
use model_core::{Chain, Mistake};
use proc_macro2::{Span, TokenStream};
use quote::quote_spanned;

use crate::expand::Names;

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

/// A warning for each error that is most likely a misspelt name, at its token; at `span` where a chain comes from a file.
pub fn doubts(chain: &Chain, names: &Names, span: Span) -> TokenStream {
    cautions(chain)
        .iter()
        .map(|caution| warning(names.place(&caution.name).unwrap_or(span), &caution.to_string()))
        .collect()
}

/// A warning. No macro can warn on stable Rust, but the compiler warns where something deprecated is used.
fn warning(span: Span, message: &str) -> TokenStream {
    quote_spanned! { span =>
        const _: () = {
            #[deprecated(note = #message)]
            struct DoubtfulName;
            let _ = DoubtfulName;
        };
    }
}

/// A compiler error.
pub fn at(span: Span, message: &str) -> TokenStream {
    quote_spanned! { span => ::core::compile_error! { #message } }
}
