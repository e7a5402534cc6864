//! Python with NumPy: functions of numbers and of arrays alike.

use model_core::{Chain, SymbolId, SymbolKind};

use super::names::{Names, Rules};
use super::notation::{Notation, Scope};
use super::unit::{self, Group, OF_REGION, Shared, describe_form, form_name};
use crate::lower::pose;
use crate::lower::tree::{Function, Name, Statement};
use model_core::escape::comments;

/// Python gives names with two underscores in front a meaning of their own.
const RULES: Rules = Rules { words: &RESERVED, starts: &["__"], takes_letters: true, longest: usize::MAX };

/// Puts components and columns together; what does not depend on the pose is the same in each.
const STACK: &str = "

def _poses(*arguments):
    return np.broadcast_shapes(*(np.shape(value) for argument in arguments for value in vars(argument).values()))


def _stack(values, shape, poses):
    values = [np.broadcast_to(value, poses) for value in values]
    return np.array(values).reshape(shape + poses)
";

/// The text of the file.
pub(crate) fn write(shared: &Shared<'_>) -> String {
    let names = Names::new(shared.unit.chain, RULES);
    let file = File { shared, names: &names };
    let mut text = format!("r\"\"\"{}\n\"\"\"\n", comments::python_doc(&shared.preamble()));
    text.push_str("\nfrom dataclasses import dataclass\nfrom typing import Any\n\nimport numpy as np\n");
    for group in shared.pose.iter().chain(&shared.errors) {
        text.push_str(&file.group(group));
    }
    let observables = shared.unit.observables.iter();
    let fields = observables
        .map(|&id| (format!("{}: np.ndarray", names.observable(id)), shared.describe_observable(id)));
    text.push_str(&class(
        "Observed",
        "An array for each observable: its components first, then the columns of a Jacobian, then the poses.",
        fields,
    ));
    text.push_str(STACK);
    for function in &shared.functions {
        text.push_str(&file.form(function));
    }
    text.push_str(&region(shared, &names, "np"));
    text
}

fn class(name: &str, about: &str, fields: impl Iterator<Item = (String, String)>) -> String {
    let fields: String =
        fields.map(|(field, about)| format!("    {field}  {}", comments::python(&about))).collect();
    format!("\n\n@dataclass\nclass {name}:\n    \"\"\"{about}\"\"\"\n\n{fields}")
}

/// One file.
struct File<'a> {
    shared: &'a Shared<'a>,
    names: &'a Names,
}

impl File<'_> {
    fn group(&self, group: &Group) -> String {
        let (about, kind) = match group.kind {
            SymbolKind::Error => (group.about.to_owned(), "float = 0.0"),
            _ => (format!("{} Numbers, or arrays of many poses.", group.about), "Any"),
        };
        let fields = group
            .symbols
            .iter()
            .map(|&id| (format!("{}: {kind}", self.names.symbol(id)), self.shared.describe(id)));
        class(&group.type_name(), &about, fields)
    }

    fn form(&self, function: &unit::Function) -> String {
        let form = function.form;
        let (name, about) = (form_name(form), describe_form(form));
        let lowered = pose(&function.program);
        let python = Python { chain: self.shared.unit.chain, names: self.names, library: "np" };
        let prepared = python.statements(&lowered.prepared);
        let kept: String =
            lowered.kept.iter().map(|value| format!("        {},\n", python.text(value))).collect();
        let evaluated = python.statements(&lowered.evaluated);
        let errors = self.shared.errors.as_ref().map_or("", |group| group.argument);
        let arguments: Vec<&str> = self.shared.pose.iter().map(|group| group.argument).collect();
        let parameters: String = arguments.iter().map(|argument| format!(", {argument}")).collect();
        let arguments = arguments.join(", ");
        let shape = |shown: usize| {
            if form.is_jacobian() {
                format!("({shown}, {})", self.shared.columns.len())
            } else {
                format!("({shown},)")
            }
        };
        let outputs: Vec<String> =
            lowered.outputs.iter().map(|value| format!("            {},\n", python.text(value))).collect();
        let rows: Vec<String> =
            outputs.chunks(self.shared.columns_of(form).max(1)).map(<[_]>::concat).collect();
        let stacks: String = self
            .shared
            .by_observable(&rows)
            .into_iter()
            .map(|(id, rows)| {
                let shape = shape(self.shared.shown(id));
                format!("        _stack([\n{}        ], {shape}, poses),\n", rows.concat())
            })
            .collect();
        format!(
            "

def prepare_{name}({errors}):
    \"\"\"Does what {name} needs once for a set of errors.\"\"\"
{prepared}    return (
{kept}    )


def {name}(p{parameters}):
    \"\"\"{about}

    `p` is what prepare_{name} returned. Sines and cosines, and their accuracy, are NumPy's.
    \"\"\"
    poses = _poses({arguments})
{evaluated}    return Observed(
{stacks}    )
"
        )
    }
}

/// Whether a pose lies in the measured region, and until when the calibration counts, where that is known.
pub(super) fn region(shared: &Shared<'_>, names: &Names, library: &'static str) -> String {
    let mut text = String::new();
    if let Some(program) = &shared.region {
        let (lowered, python) = (pose(program), Python { chain: shared.unit.chain, names, library });
        let evaluated = python.statements(&lowered.evaluated);
        let inside = lowered.outputs.iter().map(|value| python.text(value)).collect::<String>();
        let arguments: Vec<&str> = shared.pose.iter().map(|group| group.argument).collect();
        let arguments = arguments.join(", ");
        text.push_str(&format!(
            "

def in_measured_region({arguments}):
    \"\"\"{OF_REGION}\"\"\"
    poses = _poses({arguments})
{evaluated}    return {library}.broadcast_to({inside}, poses) > 0.5
"
        ));
    }
    if let Some(date) = shared.unit.calibrated.valid_until {
        text.push_str(&format!(
            "\n\n# The last day on which the calibration counts.\nVALID_UNTIL = \"{date}\"\n"
        ));
    }
    text
}

/// How Python writes a program.
pub(super) struct Python<'a> {
    pub(super) chain: &'a Chain,
    pub(super) names: &'a Names,
    /// What the library of arrays is called.
    pub(super) library: &'static str,
}

impl Notation for Python<'_> {
    fn symbol(&self, id: SymbolId) -> String {
        let name = self.names.symbol(id);
        match self.chain.symbol(id).kind {
            SymbolKind::Ramp | SymbolKind::SightAngle => {
                unreachable!("a ramp or angle of a line of sight is computed from what it follows from")
            }
            SymbolKind::Error => format!("errors.{name}"),
            SymbolKind::Joint => format!("joints.{name}"),
            SymbolKind::Input => format!("inputs.{name}"),
            SymbolKind::Pi | SymbolKind::Constant => self.number(super::declared(self.chain, id)),
        }
    }

    fn call(&self, function: Function, a: &str) -> String {
        let library = self.library;
        match function {
            Function::Saturate => format!("{library}.clip({a}, 0.0, 1.0)"),
            Function::Step => format!("{library}.heaviside({a}, 1.0)"),
            Function::Root => format!("{library}.sqrt({a})"),
        }
    }

    fn arc_tangent(&self, y: &str, x: &str) -> String {
        format!("{}.arctan2({y}, {x})", self.library)
    }

    fn name(&self, name: Name) -> String {
        Scope::Pose.name(name, self.names)
    }
}

impl Python<'_> {
    pub(super) fn statements(&self, statements: &[Statement]) -> String {
        let mut text = String::new();
        for statement in statements {
            match statement {
                Statement::Let(name, value) => {
                    text.push_str(&format!("    {} = {}\n", self.name(*name), self.text(value)));
                }
                Statement::SinCos { angle, sine, cosine } => {
                    for (function, name) in [("sin", sine), ("cos", cosine)] {
                        if let Some(name) = name {
                            let (name, angle) = (self.name(*name), self.text(angle));
                            text.push_str(&format!("    {name} = {}.{function}({angle})\n", self.library));
                        }
                    }
                }
                Statement::Angles(_)
                | Statement::SinCosOfRows(_)
                | Statement::EachRow(_)
                | Statement::Store(..) => unreachable!("Python is written from what is done for one pose"),
            }
        }
        text
    }
}

/// Words of Python that a name in a declaration may be.
pub(super) const RESERVED: [&str; 22] = [
    "False", "None", "True", "and", "assert", "class", "def", "del", "elif", "except", "finally", "from",
    "global", "import", "is", "lambda", "nonlocal", "not", "or", "pass", "raise", "with",
];
