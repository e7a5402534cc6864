//! Rust over structure of arrays: blocks of rows through the paths of [`crate::vector`], and the kernel's text.

use std::fmt::Write;

use model_core::SymbolId;

use super::rust::shape;
use super::rust_block::block;
use super::unit::{Function, Unit, camel_case, form_name};
use crate::vector::{self, Dialect, Line, Rows};

fn loops(unit: &Unit<'_>, function: &Function) -> Rows {
    let name = |id: SymbolId| unit.chain.symbol(id).name.clone();
    let dialect = Dialect {
        name: &name,
        binding: "let",
        mul_add: "arithmetic.mul_add(",
        saturate: "sine_cosine::saturate(",
        step: "sine_cosine::step(",
    };
    vector::rows(&function.program, &dialect)
}

/// What all functions of many poses share: the columns of joints, and what is known of the paths.
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

/// Slices of different lengths, or of more than [`ROWS`] where a block is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LengthsDiffer;

impl core::fmt::Display for LengthsDiffer {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(\"slices of joints and results must be equally long, and no longer than a block where one is filled\")
    }
}

impl core::error::Error for LengthsDiffer {}

/// Rows in a block.
pub const ROWS: usize = sine_cosine::ROWS;

pub use sine_cosine::Path;

/// Which instructions functions over many poses run on here.
#[must_use]
pub fn path_taken() -> Path {
    sine_cosine::path()
}
",
    );
    text
}

/// The module of sines and cosines.
pub(super) fn kernel() -> String {
    let mut text = String::from(
        "\n#[allow(dead_code, unsafe_code, clippy::all, clippy::pedantic)]\nmod sine_cosine {\n",
    );
    for part in vector::RUST {
        text.push_str(part);
    }
    text.push_str("}\n");
    text
}

/// The methods of a form that do many poses, inside its `impl`.
pub(super) fn methods(unit: &Unit<'_>, function: &Function, joints: &[SymbolId]) -> String {
    let loops = loops(unit, function);
    if loops.places.is_empty() {
        return String::new();
    }
    let names: Vec<&str> = joints.iter().map(|&id| unit.chain.symbol(id).name.as_str()).collect();
    let read: Vec<&str> = loops.columns.iter().map(|&id| unit.chain.symbol(id).name.as_str()).collect();
    if function.form.is_jacobian() {
        blocks(unit, function, &loops, &names, &read)
    } else {
        slices(unit, function, &loops, &names, &read)
    }
}

/// What a form needs beside its `impl`: for Jacobians, the type of their blocks.
pub(super) fn items(unit: &Unit<'_>, function: &Function) -> String {
    if !function.form.is_jacobian() {
        return String::new();
    }
    let loops = loops(unit, function);
    let kind = camel_case(form_name(function.form));
    let columns = unit.errors().len();
    let mut places = loops.places.iter();
    let mut fields = String::new();
    for name in unit.observable_names() {
        let _ = writeln!(fields, "            {name}: [");
        for _ in 0..3 {
            let row: Vec<String> =
                places.by_ref().take(columns).map(|place| format!("self.row({place})")).collect();
            let _ = writeln!(fields, "                [{}],", row.join(", "));
        }
        fields.push_str("            ],\n");
    }
    format!(
        "
/// A block of rows of [`{kind}`]: derivatives that are the same function are held once.
#[derive(Debug, Clone, PartialEq)]
#[repr(align(64))]
pub struct {kind}Block {{
    // The columns are longer than a block, so that they do not all meet in the same places of the cache.
    values: [[f64; ROWS + 8]; {distinct}],
}}

impl Default for {kind}Block {{
    fn default() -> Self {{
        {default}
    }}
}}

impl {kind}Block {{
    /// The derivatives, each for all rows.
    #[must_use]
    pub fn observed(&self) -> Observed<{shape}> {{
        Observed {{
{fields}        }}
    }}

    fn row(&self, place: usize) -> &[f64] {{
        &self.values[place][..ROWS]
    }}
}}
",
        default = default_block(&loops),
        distinct = loops.distinct,
        shape = shape(unit, function.form, "&[f64]"),
    )
}

/// A block that holds what is the same in all of them.
fn default_block(loops: &Rows) -> String {
    let fixed: String = loops
        .fixed
        .iter()
        .filter_map(|line| match line {
            Line::Store { place, value } if value != "0.0" => {
                Some(format!("        block.values[{place}] = [{value}; ROWS + 8];\n"))
            }
            _ => None,
        })
        .collect();
    let zeros = format!("Self {{ values: [[0.0; ROWS + 8]; {}] }}", loops.distinct);
    if fixed.is_empty() { zeros } else { format!("let mut block = {zeros};\n{fixed}        block") }
}

/// Forms with few outputs: slices of any length, block by block.
fn slices(unit: &Unit<'_>, function: &Function, loops: &Rows, names: &[&str], read: &[&str]) -> String {
    let outs: Vec<String> = (0..loops.places.len()).map(|index| format!("out{index}")).collect();
    let pattern: String = unit
        .observable_names()
        .zip(outs.chunks(3))
        .fold(String::new(), |text, (name, outs)| format!("{text}{name}: [{}], ", outs.join(", ")));
    let lengths: Vec<String> = names
        .iter()
        .map(|name| format!("joints.{name}.len()"))
        .chain(outs.iter().skip(1).map(|out| format!("{out}.len()")))
        .collect();
    let pose = pose(names, "[row]");
    let each_out = |format: &dyn Fn(&str) -> String| outs.iter().map(|out| format(out)).collect::<String>();
    let each_read =
        |format: &dyn Fn(&str) -> String| read.iter().map(|name| format(name)).collect::<String>();
    format!(
        "
    /// Many poses: as [`Self::eval`], but products may be fused with sums. {ACCURACY}
    ///
    /// # Errors
    /// If the slices of `joints` and `out` are not all equally long; nothing is written then.
    pub fn eval_rows(&self, joints: &Columns<'_>, out: Observed<{shape}>) -> Result<(), LengthsDiffer> {{
        let Observed {{ {pattern}}} = out;
        let rows = out0.len();
        if [{lengths}].iter().any(|&length| length != rows) {{
            return Err(LengthsDiffer);
        }}
        if rows < ROWS {{
            for row in 0..rows {{
                let Observed {{ {pattern_of_numbers}}} = self.eval({pose});
{scalar_stores}            }}
            return Ok(());
        }}

        struct Work<'a> {{
            prepared: &'a [f64; {carried}],
{work_fields}        }}
        impl sine_cosine::Work for Work<'_> {{
            #[inline(always)]
            fn run<A: sine_cosine::Arithmetic>(self, arithmetic: A) {{
                let rows = self.out0.len();
                let mut start = 0;
                while start < rows {{
                    // The last block may do rows again that the one before it did.
                    let first = start.min(rows - ROWS);
{columns_of_block}{outs_of_block}                    compute(arithmetic, self.prepared, {arguments});
                    start += ROWS;
                }}
            }}
        }}
{block}
        sine_cosine::run(sine_cosine::path(), Work {{ prepared: &self.prepared, {work_values} }});
        Ok(())
    }}
",
        shape = shape(unit, function.form, "&mut [f64]"),
        lengths = lengths.join(", "),
        pattern_of_numbers = pattern.replace("out", "value"),
        scalar_stores =
            each_out(&|out| { format!("                {out}[row] = {};\n", out.replace("out", "value")) }),
        carried = function.program.carried().len(),
        work_fields = each_read(&|name| format!("            column_{name}: &'a [f64],\n"))
            + &each_out(&|out| format!("            {out}: &'a mut [f64],\n")),
        columns_of_block = each_read(&|name| format!(
            "                    let Some(column_{name}) = self.column_{name}[first..].first_chunk() else {{ return }};\n"
        )),
        outs_of_block = each_out(&|out| format!(
            "                    let Some({out}) = self.{out}[first..].first_chunk_mut() else {{ return }};\n"
        )),
        arguments = each_read(&|name| format!("column_{name}, ")) + &outs.join(", "),
        block = block(function, loops, read),
        work_values = each_read(&|name| format!("column_{name}: joints.{name}, ")) + &outs.join(", "),
    )
}

/// Jacobians: a block at a time, so that it is still in the cache when it is used.
fn blocks(unit: &Unit<'_>, function: &Function, loops: &Rows, names: &[&str], read: &[&str]) -> String {
    let kind = camel_case(form_name(function.form));
    let each_read =
        |format: &dyn Fn(&str) -> String| read.iter().map(|name| format(name)).collect::<String>();
    let lengths: Vec<String> = names.iter().map(|name| format!("joints.{name}.len()")).collect();
    let each_observable =
        |format: &dyn Fn(&str) -> String| unit.observable_names().map(format).collect::<String>();
    format!(
        "
    /// A block of at most [`ROWS`] poses: as [`Self::eval`], but products may be fused with sums. {ACCURACY}
    ///
    /// # Errors
    /// If the slices of `joints` are not all equally long, or longer than a block; nothing is written then.
    pub fn eval_block(&self, joints: &Columns<'_>, block: &mut {kind}Block) -> Result<(), LengthsDiffer> {{
        let lengths: [usize; {count}] = [{lengths}];
        if lengths.iter().any(|&length| length != lengths[0] || length > ROWS) {{
            return Err(LengthsDiffer);
        }}

        struct Work<'a> {{
            prepared: &'a [f64; {carried}],
{work_fields}            out: &'a mut [[f64; ROWS + 8]; {distinct}],
        }}
        impl sine_cosine::Work for Work<'_> {{
            #[inline(always)]
            fn run<A: sine_cosine::Arithmetic>(self, arithmetic: A) {{
                compute(arithmetic, self.prepared, {arguments}self.out);
            }}
        }}
{block}
        sine_cosine::run(
            sine_cosine::path(),
            Work {{ prepared: &self.prepared, {work_values}out: &mut block.values }},
        );
        Ok(())
    }}

    /// Many poses: as [`Self::eval_block`], block by block. {ACCURACY}
    ///
    /// # Errors
    /// If the slices of `joints` and `out` are not all equally long; nothing is written then.
    pub fn eval_rows(&self, joints: &Columns<'_>, mut out: Observed<{shape}>) -> Result<(), LengthsDiffer> {{
        let lengths: [usize; {count}] = [{lengths}];
        let rows = lengths.first().copied().unwrap_or(0);
        let differs = |length: usize| length != rows;
        if lengths.iter().any(|&length| differs(length)){out_lengths} {{
            return Err(LengthsDiffer);
        }}
        let mut block = {kind}Block::default();
        for start in (0..rows).step_by(ROWS) {{
            let end = rows.min(start + ROWS);
            self.eval_block(&Columns {{ {part} }}, &mut block)?;
            let values = block.observed();
{copies}        }}
        Ok(())
    }}
",
        count = lengths.len(),
        lengths = lengths.join(", "),
        carried = function.program.carried().len(),
        distinct = loops.distinct,
        work_fields = each_read(&|name| format!("            column_{name}: &'a [f64; ROWS],\n")),
        arguments = each_read(&|name| format!("self.column_{name}, ")),
        work_values =
            each_read(&|name| format!("column_{name}: sine_cosine::whole(joints.{name}, &mut None), ")),
        block = block(function, loops, read),
        shape = shape(unit, function.form, "&mut [f64]"),
        out_lengths = each_observable(&|name| format!(
            "\n            || out.{name}.iter().flatten().any(|column| differs(column.len()))"
        )),
        part = names
            .iter()
            .map(|name| format!("{name}: &joints.{name}[start..end]"))
            .collect::<Vec<_>>()
            .join(", "),
        copies = each_observable(&|name| {
            format!(
            "            for (out, values) in out.{name}.iter_mut().flatten().zip(values.{name}.iter().flatten()) {{
                out[start..end].copy_from_slice(&values[..end - start]);
            }}
"
        )
        }),
    )
}

const ACCURACY: &str = "Sines and
    /// cosines are at most 0.9 units in the last place off for angles up to 1e6 rad, and right for any angle.";

/// One pose of columns.
fn pose(names: &[&str], index: &str) -> String {
    let fields: Vec<String> = names.iter().map(|name| format!("{name}: joints.{name}{index}")).collect();
    format!("&Joints {{ {} }}", fields.join(", "))
}
