//! The exact form: the product of the chain's matrices, applied to the observable from the device down.
//!
//! The difference is carried beside the vector itself, with R(ε) − 1 in place of R(ε), so that it keeps full
//! relative precision however small the errors are.

use std::collections::BTreeSet;

use model_core::algebra::{Poly, Rational};
use model_core::{
    Axis, Chain, Factor, Motion, Observable, ObservableId, ObservableKind, SymbolId, SymbolKind,
};
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::Context;
use super::amount::{self, Waves};

/// An amount as designed, and what errors add.
struct Split {
    nominal: Poly,
    error: Poly,
}

fn split(chain: &Chain, amount: &Poly) -> Split {
    let nominal = amount.graded_part(|id| chain.symbol(id).kind == SymbolKind::Error, 0);
    Split { error: amount - &nominal, nominal }
}

/// The factors that move an observable, from the device to the ground.
fn steps(chain: &Chain, id: ObservableId) -> impl Iterator<Item = (&Factor, Split)> {
    let is_point = chain.observable(id).kind == ObservableKind::Point;
    chain
        .factors_to(id)
        .into_iter()
        .rev()
        .filter(move |factor| is_point || factor.motion == Motion::Rotation)
        .map(|factor| (factor, split(chain, &factor.amount)))
}

/// The body of the method that gives the observable without errors, and what errors add to it.
pub fn body(context: &Context<'_>, id: ObservableId) -> TokenStream {
    let chain = context.chain;
    let Observable { components, .. } = chain.observable(id);
    let mut waves = Waves::new();
    for component in components {
        amount::collect_waves(component, &mut waves);
    }
    let mut statements = TokenStream::new();
    for (factor, Split { nominal, error }) in steps(chain, id) {
        match factor.motion {
            Motion::Translation => {
                statements.extend(shift(context, factor.axis, &format_ident!("nominal"), &nominal));
                statements.extend(shift(context, factor.axis, &format_ident!("difference"), &error));
                amount::collect_waves(&nominal, &mut waves);
            }
            Motion::Rotation => {
                if !error.is_zero() {
                    let name = departure_name(factor.axis);
                    let angle = amount::expression(context, &error);
                    statements.extend(quote! { difference += #name(#angle) * (nominal + difference); });
                }
                if !nominal.is_zero() {
                    statements.extend(rotation(context, factor.axis, &nominal));
                }
            }
        }
        amount::collect_waves(&error, &mut waves);
    }
    let waves = amount::wave_statements(context, &waves);
    let components = components.each_ref().map(|component| amount::expression(context, component));
    quote! {
        #waves
        let mut nominal = Vector3::new(#(#components),*);
        let mut difference = Vector3::zeros();
        #statements
        (nominal, difference)
    }
}

fn shift(
    context: &Context<'_>,
    axis: Axis,
    vector: &proc_macro2::Ident,
    amount: &Poly,
) -> Option<TokenStream> {
    if amount.is_zero() {
        return None;
    }
    let component = format_ident!("{}", ["x", "y", "z"][axis.index()]);
    let amount = amount::expression(context, amount);
    Some(quote! { #vector.#component += #amount; })
}

/// A rotation by design; whole quarter turns are exact.
fn rotation(context: &Context<'_>, axis: Axis, amount: &Poly) -> TokenStream {
    let quarters = quarter_turns(amount);
    let turned = Poly::symbol(SymbolId::PI).scale(&(&Rational::from(quarters) * &Rational::half()));
    let rest = amount - &turned;
    let name = rotation_name(axis);
    let (angle, sin, cos) = if rest.is_zero() {
        (quote! {}, quote! { 0.0 }, quote! { 1.0 })
    } else {
        let rest = amount::expression(context, &rest);
        (quote! { let (sin, cos) = ComplexField::sin_cos(#rest); }, quote! { sin }, quote! { cos })
    };
    let (sin, cos) = match quarters.rem_euclid(4) {
        0 => (sin, cos),
        1 => (cos, quote! { -#sin }),
        2 => (quote! { -#sin }, quote! { -#cos }),
        _ => (quote! { -#cos }, sin),
    };
    quote! {
        #angle
        let rotation = #name(#sin, #cos);
        nominal = rotation * nominal;
        difference = rotation * difference;
    }
}

/// The whole quarter turns in an angle.
fn quarter_turns(amount: &Poly) -> i64 {
    amount
        .coefficient_of(&[(SymbolId::PI, 1)], |id| id == SymbolId::PI)
        .as_constant()
        .and_then(|turns| (&turns * &Rational::from(2)).to_integer())
        .unwrap_or_default()
}

fn rotation_name(axis: Axis) -> proc_macro2::Ident {
    format_ident!("rotation_{}", ["x", "y", "z"][axis.index()])
}

fn departure_name(axis: Axis) -> proc_macro2::Ident {
    format_ident!("departure_{}", ["x", "y", "z"][axis.index()])
}

/// The functions for the matrices that the chain's observables need.
pub fn helpers(context: &Context<'_>) -> TokenStream {
    let mut rotations = BTreeSet::new();
    let mut departures = BTreeSet::new();
    for id in super::observable::ids(context.chain) {
        for (factor, Split { nominal, error }) in steps(context.chain, id) {
            if factor.motion == Motion::Rotation {
                rotations.extend((!nominal.is_zero()).then_some(factor.axis));
                departures.extend((!error.is_zero()).then_some(factor.axis));
            }
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
