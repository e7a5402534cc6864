//! `trueaxis export`: a calibrated instrument in the form of another program.

#[path = "../support/mod.rs"]
mod support;

mod dh;
mod refused;
mod tables;
mod tpoint;
mod ur;
mod urdf;

use support::Run;

/// An instrument file with a declaration, errors and what else is given.
fn instrument(chain: &str, errors: &str, more: &str) -> String {
    format!("instrument = 1\nchain = '''\n{chain}'''\n[errors]\n{errors}\n{more}")
}

/// What an export prints, its blanks made one.
fn said(run: &Run) -> String {
    assert_eq!(run.code, 0, "{run}");
    run.stdout.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What was written is the instrument, up to rounding.
fn is_exact(said: &str) {
    assert!(said.contains("differs from the instrument by nothing but rounding"), "{said}");
}
