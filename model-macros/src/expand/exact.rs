//! The exact form: the product of the chain's matrices, applied to the observable from the device down.
//!
//! The difference is carried beside the vector itself, with R(ε) − 1 in place of R(ε), so that it keeps full
//! relative precision however small the errors are.

use std::collections::BTreeSet;

use codegen::build::Step;
use codegen::matrix_product;
use model_core::{Axis, ObservableId};
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::tokens::tokens;
use super::{Context, stages};

/// The body of the method that gives the observable without errors, and what errors add to it.
pub fn body(context: &Context<'_>, id: ObservableId) -> TokenStream {
    let product = matrix_product(context.chain, id);
    let code = stages(context, &product.program);
    let statements = code.both_stages();
    let outputs: Vec<TokenStream> = code.outputs.iter().map(|text| tokens(text, context.names)).collect();
    let (nominal, difference) = (&outputs[..3], &outputs[3..6]);
    let steps = product.steps.iter().map(|step| match *step {
        Step::SmallRotation { axis, angle } => {
            let (name, angle) = (departure_name(axis), &outputs[angle]);
            quote! { difference += #name(#angle) * (nominal + difference); }
        }
        Step::SmallShift { axis, amount } => {
            let (component, amount) = (component(axis), &outputs[amount]);
            quote! { difference.#component += #amount; }
        }
        Step::Rotation { axis, sin, cos } => {
            let (name, sin, cos) = (rotation_name(axis), &outputs[sin], &outputs[cos]);
            quote! {
                let rotation = #name(#sin, #cos);
                (nominal, difference) = (rotation * nominal, rotation * difference);
            }
        }
        Step::Shift { axis, amount } => {
            let (component, amount) = (component(axis), &outputs[amount]);
            quote! { nominal.#component += #amount; }
        }
    });
    quote! {
        #statements
        let mut nominal = Vector3::new(#(#nominal),*);
        let mut difference = Vector3::new(#(#difference),*);
        #(#steps)*
        (nominal, difference)
    }
}

fn component(axis: Axis) -> Ident {
    format_ident!("{}", axis.to_string())
}

fn rotation_name(axis: Axis) -> Ident {
    format_ident!("rotation_{}", axis.to_string())
}

fn departure_name(axis: Axis) -> Ident {
    format_ident!("departure_{}", axis.to_string())
}

/// The functions for the matrices that the chain's observables need.
pub fn helpers(context: &Context<'_>) -> TokenStream {
    let mut rotations = BTreeSet::new();
    let mut departures = BTreeSet::new();
    let vectors = super::ids(context.chain).filter(|&id| context.chain.observable(id).is_vector());
    for id in vectors {
        for step in matrix_product(context.chain, id).steps {
            match step {
                Step::Rotation { axis, .. } => rotations.insert(axis),
                Step::SmallRotation { axis, .. } => departures.insert(axis),
                Step::Shift { .. } | Step::SmallShift { .. } => false,
            };
        }
    }
    let rotations = rotations.into_iter().map(|axis| {
        let name = rotation_name(axis);
        let matrix = match axis {
            Axis::X => quote! { 1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos },
            Axis::Y => quote! { cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos },
            Axis::Z => quote! { cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0 },
        };
        quote! {
            /// The rotation by the angle that has this sine and cosine.
            fn #name(sin: f64, cos: f64) -> Matrix3<f64> {
                Matrix3::new(#matrix)
            }
        }
    });
    let departures = departures.into_iter().map(|axis| {
        let name = departure_name(axis);
        let matrix = match axis {
            Axis::X => quote! { 0.0, 0.0, 0.0, 0.0, -versine, -sine, 0.0, sine, -versine },
            Axis::Y => quote! { -versine, 0.0, sine, 0.0, 0.0, 0.0, -sine, 0.0, -versine },
            Axis::Z => quote! { -versine, -sine, 0.0, sine, -versine, 0.0, 0.0, 0.0, 0.0 },
        };
        quote! {
            /// The rotation by an angle, less the identity: without cancellation for small angles.
            fn #name(angle: f64) -> Matrix3<f64> {
                let (sin, cos) = ComplexField::sin_cos(0.5 * angle);
                let (sine, versine) = (2.0 * sin * cos, 2.0 * sin * sin);
                Matrix3::new(#matrix)
            }
        }
    });
    quote! { #(#rotations)* #(#departures)* }
}
