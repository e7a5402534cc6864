//! A snapshot of an expansion, formatted, and where its names point.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::str::FromStr;

use proc_macro2::{TokenStream, TokenTree};

use super::{Names, module};

/// The file that `cargo clippy` sees as if it were written by hand: the root's tests warn of everything pedantic.
const CHECKED_BY_CLIPPY: &str = "../tests/macros/expanded.rs";

fn read(path: &str) -> String {
    fs::read_to_string(format!("../{path}.chain")).unwrap()
}

fn expand(text: &str) -> TokenStream {
    let (declaration, chain) = model_core::validate::read(TokenStream::from_str(text).unwrap()).unwrap();
    module(&chain, &Names::of(&declaration)).unwrap()
}

fn formatted(tokens: TokenStream) -> String {
    prettyplease::unparse(&syn::parse2(tokens).unwrap())
}

#[test]
fn expansion_of_a_turntable() {
    insta::assert_snapshot!("turntable", formatted(expand(&read("tests/chains/turntable"))));
}

#[test]
fn the_file_that_clippy_sees_is_the_expansion() {
    let current = format!(
        "//! The expansion of `thermal.chain`, for `cargo clippy`: written by the tests of `model-macros`\n\
         //! with `UPDATE_EXPANDED=1`.\n\n{}",
        formatted(expand(&read("tests/chains/thermal")))
    );
    if std::env::var_os("UPDATE_EXPANDED").is_some() {
        fs::write(CHECKED_BY_CLIPPY, &current).unwrap();
    }
    assert!(fs::read_to_string(CHECKED_BY_CLIPPY).unwrap() == current, "run with UPDATE_EXPANDED=1");
}

/// Editors go from a field to the token that it came from.
#[test]
fn fields_and_methods_point_at_the_declaration() {
    let text = "chain Mount {\n    const arm: length = 1;\n    body fork on ground {\n        motion: Rz(alpha);\n        \
                motion_error: Tx(shift);\n    }\n    input range: length;\n    \
                observe lens: point(arm, 0, range) of fork;\n}";
    let expansion = expand(text);
    for (name, line) in [("arm", 2), ("alpha", 4), ("shift", 5), ("range", 7), ("lens", 8), ("Mount", 1)] {
        let lines = lines_of(&expansion, name);
        assert!(!lines.is_empty(), "{name} occurs");
        assert!(lines.iter().all(|&found| found == line), "{name}: {lines:?}");
    }
}

/// The lines of the declaration that an identifier of the expansion points at.
fn lines_of(tokens: &TokenStream, name: &str) -> Vec<usize> {
    let mut lines = Vec::new();
    for token in tokens.clone() {
        match token {
            TokenTree::Group(group) => lines.extend(lines_of(&group.stream(), name)),
            TokenTree::Ident(ident) if ident == name => lines.push(ident.span().start().line),
            _ => {}
        }
    }
    lines
}

#[test]
fn names_that_would_clash_are_refused() {
    for (text, message) in [
        ("chain Errors {}", "`Errors` is a type that every chain's module has"),
        ("chain Move {}", "the module of `Move` cannot be named `move`"),
        (
            "chain Mount { body fork on ground { motion: Rz(alpha); }
             observe sight: direction(1, 0, 0) of fork; observe sight_error: direction(0, 1, 0) of fork; }",
            "the observable `sight_error` needs the method `sight_error`, which exists already",
        ),
    ] {
        let (declaration, chain) = model_core::validate::read(TokenStream::from_str(text).unwrap()).unwrap();
        let mistakes = module(&chain, &Names::of(&declaration)).unwrap_err();
        assert_eq!(mistakes.iter().map(|mistake| mistake.message.as_str()).collect::<Vec<_>>(), [message]);
    }
}
