//! Reading the file of `chain_file!`.

use std::path::Path;

use model_core::{Chain, Mistakes};
use proc_macro2::{Span, TokenStream};
use quote::quote;

use crate::expand::{self, Names};
use crate::report;

/// The expansion of the file that a string literal names, which stands at `span`, or a message.
pub fn expand(input: TokenStream, span: Span) -> Result<TokenStream, String> {
    let path = syn::parse2::<syn::LitStr>(input)
        .map_err(|_| {
            "expected the path of a file in quotes: write `chain_file!(\"instruments/lidar.chain\")`"
                .to_owned()
        })?
        .value();
    let package = std::env::var("CARGO_MANIFEST_DIR")
        .map_err(|_| "the package's directory is not known: build with cargo".to_owned())?;
    let text = std::fs::read_to_string(Path::new(&package).join(&path)).map_err(|error| {
        format!("cannot read `{path}` in the directory of the package's Cargo.toml: {error}")
    })?;
    let chain = read(&text).map_err(|mistakes| format!("in `{path}`\n{}", mistakes.render(&path, &text)))?;
    let module = expand::module(&chain, &Names::default()).map_err(|mistakes| {
        mistakes.iter().map(|mistake| mistake.message.as_str()).collect::<Vec<_>>().join("\n")
    })?;
    let doubts = report::doubts(&chain, &Names::default(), span);
    Ok(quote! {
        #module
        #doubts
        // The compiler rebuilds what includes a file when the file changes.
        const _: &[u8] = ::core::include_bytes!(::core::concat!(::core::env!("CARGO_MANIFEST_DIR"), "/", #path));
    })
}

/// Reads a chain with places counted in the text: the compiler's own tokens of a text have none.
fn read(text: &str) -> Result<Chain, Mistakes> {
    struct CompilerTokensAgain;
    impl Drop for CompilerTokensAgain {
        fn drop(&mut self) {
            proc_macro2::fallback::unforce();
        }
    }
    proc_macro2::fallback::force();
    let _guard = CompilerTokensAgain;
    Chain::from_text(text)
}
