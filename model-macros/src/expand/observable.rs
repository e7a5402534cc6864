//! The methods of one observable.

use model_core::{Chain, ObservableId, ObservableKind, SymbolKind};
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::first_order::{self, Code};
use super::parameters::slices_name;
use super::{Context, closed_form, count, doc, exact};

/// The observables of a chain, in order.
pub fn ids(chain: &Chain) -> impl Iterator<Item = ObservableId> {
    (0u16..).map(ObservableId).take(chain.observables.len())
}

/// The parameters of a method: of one pose, or of many.
struct Parameters {
    /// `joints: &Joints, inputs: &Inputs`
    one: TokenStream,
    /// `joints, inputs`
    arguments: TokenStream,
    /// `joints: &JointSlices<'_>, inputs: &InputSlices<'_>`
    many: TokenStream,
    /// Whether each of them has the length `length`.
    have_length: Vec<TokenStream>,
    /// One pose of them, by the same names.
    at_pose: TokenStream,
}

/// Everything of one observable.
pub fn items(context: &Context<'_>, id: ObservableId) -> TokenStream {
    let closed_form = closed_form::constants(context.chain, id);
    let parameters = parameters(context);
    let exact = exact_methods(context, id, &parameters);
    let first_order = first_order_methods(context, id, &parameters);
    let jacobian = context
        .group(SymbolKind::Error)
        .map(|errors| jacobian_methods(context, id, &parameters, errors.symbols.len()));
    quote! { #closed_form #exact #first_order #jacobian }
}

fn parameters(context: &Context<'_>) -> Parameters {
    let (mut one, mut arguments, mut many) = (TokenStream::new(), TokenStream::new(), TokenStream::new());
    let (mut have_length, mut at_pose) = (Vec::new(), TokenStream::new());
    for group in context.pose() {
        let (field, type_name, slices) = (&group.field, &group.type_name, slices_name(group));
        one.extend(quote! { #field: &#type_name, });
        arguments.extend(quote! { #field, });
        many.extend(quote! { #field: &#slices<'_>, });
        have_length.push(quote! { #field.have_length(length) });
        at_pose.extend(quote! { let #field = &#field.at(pose); });
    }
    Parameters { one, arguments, many, have_length, at_pose }
}

/// What a person reads of an observable: its documentation, and its unit.
fn meaning(context: &Context<'_>, id: ObservableId) -> (String, &'static str) {
    let observable = context.chain.observable(id);
    let first = match observable.documentation.as_str() {
        "" => format!("The observable `{}`.", observable.name),
        documentation => documentation.to_owned(),
    };
    let unit = match observable.kind {
        ObservableKind::Direction => "a direction, without unit",
        ObservableKind::Point => "a point, in metres",
    };
    (first, unit)
}

fn exact_methods(context: &Context<'_>, id: ObservableId, parameters: &Parameters) -> TokenStream {
    let Parameters { one, arguments, .. } = parameters;
    let name = &context.chain.observable(id).name;
    let method = Ident::new(name, context.names.observable(name));
    let (parts, error) = (format_ident!("{name}_parts"), format_ident!("{name}_error"));
    let (documentation, unit) = meaning(context, id);
    let value_doc = doc(&format!("{documentation}\n\nWith its errors, in the ground frame: {unit}."));
    let error_doc = doc(&format!(
        "What the errors add to [`{name}`](Self::{name}), exactly.\n\nIn the ground frame, with full relative precision however small the errors are."
    ));
    let parts_doc = doc(&format!("[`{name}`](Self::{name}) without errors, and what they add."));
    let body = exact::body(context, id);
    let over = over_slices(
        context,
        &format_ident!("{name}_error_over"),
        &format!("[`{name}_error`](Self::{name}_error) of many poses."),
        parameters,
        &Code {
            prepared: TokenStream::new(),
            evaluated: quote! { let error = self.#error(#arguments); },
            outputs: vec![quote! { error.x }, quote! { error.y }, quote! { error.z }],
        },
    );
    quote! {
        #value_doc
        #[must_use]
        pub fn #method(&self, #one) -> Vector3<f64> {
            let (nominal, difference) = self.#parts(#arguments);
            nominal + difference
        }

        #error_doc
        #[must_use]
        pub fn #error(&self, #one) -> Vector3<f64> {
            self.#parts(#arguments).1
        }

        #parts_doc
        fn #parts(&self, #one) -> (Vector3<f64>, Vector3<f64>) {
            #body
        }

        #over
    }
}

fn first_order_methods(context: &Context<'_>, id: ObservableId, parameters: &Parameters) -> TokenStream {
    let one = &parameters.one;
    let name = &context.chain.observable(id).name;
    let method = format_ident!("{name}_first_order");
    let documentation = doc(&format!(
        "What the errors add to [`{name}`](Self::{name}), to first order.\n\nProducts of two or more errors are dropped."
    ));
    let code = first_order::error(context, id);
    let Code { prepared, evaluated, outputs } = &code;
    let over = over_slices(
        context,
        &format_ident!("{name}_first_order_over"),
        &format!("[`{name}_first_order`](Self::{name}_first_order) of many poses."),
        parameters,
        &code,
    );
    quote! {
        #documentation
        #[must_use]
        pub fn #method(&self, #one) -> Vector3<f64> {
            #prepared
            #evaluated
            Vector3::new(#(#outputs),*)
        }

        #over
    }
}

/// A method that fills three slices.
fn over_slices(
    context: &Context<'_>,
    method: &Ident,
    documentation: &str,
    parameters: &Parameters,
    code: &Code,
) -> Option<TokenStream> {
    context.pose().next()?;
    let documentation = doc(documentation);
    let Parameters { many, have_length, at_pose, .. } = parameters;
    let Code { prepared, evaluated, outputs } = code;
    let outputs =
        outputs.iter().zip(["x", "y", "z"].map(|axis| format_ident!("{axis}"))).map(|(value, axis)| {
            quote! { #axis[pose] = #value; }
        });
    Some(quote! {
        #documentation
        ///
        /// `out` receives x, y and z.
        ///
        /// # Errors
        ///
        /// If the slices have different lengths.
        pub fn #method(&self, #many out: [&mut [f64]; 3]) -> Result<(), UnequalLengths> {
            let [x, y, z] = out;
            let length = x.len();
            let all_equal = y.len() == length && z.len() == length #(&& #have_length)*;
            if !all_equal {
                return Err(UnequalLengths);
            }
            #prepared
            for pose in 0..length {
                #at_pose
                #evaluated
                #(#outputs)*
            }
            Ok(())
        }
    })
}

fn jacobian_methods(
    context: &Context<'_>,
    id: ObservableId,
    parameters: &Parameters,
    errors: usize,
) -> TokenStream {
    let Parameters { one, arguments, many, have_length, at_pose } = parameters;
    let name = &context.chain.observable(id).name;
    let (method, over) = (format_ident!("{name}_jacobian"), format_ident!("{name}_jacobian_over"));
    let documentation = doc(&format!(
        "Derivatives of [`{name}`](Self::{name}) with respect to the errors, where they are zero.\n\nThe columns are in the order of the fields of [`Errors`]."
    ));
    let over_doc = doc(&format!("[`{name}_jacobian`](Self::{name}_jacobian) of many poses."));
    let errors = count(errors);
    let Code { prepared, evaluated, outputs } = first_order::jacobian(context, id);
    let over = context.pose().next().map(|_| {
        quote! {
            #over_doc
            ///
            /// # Errors
            ///
            /// If the slices have different lengths.
            pub fn #over(&self, #many out: &mut [SMatrix<f64, 3, #errors>]) -> Result<(), UnequalLengths> {
                let length = out.len();
                let all_equal = #(#have_length)&&*;
                if !all_equal {
                    return Err(UnequalLengths);
                }
                for pose in 0..length {
                    #at_pose
                    out[pose] = self.#method(#arguments);
                }
                Ok(())
            }
        }
    });
    quote! {
        #documentation
        #[must_use]
        pub fn #method(&self, #one) -> SMatrix<f64, 3, #errors> {
            #prepared
            #evaluated
            SMatrix::from([#(#outputs),*])
        }

        #over
    }
}
