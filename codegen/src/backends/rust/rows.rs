//! Rust over structure of arrays: what a form has for many poses, and the text of the kernel.

use super::File;
use super::code::{Constants, Rust};
use super::types::{ALLOW, rows_name};
use crate::backends::names::camel_case;
use crate::backends::notation::Scope;
use crate::backends::unit::{Function, Group, Precision, Shared, form_name};
use crate::lower::{Block, Fixed, block};
use crate::vector;

const ACCURACY: &str = "Sines and
    /// cosines are at most 0.9 units in the last place off for angles up to 1e6 rad, and right for any angle.";

/// What functions of many poses have in common.
pub(super) const SHARED: &str = "
/// Rows in a block.
#[allow(dead_code)]
pub const ROWS: usize = sine_cosine::ROWS;

#[allow(unused_imports)]
pub use sine_cosine::Path;

/// Which instructions functions of many poses run on here.
#[must_use]
#[allow(dead_code)]
pub fn path_taken() -> Path {
    sine_cosine::path()
}
";

/// The module of sines and cosines, with no more than the file needs.
pub(super) fn kernel(shared: &Shared<'_>) -> String {
    let [paths, kernel, wide, blocks] = vector::RUST;
    let text = match (shared.unit.precision, shared.has_rows()) {
        (Precision::Single, _) => vector::RUST_SINGLE.to_owned(),
        (Precision::Double, true) => [paths, kernel, wide, blocks].concat(),
        (Precision::Double, false) => [paths, kernel, wide].concat(),
    };
    format!(
        "\n#[allow(dead_code, unsafe_code, clippy::all, clippy::pedantic)]\nmod sine_cosine {{\n{text}}}\n"
    )
}

/// What of a form is done for a block of rows. A Jacobian's block has its fixed values from the start.
fn lowered(function: &Function) -> Block {
    block(&function.program, if function.form.is_jacobian() { Fixed::Before } else { Fixed::InLoop })
}

/// The methods of a form that do many poses, inside its `impl`.
pub(super) fn methods(file: &File<'_>, function: &Function) -> String {
    if function.form.is_jacobian() { of_jacobian(file, function) } else { of_components(file, function) }
}

/// What a form needs beside its `impl`.
pub(super) fn items(file: &File<'_>, function: &Function) -> String {
    let lowered = lowered(function);
    let mut text = compute(file, function, &lowered);
    if function.form.is_jacobian() {
        text.push_str(&jacobian_block(file, function, &lowered));
    }
    text
}

/// `joints: &JointRows<'_>, inputs: &InputRows<'_>`
fn parameters(file: &File<'_>) -> String {
    file.of_pose(&|group| format!("{}: &{}<'_>", group.argument, rows_name(group)))
}

/// Whether all slices of joints and inputs have as many rows.
fn have_length(file: &File<'_>) -> String {
    file.shared
        .pose
        .iter()
        .map(|group| format!("{}.have_length(rows)", group.argument))
        .collect::<Vec<_>>()
        .join(" && ")
}

/// The columns that a block reads: `joints.alpha`, `inputs.range`.
fn columns(file: &File<'_>, lowered: &Block) -> Vec<String> {
    let column = |&id| {
        let holds = |group: &&Group| group.symbols.contains(&id);
        let group = file.shared.pose.iter().find(holds).map_or("", |group| group.argument);
        format!("{group}.{}", file.names.symbol(id))
    };
    lowered.columns.iter().map(column).collect()
}

/// `mark: [out0, out1, out2], rim: […]`
fn pattern(file: &File<'_>, name: &str) -> String {
    let count = file.shared.unit.observables.iter().map(|&id| file.shared.shown(id)).sum::<usize>();
    let places: Vec<String> = (0..count).map(|place| format!("{name}{place}")).collect();
    let fields = file.shared.by_observable(&places).into_iter();
    let fields = fields.map(|(id, places)| format!("{}: [{}]", file.names.observable(id), places.join(", ")));
    fields.collect::<Vec<_>>().join(", ")
}

/// Forms with few outputs: slices of any length, block by block.
fn of_components(file: &File<'_>, function: &Function) -> String {
    let lowered = lowered(function);
    let outs: Vec<String> = (0..lowered.places.len()).map(|index| format!("out{index}")).collect();
    let (shape, parameters) = (file.shape(function.form, "&mut [f64]"), parameters(file));
    let (slices, numbers) = (pattern(file, "out"), pattern(file, "value"));
    let have_length = have_length(file);
    let out_lengths: Vec<String> = outs.iter().map(|out| format!("{out}.len()")).collect();
    let (out_lengths, out) = (out_lengths.join(", "), outs.join(", "));
    let pose = file.of_pose(&|group| format!("&{}.at(row)", group.argument));
    let stores: String =
        (0..outs.len()).map(|index| format!("                out{index}[row] = value{index};\n")).collect();
    let columns = columns(file, &lowered).join(", ");
    format!(
        "
    /// Many poses: as [`Self::eval`], but products may be fused with sums. {ACCURACY}
    ///
    /// # Errors
    /// If the slices are not all equally long; nothing is written then.
    pub fn eval_rows(&self, {parameters}, out: Observed<{shape}>) -> Result<(), LengthsDiffer> {{
        let Observed {{ {slices} }} = out;
        let rows = out0.len();
        if !({have_length} && [{out_lengths}].iter().all(|&length| length == rows)) {{
            return Err(LengthsDiffer);
        }}
        if rows < ROWS {{
            for row in 0..rows {{
                let Observed {{ {numbers} }} = self.eval({pose});
{stores}            }}
        }} else {{
            sine_cosine::run_rows(sine_cosine::path(), self, rows, [{columns}], [{out}]);
        }}
        Ok(())
    }}
"
    )
}

/// Jacobians: a block at a time, so that it is still in the cache when it is used.
fn of_jacobian(file: &File<'_>, function: &Function) -> String {
    let lowered = lowered(function);
    let kind = camel_case(form_name(function.form));
    let (shape, parameters) = (file.shape(function.form, "&mut [f64]"), parameters(file));
    let have_length = have_length(file);
    let rows = file.shared.pose.first().zip(file.shared.pose_symbols().next());
    let rows =
        rows.map_or_else(String::new, |(group, id)| format!("{}.{}", group.argument, file.names.symbol(id)));
    let whole = |column: &String| format!("sine_cosine::whole({column}, &mut None)");
    let columns: Vec<String> = columns(file, &lowered).iter().map(whole).collect();
    let columns = columns.join(", ");
    let arguments = file.of_pose(&|group| {
        let part = |&id| format!("{0}: &{1}.{0}[start..end]", file.names.symbol(id), group.argument);
        let fields: Vec<String> = group.symbols.iter().map(part).collect();
        format!("&{} {{ {} }}", rows_name(group), fields.join(", "))
    });
    let observables = || file.shared.unit.observables.iter().map(|&id| file.names.observable(id));
    let out_lengths: String = observables()
        .map(|name| format!(" && out.{name}.iter().flatten().all(|column| column.len() == rows)"))
        .collect();
    let copies: String = observables()
        .map(|name| {
            format!(
                "            for (out, values) in out.{name}.iter_mut().flatten().zip(values.{name}.iter().flatten()) {{
                out[start..end].copy_from_slice(&values[..end - start]);
            }}
"
            )
        })
        .collect();
    format!(
        "
    /// A block of at most [`ROWS`] poses: as [`Self::eval`], but products may be fused with sums. {ACCURACY}
    ///
    /// # Errors
    /// If the slices are not all equally long, or longer than a block; nothing is written then.
    pub fn eval_block(&self, {parameters}, block: &mut {kind}Block) -> Result<(), LengthsDiffer> {{
        let rows = {rows}.len();
        if !({have_length} && rows <= ROWS) {{
            return Err(LengthsDiffer);
        }}
        sine_cosine::run_block(sine_cosine::path(), self, [{columns}], &mut block.values);
        Ok(())
    }}

    /// Many poses: as [`Self::eval_block`], block by block. {ACCURACY}
    ///
    /// # Errors
    /// If the slices are not all equally long; nothing is written then.
    pub fn eval_rows(&self, {parameters}, mut out: Observed<{shape}>) -> Result<(), LengthsDiffer> {{
        let rows = {rows}.len();
        if !({have_length}{out_lengths}) {{
            return Err(LengthsDiffer);
        }}
        let mut block = {kind}Block::default();
        for start in (0..rows).step_by(ROWS) {{
            let end = rows.min(start + ROWS);
            self.eval_block({arguments}, &mut block)?;
            let values = block.observed();
{copies}        }}
        Ok(())
    }}
"
    )
}

/// What a form does with a block of rows. With sines and cosines in the loop over rows, the loop is there for narrow
/// angles and for any.
fn compute(file: &File<'_>, function: &Function, lowered: &Block) -> String {
    let kept = function.program.carried().len();
    let kept_names: Vec<String> = (0..kept).map(|place| format!("p{place}")).collect();
    let columns: Vec<String> =
        lowered.columns.iter().map(|&id| format!("column_{}", file.names.symbol(id))).collect();
    let distinct = lowered.distinct;
    let (outs, out_type) = if function.form.is_jacobian() {
        (vec!["out".to_owned()], format!("[[f64; ROWS + 8]; {distinct}]"))
    } else {
        let outs = (0..lowered.places.len()).map(|index| format!("out{index}"));
        (outs.collect(), "[f64; ROWS]".to_owned())
    };
    let parameters: Vec<String> = columns
        .iter()
        .map(|column| format!("{column}: &[f64; ROWS]"))
        .chain(outs.iter().map(|out| format!("{out}: &mut {out_type}")))
        .collect();
    let parameters = parameters.join(", ");
    let arguments = [columns.as_slice(), &outs].concat().join(", ");
    let kept_names = kept_names.join(", ");
    let (narrow, scope, calls) = if lowered.angles_in_loop.is_empty() {
        let call = format!("        rows(arithmetic, &self.prepared, {arguments});\n");
        ("", Scope::Row, call)
    } else {
        let angles: Vec<String> =
            lowered.angles_in_loop.iter().map(|&id| format!("column_{}", file.names.symbol(id))).collect();
        let angles = angles.join(", ");
        let calls = format!(
            "        if sine_cosine::are_narrow([{angles}]) {{
            rows::<A, true>(arithmetic, &self.prepared, {arguments});
        }} else {{
            rows::<A, false>(arithmetic, &self.prepared, {arguments});
        }}
"
        );
        (", const NARROW: bool", Scope::RowWithWaves, calls)
    };
    let rust = Rust {
        chain: file.shared.unit.chain,
        names: file.names,
        scope,
        constants: Constants::AsDeclared,
        precision: Precision::Double,
        kernel: "sine_cosine::",
        sin_cos: "",
    };
    let body = rust.statements(&lowered.body, 12);
    let (head, taken) = head(function, &columns, &outs, distinct);
    format!(
        "
#[allow(non_snake_case, unused_variables, clippy::all, clippy::pedantic)]
impl {head} {{
        #[inline(always)]
        fn rows<A: sine_cosine::Arithmetic{narrow}>(arithmetic: A, &[{kept_names}]: &[f64; {kept}], {parameters}) {{
{body}        }}
{taken}{calls}    }}
}}
"
    )
}

/// What is implemented, up to the body of its function, and how that takes its block out of what it is given.
fn head(function: &Function, columns: &[String], outs: &[String], distinct: usize) -> (String, String) {
    let kind = camel_case(form_name(function.form));
    let (columns_in, count) = (columns.join(", "), columns.len());
    if function.form.is_jacobian() {
        let head = format!(
            "sine_cosine::Block<{count}, {distinct}> for &{kind} {{
    #[inline(always)]
    fn compute<A: sine_cosine::Arithmetic>(self, arithmetic: A, [{columns_in}]: [&[f64; ROWS]; {count}], out: &mut [[f64; ROWS + 8]; {distinct}])"
        );
        return (head, String::new());
    }
    let (outs_in, count_out) = (outs.join(", "), outs.len());
    let head = format!(
        "sine_cosine::Rows<{count}, {count_out}> for &{kind} {{
    #[inline(always)]
    fn compute<A: sine_cosine::Arithmetic>(self, arithmetic: A, [{columns_in}]: &[&[f64]; {count}], [{outs_in}]: &mut [&mut [f64]; {count_out}], first: usize)"
    );
    let taken: String = columns
        .iter()
        .map(|column| {
            format!("        let Some({column}) = {column}[first..].first_chunk() else {{ unreachable!(\"all slices have as many rows\") }};\n")
        })
        .chain(outs.iter().map(|out| {
            format!("        let Some({out}) = {out}[first..].first_chunk_mut() else {{ unreachable!(\"all slices have as many rows\") }};\n")
        }))
        .collect();
    (head, taken)
}

/// The type of a Jacobian's blocks.
fn jacobian_block(file: &File<'_>, function: &Function, lowered: &Block) -> String {
    let kind = camel_case(form_name(function.form));
    let columns = file.shared.columns.len();
    let rows: Vec<String> = lowered
        .places
        .chunks(columns.max(1))
        .map(|row| {
            let row: Vec<String> = row.iter().map(|place| format!("self.row({place})")).collect();
            format!("                [{}],\n", row.join(", "))
        })
        .collect();
    let fields: String = file
        .shared
        .by_observable(&rows)
        .into_iter()
        .map(|(id, rows)| {
            format!("            {}: [\n{}            ],\n", file.names.observable(id), rows.concat())
        })
        .collect();
    let (distinct, shape) = (lowered.distinct, file.shape(function.form, "&[f64]"));
    let fixed: String = lowered
        .fixed
        .iter()
        .filter(|(_, value)| *value != 0.0)
        .map(|(place, value)| format!("        block.values[{place}] = [{value:?}; ROWS + 8];\n"))
        .collect();
    let zeros = format!("Self {{ values: [[0.0; ROWS + 8]; {distinct}] }}");
    let default =
        if fixed.is_empty() { zeros } else { format!("let mut block = {zeros};\n{fixed}        block") };
    format!(
        "
/// A block of rows of [`{kind}`]: derivatives that are the same function are held once.
#[derive(Debug, Clone, PartialEq)]
#[repr(align(64))]
{ALLOW}
pub struct {kind}Block {{
    // The columns are longer than a block, so that they do not all meet in the same places of the cache.
    values: [[f64; ROWS + 8]; {distinct}],
}}

impl Default for {kind}Block {{
    fn default() -> Self {{
        {default}
    }}
}}

{ALLOW}
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
"
    )
}
