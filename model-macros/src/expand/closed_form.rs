//! The closed form of the first-order error as text, so that a program can print its own formula.

use model_core::{Chain, Motion, ObservableId, Role, forms, print};
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::doc;

/// Behind more turning joints than this a formula fills pages (its terms double with each), and is left out.
const MAX_TURNS: usize = 7;

/// The constants with the closed form, as plain text and in LaTeX.
pub fn constants(chain: &Chain, id: ObservableId) -> Option<TokenStream> {
    let turns = chain
        .factors_to(id)
        .into_iter()
        .filter(|factor| factor.role == Role::Motion && factor.motion == Motion::Rotation);
    if turns.count() > MAX_TURNS {
        return None;
    }
    let form = forms::derive(chain, id, 1).ok()?;
    let name = &chain.observable(id).name;
    let plain = form.components.each_ref().map(|component| print::text(component, chain));
    let latex = form.components.each_ref().map(|component| print::latex(component, chain));
    let (plain_name, latex_name) = (constant(name, ""), constant(name, "_LATEX"));
    let plain_doc = doc(&format!("The first-order error of `{name}` as text: x, y and z."));
    let latex_doc = doc(&format!("The first-order error of `{name}` in LaTeX: x, y and z."));
    Some(quote! {
        #plain_doc
        pub const #plain_name: [&'static str; 3] = [#(#plain),*];
        #latex_doc
        pub const #latex_name: [&'static str; 3] = [#(#latex),*];
    })
}

/// `POINTING_FIRST_ORDER`
fn constant(observable: &str, ending: &str) -> Ident {
    format_ident!("{}_FIRST_ORDER{}", observable.to_uppercase(), ending)
}
