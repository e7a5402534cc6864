//! The structures of joints, inputs, errors and constants, for one pose and for many.

use model_core::{Chain, Quantity, SymbolId, SymbolKind};

use super::code::real;
use crate::backends::names::Names;
use crate::backends::unit::{Group, Precision};
use model_core::escape::comments;

/// What stands before items, so that nobody is warned of what he does not use.
pub(super) const ALLOW: &str = "#[allow(dead_code, non_snake_case)]";

/// The structure of a group, which converts to and from an array.
pub(super) fn structure(chain: &Chain, names: &Names, group: &Group, precision: Precision) -> String {
    let (name, count) = (group.type_name(), group.symbols.len());
    let real = real(precision);
    let fields: String = group.symbols.iter().map(|&id| field(chain, names, id, real)).collect();
    let default = if group.kind == SymbolKind::Constant { "" } else { ", Default" };
    let each = |form: &dyn Fn(usize, &str) -> String| -> String {
        let named = group.symbols.iter().enumerate();
        named.map(|(index, &id)| form(index, names.symbol(id))).collect::<Vec<_>>().join(", ")
    };
    let from = each(&|index, field| format!("{field}: values[{index}]"));
    let into = each(&|_, field| format!("values.{field}"));
    let mut text = format!(
        "
/// {about}
#[derive(Debug, Clone, Copy, PartialEq{default})]
{ALLOW}
pub struct {name} {{
{fields}}}

impl From<[{real}; {count}]> for {name} {{
    fn from(values: [{real}; {count}]) -> Self {{
        Self {{ {from} }}
    }}
}}

impl From<{name}> for [{real}; {count}] {{
    fn from(values: {name}) -> Self {{
        [{into}]
    }}
}}
",
        about = group.about,
    );
    if group.kind == SymbolKind::Constant {
        let declared = each(&|index, field| {
            format!("{field}: {:?}", crate::backends::declared(chain, group.symbols[index]))
        });
        text.push_str(&format!(
            "
/// As declared.
impl Default for {name} {{
    fn default() -> Self {{
        Self {{ {declared} }}
    }}
}}
"
        ));
    }
    text
}

/// The same symbols for many poses.
pub(super) fn rows(chain: &Chain, names: &Names, group: &Group) -> String {
    let (name, singular, argument) = (group.type_name(), group.singular(), group.argument);
    let rows_name = rows_name(group);
    let fields: String = group.symbols.iter().map(|&id| field(chain, names, id, "&'a [f64]")).collect();
    let each = |form: &dyn Fn(&str) -> String| -> String {
        group.symbols.iter().map(|&id| form(names.symbol(id))).collect::<Vec<_>>().join(", ")
    };
    let lengths = each(&|field| format!("self.{field}.len()"));
    let row = each(&|field| format!("{field}: self.{field}[row]"));
    let about =
        format!("{} of many poses: a slice for each {singular}, all equally long.", capital(argument));
    format!(
        "
/// {about}
#[derive(Debug, Clone, Copy)]
{ALLOW}
pub struct {rows_name}<'a> {{
{fields}}}

{ALLOW}
impl {rows_name}<'_> {{
    fn have_length(&self, rows: usize) -> bool {{
        [{lengths}].iter().all(|&length| length == rows)
    }}

    fn at(&self, row: usize) -> {name} {{
        {name} {{ {row} }}
    }}
}}
"
    )
}

/// `JointRows`
pub(super) fn rows_name(group: &Group) -> String {
    format!("{}Rows", capital(group.singular()))
}

fn capital(word: &str) -> String {
    crate::backends::names::camel_case(word)
}

fn field(chain: &Chain, names: &Names, id: SymbolId, of: &str) -> String {
    let documentation = comments::rust_doc(&meaning(chain, id));
    let documentation: String = documentation.lines().map(|line| format!("    {line}\n")).collect();
    format!("{documentation}    pub {}: {of},\n", names.symbol(id))
}

/// What a symbol is: the declaration's words, unit and printed form.
fn meaning(chain: &Chain, id: SymbolId) -> String {
    let symbol = chain.symbol(id);
    let unit = match symbol.quantity {
        Quantity::Angle => "In radians",
        Quantity::Length => "In metres",
        Quantity::Number => "A number, in the unit of the data",
    };
    let value = match (symbol.kind, symbol.value) {
        (SymbolKind::Constant, Some(value)) => format!("; {value} as declared"),
        _ => String::new(),
    };
    let note = format!("{unit}{value}; printed as `{}`.", symbol.latex);
    if symbol.documentation.is_empty() { note } else { format!("{}\n\n{note}", symbol.documentation) }
}

/// The error of functions of many poses.
pub(super) const LENGTHS_DIFFER: &str = "
/// Slices that should be equally long are not, or a block is asked for more rows than it has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code)]
pub struct LengthsDiffer;

impl core::fmt::Display for LengthsDiffer {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(\"slices of joints, inputs and results must be equally long, and no longer than a block where one is filled\")
    }
}

impl core::error::Error for LengthsDiffer {}
";
