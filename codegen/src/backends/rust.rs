//! Rust: one file of types and functions that needs nothing but `core`.
//!
//! The file can be a module of its own or be included in one. Sines and cosines come from
//! [`crate::vector`]'s kernel, whose text is part of the file, so that results are those of the interpreter.

use std::fmt::Write;

use model_core::{Chain, SymbolId, SymbolKind};

use super::listing::{Statement, Words, list};
use super::rust_rows;
use super::unit::{Function, Unit, camel_case, describe_form, form_name};
use crate::program::Form;

/// The text of the file.
#[must_use]
pub(crate) fn write(unit: &Unit<'_>) -> String {
    let functions = unit.functions();
    let joints = unit.joints(&functions);
    let mut file = String::new();
    for line in unit.preamble() {
        let _ = writeln!(file, "{}", format!("// {line}").trim_end());
    }
    file.push_str(&types(unit, &joints));
    for function in &functions {
        file.push_str(&item(unit, function, &joints));
    }
    // Without joints and inputs there is one pose.
    if !joints.is_empty() {
        file.push_str(&rust_rows::shared(unit, &joints));
    }
    file.push_str(&rust_rows::kernel());
    file
}

fn types(unit: &Unit<'_>, joints: &[SymbolId]) -> String {
    let mut text = String::new();
    let mut structure = |name: &str, about: &str, fields: &[SymbolId]| {
        let _ = write!(
            text,
            "\n/// {about}\n#[derive(Debug, Clone, Copy, PartialEq, Default)]\n#[allow(non_snake_case)]\npub struct {name} {{\n"
        );
        for &field in fields {
            let _ = writeln!(
                text,
                "    /// {}\n    pub {}: f64,",
                unit.describe(field),
                unit.chain.symbol(field).name
            );
        }
        text.push_str("}\n");
    };
    structure("Joints", "Where the instrument is: its joints, and what is measured beside them.", joints);
    structure("Errors", "What is wrong with the instrument; by default nothing.", &unit.errors());
    text.push_str("\n/// One thing for each observable.\n#[derive(Debug, Clone, Copy, PartialEq, Default)]\n#[allow(non_snake_case)]\npub struct Observed<T> {\n");
    for &id in unit.observables {
        let _ = writeln!(
            text,
            "    /// {}\n    pub {}: T,",
            unit.describe_observable(id),
            unit.chain.observable(id).name
        );
    }
    text.push_str("}\n");
    text
}

/// One form: a type that holds what is prepared, and what can be done with it.
fn item(unit: &Unit<'_>, function: &Function, joints: &[SymbolId]) -> String {
    let (name, kind) = (form_name(function.form), camel_case(form_name(function.form)));
    let names =
        Names { chain: unit.chain, symbol: &fields(unit.chain), carried: &|index| format!("p[{index}]") };
    let listing = list(&function.program, &names);
    let about = describe_form(function.form);
    let shape = shape(unit, function.form, "f64");
    let mut text = String::new();
    let _ = write!(
        text,
        "
/// {about}
///
/// Holds what depends on errors and constants alone; [`Self::eval`] does the rest for a pose.
/// Per pose: {}.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct {kind} {{
    prepared: [f64; {}],
}}

/// {about}
#[must_use]
pub fn {name}(errors: &Errors, joints: &Joints) -> Observed<{shape}> {{
    {kind}::prepare(errors).eval(joints)
}}

#[allow(unused_variables, non_snake_case, clippy::all, clippy::pedantic)]
impl {kind} {{
    /// Does what depends on errors and constants alone.
    #[must_use]
    pub fn prepare(errors: &Errors) -> Self {{
{}        Self {{
            prepared: [
{}            ],
        }}
    }}

    /// One pose.
    #[must_use]
    pub fn eval(&self, joints: &Joints) -> Observed<{shape}> {{
        let p = &self.prepared;
{}        {}
    }}
",
        function.program.counts().evaluated,
        listing.carried.len(),
        statements(&listing.prepared, "sine_cosine::sin_cos", 8),
        listing.carried.iter().fold(String::new(), |text, value| format!("{text}                {value},\n")),
        statements(&listing.evaluated, "sine_cosine::sin_cos", 8),
        observed(unit, function.form, &listing.outputs),
    );
    if function.form == Form::FirstOrderError {
        let _ = write!(
            text,
            "
    /// One pose as [`Self::eval`], by the same instructions for every pose: no branch, no allocation, no recursion, so
    /// that time and stack are known beforehand. Not a number where an angle is beyond 1e6 rad.
    #[must_use]
    pub fn eval_without_branch(&self, joints: &Joints) -> Observed<{shape}> {{
        let p = &self.prepared;
{}        {}
    }}
",
            statements(&listing.evaluated, "sine_cosine::sin_cos_without_branch", 8),
            observed(unit, function.form, &listing.outputs),
        );
    }
    if joints.is_empty() {
        return text + "}\n";
    }
    text.push_str(&rust_rows::methods(unit, function, joints));
    text.push_str("}\n");
    text.push_str(&rust_rows::items(unit, function));
    text
}

/// The type of one observable's part of a form, of numbers or of something else.
pub(super) fn shape(unit: &Unit<'_>, form: Form, of: &str) -> String {
    if form.is_jacobian() { format!("[[{of}; {}]; 3]", unit.errors().len()) } else { format!("[{of}; 3]") }
}

/// Outputs as they are returned.
fn observed(unit: &Unit<'_>, form: Form, outputs: &[String]) -> String {
    let columns = if form.is_jacobian() { unit.errors().len() } else { 1 };
    let mut rows = outputs
        .chunks(columns.max(1))
        .map(|row| if form.is_jacobian() { format!("[{}]", row.join(", ")) } else { row.concat() });
    let mut text = String::from("Observed {\n");
    for name in unit.observable_names() {
        let _ = writeln!(text, "            {name}: [");
        for _ in 0..3 {
            let _ = writeln!(text, "                {},", rows.next().unwrap_or_else(|| "[]".into()));
        }
        text.push_str("            ],\n");
    }
    text.push_str("        }");
    text
}

/// Statements, indented.
pub(super) fn statements(statements: &[Statement], sin_cos: &str, indent: usize) -> String {
    statements.iter().fold(String::new(), |mut text, statement| {
        let _ = match statement {
            Statement::Let { name, value } => writeln!(text, "{:indent$}let {name} = {value};", ""),
            Statement::SinCos { angle, sin, cos } => writeln!(
                text,
                "{:indent$}let ({}, {}) = {sin_cos}({angle});",
                "",
                sin.as_deref().unwrap_or("_"),
                cos.as_deref().unwrap_or("_")
            ),
        };
        text
    })
}

/// How Rust writes a program: the caller says what a symbol and a carried node are called.
pub(super) struct Names<'a> {
    pub(super) chain: &'a Chain,
    pub(super) symbol: &'a dyn Fn(SymbolId) -> String,
    pub(super) carried: &'a dyn Fn(usize) -> String,
}

impl Words for Names<'_> {
    fn symbol(&self, symbol: SymbolId) -> String {
        (self.symbol)(symbol)
    }

    fn wave_of_symbol(&self, wave: &str, symbol: SymbolId) -> String {
        format!("{wave}_{}", self.chain.symbol(symbol).name)
    }

    fn saturate(&self, a: &str) -> String {
        format!("sine_cosine::saturate({a})")
    }

    fn step(&self, a: &str) -> String {
        format!("sine_cosine::step({a})")
    }

    fn carried(&self, index: usize) -> String {
        (self.carried)(index)
    }

    fn local(&self, index: usize) -> String {
        format!("t{index}")
    }
}

/// Symbols as fields of `joints` and `errors`, constants as numbers.
fn fields(chain: &Chain) -> impl Fn(SymbolId) -> String {
    |id| {
        let symbol = chain.symbol(id);
        match symbol.kind {
            SymbolKind::Error => format!("errors.{}", symbol.name),
            SymbolKind::Ramp => unreachable!("a ramp is computed from its joint or input"),
            SymbolKind::Joint | SymbolKind::Input => format!("joints.{}", symbol.name),
            SymbolKind::Pi | SymbolKind::Constant => format!("{:?}", symbol.value.unwrap_or(f64::NAN)),
        }
    }
}
