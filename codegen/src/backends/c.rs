//! C99: a header and a source that needs nothing but `stddef.h` and `stdint.h`.
//!
//! Sines and cosines come from [`crate::vector`]'s kernel, whose text is part of the source, so that results are those
//! of the interpreter wherever products and sums are not fused.

use std::fmt::Write;

use model_core::{Chain, SymbolId, SymbolKind};

use super::c_rows;
use super::listing::{Statement, Words, list};
use super::unit::{Function, Unit, describe_form, form_name, snake_case, unreserved};
use crate::program::Form;
use crate::vector;

/// The header and the source that includes it as `<file name>.h`.
pub(crate) fn write(unit: &Unit<'_>, file_name: &str) -> (String, String) {
    let functions = unit.functions();
    let c = C { unit, prefix: prefix(unit.chain), joints: unit.joints(&functions) };
    (c.header(&functions), c.source(&functions, file_name))
}

/// One chain in C.
pub(super) struct C<'a> {
    pub(super) unit: &'a Unit<'a>,
    /// What every public name begins with.
    pub(super) prefix: String,
    pub(super) joints: Vec<SymbolId>,
}

impl C<'_> {
    fn header(&self, functions: &[Function]) -> String {
        let (prefix, unit) = (&self.prefix, self.unit);
        let guard = prefix.to_uppercase();
        let mut text = preamble(unit);
        let _ = write!(
            text,
            "\n#ifndef {guard}_H\n#define {guard}_H\n\n#include <stddef.h>\n\n#ifdef __cplusplus\nextern \"C\" {{\n#endif\n"
        );
        let joints: Vec<_> = self.joints.iter().map(|&id| (self.name(id), unit.describe(id))).collect();
        let errors: Vec<_> = unit.errors().into_iter().map(|id| (self.name(id), unit.describe(id))).collect();
        structure(
            &mut text,
            &format!("{prefix}_joints"),
            "Where the instrument is: its joints, and what is measured beside them.",
            joints.iter().map(|(name, about)| (format!("double {name}"), about.clone())),
        );
        structure(
            &mut text,
            &format!("{prefix}_errors"),
            "What is wrong with the instrument: nothing, if all are zero.",
            errors.iter().map(|(name, about)| (format!("double {name}"), about.clone())),
        );
        structure(
            &mut text,
            &format!("{prefix}_joints_rows"),
            "Joints of many poses: an array for each.",
            joints.iter().map(|(name, about)| (format!("const double *{name}"), about.clone())),
        );
        for (form, name, about) in [
            (Form::ExactError, "observed", "Three components for each observable."),
            (
                Form::ExactJacobian,
                "jacobian",
                "Three rows for each observable, a column for each error, in the order of the errors.",
            ),
        ] {
            if functions.iter().any(|function| function.form.is_jacobian() == form.is_jacobian()) {
                for (name, of, about) in [
                    (name.to_owned(), "double ", about.to_owned()),
                    (format!("{name}_rows"), "double *", format!("{about} An array of poses each.")),
                ] {
                    structure(&mut text, &format!("{prefix}_{name}"), &about, self.observables(form, of));
                }
            }
        }
        for function in functions {
            let name = form_name(function.form);
            let about = describe_form(function.form);
            let result = self.result(function.form);
            let _ = write!(
                text,
                "
// What {name} keeps between poses: all that depends on errors and constants alone.
typedef struct {{
    double values[{}];
}} {prefix}_{name}_prepared;

void {prefix}_{name}_prepare(const {prefix}_errors *errors, {prefix}_{name}_prepared *prepared);

// {about}
// Per pose: {}.
void {prefix}_{name}(const {prefix}_{name}_prepared *prepared, const {prefix}_joints *joints,
    {prefix}_{result} *out);
{}{}",
                function.program.carried().len().max(1),
                function.program.counts().evaluated,
                self.declared_without_branch(function.form),
                c_rows::declarations(self, function),
            );
        }
        text.push_str(&c_rows::declaration_of_path(self));
        text.push_str("\n#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
        text
    }

    fn source(&self, functions: &[Function], file_name: &str) -> String {
        let mut text = preamble(self.unit);
        let _ = write!(text, "\n#include \"{file_name}.h\"\n\n{}", vector::C);
        for function in functions {
            text.push_str(&self.one_pose(function));
            text.push_str(&c_rows::definitions(self, function));
        }
        text.push_str(&c_rows::definition_of_path(self));
        text
    }

    fn one_pose(&self, function: &Function) -> String {
        let (prefix, name, result) = (&self.prefix, form_name(function.form), self.result(function.form));
        let words = Names { c: self, row: "" };
        let listing = list(&function.program, &words);
        let mut text = format!(
            "\nvoid {prefix}_{name}_prepare(const {prefix}_errors *errors, {prefix}_{name}_prepared *prepared)\n{{\n    (void)errors;\n"
        );
        if listing.carried.is_empty() {
            text.push_str("    prepared->values[0] = 0.0;\n");
        }
        text.push_str(&statements(&listing.prepared, "trueaxis_sin_cos_with(0, ", 4));
        for (index, value) in listing.carried.iter().enumerate() {
            let _ = writeln!(text, "    prepared->values[{index}] = {value};");
        }
        text.push_str("}\n");
        for (variant, sin_cos) in variants(function.form) {
            let _ = write!(
                text,
                "
void {prefix}_{name}{variant}(const {prefix}_{name}_prepared *prepared, const {prefix}_joints *joints,
    {prefix}_{result} *out)
{{
    const double *const p = prepared->values;
    (void)p;
    (void)joints;
{}",
                statements(&listing.evaluated, sin_cos, 4)
            );
            for (place, value) in self.places(function.form).iter().zip(&listing.outputs) {
                let _ = writeln!(text, "    out->{place} = {value};");
            }
            text.push_str("}\n");
        }
        text
    }

    /// The function without branches, if the form has one.
    fn declared_without_branch(&self, form: Form) -> String {
        if form != Form::FirstOrderError {
            return String::new();
        }
        let (prefix, name) = (&self.prefix, form_name(form));
        format!(
            "
// One pose by the same instructions for every pose: no branch, no allocation, no recursion, so that time and stack are
// known beforehand. Not a number where an angle is beyond 1e6 rad.
void {prefix}_{name}_without_branch(const {prefix}_{name}_prepared *prepared,
    const {prefix}_joints *joints, {prefix}_observed *out);
"
        )
    }

    /// Where each output of a form goes, in order.
    pub(super) fn places(&self, form: Form) -> Vec<String> {
        let columns = self.unit.errors().len();
        self.observable_fields()
            .flat_map(|name| {
                (0..3).flat_map(move |component| {
                    let name = name.clone();
                    let columns = if form.is_jacobian() { columns } else { 1 };
                    (0..columns).map(move |column| {
                        if form.is_jacobian() {
                            format!("{name}[{component}][{column}]")
                        } else {
                            format!("{name}[{component}]")
                        }
                    })
                })
            })
            .collect()
    }

    /// The observables' names in C.
    pub(super) fn observable_fields(&self) -> impl Iterator<Item = String> {
        self.unit.observable_names().map(|name| identifier(self.unit.chain, name))
    }

    /// The type that a form puts out.
    pub(super) fn result(&self, form: Form) -> &'static str {
        if form.is_jacobian() { "jacobian" } else { "observed" }
    }

    /// A symbol's name in C.
    pub(super) fn name(&self, id: SymbolId) -> String {
        identifier(self.unit.chain, &self.unit.chain.symbol(id).name)
    }

    /// The observables as fields.
    fn observables<'b>(&'b self, form: Form, of: &'b str) -> impl Iterator<Item = (String, String)> + 'b {
        let shape =
            if form.is_jacobian() { format!("[3][{}]", self.unit.errors().len()) } else { "[3]".into() };
        self.unit.observables.iter().map(move |&id| {
            let name = identifier(self.unit.chain, &self.unit.chain.observable(id).name);
            (format!("{of}{name}{shape}"), self.unit.describe_observable(id))
        })
    }
}

/// The functions of one pose: what their names add to that of the form, and their sine and cosine.
fn variants(form: Form) -> &'static [(&'static str, &'static str)] {
    const ANY_ANGLE: (&str, &str) = ("", "trueaxis_sin_cos_with(0, ");
    const WITHOUT_BRANCH: (&str, &str) = ("_without_branch", "trueaxis_sin_cos_without_branch(");
    if form == Form::FirstOrderError { &[ANY_ANGLE, WITHOUT_BRANCH] } else { &[ANY_ANGLE] }
}

/// A structure; C knows no empty ones.
fn structure(text: &mut String, name: &str, about: &str, fields: impl Iterator<Item = (String, String)>) {
    let _ = write!(text, "\n// {about}\ntypedef struct {{\n");
    let mut is_empty = true;
    for (field, about) in fields {
        is_empty = false;
        let _ = writeln!(text, "    {field}; // {about}");
    }
    if is_empty {
        text.push_str("    double none; // Nothing.\n");
    }
    let _ = writeln!(text, "}} {name};");
}

fn preamble(unit: &Unit<'_>) -> String {
    unit.preamble().iter().fold(String::new(), |mut text, line| {
        // A backslash at the end would go on with the next line.
        let _ = writeln!(text, "{}", format!("// {}", line.trim_end_matches('\\')).trim_end());
        text
    })
}

/// Statements, indented; `sin_cos` is the call up to the angle.
pub(super) fn statements(statements: &[Statement], sin_cos: &str, indent: usize) -> String {
    statements.iter().fold(String::new(), |mut text, statement| {
        let _ = match statement {
            Statement::Let { name, value } => writeln!(text, "{:indent$}const double {name} = {value};", ""),
            Statement::SinCos { angle, sin, cos } => {
                let missing = |wave: &Option<String>, other: &Option<String>, name: &str| {
                    wave.clone().unwrap_or_else(|| format!("{name}_{}", other.clone().unwrap_or_default()))
                };
                let (sin, cos) = (missing(sin, cos, "unread"), missing(cos, sin, "unread"));
                writeln!(
                    text,
                    "{:indent$}double {sin}, {cos};\n{:indent$}{sin_cos}{angle}, &{sin}, &{cos});",
                    "", ""
                )
            }
        };
        text
    })
}

/// How C writes a program; `row` is what follows the name of a joint.
pub(super) struct Names<'a> {
    pub(super) c: &'a C<'a>,
    pub(super) row: &'a str,
}

impl Words for Names<'_> {
    fn symbol(&self, id: SymbolId) -> String {
        let symbol = self.c.unit.chain.symbol(id);
        match symbol.kind {
            SymbolKind::Error => format!("errors->{}", self.c.name(id)),
            SymbolKind::Ramp => unreachable!("a ramp is computed from its joint or input"),
            SymbolKind::Joint | SymbolKind::Input => format!("joints->{}{}", self.c.name(id), self.row),
            SymbolKind::Pi | SymbolKind::Constant => self.number(symbol.value.unwrap_or(f64::NAN)),
        }
    }

    fn wave_of_symbol(&self, wave: &str, id: SymbolId) -> String {
        format!("{wave}_{}", self.c.name(id))
    }

    fn saturate(&self, a: &str) -> String {
        format!("trueaxis_saturate({a})")
    }

    fn step(&self, a: &str) -> String {
        format!("trueaxis_step({a})")
    }

    fn carried(&self, index: usize) -> String {
        format!("p[{index}]")
    }

    fn local(&self, index: usize) -> String {
        format!("t{index}")
    }
}

fn prefix(chain: &Chain) -> String {
    ascii(&snake_case(&chain.name))
}

/// A name of a declaration as C and C++ allow it.
fn identifier(chain: &Chain, name: &str) -> String {
    unreserved(chain, &ascii(name), &RESERVED)
}

fn ascii(name: &str) -> String {
    name.chars().fold(String::new(), |mut text, c| {
        if c.is_ascii() {
            text.push(c);
        } else {
            let _ = write!(text, "u{:x}_", u32::from(c));
        }
        text
    })
}

/// Words of C99 and C++ that a name in a declaration may be.
const RESERVED: [&str; 69] = [
    "alignas",
    "alignof",
    "and",
    "and_eq",
    "asm",
    "auto",
    "bitand",
    "bitor",
    "bool",
    "case",
    "catch",
    "char",
    "class",
    "compl",
    "concept",
    "consteval",
    "constexpr",
    "constinit",
    "const_cast",
    "decltype",
    "default",
    "delete",
    "double",
    "dynamic_cast",
    "explicit",
    "export",
    "float",
    "friend",
    "goto",
    "inline",
    "int",
    "long",
    "mutable",
    "namespace",
    "new",
    "noexcept",
    "not",
    "not_eq",
    "nullptr",
    "operator",
    "or",
    "or_eq",
    "private",
    "protected",
    "public",
    "register",
    "reinterpret_cast",
    "requires",
    "restrict",
    "short",
    "signed",
    "sizeof",
    "static_assert",
    "static_cast",
    "switch",
    "template",
    "this",
    "thread_local",
    "throw",
    "typedef",
    "typeid",
    "typename",
    "union",
    "unsigned",
    "using",
    "void",
    "volatile",
    "wchar_t",
    "xor",
];
