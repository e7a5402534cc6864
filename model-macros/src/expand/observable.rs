//! The methods of one observable.

use codegen::Form;
use model_core::readings::Measures;
use model_core::{ObservableId, SymbolId, SymbolKind};
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::arguments::Arguments;
use super::shown::{meaning, rows, shown, vector};
use super::tokens::{ident, tokens};
use super::{Context, closed_form, count, doc, exact, readings, stages};

/// Everything of one observable.
pub fn items(context: &Context<'_>, id: ObservableId) -> TokenStream {
    let closed_form = closed_form::constants(context.chain, id);
    let arguments = Arguments::of(context, id);
    let exact = if context.chain.observable(id).is_vector() {
        exact_methods(context, id, &arguments)
    } else {
        readings::exact_methods(context, id, &arguments)
    };
    let first_order = first_order_methods(context, id, &arguments);
    let has_derivatives =
        context.chain.observable(id).shown.iter().all(|one| one.measures != Measures::OffAxis);
    let jacobian = (has_derivatives && context.has(SymbolKind::Error))
        .then(|| jacobian_methods(context, id, &arguments));
    quote! { #closed_form #exact #first_order #jacobian }
}

/// The text with a capital letter in front.
fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn exact_methods(context: &Context<'_>, id: ObservableId, arguments: &Arguments) -> TokenStream {
    let Arguments { one, passed, at_row, .. } = arguments;
    let name = &context.chain.observable(id).name;
    let method = ident(name, context.names);
    let (parts, error) = (format_ident!("{name}_parts"), format_ident!("{name}_error"));
    let (documentation, unit) = meaning(context, id);
    let value_doc = doc(&format!("{documentation}\n\nWith its errors, {unit}."));
    let in_frame = capitalised(unit.split(':').next().unwrap_or_default());
    let error_doc = doc(&format!(
        "What the errors add to [`{name}`](Self::{name}), exactly.\n\n{in_frame}, with full relative precision however small the errors are."
    ));
    let parts_doc = doc(&format!("[`{name}`](Self::{name}) without errors, and what they add."));
    let body = exact::body(context, id);
    let rows = rows(
        context,
        id,
        &format_ident!("{name}_error_rows"),
        &format!("[`{name}_error`](Self::{name}_error) of many poses."),
        arguments,
        &TokenStream::new(),
        &quote! { self.#error(#at_row).into() },
    );
    quote! {
        #value_doc
        #[must_use]
        pub fn #method(&self, #one) -> Vector3<f64> {
            let (nominal, difference) = self.#parts(#passed);
            nominal + difference
        }

        #error_doc
        #[must_use]
        pub fn #error(&self, #one) -> Vector3<f64> {
            self.#parts(#passed).1
        }

        #parts_doc
        fn #parts(&self, #one) -> (Vector3<f64>, Vector3<f64>) {
            #body
        }

        #rows
    }
}

fn first_order_methods(context: &Context<'_>, id: ObservableId, arguments: &Arguments) -> TokenStream {
    let Arguments { one, passed, at_row, .. } = arguments;
    let name = &context.chain.observable(id).name;
    let method = format_ident!("{name}_first_order");
    let (prepare, at) =
        (format_ident!("{name}_first_order_prepared"), format_ident!("{name}_first_order_at"));
    let documentation = doc(&format!(
        "What the errors add to [`{name}`](Self::{name}), to first order.\n\nProducts of two or more errors are dropped."
    ));
    let prepare_doc =
        doc(&format!("What of [`{name}_first_order`](Self::{name}_first_order) no pose changes."));
    let at_doc = doc(&format!("The rest of [`{name}_first_order`](Self::{name}_first_order), for one pose."));
    let code = stages(context, &codegen::build(context.chain, &[id], Form::FirstOrderError, &[]));
    let kept = count(code.kept());
    let (prepared, evaluated) = (code.prepared(), code.evaluated());
    let outputs = code.outputs.iter().map(|text| tokens(text, context.names));
    let (shown, vector) = (shown(context, id), vector(context, id));
    let rows = rows(
        context,
        id,
        &format_ident!("{name}_first_order_rows"),
        &format!("[`{name}_first_order`](Self::{name}_first_order) of many poses."),
        arguments,
        &quote! { let p = &self.#prepare(); },
        &quote! { Self::#at(p, #at_row) },
    );
    quote! {
        #documentation
        #[must_use]
        pub fn #method(&self, #one) -> #vector {
            Self::#at(&self.#prepare(), #passed).into()
        }

        #prepare_doc
        fn #prepare(&self) -> [f64; #kept] {
            #prepared
        }

        #at_doc
        fn #at(p: &[f64; #kept], #one) -> [f64; #shown] {
            #evaluated
            [#(#outputs),*]
        }

        #rows
    }
}

fn jacobian_methods(context: &Context<'_>, id: ObservableId, arguments: &Arguments) -> TokenStream {
    let Arguments { one, many, have_length, at_row, .. } = arguments;
    let errors: Vec<SymbolId> = context.chain.symbols_of(SymbolKind::Error).collect();
    let name = &context.chain.observable(id).name;
    let (method, rows) = (format_ident!("{name}_jacobian"), format_ident!("{name}_jacobian_rows"));
    let documentation = doc(&format!(
        "Derivatives of [`{name}`](Self::{name}) with respect to the errors, where they are zero.\n\nThe columns are in the order of the fields of [`Errors`]."
    ));
    let rows_doc = doc(&format!("[`{name}_jacobian`](Self::{name}_jacobian) of many poses."));
    let count = count(errors.len());
    let code = stages(context, &codegen::build(context.chain, &[id], Form::FirstOrderJacobian, &errors));
    let statements = code.both_stages();
    let outputs: Vec<TokenStream> = code.outputs.iter().map(|text| tokens(text, context.names)).collect();
    let height = context.chain.observable(id).shown.len();
    let shown = shown(context, id);
    let columns = (0..errors.len()).map(|column| {
        let rows = (0..height).map(|row| &outputs[row * errors.len() + column]);
        quote! { [#(#rows),*] }
    });
    let rows = (!arguments.is_empty).then(|| {
        quote! {
            #rows_doc
            ///
            /// # Errors
            ///
            /// If the slices have different lengths.
            pub fn #rows(&self, #many out: &mut [SMatrix<f64, #shown, #count>]) -> Result<(), LengthsDiffer> {
                let rows = out.len();
                if !(#have_length) {
                    return Err(LengthsDiffer);
                }
                for (row, out) in out.iter_mut().enumerate() {
                    *out = self.#method(#at_row);
                }
                Ok(())
            }
        }
    });
    quote! {
        #documentation
        #[must_use]
        pub fn #method(&self, #one) -> SMatrix<f64, #shown, #count> {
            #statements
            SMatrix::from([#(#columns),*])
        }

        #rows
    }
}
