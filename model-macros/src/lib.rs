//! `chain!` and `chain_file!`: thin macros that parse and check with `model-core`, and expand.
//!
//! Text or tokens → declaration and chain (`model-core`) → `expand`; mistakes become compiler errors at the
//! token at fault.

mod expand;
mod file;
mod report;

use proc_macro2::Span;
use quote::quote;

use expand::Names;

/// Declares an instrument and expands to a module with its evaluators.
///
/// ```text
/// trueaxis::chain! {
///     /// A turntable.
///     chain Turntable {
///         body table on ground {
///             position_error: Rx(tilt_x), Ry(tilt_y);
///             motion:         Rz(alpha);
///         }
///         observe arm: direction(1, 0, 0) of table;
///     }
/// }
///
/// let table = turntable::Turntable::new(turntable::Errors { tilt_x: 1e-5, ..Default::default() });
/// let error = table.arm_error(&turntable::Joints { alpha: 0.3 });
/// ```
///
/// The module has the chain's name in snake case. In it are the type of the chain; `Errors`, `Joints`, `Inputs`
/// and `Constants` with a documented field for each symbol; and, for each observable `arm`, the methods `arm`
/// (its value), `arm_error` (exact), `arm_first_order` and `arm_jacobian`, and the same over slices. The book's
/// chapter on the macro shows the whole of it.
#[proc_macro]
pub fn chain(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let result = model_core::validate::read(input.into()).and_then(|(declaration, chain)| {
        let names = Names::of(&declaration);
        let module = expand::module(&chain, &names)?;
        let doubts = report::doubts(&chain, &names, Span::call_site());
        Ok(quote! { #module #doubts })
    });
    result.unwrap_or_else(|mistakes| report::at_tokens(&mistakes)).into()
}

/// Expands the declaration in a `.chain` file, as [`chain!`] does; the crate is rebuilt when the file changes.
///
/// The path is relative to the directory of the package's `Cargo.toml`.
///
/// ```text
/// trueaxis::chain_file!("instruments/turntable.chain");
/// ```
#[proc_macro]
pub fn chain_file(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let span = proc_macro2::TokenStream::from(input.clone())
        .into_iter()
        .next()
        .map_or_else(Span::call_site, |token| token.span());
    file::expand(input.into(), span).unwrap_or_else(|message| report::at(span, &message)).into()
}
