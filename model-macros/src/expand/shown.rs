//! What an observable shows, as the methods of every form say it: in words, as a type, into slices.

use model_core::escape::markdown;
use model_core::readings::Reading;
use model_core::{ObservableId, ObservableKind};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::arguments::Arguments;
use super::{Context, count, doc};

/// What a person reads of an observable: its documentation, and its unit.
pub fn meaning(context: &Context<'_>, id: ObservableId) -> (String, String) {
    let observable = context.chain.observable(id);
    let first = match observable.documentation.as_str() {
        "" => format!("The observable `{}`.", observable.name),
        documentation => markdown(documentation),
    };
    let frame = match observable.frame {
        _ if observable.is_image() => "in the image".to_owned(),
        None => "in the ground frame".to_owned(),
        Some(frame) => format!("in the frame of {}", context.chain.body(frame).name),
    };
    let shown = match observable.kind {
        _ if !observable.is_vector() => {
            let unit = |reading: &Reading| match reading.unit(observable.kind) {
                "rad" => "in radians",
                "m" => "in metres",
                "px" => "in pixels",
                _ => "without unit",
            };
            let shown = observable.shown.iter().map(|one| format!("{}, {}", one.describe(), unit(one)));
            shown.collect::<Vec<_>>().join("; ")
        }
        ObservableKind::Direction => "a direction, without unit".to_owned(),
        ObservableKind::Point => "a point, in metres".to_owned(),
    };
    (first, format!("{frame}: {shown}"))
}

/// How many numbers an observable shows.
pub fn shown(context: &Context<'_>, id: ObservableId) -> Literal {
    count(context.chain.observable(id).shown.len())
}

/// The type of what an observable shows.
pub fn vector(context: &Context<'_>, id: ObservableId) -> TokenStream {
    match context.chain.observable(id).shown.len() {
        3 => quote! { Vector3<f64> },
        n => {
            let n = count(n);
            quote! { SMatrix<f64, #n, 1> }
        }
    }
}

/// A method that fills a slice for each number that is shown, if poses can differ.
pub fn rows(
    context: &Context<'_>,
    id: ObservableId,
    method: &Ident,
    documentation: &str,
    arguments: &Arguments,
    before: &TokenStream,
    value: &TokenStream,
) -> Option<TokenStream> {
    if arguments.is_empty {
        return None;
    }
    let shown = shown(context, id);
    let mut labels: Vec<&str> = context.chain.observable(id).labels().collect();
    let last = labels.pop().unwrap_or_default();
    let labels =
        if labels.is_empty() { last.to_owned() } else { format!("{} and {last}", labels.join(", ")) };
    let documentation = doc(&format!("{documentation}\n\n`out` receives {labels}."));
    let Arguments { many, have_length, .. } = arguments;
    Some(quote! {
        #documentation
        ///
        /// # Errors
        ///
        /// If the slices have different lengths.
        pub fn #method(&self, #many out: [&mut [f64]; #shown]) -> Result<(), LengthsDiffer> {
            #before
            fill(out, |rows| #have_length, |row| #value)
        }
    })
}
