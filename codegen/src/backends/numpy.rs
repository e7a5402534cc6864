//! Python with NumPy: functions of numbers and of arrays alike.

use std::fmt::Write;

use model_core::{Chain, SymbolId, SymbolKind};

use super::listing::{Statement, Words, list};
use super::unit::{Function, Unit, describe_form, form_name, unreserved};

/// Puts components and columns together; what does not depend on the pose is the same in each.
const STACK: &str = "

def _poses(joints):
    return np.broadcast_shapes(*(np.shape(value) for value in vars(joints).values()))


def _stack(values, shape, poses):
    values = [np.broadcast_to(value, poses) for value in values]
    return np.array(values).reshape(shape + poses)
";

/// The text of the file.
pub(crate) fn write(unit: &Unit<'_>) -> String {
    let functions = unit.functions();
    let joints = unit.joints(&functions);
    let mut text = String::from("r\"\"\"");
    for line in unit.preamble() {
        let _ = writeln!(text, "{}", line.replace("\"\"\"", "'''"));
    }
    text.push_str(
        "\"\"\"\n\nfrom dataclasses import dataclass\nfrom typing import Any\n\nimport numpy as np\n",
    );
    class(
        &mut text,
        "Joints",
        "Where the instrument is: numbers, or arrays of many poses.",
        joints.iter().map(|&id| (format!("{}: Any", name(unit.chain, id)), unit.describe(id))),
    );
    class(
        &mut text,
        "Errors",
        "What is wrong with the instrument; by default nothing.",
        unit.errors()
            .into_iter()
            .map(|id| (format!("{}: float = 0.0", name(unit.chain, id)), unit.describe(id))),
    );
    class(
        &mut text,
        "Observed",
        "An array for each observable: its components first, then the columns of a Jacobian, then the poses.",
        unit.observables.iter().map(|&id| {
            let name = unreserved(unit.chain, &unit.chain.observable(id).name, &RESERVED);
            (format!("{name}: np.ndarray"), unit.describe_observable(id))
        }),
    );
    text.push_str(STACK);
    for function in &functions {
        text.push_str(&one_form(unit, function));
    }
    text
}

fn class(text: &mut String, name: &str, about: &str, fields: impl Iterator<Item = (String, String)>) {
    let _ = write!(text, "\n\n@dataclass\nclass {name}:\n    \"\"\"{about}\"\"\"\n\n");
    let mut is_empty = true;
    for (field, about) in fields {
        is_empty = false;
        let _ = writeln!(text, "    {field}  # {about}");
    }
    if is_empty {
        text.push_str("    pass\n");
    }
}

fn one_form(unit: &Unit<'_>, function: &Function) -> String {
    let form = function.form;
    let (name, about) = (form_name(form), describe_form(form));
    let listing = list(&function.program, &Names { chain: unit.chain });
    let mut text = format!(
        "

def prepare_{name}(errors):
    \"\"\"Does what {name} needs once for a set of errors.\"\"\"
{}    return (
{}    )


def {name}(p, joints):
    \"\"\"{about}

    `p` is what prepare_{name} returned. Sines and cosines, and their accuracy, are NumPy's.
    \"\"\"
    poses = _poses(joints)
{}    return Observed(
",
        statements(&listing.prepared),
        listing.carried.iter().fold(String::new(), |text, value| format!("{text}        {value},\n")),
        statements(&listing.evaluated),
    );
    let mut components = listing.components(unit.columns_of(form));
    for _ in unit.observables {
        text.push_str("        _stack([\n");
        for _ in 0..3 {
            for output in components.next().unwrap_or_default() {
                let _ = writeln!(text, "            {output},");
            }
        }
        let shape = if form.is_jacobian() { format!("(3, {})", unit.errors().len()) } else { "(3,)".into() };
        let _ = writeln!(text, "        ], {shape}, poses),");
    }
    text.push_str("    )\n");
    text
}

fn statements(statements: &[Statement]) -> String {
    statements.iter().fold(String::new(), |mut text, statement| {
        match statement {
            Statement::Let { name, value } => {
                let _ = writeln!(text, "    {name} = {value}");
            }
            Statement::SinCos { angle, sin, cos } => {
                for (function, name) in [("sin", sin), ("cos", cos)] {
                    if let Some(name) = name {
                        let _ = writeln!(text, "    {name} = np.{function}({angle})");
                    }
                }
            }
        }
        text
    })
}

fn name(chain: &Chain, id: SymbolId) -> String {
    unreserved(chain, &chain.symbol(id).name, &RESERVED)
}

/// How Python writes a program.
struct Names<'a> {
    chain: &'a Chain,
}

impl Words for Names<'_> {
    fn symbol(&self, id: SymbolId) -> String {
        let symbol = self.chain.symbol(id);
        match symbol.kind {
            SymbolKind::Error => format!("errors.{}", name(self.chain, id)),
            SymbolKind::Ramp => unreachable!("a ramp is computed from its joint or input"),
            SymbolKind::Joint | SymbolKind::Input => format!("joints.{}", name(self.chain, id)),
            SymbolKind::Pi | SymbolKind::Constant => self.number(symbol.value.unwrap_or(f64::NAN)),
        }
    }

    fn wave_of_symbol(&self, wave: &str, id: SymbolId) -> String {
        format!("{wave}_{}", self.chain.symbol(id).name)
    }

    fn saturate(&self, a: &str) -> String {
        format!("np.clip({a}, 0.0, 1.0)")
    }

    fn step(&self, a: &str) -> String {
        format!("np.heaviside({a}, 1.0)")
    }

    fn carried(&self, index: usize) -> String {
        format!("p[{index}]")
    }

    fn local(&self, index: usize) -> String {
        format!("t{index}")
    }
}

/// Words of Python that a name in a declaration may be.
const RESERVED: [&str; 22] = [
    "False", "None", "True", "and", "assert", "class", "def", "del", "elif", "except", "finally", "from",
    "global", "import", "is", "lambda", "nonlocal", "not", "or", "pass", "raise", "with",
];
