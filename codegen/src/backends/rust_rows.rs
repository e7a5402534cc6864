//! Rust over structure of arrays: the loop around the evaluated stage, and the kernel's text.

use std::fmt::Write;

use model_core::{SymbolId, SymbolKind};

use super::listing::list;
use super::rust::{Names, shape, statements};
use super::unit::{Function, Unit};
use crate::vector;

/// What all functions of a file share: the columns of joints, and the module of sines and cosines.
pub(super) fn shared(unit: &Unit<'_>, joints: &[SymbolId]) -> String {
    let mut text = String::from(
        "\n/// [`Joints`] of many poses: a slice for each, all equally long.\n#[derive(Debug, Clone, Copy, Default)]\n#[allow(non_snake_case)]\npub struct Columns<'a> {\n",
    );
    for &id in joints {
        let _ = writeln!(
            text,
            "    /// {}\n    pub {}: &'a [f64],",
            unit.describe(id),
            unit.chain.symbol(id).name
        );
    }
    text.push_str(
        "}

/// Slices of different lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LengthsDiffer;

",
    );
    text.push_str("#[allow(dead_code, unsafe_code, clippy::all, clippy::pedantic)]\nmod sine_cosine {\n");
    for part in vector::RUST {
        text.push_str(part);
    }
    text.push_str("}\n");
    text
}

/// The method of a form that does many poses, inside its `impl`.
pub(super) fn method(unit: &Unit<'_>, function: &Function, joints: &[SymbolId]) -> String {
    let chain = unit.chain;
    let symbol = |id: SymbolId| match chain.symbol(id).kind {
        SymbolKind::Joint | SymbolKind::Input => format!("joints.{}[row]", chain.symbol(id).name),
        SymbolKind::Pi | SymbolKind::Error | SymbolKind::Constant => String::new(),
    };
    let names = Names { chain, symbol: &symbol, carried: &|index| format!("p[{index}]") };
    let listing = list(&function.program, &names);
    let columns = if function.form.is_jacobian() { unit.errors().len() } else { 1 };
    let places = unit.observable_names().flat_map(|name| {
        (0..3).flat_map(move |component| {
            (0..columns).map(move |column| {
                if function.form.is_jacobian() {
                    format!("out.{name}[{component}][{column}]")
                } else {
                    format!("out.{name}[{component}]")
                }
            })
        })
    });
    let places: Vec<String> = places.collect();
    let Some(first) = places.first() else { return String::new() };
    let mut text = String::new();
    let shape = shape(unit, function.form, "&mut [f64]");
    let _ = writeln!(
        text,
        "
    /// Many poses, each as [`Self::eval`] has it up to the last place of its sines and cosines.
    ///
    /// # Errors
    /// If the slices of `joints` and `out` are not all equally long; nothing is written then.
    pub fn eval_rows(&self, joints: &Columns<'_>, out: Observed<{shape}>) -> Result<(), LengthsDiffer> {{
        let rows = {first}.len();"
    );
    let lengths = joints
        .iter()
        .map(|&id| format!("joints.{}", chain.symbol(id).name))
        .chain(places.iter().skip(1).cloned());
    for slice in lengths {
        let _ = writeln!(text, "        if {slice}.len() != rows {{ return Err(LengthsDiffer); }}");
    }
    let _ = writeln!(
        text,
        "        let p = &self.prepared;
        for row in 0..rows {{
{}{}        }}
        Ok(())
    }}",
        statements(&listing.evaluated, "sine_cosine::sin_cos", 12),
        places.iter().zip(&listing.outputs).fold(String::new(), |text, (place, value)| format!(
            "{text}            {place}[row] = {value};\n"
        )),
    );
    text
}
