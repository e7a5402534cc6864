//! C++17: the C source as it is, which C++ compiles too, and a header with a namespace, classes and spans.
//!
//! C++17 has no `std::span`; `trueaxis::Span` of the header is a pointer and a count, and takes whatever has `data()` and
//! `size()`. Maps of Eigen are there where Eigen is.

use super::names::{Names, camel_case, snake_case};
use super::unit::{Function, Group, OF_REGION, Shared, describe_form, form_name};
use super::{c, file};
use crate::program::Form;
use model_core::escape::comments;

/// The source, the header of C++, and that of C which both include as `<file name>.h`.
pub(crate) fn write(shared: &Shared<'_>, file_name: &str) -> Vec<super::File> {
    let (header, source) = c::write(shared, file_name);
    let names = Names::new(shared.unit.chain, c::RULES);
    let prefix = c::RULES.letters(&snake_case(&shared.unit.chain.name));
    let classes = File { shared, names: &names, prefix }.header(file_name);
    vec![file("cpp", source), file("hpp", classes), file("h", header)]
}

/// What every header has in common, once for all that are included together.
const COMMON: &str = include_str!("cpp/common.hpp");

/// How the header is used.
const USE: &str = "
C++17. Compile the .cpp beside it with -ffp-contract=off for the same bits on every processor, and never with -ffast-math.
Columns are trueaxis::Span: a pointer and a count, made of anything contiguous that has data() and size(). Where <Eigen/Core>
is found, trueaxis::eigen maps results and spans without a copy; define TRUEAXIS_WITHOUT_EIGEN to leave it out.
";

/// The name of a field of columns, its shape, and what it is.
type Field = (String, String, String);

/// One header.
struct File<'a> {
    shared: &'a Shared<'a>,
    names: &'a Names,
    prefix: String,
}

impl File<'_> {
    fn header(&self, file_name: &str) -> String {
        let (prefix, shared) = (&self.prefix, self.shared);
        let (guard, mut namespace) = (prefix.to_uppercase(), c::RULES.spell(prefix));
        if matches!(namespace.as_str(), "detail" | "eigen") {
            namespace.push('_');
        }
        let mut text = comments::c(&format!("{}{USE}", shared.preamble()));
        text.push_str(&format!(
            "\n#ifndef {guard}_HPP\n#define {guard}_HPP\n\n#include \"{file_name}.h\"\n\n{COMMON}\n\
             namespace trueaxis::{namespace} {{\n"
        ));
        for group in shared.pose.iter().chain(&shared.errors) {
            let (kind, argument) = (group.type_name(), group.argument);
            text.push_str(&format!("\n// {}\nusing {kind} = ::{prefix}_{argument};\n", group.about));
        }
        for (kind, is_jacobian) in [("Observed", false), ("Jacobian", true)] {
            if shared.functions.iter().any(|function| function.form.is_jacobian() == is_jacobian) {
                text.push_str(&format!(
                    "\n// A field for each observable.\nusing {kind} = ::{prefix}_{};\n",
                    snake_case(kind)
                ));
                if shared.has_rows() {
                    text.push_str(&self.rows_of_results(kind, is_jacobian));
                }
            }
        }
        if shared.has_rows() {
            text.extend(shared.pose.iter().map(|group| self.rows_of(group)));
        }
        text.extend(shared.functions.iter().map(|function| self.class(function)));
        text.push_str(&self.inverses());
        if shared.region.is_some() {
            text.push_str(&format!(
                "\n// {OF_REGION}\n[[nodiscard]] inline bool in_measured_region({}) noexcept {{\n    return ::{prefix}_in_measured_region({}) != 0;\n}}\n",
                self.parameters(""),
                self.of_pose(&|group| format!("&{}", group.argument))
            ));
        }
        if let Some(date) = shared.unit.calibrated.valid_until {
            text.push_str(&format!(
                "\n// The last day on which the calibration counts.\ninline constexpr char valid_until[] = \"{date}\";\n"
            ));
        }
        text.push_str(&format!("\n}} // namespace trueaxis::{namespace}\n\n#endif\n"));
        text
    }

    /// Columns of results, which are written.
    fn rows_of_results(&self, kind: &str, is_jacobian: bool) -> String {
        let columns = if is_jacobian { format!("[{}]", self.shared.columns.len()) } else { String::new() };
        let shape = |id| format!("[{}]{columns}", self.shared.shown(id));
        let words = |id| self.shared.describe_observable(id);
        let field = |&id| (self.names.observable(id).to_owned(), shape(id), words(id));
        let fields: Vec<Field> = self.shared.unit.observables.iter().map(field).collect();
        self.columns(kind, "double", "Results of many poses: a column for each number.", &fields)
    }

    /// Columns of joints or inputs, which are read.
    fn rows_of(&self, group: &Group) -> String {
        let field = |&id| (self.names.symbol(id).to_owned(), String::new(), self.shared.describe(id));
        let fields: Vec<Field> = group.symbols.iter().map(field).collect();
        let about = format!("The {} of many poses: a column for each, all equally long.", group.argument);
        self.columns(&camel_case(group.singular()), "const double", &about, &fields)
    }

    /// A structure of spans. No name of a declaration begins as those of its functions.
    fn columns(&self, kind: &str, of: &str, about: &str, fields: &[Field]) -> String {
        let (prefix, c_name) = (&self.prefix, snake_case(kind));
        let declare = |(name, shape, about): &Field| {
            format!("    ::trueaxis::Span<{of}> {name}{shape}; {}", comments::c(about))
        };
        let declared: String = fields.iter().map(declare).collect();
        let each = |of: &dyn Fn(&str) -> String, between: &str| {
            fields.iter().map(|(name, ..)| of(name)).collect::<Vec<_>>().join(between)
        };
        let have = |name: &str| format!("::trueaxis::detail::have_length(this->{name}, rows)");
        let point = |name: &str| format!("        ::trueaxis::detail::point(this->{name}, to.{name});");
        let (have, point) = (each(&have, "\n            && "), each(&point, "\n"));
        format!(
            "
// {about}
struct {kind}Rows {{
{declared}
    // Whether every column has so many rows.
    [[nodiscard]] bool TRUEAXIS_have_length(::std::size_t rows) const noexcept {{
        return {have};
    }}

    [[nodiscard]] ::{prefix}_{c_name}_rows TRUEAXIS_pointers() const noexcept {{
        ::{prefix}_{c_name}_rows to;
{point}
        return to;
    }}
}};
"
        )
    }

    /// One form.
    fn class(&self, function: &Function) -> String {
        let (prefix, form) = (&self.prefix, form_name(function.form));
        let (kind, result) = (camel_case(form), result(function.form));
        let about = describe_form(function.form);
        let cost = function.program.counts().evaluated;
        let each = |of: &dyn Fn(&str) -> String| -> String {
            self.shared.pose.iter().map(|group| of(group.argument)).collect()
        };
        let (parameters, passed) = (self.parameters(""), each(&|argument| format!("&{argument}, ")));
        let (errors, given) = match &self.shared.errors {
            Some(_) => ("const Errors& errors", "&errors, "),
            None => ("", ""),
        };
        let explicit = if errors.is_empty() { "" } else { "explicit " };
        let one = |name: &str, variant: &str| {
            format!(
                "    [[nodiscard]] {result} {name}({parameters}) const noexcept {{
        {result} out;
        ::{prefix}_{form}{variant}(&prepared_, {passed}&out);
        return out;
    }}
"
            )
        };
        let mut methods = format!("    // One pose.\n{}", one("operator()", ""));
        if self.shared.has_variant_without_branch(function.form) {
            methods.push_str("\n    // One pose by the same instructions for every pose.\n");
            methods.push_str(&one("without_branch", "_without_branch"));
        }
        if let (true, Some(first)) = (self.shared.has_rows(), self.shared.pose.first()) {
            let rows = self.parameters("Rows");
            let counted = first.symbols.first().map_or("", |&id| self.names.symbol(id));
            let have = each(&|argument| format!("{argument}.TRUEAXIS_have_length(count) && "));
            let passed = each(&|argument| format!("&{argument}_of_c, "));
            let point = |argument: &str| {
                format!("        const auto {argument}_of_c = {argument}.TRUEAXIS_pointers();\n")
            };
            let point = each(&point);
            methods.push_str(&format!(
                "
    // Many poses; false, and nothing is written, where columns are not equally long. Columns must not overlap.
    [[nodiscard]] bool rows({rows}, const {result}Rows& out) const noexcept {{
        const ::std::size_t count = {}.{counted}.size();
        if (!({have}out.TRUEAXIS_have_length(count)))
            return false;
{point}        const auto out_of_c = out.TRUEAXIS_pointers();
        ::{prefix}_{form}_rows(&prepared_, count, {passed}&out_of_c);
        return true;
    }}
",
                first.argument
            ));
        }
        format!(
            "
// {about}
// Holds what depends on errors and constants alone. Per pose: {cost}.
class {kind} {{
public:
    {explicit}{kind}({errors}) noexcept {{ ::{prefix}_{form}_prepare({given}&prepared_); }}

{methods}
private:
    ::{prefix}_{form}_prepared prepared_;
}};
"
        )
    }

    /// The inverse correction of each observable that shows components.
    fn inverses(&self) -> String {
        let Some(joints) = self.shared.joints_to_correct() else { return String::new() };
        let (parameters, passed) = (self.parameters(""), self.of_pose(&|group| group.argument.to_owned()));
        let fields = joints.symbols.iter().map(|&id| format!("&Joints::{}", self.names.symbol(id)));
        let (count, fields) = (joints.symbols.len(), fields.collect::<Vec<_>>().join(", "));
        let inverse = |id| {
            let name = self.names.observable(id);
            format!(
                "
// What to add to the joint readings so that `{name}` with the errors is what it is at these readings without them. Returns
// the distance that remains: more than rounding where no readings do that.
[[nodiscard]] inline double inverse_correction_{name}(const ExactValue& value, const ExactError& error, {parameters},
                                                      Joints& correction) {{
    static constexpr double Joints::*const fields[{count}] = {{{fields}}};
    return ::trueaxis::detail::inverse(&Observed::{name}, fields, value, error, correction, {passed});
}}
"
            )
        };
        self.shared.with_inverse().map(inverse).collect()
    }

    /// Something of each argument of a pose, in a list.
    fn of_pose(&self, of: &dyn Fn(&Group) -> String) -> String {
        self.shared.pose.iter().map(of).collect::<Vec<_>>().join(", ")
    }

    /// `const Joints& joints, const Inputs& inputs`, or the same of many poses.
    fn parameters(&self, rows: &str) -> String {
        self.of_pose(&|group| match rows {
            "" => format!("const {}& {}", group.type_name(), group.argument),
            _ => format!("const {}{rows}& {}", camel_case(group.singular()), group.argument),
        })
    }
}

/// The type that a form puts out.
fn result(form: Form) -> &'static str {
    if form.is_jacobian() { "Jacobian" } else { "Observed" }
}
