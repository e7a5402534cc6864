//! The closed form of the first-order error as text, so that a program can print its own formula.

use model_core::{Chain, ObservableId, Role, TransformKind, forms, print};
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::doc;

/// Behind more turning joints than this a formula fills pages (its terms double with each), and is left out.
const MAX_TURNS: usize = 7;

/// The constants with the closed form, as plain text and in LaTeX.
pub fn constants(chain: &Chain, id: ObservableId) -> Option<TokenStream> {
    let turns = chain
        .way(id)
        .into_iter()
        .map(|passed| passed.factor)
        .filter(|factor| factor.role == Role::Motion && factor.kind == TransformKind::Rotation);
    if turns.count() > MAX_TURNS {
        return None;
    }
    let form = forms::derive(chain, id, 1).ok()?;
    let name = &chain.observable(id).name;
    let shown =
        |style| form.components.iter().map(|component| component.show(chain, style)).collect::<Vec<_>>();
    let (plain, latex) = (shown(print::Style::Text), shown(print::Style::Latex));
    let count = super::count(plain.len());
    let mut labels: Vec<&str> = chain.observable(id).labels().collect();
    let last = labels.pop().unwrap_or_default();
    let labels =
        if labels.is_empty() { last.to_owned() } else { format!("{} and {last}", labels.join(", ")) };
    let (plain_name, latex_name) = (constant(name, ""), constant(name, "_LATEX"));
    let plain_doc = doc(&format!("The first-order error of `{name}` as text: {labels}."));
    let latex_doc = doc(&format!("The first-order error of `{name}` in LaTeX: {labels}."));
    Some(quote! {
        #plain_doc
        pub const #plain_name: [&'static str; #count] = [#(#plain),*];
        #latex_doc
        pub const #latex_name: [&'static str; #count] = [#(#latex),*];
    })
}

/// `POINTING_FIRST_ORDER`
fn constant(observable: &str, ending: &str) -> Ident {
    format_ident!("{}_FIRST_ORDER{}", observable.to_uppercase(), ending)
}
