//! The structs of joints, inputs, errors and constants.

use model_core::{Chain, Quantity, Symbol, SymbolId, SymbolKind};
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::{Context, count, doc};

/// The symbols of one kind, as one struct.
pub struct Group {
    /// What they are for.
    pub kind: SymbolKind,
    /// `joint`
    pub singular: &'static str,
    /// The variable or field that holds them: `joints`.
    pub field: Ident,
    /// The type of one set of them: `Joints`.
    pub type_name: Ident,
    /// The symbols, in order.
    pub symbols: Vec<SymbolId>,
}

/// The groups that a chain has symbols of.
pub fn groups(chain: &Chain) -> Vec<Group> {
    [
        (SymbolKind::Joint, "joint", "joints", "Joints"),
        (SymbolKind::Input, "input", "inputs", "Inputs"),
        (SymbolKind::Error, "error", "errors", "Errors"),
        (SymbolKind::Constant, "constant", "constants", "Constants"),
    ]
    .into_iter()
    .map(|(kind, singular, field, type_name)| Group {
        kind,
        singular,
        field: format_ident!("{field}"),
        type_name: format_ident!("{type_name}"),
        symbols: chain.symbols_of(kind).collect(),
    })
    .filter(|group| !group.symbols.is_empty())
    .collect()
}

/// Every item of a group.
pub fn items(context: &Context<'_>, group: &Group) -> TokenStream {
    let structure = structure(context, group);
    let conversions = match group.kind {
        SymbolKind::Joint | SymbolKind::Input => {
            let (arrays, slices) = (arrays(context, group), slices(context, group));
            quote! { #arrays #slices }
        }
        SymbolKind::Error => arrays(context, group),
        _ => declared_values(context, group),
    };
    quote! { #structure #conversions }
}

fn structure(context: &Context<'_>, group: &Group) -> TokenStream {
    let Group { kind, type_name, symbols, .. } = group;
    let (documentation, default) = match kind {
        SymbolKind::Joint => ("Where the joints stand, by their encoders.", quote! { Default, }),
        SymbolKind::Input => ("What is measured beside the joints.", quote! { Default, }),
        SymbolKind::Error => ("The errors; `Default` is the instrument without any.", quote! { Default, }),
        _ => ("The sizes of the geometry; `Default` is as declared.", quote! {}),
    };
    let fields = symbols.iter().map(|&id| {
        let symbol = context.chain.symbol(id);
        let field = context.names.symbol(&symbol.name);
        let documentation = doc(&meaning(symbol));
        quote! { #documentation pub #field: f64 }
    });
    let documentation = doc(documentation);
    quote! {
        #documentation
        #[derive(Debug, Clone, Copy, PartialEq, #default)]
        pub struct #type_name {
            #(#fields),*
        }
    }
}

/// The documentation of a field: the declaration's own, unit and printed form.
fn meaning(symbol: &Symbol) -> String {
    let unit = match symbol.quantity {
        Quantity::Angle => "In radians",
        Quantity::Length => "In metres",
        Quantity::Number => "A number, in the unit of the data",
    };
    let value = match (symbol.kind, symbol.value) {
        (SymbolKind::Constant, Some(value)) => format!("; {value} as declared"),
        _ => String::new(),
    };
    let note = format!("{unit}{value}; printed as `{}`.", symbol.latex);
    if symbol.documentation.is_empty() { note } else { format!("{}\n\n{note}", symbol.documentation) }
}

/// To and from an array, in order; that of errors is the order of the Jacobians' columns.
fn arrays(context: &Context<'_>, group: &Group) -> TokenStream {
    let Group { field: variable, type_name, symbols, .. } = group;
    let fields: Vec<Ident> = fields(context, symbols).collect();
    let count = count(fields.len());
    quote! {
        impl From<[f64; #count]> for #type_name {
            fn from([#(#fields),*]: [f64; #count]) -> Self {
                Self { #(#fields),* }
            }
        }

        impl From<#type_name> for [f64; #count] {
            fn from(#variable: #type_name) -> Self {
                [#(#variable.#fields),*]
            }
        }
    }
}

fn declared_values(context: &Context<'_>, group: &Group) -> TokenStream {
    let Group { type_name, symbols, .. } = group;
    let fields = symbols.iter().map(|&id| {
        let symbol = context.chain.symbol(id);
        let field = context.names.symbol(&symbol.name);
        let value = super::amount::number(symbol.value.unwrap_or_default());
        quote! { #field: #value }
    });
    quote! {
        impl Default for #type_name {
            fn default() -> Self {
                Self { #(#fields),* }
            }
        }
    }
}

/// The same symbols for many poses: a slice for each.
fn slices(context: &Context<'_>, group: &Group) -> TokenStream {
    let Group { type_name, singular, symbols, .. } = group;
    let name = slices_name(group);
    let documentation =
        doc(&format!("The {singular}s of many poses: a slice for each {singular}, all of one length."));
    let fields: Vec<Ident> = fields(context, symbols).collect();
    let meanings = symbols.iter().map(|&id| doc(&meaning(context.chain.symbol(id))));
    quote! {
        #documentation
        #[derive(Debug, Clone, Copy)]
        pub struct #name<'a> {
            #(#meanings pub #fields: &'a [f64]),*
        }

        impl #name<'_> {
            fn have_length(&self, length: usize) -> bool {
                [#(self.#fields.len()),*].iter().all(|&other| other == length)
            }

            fn at(&self, pose: usize) -> #type_name {
                #type_name { #(#fields: self.#fields[pose]),* }
            }
        }
    }
}

/// `JointSlices`
pub fn slices_name(group: &Group) -> Ident {
    let type_name = group.type_name.to_string();
    format_ident!("{}Slices", type_name.trim_end_matches('s'))
}

fn fields<'a>(context: &'a Context<'_>, symbols: &'a [SymbolId]) -> impl Iterator<Item = Ident> + 'a {
    symbols.iter().map(|&id| context.names.symbol(&context.chain.symbol(id).name))
}

/// The error of the methods over slices.
pub fn unequal_lengths() -> TokenStream {
    quote! {
        /// The slices that were given have different lengths.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub struct UnequalLengths;

        impl ::core::fmt::Display for UnequalLengths {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                f.write_str("the slices have different lengths")
            }
        }

        impl ::core::error::Error for UnequalLengths {}
    }
}
