//! What methods take: joints, and the inputs if what they compute depends on any.

use codegen::Form;
use model_core::{ObservableId, SymbolKind};
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::Context;

/// The arguments of one observable's methods.
pub struct Arguments {
    /// `joints: &Joints, inputs: &Inputs`
    pub one: TokenStream,
    /// `joints, inputs`
    pub passed: TokenStream,
    /// `joints: &JointRows<'_>, inputs: &InputRows<'_>`
    pub many: TokenStream,
    /// Whether all slices have the length `rows`.
    pub have_length: TokenStream,
    /// The arguments of row `row`.
    pub at_row: TokenStream,
    /// Whether there is nothing that could differ from pose to pose.
    pub is_empty: bool,
}

impl Arguments {
    pub fn of(context: &Context<'_>, id: ObservableId) -> Self {
        let chain = context.chain;
        let program = codegen::build(chain, &[id], Form::ExactValue, &[]);
        let reads_input =
            program.inputs().iter().any(|&(symbol, _)| chain.symbol(symbol).kind == SymbolKind::Input);
        let mut kinds = Vec::new();
        if context.has(SymbolKind::Joint) {
            kinds.push(("joints", "Joints", "JointRows"));
        }
        if reads_input {
            kinds.push(("inputs", "Inputs", "InputRows"));
        }
        let mut arguments = Self {
            one: TokenStream::new(),
            passed: TokenStream::new(),
            many: TokenStream::new(),
            have_length: TokenStream::new(),
            at_row: TokenStream::new(),
            is_empty: kinds.is_empty(),
        };
        for (name, one, many) in kinds {
            let (name, one, many) =
                (format_ident!("{name}"), format_ident!("{one}"), format_ident!("{many}"));
            if !arguments.have_length.is_empty() {
                arguments.have_length.extend(quote! { && });
            }
            arguments.one.extend(quote! { #name: &#one, });
            arguments.passed.extend(quote! { #name, });
            arguments.many.extend(quote! { #name: &#many<'_>, });
            arguments.have_length.extend(quote! { #name.have_length(rows) });
            arguments.at_row.extend(quote! { &#name.at(row), });
        }
        arguments
    }
}
