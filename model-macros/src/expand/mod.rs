//! From a chain to the tokens of its module: types, methods, constants.

mod amount;
mod closed_form;
mod exact;
mod first_order;
mod names;
mod observable;
mod parameters;
mod program;
#[cfg(test)]
mod tests;

use model_core::{Chain, Mistake, SymbolKind};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

pub use names::Names;
use names::snake_case;
use parameters::{Group, groups};

/// Everything that the expansion looks at.
struct Context<'a> {
    chain: &'a Chain,
    names: &'a Names,
    /// Joints, inputs, errors and constants, those of them that the chain has.
    groups: Vec<Group>,
}

impl Context<'_> {
    /// The group of one kind, if the chain has such symbols.
    fn group(&self, kind: SymbolKind) -> Option<&Group> {
        self.groups.iter().find(|group| group.kind == kind)
    }

    /// The groups that a pose is made of: joints and inputs.
    fn pose(&self) -> impl Iterator<Item = &Group> {
        self.groups.iter().filter(|group| matches!(group.kind, SymbolKind::Joint | SymbolKind::Input))
    }

    /// The groups that an instrument is made of: errors and constants.
    fn instrument(&self) -> impl Iterator<Item = &Group> {
        self.groups.iter().filter(|group| matches!(group.kind, SymbolKind::Error | SymbolKind::Constant))
    }
}

/// The module of a chain.
///
/// # Errors
///
/// Names that would stand for two things in the module.
pub fn module(chain: &Chain, names: &Names) -> Result<TokenStream, Vec<Mistake<Span>>> {
    let mistakes = names::clashes(chain, names);
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    let context = Context { chain, names, groups: groups(chain) };
    let module = Ident::new(&snake_case(&chain.name), names.chain());
    let documentation = doc(&if chain.documentation.is_empty() {
        format!("The chain `{}`.", chain.name)
    } else {
        chain.documentation.clone()
    });
    let instrument = instrument(&context, &documentation);
    let parameters: TokenStream =
        context.groups.iter().map(|group| parameters::items(&context, group)).collect();
    let unequal_lengths = context.pose().next().map(|_| parameters::unequal_lengths());
    let helpers = exact::helpers(&context);
    Ok(quote! {
        #documentation
        #[allow(
            dead_code,
            non_camel_case_types,
            non_snake_case,
            non_upper_case_globals,
            unused_imports,
            unused_mut,
            unused_variables,
            clippy::default_trait_access,
            clippy::doc_markdown,
            clippy::large_types_passed_by_value,
            clippy::many_single_char_names,
            clippy::needless_range_loop,
            clippy::similar_names,
            clippy::struct_field_names,
            clippy::suboptimal_flops,
            clippy::too_many_lines,
            clippy::trivially_copy_pass_by_ref,
            clippy::unreadable_literal,
            clippy::unused_self
        )]
        pub mod #module {
            use ::trueaxis::__private::{ComplexField, Matrix3, SMatrix, Vector3};

            #instrument
            #parameters
            #unequal_lengths
            #helpers
        }
    })
}

/// Documentation, as `///` lines would be.
fn doc(text: &str) -> TokenStream {
    text.lines()
        .map(|line| {
            let line = if line.is_empty() { String::new() } else { format!(" {line}") };
            quote! { #[doc = #line] }
        })
        .collect()
}

/// How many, as a number without a suffix.
fn count(number: usize) -> Literal {
    Literal::usize_unsuffixed(number)
}

/// The type of the chain with its methods.
fn instrument(context: &Context<'_>, documentation: &TokenStream) -> TokenStream {
    let Context { chain, names, .. } = context;
    let name = Ident::new(&chain.name, names.chain());
    let fields = context.instrument().map(|group| {
        let Group { field, type_name, .. } = group;
        let meaning = match group.kind {
            SymbolKind::Error => "What differs from the design.",
            _ => "The sizes of the geometry.",
        };
        let meaning = doc(meaning);
        quote! { #meaning pub #field: #type_name }
    });
    let new = context.group(SymbolKind::Error).map(|errors| {
        let Group { field, type_name, .. } = errors;
        let constants = context.group(SymbolKind::Constant).map(|constants| {
            let Group { field, type_name, .. } = constants;
            quote! { #field: #type_name::default() }
        });
        quote! {
            /// The instrument with these errors, and everything else as declared.
            #[must_use]
            pub fn new(#field: #type_name) -> Self {
                Self { #field, #constants }
            }
        }
    });
    let lists = context.groups.iter().map(|group| {
        let symbols = group.symbols.iter().map(|&id| chain.symbol(id));
        let (plain, printed): (Vec<&str>, Vec<&str>) =
            symbols.map(|symbol| (symbol.name.as_str(), symbol.latex.as_str())).unzip();
        let count = count(plain.len());
        let singular = group.singular.to_uppercase();
        let (plain_name, printed_name) =
            (format_ident!("{singular}_NAMES"), format_ident!("{singular}_LATEX"));
        let plain_doc = doc(&format!("The names of the {}s, in order.", group.singular));
        let printed_doc = doc(&format!("The printed forms of the {}s, in LaTeX, in order.", group.singular));
        quote! {
            #plain_doc
            pub const #plain_name: [&'static str; #count] = [#(#plain),*];
            #printed_doc
            pub const #printed_name: [&'static str; #count] = [#(#printed),*];
        }
    });
    let chain_name = &chain.name;
    let observables: TokenStream = observable::ids(chain).map(|id| observable::items(context, id)).collect();
    quote! {
        #documentation
        ///
        /// Angles are radians, lengths metres. `Default` is the instrument as designed.
        #[derive(Debug, Clone, Copy, PartialEq, Default)]
        pub struct #name {
            #(#fields),*
        }

        impl #name {
            /// The declared name.
            pub const NAME: &'static str = #chain_name;
            #(#lists)*
            #new
            #observables
        }
    }
}
