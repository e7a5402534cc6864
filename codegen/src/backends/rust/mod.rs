//! Rust: one file of types and functions that needs nothing but `core`, and the same pieces for the macro `chain!`.
//!
//! The file can be a module of its own or be included in one. Sines and cosines come from [`crate::vector`]'s kernel,
//! whose text is part of the file, so that results are those of the interpreter.

mod code;
mod pieces;
mod rows;
mod types;

use self::code::{Constants, RULES, Rust};
use self::types::ALLOW;
use super::names::{Names, camel_case};
use super::notation::{Notation as _, Scope};
use super::unit::{Function, Group, OF_REGION, Shared, describe_form, form_name};
use crate::lower::pose;
use crate::program::Form;
use model_core::escape::comments;

pub use self::code::Stages;
pub use self::pieces::Pieces;

/// The text of the file.
#[must_use]
pub(crate) fn write(shared: &Shared<'_>) -> String {
    let names = Names::new(shared.unit.chain, RULES);
    let file = File { shared, names: &names };
    let mut text = comments::slashes(&shared.preamble());
    text.push_str(&file.types());
    for function in &shared.functions {
        text.push_str(&file.item(function));
    }
    text.push_str(&file.region());
    if let Some(date) = shared.unit.calibrated.valid_until {
        text.push_str(&format!(
            "\n/// The last day on which the calibration counts.\n#[allow(dead_code)]\npub const VALID_UNTIL: &str = \"{date}\";\n"
        ));
    }
    if shared.has_rows() {
        text.push_str(types::LENGTHS_DIFFER);
        text.push_str(rows::SHARED);
    }
    text.push_str(&rows::kernel(shared));
    text
}

/// One file.
struct File<'a> {
    shared: &'a Shared<'a>,
    names: &'a Names,
}

impl File<'_> {
    fn types(&self) -> String {
        let chain = self.shared.unit.chain;
        let mut text = String::new();
        for group in self.shared.pose.iter().chain(&self.shared.errors) {
            text.push_str(&types::structure(chain, self.names, group, self.shared.unit.precision));
        }
        if self.shared.has_rows() {
            text.extend(self.shared.pose.iter().map(|group| types::rows(chain, self.names, group)));
        }
        // Observables that show different counts of numbers have types of their own.
        let observables = self.shared.unit.observables;
        let kinds: Vec<String> = match self.shared.shown_by_each() {
            Some(_) => vec!["T".to_owned()],
            None => (0..observables.len()).map(|index| format!("T{index}")).collect(),
        };
        text.push_str(&format!(
            "\n/// One thing for each observable.\n#[derive(Debug, Clone, Copy, PartialEq, Default)]\n{ALLOW}\npub struct Observed<{}> {{\n",
            kinds.join(", ")
        ));
        for (&id, kind) in observables.iter().zip(kinds.iter().cycle()) {
            text.push_str("    ");
            text.push_str(&comments::rust_doc(&self.shared.describe_observable(id)));
            text.push_str(&format!("    pub {}: {kind},\n", self.names.observable(id)));
        }
        text.push_str("}\n");
        text
    }

    /// One form: a type that holds what is prepared, and what can be done with it.
    fn item(&self, function: &Function) -> String {
        let (name, kind) = (form_name(function.form), camel_case(form_name(function.form)));
        let about = describe_form(function.form);
        let real = code::real(self.shared.unit.precision);
        let shape = self.shape(function.form, real);
        let lowered = pose(&function.program);
        let stages = self.rust("sine_cosine::sin_cos").stages(&lowered, 8);
        let count = stages.kept.len();
        let cost = function.program.counts().evaluated;
        let errors = self.shared.errors.as_ref().map_or("", |_| "errors");
        let errors_parameter = self.shared.errors.as_ref().map_or("", |_| "errors: &Errors");
        let parameters = self.parameters();
        let all_parameters = [errors_parameter, &parameters].map(str::to_owned).into_iter();
        let all_parameters = all_parameters.filter(|text| !text.is_empty()).collect::<Vec<_>>().join(", ");
        let arguments = self.arguments();
        let kept: String = stages.kept.iter().map(|value| format!("                {value},\n")).collect();
        let receiver = if parameters.is_empty() { "&self" } else { "&self, " };
        let prepared = &stages.prepared;
        let body = self.body(function.form, &stages);
        let mut text = format!(
            "
/// {about}
///
/// Holds what depends on errors and constants alone; [`Self::eval`] does the rest for a pose.
/// Per pose: {cost}.
#[derive(Debug, Clone, Copy, PartialEq)]
{ALLOW}
pub struct {kind} {{
    prepared: [{real}; {count}],
}}

/// {about}
#[must_use]
{ALLOW}
pub fn {name}({all_parameters}) -> Observed<{shape}> {{
    {kind}::prepare({errors}).eval({arguments})
}}

#[allow(dead_code, unused_variables, non_snake_case, clippy::all, clippy::pedantic)]
impl {kind} {{
    /// Does what depends on errors and constants alone.
    #[must_use]
    pub fn prepare({errors_parameter}) -> Self {{
{prepared}        Self {{
            prepared: [
{kept}            ],
        }}
    }}

    /// One pose.
    #[must_use]
    pub fn eval({receiver}{parameters}) -> Observed<{shape}> {{
{body}    }}
"
        );
        if self.shared.has_variant_without_branch(function.form) {
            let stages = self.rust("sine_cosine::sin_cos_without_branch").stages(&lowered, 8);
            let body = self.body(function.form, &stages);
            text.push_str(&format!(
                "
    /// One pose as [`Self::eval`], by the same instructions for every pose: no branch, no allocation, no recursion, so
    /// that time and stack are known beforehand. Not a number where an angle is beyond 1e6 rad.
    #[must_use]
    pub fn eval_without_branch({receiver}{parameters}) -> Observed<{shape}> {{
{body}    }}
"
            ));
        }
        if self.shared.has_rows() {
            text.push_str(&rows::methods(self, function));
        }
        text.push_str("}\n");
        if self.shared.has_rows() {
            text.push_str(&rows::items(self, function));
        }
        text
    }

    /// Whether a pose lies in the measured region.
    fn region(&self) -> String {
        let Some(program) = &self.shared.region else { return String::new() };
        let (lowered, rust) = (pose(program), self.rust("sine_cosine::sin_cos"));
        let body = rust.statements(&lowered.evaluated, 4);
        let inside = lowered.outputs.iter().map(|value| rust.text(value)).collect::<String>();
        let parameters = self.parameters();
        format!(
            "
/// {OF_REGION}
#[must_use]
#[allow(dead_code, unused_variables, non_snake_case, clippy::all, clippy::pedantic)]
pub fn in_measured_region({parameters}) -> bool {{
{body}    {inside} > 0.5
}}
"
        )
    }

    /// The statements of a pose and what it returns.
    fn body(&self, form: Form, stages: &Stages) -> String {
        let observed = self.observed(form, &stages.outputs);
        format!("        let p = &self.prepared;\n{}        {observed}\n", stages.evaluated)
    }

    fn rust<'a>(&'a self, sin_cos: &'a str) -> Rust<'a> {
        Rust {
            chain: self.shared.unit.chain,
            names: self.names,
            scope: Scope::Pose,
            constants: Constants::AsDeclared,
            precision: self.shared.unit.precision,
            kernel: "sine_cosine::",
            sin_cos,
        }
    }

    /// `joints: &Joints, inputs: &Inputs`
    fn parameters(&self) -> String {
        self.of_pose(&|group| format!("{}: &{}", group.argument, group.type_name()))
    }

    /// `joints, inputs`
    fn arguments(&self) -> String {
        self.of_pose(&|group| group.argument.to_owned())
    }

    /// Something of each argument of a pose.
    fn of_pose(&self, text: &dyn Fn(&Group) -> String) -> String {
        self.shared.pose.iter().map(text).collect::<Vec<_>>().join(", ")
    }

    /// The type of one observable's part of a form, of numbers or of something else.
    fn shape(&self, form: Form, of: &str) -> String {
        let shape = |shown: usize| {
            if form.is_jacobian() {
                format!("[[{of}; {}]; {shown}]", self.shared.columns.len())
            } else {
                format!("[{of}; {shown}]")
            }
        };
        match self.shared.shown_by_each() {
            Some(shown) => shape(shown),
            None => {
                let observables = self.shared.unit.observables.iter();
                observables.map(|&id| shape(self.shared.shown(id))).collect::<Vec<_>>().join(", ")
            }
        }
    }

    /// Outputs in the shape in which they are returned.
    fn observed(&self, form: Form, outputs: &[String]) -> String {
        let columns = self.shared.columns_of(form);
        let rows: Vec<String> = outputs
            .chunks(columns.max(1))
            .map(|row| if form.is_jacobian() { format!("[{}]", row.join(", ")) } else { row.concat() })
            .collect();
        let mut text = String::from("Observed {\n");
        for (id, rows) in self.shared.by_observable(&rows) {
            text.push_str(&format!("            {}: [\n", self.names.observable(id)));
            text.extend(rows.iter().map(|row| format!("                {row},\n")));
            text.push_str("            ],\n");
        }
        text.push_str("        }");
        text
    }
}
