//! Amounts as Rust expressions of the symbols: `errors.sag * cos_beta`.

use std::collections::BTreeSet;

use model_core::algebra::{Poly, Rational, Term, Wave};
use model_core::ramp::Ramp;
use model_core::{SymbolId, SymbolKind};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::Context;

/// A number.
pub fn number(value: f64) -> TokenStream {
    if value.is_nan() {
        return quote! { f64::NAN };
    }
    let size = if value.is_infinite() {
        quote! { f64::INFINITY }
    } else {
        let literal = Literal::f64_unsuffixed(value.abs());
        quote! { #literal }
    };
    if value < 0.0 {
        quote! { -#size }
    } else {
        size
    }
}

/// The value of a symbol, where `errors` and `constants` are fields of `self` and `joints` and `inputs` arguments.
pub fn symbol(context: &Context<'_>, id: SymbolId) -> TokenStream {
    let symbol = context.chain.symbol(id);
    let name = context.names.symbol(&symbol.name);
    match (symbol.kind, context.group(symbol.kind)) {
        (SymbolKind::Error | SymbolKind::Constant, Some(group)) => {
            let field = &group.field;
            quote! { self.#field.#name }
        }
        (SymbolKind::Joint | SymbolKind::Input, Some(group)) => {
            let field = &group.field;
            quote! { #field.#name }
        }
        (SymbolKind::Ramp, _) => match context.chain.ramp(id) {
            Some(of) => ramp(context, of),
            None => unreachable!("every symbol of this kind is a ramp of its chain"),
        },
        _ => quote! { ::core::f64::consts::PI },
    }
}

/// The value of a ramp.
fn ramp(context: &Context<'_>, ramp: &Ramp) -> TokenStream {
    let (at, from, to) =
        (symbol(context, ramp.of), expression(context, &ramp.from), expression(context, &ramp.to));
    if ramp.is_step() {
        step(&quote! { #at - (#from) })
    } else {
        saturate(&quote! { (#at - (#from)) / (#to - (#from)) })
    }
}

/// A value between 0 and 1, and the nearer of the two outside; NaN stays NaN.
pub fn saturate(value: &TokenStream) -> TokenStream {
    quote! { f64::clamp(#value, 0.0, 1.0) }
}

/// 1 where a value is at least 0, else 0; NaN stays NaN.
pub fn step(value: &TokenStream) -> TokenStream {
    quote! { { let ramp: f64 = #value; if ramp >= 0.0 { 1.0 } else if ramp < 0.0 { 0.0 } else { ramp } } }
}

/// The sines and cosines that amounts use: angles with their multiples.
pub type Waves = BTreeSet<(SymbolId, u32)>;

/// Adds the sines and cosines of an amount.
pub fn collect_waves(amount: &Poly, waves: &mut Waves) {
    for term in amount.terms() {
        waves.extend(term.waves.iter().map(|wave| (wave.symbol, wave.harmonic)));
        waves.extend(term.poles.iter().map(|pole| (pole.symbol, 1)));
    }
}

/// `let (sin_beta, cos_beta) = …;` for each sine and cosine.
pub fn wave_statements(context: &Context<'_>, waves: &Waves) -> TokenStream {
    waves
        .iter()
        .map(|&(id, harmonic)| {
            let (sin, cos) =
                (wave_name(context, id, harmonic, Wave::Sin), wave_name(context, id, harmonic, Wave::Cos));
            let value = symbol(context, id);
            let angle = match harmonic {
                1 => value,
                _ => {
                    let multiple = number(f64::from(harmonic));
                    quote! { #multiple * #value }
                }
            };
            quote! { let (#sin, #cos) = ComplexField::sin_cos(#angle); }
        })
        .collect()
}

fn wave_name(context: &Context<'_>, id: SymbolId, harmonic: u32, wave: Wave) -> Ident {
    let function = match wave {
        Wave::Sin => "sin",
        Wave::Cos => "cos",
    };
    let name = &context.chain.symbol(id).name;
    match harmonic {
        1 => format_ident!("{function}_{name}"),
        _ => format_ident!("{function}_{harmonic}_{name}"),
    }
}

/// The expression of an amount; its sines and cosines are variables.
pub fn expression(context: &Context<'_>, amount: &Poly) -> TokenStream {
    let mut sum = TokenStream::new();
    for term in amount.terms() {
        let product = product(context, &term);
        sum.extend(match (term.coefficient.is_negative(), sum.is_empty()) {
            (true, _) => quote! { - #product },
            (false, true) => product,
            (false, false) => quote! { + #product },
        });
    }
    if sum.is_empty() {
        quote! { 0.0 }
    } else {
        sum
    }
}

/// A term without its sign.
fn product(context: &Context<'_>, term: &Term) -> TokenStream {
    let mut factors: Vec<TokenStream> = Vec::new();
    let size: Rational = term.coefficient.abs();
    if !size.is_one() {
        factors.push(number(size.to_f64()));
    }
    for &(id, power) in &term.powers {
        let value = symbol(context, id);
        factors.extend(std::iter::repeat_n(value, power as usize));
    }
    for wave in &term.waves {
        let name = wave_name(context, wave.symbol, wave.harmonic, wave.wave);
        factors.push(quote! { #name });
    }
    let mut product =
        factors.into_iter().reduce(|left, right| quote! { #left * #right }).unwrap_or(quote! { 1.0 });
    for pole in &term.poles {
        for (wave, power) in [(Wave::Sin, pole.sin_power), (Wave::Cos, pole.cos_power)] {
            let name = wave_name(context, pole.symbol, 1, wave);
            for _ in 0..power {
                product = quote! { #product / #name };
            }
        }
    }
    product
}
