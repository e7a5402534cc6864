//! JavaScript: a module without dependencies, for numbers and for typed arrays.

use std::fmt::Write;

use model_core::{Chain, SymbolId, SymbolKind};

use super::listing::{Listing, Statement, Words, list};
use super::unit::{Function, Unit, camel_case, describe_form, form_name};
use crate::program::{Form, Op};

/// The text of the file.
pub(crate) fn write(unit: &Unit<'_>) -> String {
    let functions = unit.functions();
    let joints = unit.joints(&functions);
    let mut text = unit.preamble().iter().fold(String::new(), |mut text, line| {
        let _ = writeln!(text, "{}", format!("// {line}").trim_end());
        text
    });
    let _ = write!(
        text,
        "\n/**\n * Where the instrument is: its joints, and what is measured beside them.\n * @typedef {{Object}} Joints\n"
    );
    property_docs(&mut text, unit, &joints);
    text.push_str(" */\n\n/**\n * What is wrong with the instrument.\n * @typedef {Object} Errors\n");
    property_docs(&mut text, unit, &unit.errors());
    text.push_str(" */\n\n/** No errors. */\nexport const noErrors = Object.freeze({\n");
    for id in unit.errors() {
        let _ = writeln!(text, "  {}: 0,", unit.chain.symbol(id).name);
    }
    text.push_str("});\n");
    for function in &functions {
        text.push_str(&one_form(unit, function, &joints));
    }
    let is_of_ramps = |op: &Op| matches!(op, Op::Saturate(_) | Op::Step(_));
    if functions.iter().any(|function| function.program.nodes().iter().any(is_of_ramps)) {
        text.push_str(RAMPS);
    }
    text
}

/// What ramps are made of.
const RAMPS: &str = "
function saturate(x) {
  return x < 0 ? 0 : x > 1 ? 1 : x;
}

function step(x) {
  return x >= 0 ? 1 : x < 0 ? 0 : x;
}
";

fn property_docs(text: &mut String, unit: &Unit<'_>, ids: &[SymbolId]) {
    for &id in ids {
        let _ =
            writeln!(text, " * @property {{number}} {} {}", unit.chain.symbol(id).name, unit.describe(id));
    }
}

fn one_form(unit: &Unit<'_>, function: &Function, joints: &[SymbolId]) -> String {
    let about = describe_form(function.form);
    let kind = camel_case(form_name(function.form));
    let mut name = kind.clone();
    name.replace_range(..1, &kind[..1].to_lowercase());
    let listing = list(&function.program, &Names { chain: unit.chain, row: "" });
    let row_listing = list(&function.program, &Names { chain: unit.chain, row: "[row]" });
    let mut text = format!(
        "
/**
 * Does what {name} needs once for a set of errors.
 * @param {{Errors}} errors
 * @returns {{Float64Array}}
 */
export function prepare{kind}(errors) {{
{}  return Float64Array.of(
{}  );
}}

/**
 * {about}
 * @param {{Float64Array}} p from prepare{kind}
 * @param {{Joints}} joints
 */
export function {name}(p, joints) {{
{}  return {};
}}
",
        statements(&listing.prepared, 2),
        listing.carried.iter().fold(String::new(), |text, value| format!("{text}    {value},\n")),
        statements(&listing.evaluated, 2),
        observed(unit, function.form, &listing),
    );
    let Some(first) = joints.first().map(|&id| unit.chain.symbol(id).name.as_str()) else { return text };
    let _ = write!(
        text,
        "
/**
 * The same for many poses: `joints` holds an array for each joint, `out` has the shape of what {name} returns, with an
 * array in place of each number. Sines and cosines, and their accuracy, are those of Math.
 */
export function {name}Rows(p, joints, out) {{
  const rows = joints.{first}.length;
  for (let row = 0; row < rows; row++) {{
{}",
        statements(&row_listing.evaluated, 4),
    );
    for (place, value) in places(unit, function.form).iter().zip(&row_listing.outputs) {
        let _ = writeln!(text, "    out.{place}[row] = {value};");
    }
    text.push_str("  }\n}\n");
    text
}

fn places(unit: &Unit<'_>, form: Form) -> Vec<String> {
    let mut places = Vec::new();
    for name in unit.observable_names() {
        for component in 0..3 {
            if form.is_jacobian() {
                places
                    .extend((0..unit.errors().len()).map(|column| format!("{name}[{component}][{column}]")));
            } else {
                places.push(format!("{name}[{component}]"));
            }
        }
    }
    places
}

fn observed(unit: &Unit<'_>, form: Form, listing: &Listing) -> String {
    let mut rows = listing.components(unit.columns_of(form)).map(|row| row.join(", "));
    let mut text = String::from("{\n");
    for name in unit.observable_names() {
        let _ = writeln!(text, "    {name}: [");
        for _ in 0..3 {
            let row = rows.next().unwrap_or_default();
            let row = if form.is_jacobian() { format!("[{row}]") } else { row };
            let _ = writeln!(text, "      {row},");
        }
        text.push_str("    ],\n");
    }
    text.push_str("  }");
    text
}

fn statements(statements: &[Statement], indent: usize) -> String {
    statements.iter().fold(String::new(), |mut text, statement| {
        match statement {
            Statement::Let { name, value } => {
                let _ = writeln!(text, "{:indent$}const {name} = {value};", "");
            }
            Statement::SinCos { angle, sin, cos } => {
                for (function, name) in [("sin", sin), ("cos", cos)] {
                    if let Some(name) = name {
                        let _ = writeln!(text, "{:indent$}const {name} = Math.{function}({angle});", "");
                    }
                }
            }
        }
        text
    })
}

/// How JavaScript writes a program; `row` is what follows the name of a joint. Any word can be a property.
struct Names<'a> {
    chain: &'a Chain,
    row: &'a str,
}

impl Words for Names<'_> {
    fn symbol(&self, id: SymbolId) -> String {
        let symbol = self.chain.symbol(id);
        match symbol.kind {
            SymbolKind::Error => format!("errors.{}", symbol.name),
            SymbolKind::Ramp => unreachable!("a ramp is computed from its joint or input"),
            SymbolKind::Joint | SymbolKind::Input => format!("joints.{}{}", symbol.name, self.row),
            SymbolKind::Pi | SymbolKind::Constant => self.number(symbol.value.unwrap_or(f64::NAN)),
        }
    }

    fn wave_of_symbol(&self, wave: &str, id: SymbolId) -> String {
        format!("{wave}_{}", self.chain.symbol(id).name)
    }

    fn saturate(&self, a: &str) -> String {
        format!("saturate({a})")
    }

    fn step(&self, a: &str) -> String {
        format!("step({a})")
    }

    fn carried(&self, index: usize) -> String {
        format!("p[{index}]")
    }

    fn local(&self, index: usize) -> String {
        format!("t{index}")
    }
}
