//! C99: a header and a source that needs nothing but `stddef.h` and `stdint.h`.
//!
//! Sines and cosines come from [`crate::vector`]'s kernel, whose text is part of the source, so that results are those
//! of the interpreter wherever products and sums are not fused.

mod code;
mod entries;
mod rows;
mod words;

use self::code::{C, real};
pub(crate) use self::entries::REPEATED;
pub(crate) use self::words::RULES;
use super::names::{Names, snake_case};
use super::notation::{Notation, Scope};
use super::unit::{Function, Group, OF_REGION, Precision, Shared, describe_form, form_name};
use crate::lower::pose;
use crate::program::Form;
use crate::vector;
use model_core::escape::comments;

/// How the files are used.
const USE: &str = "
C99, and C++17 too, with nothing but stddef.h and stdint.h; no library is needed, -lm neither. Compile with
-ffp-contract=off for the same bits on every processor, and never with -ffast-math.
";

/// The header and the source that includes it as `<file name>.h`.
pub(crate) fn write(shared: &Shared<'_>, file_name: &str) -> (String, String) {
    let names = Names::new(shared.unit.chain, RULES);
    let file = pair(shared, &names);
    (file.header(), file.source(file_name))
}

/// The header and the source, and a third file that includes them and has an entry for each form, with its name.
pub(crate) fn write_with_entries(shared: &Shared<'_>, file_name: &str) -> (String, String, Entries) {
    let names = Names::new(shared.unit.chain, RULES);
    let file = pair(shared, &names);
    let called = shared.functions.iter().map(|function| (function.form, entries::name(&file, function)));
    let entries = Entries { source: entries::source(&file, file_name), called: called.collect() };
    (file.header(), file.source(file_name), entries)
}

/// Entries of a file: their text, and what each form's is called.
pub(crate) struct Entries {
    pub(crate) source: String,
    pub(crate) called: Vec<(Form, String)>,
}

/// One pair of files.
struct File<'a> {
    shared: &'a Shared<'a>,
    names: &'a Names,
    /// What every public name begins with.
    prefix: String,
}

fn pair<'a>(shared: &'a Shared<'a>, names: &'a Names) -> File<'a> {
    File { shared, names, prefix: RULES.letters(&snake_case(&shared.unit.chain.name)) }
}

impl File<'_> {
    fn header(&self) -> String {
        let (prefix, shared) = (&self.prefix, self.shared);
        let guard = prefix.to_uppercase();
        let mut text = comments::c(&format!("{}{USE}", shared.preamble()));
        text.push_str(&format!(
            "\n#ifndef {guard}_H\n#define {guard}_H\n\n#include <stddef.h>\n\n#ifdef __cplusplus\nextern \"C\" {{\n#endif\n"
        ));
        for group in shared.pose.iter().chain(&shared.errors) {
            let fields = self.fields(group, &format!("{} ", real(shared.unit.precision)));
            text.push_str(&self.structure(group.argument, group.about, &fields));
        }
        if shared.has_rows() {
            for group in &shared.pose {
                let about = format!("The {} of many poses: an array for each.", group.argument);
                let fields = self.fields(group, "const double *");
                text.push_str(&self.structure(&format!("{}_rows", group.singular()), &about, &fields));
            }
        }
        text.push_str(&self.results());
        for function in &shared.functions {
            text.push_str(&self.declarations(function));
        }
        if shared.region.is_some() {
            text.push_str(&format!(
                "\n// {OF_REGION}\n// 1 inside, 0 outside.\n{};\n",
                self.region_signature()
            ));
        }
        if shared.unit.calibrated.valid_until.is_some() {
            text.push_str(&format!(
                "\n// The last day on which the calibration counts.\nextern const char {prefix}_valid_until[11];\n"
            ));
        }
        if shared.has_rows() {
            text.push_str(&rows::declaration_of_path(prefix));
        }
        text.push_str("\n#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
        text
    }

    fn source(&self, file_name: &str) -> String {
        let mut text = comments::c(&self.shared.preamble());
        text.push_str(&format!("\n#include \"{file_name}.h\"\n\n{}", self.kernel()));
        for function in &self.shared.functions {
            text.push_str(&self.definitions(function));
            if self.shared.has_rows() {
                text.push_str(&rows::definitions(self, function));
            }
        }
        text.push_str(&self.region());
        if let Some(date) = self.shared.unit.calibrated.valid_until {
            text.push_str(&format!("\nconst char {}_valid_until[11] = \"{date}\";\n", self.prefix));
        }
        if self.shared.has_rows() {
            text.push_str(&rows::definition_of_path(&self.prefix));
        }
        text
    }

    fn region_signature(&self) -> String {
        let prefix = &self.prefix;
        let pose = self.of_pose(&|group| format!("const {prefix}_{0} *{0}, ", group.argument));
        format!("int {prefix}_in_measured_region({})", pose.trim_end_matches(", "))
    }

    /// Whether a pose lies in the measured region.
    fn region(&self) -> String {
        let Some(program) = &self.shared.region else { return String::new() };
        let lowered = pose(program);
        let c = self.code(self.any_angle());
        let body = c.statements(&lowered.evaluated, 4);
        let inside = lowered.outputs.iter().map(|value| c.text(value)).collect::<String>();
        let unread = self.of_pose(&|group| format!("    (void){};\n", group.argument));
        format!("\n{}\n{{\n{unread}{body}    return {inside} > 0.5;\n}}\n", self.region_signature())
    }

    /// C of one pose.
    fn code<'s>(&'s self, sin_cos: &'s str) -> C<'s> {
        let (chain, names, scope) = (self.shared.unit.chain, self.names, Scope::Pose);
        C { chain, names, scope, precision: self.shared.unit.precision, sin_cos }
    }

    /// The call that gives sine and cosine of any angle, up to the angle.
    fn any_angle(&self) -> &'static str {
        match self.shared.unit.precision {
            Precision::Double => "trueaxis_sin_cos_with(0, ",
            Precision::Single => "trueaxis_sin_cos(",
        }
    }

    /// The text of sines and cosines.
    fn kernel(&self) -> &'static str {
        match self.shared.unit.precision {
            Precision::Double => vector::C,
            Precision::Single => vector::C_SINGLE,
        }
    }

    /// A structure of documented fields.
    fn structure(&self, name: &str, about: &str, fields: &[(String, String)]) -> String {
        let fields: String =
            fields.iter().map(|(field, about)| format!("    {field}; {}", comments::c(about))).collect();
        format!("\n// {about}\ntypedef struct {{\n{fields}}} {}_{name};\n", self.prefix)
    }

    fn fields(&self, group: &Group, of: &str) -> Vec<(String, String)> {
        let field = |&id| (format!("{of}{}", self.names.symbol(id)), self.shared.describe(id));
        group.symbols.iter().map(field).collect()
    }

    /// What functions put out.
    fn results(&self) -> String {
        let mut text = String::new();
        let count = if self.shared.shown_by_each() == Some(3) { "Three" } else { "The" };
        for (is_jacobian, name, about) in [
            (false, "observed", format!("{count} components for each observable.")),
            (
                true,
                "jacobian",
                format!(
                    "{count} rows for each observable, a column for each error, in the order of the errors."
                ),
            ),
        ] {
            if !self.shared.functions.iter().any(|function| function.form.is_jacobian() == is_jacobian) {
                continue;
            }
            let shape = |id| {
                let shown = self.shared.shown(id);
                if is_jacobian {
                    format!("[{shown}][{}]", self.shared.columns.len())
                } else {
                    format!("[{shown}]")
                }
            };
            let fields = |of: &str| -> Vec<(String, String)> {
                let observables = self.shared.unit.observables.iter();
                let field = |&id| {
                    let about = self.shared.describe_observable(id);
                    (format!("{of}{}{}", self.names.observable(id), shape(id)), about)
                };
                observables.map(field).collect()
            };
            let of = format!("{} ", real(self.shared.unit.precision));
            text.push_str(&self.structure(name, &about, &fields(&of)));
            if self.shared.has_rows() {
                let about = format!("{about} An array of poses each.");
                text.push_str(&self.structure(&format!("{name}_rows"), &about, &fields("double *")));
            }
        }
        text
    }

    fn declarations(&self, function: &Function) -> String {
        let (prefix, name) = (&self.prefix, form_name(function.form));
        let about = describe_form(function.form);
        let kept = function.program.carried().len().max(1);
        let cost = function.program.counts().evaluated;
        let real = real(self.shared.unit.precision);
        let (prepare, one) = (self.prepare(function), self.one(function.form, ""));
        let mut text = format!(
            "
// What {name} keeps between poses: all that depends on errors and constants alone.
typedef struct {{
    {real} values[{kept}];
}} {prefix}_{name}_prepared;

{prepare};

// {about}
// Per pose: {cost}.
{one};
"
        );
        if self.shared.has_variant_without_branch(function.form) {
            text.push_str(&format!(
                "
// One pose by the same instructions for every pose: no branch, no allocation, no recursion, so that time and stack are
// known beforehand. Not a number where an angle is beyond 1e6 rad.
{};
",
                self.one(function.form, "_without_branch")
            ));
        }
        if self.shared.has_rows() {
            text.push_str(&rows::declarations(self, function));
        }
        text
    }

    /// The function that prepares a form, up to its body.
    fn prepare(&self, function: &Function) -> String {
        let (prefix, name) = (&self.prefix, form_name(function.form));
        let errors = self
            .shared
            .errors
            .as_ref()
            .map_or_else(String::new, |_| format!("const {prefix}_errors *errors, "));
        format!("void {prefix}_{name}_prepare({errors}{prefix}_{name}_prepared *prepared)")
    }

    /// The function of one pose, up to its body.
    fn one(&self, form: Form, variant: &str) -> String {
        let (prefix, name, result) = (&self.prefix, form_name(form), result(form));
        let pose = self.of_pose(&|group| format!("const {prefix}_{0} *{0}, ", group.argument));
        format!(
            "void {prefix}_{name}{variant}(const {prefix}_{name}_prepared *prepared,\n    {pose}{prefix}_{result} *out)"
        )
    }

    fn definitions(&self, function: &Function) -> String {
        let lowered = pose(&function.program);
        let any_angle = self.any_angle();
        let mut variants = vec![("", any_angle)];
        if self.shared.has_variant_without_branch(function.form) {
            variants.push(("_without_branch", "trueaxis_sin_cos_without_branch("));
        }
        let prepared = self.code(any_angle);
        let real = real(self.shared.unit.precision);
        let mut text = format!("\n{}\n{{\n", self.prepare(function));
        if self.shared.errors.is_some() {
            text.push_str("    (void)errors;\n");
        }
        if lowered.kept.is_empty() {
            text.push_str("    prepared->values[0] = 0;\n");
        }
        text.push_str(&prepared.statements(&lowered.prepared, 4));
        for (place, value) in lowered.kept.iter().enumerate() {
            text.push_str(&format!("    prepared->values[{place}] = {};\n", prepared.text(value)));
        }
        text.push_str("}\n");
        let unread = self.of_pose(&|group| format!("    (void){};\n", group.argument));
        for (variant, sin_cos) in variants {
            let (signature, c) = (self.one(function.form, variant), self.code(sin_cos));
            let body = c.statements(&lowered.evaluated, 4);
            let places = self.shared.places(function.form, self.names);
            let stores: String = places
                .iter()
                .zip(&lowered.outputs)
                .map(|(place, value)| format!("    out->{place} = {};\n", c.text(value)))
                .collect();
            text.push_str(&format!(
                "\n{signature}\n{{\n    const {real} *const p = prepared->values;\n    (void)p;\n{unread}{body}{stores}}}\n"
            ));
        }
        text
    }

    /// Something of each argument of a pose.
    fn of_pose(&self, text: &dyn Fn(&Group) -> String) -> String {
        self.shared.pose.iter().map(text).collect()
    }
}

/// The type that a form puts out.
fn result(form: Form) -> &'static str {
    if form.is_jacobian() { "jacobian" } else { "observed" }
}
