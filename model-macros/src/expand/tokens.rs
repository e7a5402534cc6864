//! Text of the Rust generator as tokens: names of the declaration get the places where they were declared.

use proc_macro2::{Group, Ident, TokenStream, TokenTree};

use super::Names;

/// The tokens of a text.
pub fn tokens(text: &str, names: &Names) -> TokenStream {
    match text.parse::<TokenStream>() {
        Ok(tokens) => placed(tokens, names),
        Err(error) => unreachable!("what the generator writes is Rust: {error}\n{text}"),
    }
}

fn placed(tokens: TokenStream, names: &Names) -> TokenStream {
    tokens
        .into_iter()
        .map(|token| match token {
            TokenTree::Group(group) => {
                let mut inner = Group::new(group.delimiter(), placed(group.stream(), names));
                inner.set_span(group.span());
                TokenTree::Group(inner)
            }
            TokenTree::Ident(mut ident) => {
                if let Some(place) = names.place(&ident.to_string()) {
                    ident.set_span(place);
                }
                TokenTree::Ident(ident)
            }
            token => token,
        })
        .collect()
}

/// An identifier that may be a name of the declaration.
pub fn ident(name: &str, names: &Names) -> Ident {
    let mut ident = Ident::new(name, proc_macro2::Span::call_site());
    if let Some(place) = names.place(&ident.to_string()) {
        ident.set_span(place);
    }
    ident
}
