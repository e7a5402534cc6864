//! A straight-line program as Rust statements.

use codegen::{NodeId, Op, Program, Stage};
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::Context;
use super::amount::{number, saturate, step, symbol};

/// The statements of one stage; nodes of the other are known by name.
pub fn statements(context: &Context<'_>, program: &Program, stage: Stage) -> TokenStream {
    program.stage(stage).map(|(id, op)| statement(context, program, id, op)).collect()
}

/// The outputs as expressions.
pub fn outputs(context: &Context<'_>, program: &Program) -> Vec<TokenStream> {
    program.outputs().iter().map(|&id| operand(context, program, id)).collect()
}

/// A node as an operand: numbers and symbols as they are, what is computed by its name.
fn operand(context: &Context<'_>, program: &Program, id: NodeId) -> TokenStream {
    match program.nodes()[id.index()] {
        Op::Constant(literal) => number(literal.value()),
        Op::Input(id) => symbol(context, id),
        _ => {
            let name = name(id);
            quote! { #name }
        }
    }
}

fn statement(context: &Context<'_>, program: &Program, id: NodeId, op: Op) -> TokenStream {
    let name = name(id);
    let read = |id| operand(context, program, id);
    let value = match op {
        Op::Constant(_) | Op::Input(_) => return TokenStream::new(),
        Op::Neg(a) => {
            let a = read(a);
            quote! { -#a }
        }
        Op::Add(a, b) => {
            let (a, b) = (read(a), read(b));
            quote! { #a + #b }
        }
        Op::Sub(a, b) => {
            let (a, b) = (read(a), read(b));
            quote! { #a - #b }
        }
        Op::Mul(a, b) => {
            let (a, b) = (read(a), read(b));
            quote! { #a * #b }
        }
        Op::Div(a, b) => {
            let (a, b) = (read(a), read(b));
            quote! { #a / #b }
        }
        Op::Saturate(a) => {
            let a = read(a);
            saturate(&a)
        }
        Op::Step(a) => {
            let a = read(a);
            step(&a)
        }
        Op::Sin(angle) => match other_wave(program, id, Op::Cos(angle)) {
            Some(cos) if cos < id => return TokenStream::new(),
            Some(cos) => {
                let (angle, cos) = (read(angle), self::name(cos));
                return quote! { let (#name, #cos) = ComplexField::sin_cos(#angle); };
            }
            None => {
                let angle = read(angle);
                quote! { ComplexField::sin(#angle) }
            }
        },
        Op::Cos(angle) => match other_wave(program, id, Op::Sin(angle)) {
            Some(sin) if sin < id => return TokenStream::new(),
            Some(sin) => {
                let (angle, sin) = (read(angle), self::name(sin));
                return quote! { let (#sin, #name) = ComplexField::sin_cos(#angle); };
            }
            None => {
                let angle = read(angle);
                quote! { ComplexField::cos(#angle) }
            }
        },
    };
    quote! { let #name = #value; }
}

/// The node of the same angle's other function, if the program has it: both are computed where the first stands.
fn other_wave(program: &Program, id: NodeId, wanted: Op) -> Option<NodeId> {
    program.stage(program.stage_of(id)).find(|&(_, op)| op == wanted).map(|(other, _)| other)
}

fn name(id: NodeId) -> Ident {
    format_ident!("t{}", id.index())
}
