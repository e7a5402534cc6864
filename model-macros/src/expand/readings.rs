//! The exact form of what is no vector: angles, ranges, single components.

use codegen::Form;
use model_core::ObservableId;
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::arguments::Arguments;
use super::shown::{meaning, rows, vector};
use super::tokens::{ident, tokens};
use super::{Context, doc, stages};

/// The methods that give the value with errors, and what errors add to it.
pub fn exact_methods(context: &Context<'_>, id: ObservableId, arguments: &Arguments) -> TokenStream {
    let Arguments { one, at_row, .. } = arguments;
    let name = &context.chain.observable(id).name;
    let (method, error) = (ident(name, context.names), format_ident!("{name}_error"));
    let (documentation, shown) = meaning(context, id);
    let value_doc = doc(&format!("{documentation}\n\nWith its errors, {shown}."));
    let error_doc = doc(&format!(
        "What the errors add to [`{name}`](Self::{name}), exactly.\n\nWith full relative precision however small the errors are."
    ));
    let body = |form| {
        let code = stages(context, &codegen::build(context.chain, &[id], form, &[]));
        let statements = code.both_stages();
        let outputs = code.outputs.iter().map(|text| tokens(text, context.names));
        quote! {
            #statements
            [#(#outputs),*].into()
        }
    };
    let (value_body, error_body) = (body(Form::ExactValue), body(Form::ExactError));
    let rows = rows(
        context,
        id,
        &format_ident!("{name}_error_rows"),
        &format!("[`{name}_error`](Self::{name}_error) of many poses."),
        arguments,
        &TokenStream::new(),
        &quote! { self.#error(#at_row).into() },
    );
    let vector = vector(context, id);
    quote! {
        #value_doc
        #[must_use]
        pub fn #method(&self, #one) -> #vector {
            #value_body
        }

        #error_doc
        #[must_use]
        pub fn #error(&self, #one) -> #vector {
            #error_body
        }

        #rows
    }
}
