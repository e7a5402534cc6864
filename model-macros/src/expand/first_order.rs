//! The first-order forms: straight-line code from the derived program.

use codegen::{Form, Program, Stage};
use model_core::{ObservableId, SymbolId, SymbolKind};
use proc_macro2::TokenStream;
use quote::quote;

use super::Context;
use super::program::{outputs, statements};

/// Statements in their two stages, and the result.
pub struct Code {
    /// What is computed once for an instrument.
    pub prepared: TokenStream,
    /// What is computed for every pose.
    pub evaluated: TokenStream,
    /// The outputs.
    pub outputs: Vec<TokenStream>,
}

/// The first-order error of an observable: x, y, z.
pub fn error(context: &Context<'_>, id: ObservableId) -> Code {
    code(context, &codegen::build(context.chain, &[id], Form::FirstOrderError, &[]))
}

/// Its first-order Jacobian, column by column.
pub fn jacobian(context: &Context<'_>, id: ObservableId) -> Code {
    let errors: Vec<SymbolId> = context.chain.symbols_of(SymbolKind::Error).collect();
    let mut code = code(context, &codegen::build(context.chain, &[id], Form::FirstOrderJacobian, &errors));
    let by_row = std::mem::take(&mut code.outputs);
    code.outputs = (0..errors.len())
        .map(|column| {
            let rows = (0..3).map(|row| &by_row[row * errors.len() + column]);
            quote! { [#(#rows),*] }
        })
        .collect();
    code
}

fn code(context: &Context<'_>, program: &Program) -> Code {
    Code {
        prepared: statements(context, program, Stage::Prepared),
        evaluated: statements(context, program, Stage::Evaluated),
        outputs: outputs(context, program),
    }
}
