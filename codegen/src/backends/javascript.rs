//! JavaScript: a module without dependencies, for numbers and for typed arrays.

use model_core::{Chain, SymbolId, SymbolKind};

use super::names::{Names, Rules, camel_case};
use super::notation::{Notation, Scope};
use super::unit::{self, Group, OF_REGION, Shared, describe_form, form_name};
use crate::lower::tree::{Function, Name, Statement};
use crate::lower::{Pose, pose};
use crate::program::{Form, Op};
use model_core::escape::comments;

/// Any word can be a property, but one is no ordinary one.
const RULES: Rules = Rules { words: &["__proto__"], starts: &[], takes_letters: true, longest: usize::MAX };

/// Refuses fields that are unknown or missing: a misspelt joint would be NaN, a misspelt error nothing.
const CHECK: &str = "
function check(what, names, given) {
  if (given === null || typeof given !== 'object') throw new TypeError(`${what} must be an object`);
  for (const name of Object.keys(given)) {
    if (!names.includes(name)) throw new TypeError(`${what} have no field ${name}: there are ${names.join(', ')}`);
  }
  for (const name of names) {
    if (!Object.hasOwn(given, name)) throw new TypeError(`${what} lack the field ${name}`);
  }
}
";

/// What ramps are made of.
const RAMPS: &str = "
function saturate(x) {
  return x <= 0 ? 0 : x >= 1 ? 1 : x;
}

function step(x) {
  return x >= 0 ? 1 : x < 0 ? 0 : x;
}
";

/// The text of the file.
pub(crate) fn write(shared: &Shared<'_>) -> String {
    let names = Names::new(shared.unit.chain, RULES);
    let file = File { shared, names: &names };
    let mut text = comments::slashes(&shared.preamble());
    for group in shared.pose.iter().chain(&shared.errors) {
        text.push_str(&file.group(group));
    }
    if let Some(errors) = &shared.errors {
        let zeros: String = file.each(errors, &|name| format!("  {name}: 0,\n"));
        text.push_str(&format!(
            "\n/** No errors. */\nexport const noErrors = Object.freeze({{\n{zeros}}});\n"
        ));
    }
    if !shared.pose.is_empty() || shared.errors.is_some() {
        text.push_str(CHECK);
    }
    for function in &shared.functions {
        text.push_str(&file.form(function));
    }
    text.push_str(&file.region());
    let is_of_ramps = |op: &Op| matches!(op, Op::Saturate(_) | Op::Step(_));
    let programs = shared.functions.iter().map(|function| &function.program).chain(&shared.region);
    if programs.into_iter().any(|program| program.nodes().iter().any(is_of_ramps)) {
        text.push_str(RAMPS);
    }
    text
}

/// One file.
struct File<'a> {
    shared: &'a Shared<'a>,
    names: &'a Names,
}

impl File<'_> {
    /// The type of a group, and the names of its fields.
    fn group(&self, group: &Group) -> String {
        let fields: String = group
            .symbols
            .iter()
            .map(|&id| {
                let about = comments::javascript_doc(&self.shared.describe(id));
                format!(" * @property {{number}} {} {about}\n", self.names.symbol(id))
            })
            .collect();
        let (about, kind, argument) = (group.about, group.type_name(), group.argument);
        let names = self.each(group, &|name| format!("'{name}', "));
        let names = names.trim_end_matches(", ");
        format!(
            "\n/**\n * {about}\n * @typedef {{Object}} {kind}\n{fields} */\n\nconst {argument}Fields = [{names}];\n"
        )
    }

    fn each(&self, group: &Group, text: &dyn Fn(&str) -> String) -> String {
        group.symbols.iter().map(|&id| text(self.names.symbol(id))).collect()
    }

    fn form(&self, function: &unit::Function) -> String {
        let about = describe_form(function.form);
        let kind = camel_case(form_name(function.form));
        let name = format!("{}{}", kind[..1].to_lowercase(), &kind[1..]);
        let lowered = pose(&function.program);
        let js = JavaScript { chain: self.shared.unit.chain, names: self.names, row: "" };
        let prepared = js.statements(&lowered.prepared, 2);
        let kept: String = lowered.kept.iter().map(|value| format!("    {},\n", js.text(value))).collect();
        let evaluated = js.statements(&lowered.evaluated, 2);
        let observed = self.observed(&js, function.form, &lowered);
        let check = |group: &Group| {
            let argument = group.argument;
            format!("  check('{argument}', {argument}Fields, {argument});\n")
        };
        let document = |group: &Group| format!(" * @param {{{}}} {}\n", group.type_name(), group.argument);
        let errors = self.shared.errors.as_ref();
        let (errors, errors_document, errors_check) = (
            errors.map_or("", |group| group.argument),
            errors.map_or_else(String::new, document),
            errors.map_or_else(String::new, check),
        );
        let pose = &self.shared.pose;
        let documents: String = pose.iter().map(document).collect();
        let checks: String = pose.iter().map(check).collect();
        let arguments: String = pose.iter().map(|group| format!(", {}", group.argument)).collect();
        let mut text = format!(
            "
/**
 * Does what {name} needs once for a set of errors.
{errors_document} * @returns {{Float64Array}}
 */
export function prepare{kind}({errors}) {{
{errors_check}{prepared}  return Float64Array.of(
{kept}  );
}}

/**
 * {about}
 * @param {{Float64Array}} p from prepare{kind}
{documents} */
export function {name}(p{arguments}) {{
{checks}{evaluated}  return {observed};
}}
"
        );
        let first = pose.first().and_then(|group| Some((group.argument, group.symbols.first()?)));
        let Some((argument, &first)) = first.filter(|_| self.shared.has_rows()) else { return text };
        let first = self.names.symbol(first);
        let js = JavaScript { row: "[row]", ..js };
        let evaluated = js.statements(&lowered.evaluated, 4);
        let stores: String = self
            .shared
            .places(function.form, self.names)
            .iter()
            .zip(&lowered.outputs)
            .map(|(place, value)| format!("    out.{place}[row] = {};\n", js.text(value)))
            .collect();
        let holders =
            pose.iter().map(|group| format!("`{}`", group.argument)).collect::<Vec<_>>().join(" and ");
        let lengths: String = pose
            .iter()
            .map(|group| {
                let argument = group.argument;
                format!(
                    "  for (const name of {argument}Fields) {{
    if ({argument}[name].length !== rows) throw new RangeError(`${{name}} has not as many rows as {first}`);
  }}
"
                )
            })
            .collect();
        text.push_str(&format!(
            "
/**
 * The same for many poses: {holders} hold an array for each field, all equally long, `out` has the shape of what {name}
 * returns, with an array in place of each number. Sines and cosines, and their accuracy, are those of Math.
 */
export function {name}Rows(p{arguments}, out) {{
{checks}  const rows = {argument}.{first}.length;
{lengths}  for (let row = 0; row < rows; row++) {{
{evaluated}{stores}  }}
}}
"
        ));
        text
    }

    /// Whether a pose lies in the measured region, and until when the calibration counts, where that is known.
    fn region(&self) -> String {
        let mut text = String::new();
        if let Some(program) = &self.shared.region {
            let lowered = pose(program);
            let js = JavaScript { chain: self.shared.unit.chain, names: self.names, row: "" };
            let evaluated = js.statements(&lowered.evaluated, 2);
            let inside = lowered.outputs.iter().map(|value| js.text(value)).collect::<String>();
            let pose = &self.shared.pose;
            let document =
                |group: &Group| format!(" * @param {{{}}} {}\n", group.type_name(), group.argument);
            let documents: String = pose.iter().map(document).collect();
            let check = |group: &Group| format!("  check('{0}', {0}Fields, {0});\n", group.argument);
            let checks: String = pose.iter().map(check).collect();
            let arguments = pose.iter().map(|group| group.argument).collect::<Vec<_>>().join(", ");
            text.push_str(&format!(
                "
/**
 * {OF_REGION}
{documents} * @returns {{boolean}}
 */
export function inMeasuredRegion({arguments}) {{
{checks}{evaluated}  return {inside} > 0.5;
}}
"
            ));
        }
        if let Some(date) = self.shared.unit.calibrated.valid_until {
            text.push_str(&format!(
                "\n/** The last day on which the calibration counts. */\nexport const validUntil = '{date}';\n"
            ));
        }
        text
    }

    fn observed(&self, js: &JavaScript<'_>, form: Form, lowered: &Pose) -> String {
        let rows: Vec<String> = lowered
            .components(self.shared.columns_of(form))
            .map(|row| {
                let row = row.iter().map(|value| js.text(value)).collect::<Vec<_>>().join(", ");
                if form.is_jacobian() { format!("      [{row}],\n") } else { format!("      {row},\n") }
            })
            .collect();
        let fields: String = self
            .shared
            .by_observable(&rows)
            .into_iter()
            .map(|(id, rows)| format!("    {}: [\n{}    ],\n", self.names.observable(id), rows.concat()))
            .collect();
        format!("{{\n{fields}  }}")
    }
}

/// JavaScript in one place of a file; `row` is what follows the name of a joint or input.
struct JavaScript<'a> {
    chain: &'a Chain,
    names: &'a Names,
    row: &'a str,
}

impl Notation for JavaScript<'_> {
    fn symbol(&self, id: SymbolId) -> String {
        let name = self.names.symbol(id);
        match self.chain.symbol(id).kind {
            SymbolKind::Ramp | SymbolKind::SightAngle => {
                unreachable!("a ramp or angle of a line of sight is computed from what it follows from")
            }
            SymbolKind::Error => format!("errors.{name}"),
            SymbolKind::Joint => format!("joints.{name}{}", self.row),
            SymbolKind::Input => format!("inputs.{name}{}", self.row),
            SymbolKind::Pi | SymbolKind::Constant => self.number(super::declared(self.chain, id)),
        }
    }

    fn call(&self, function: Function, a: &str) -> String {
        match function {
            Function::Saturate => format!("saturate({a})"),
            Function::Step => format!("step({a})"),
            Function::Root => format!("Math.sqrt({a})"),
        }
    }

    fn arc_tangent(&self, y: &str, x: &str) -> String {
        format!("Math.atan2({y}, {x})")
    }

    fn name(&self, name: Name) -> String {
        Scope::Pose.name(name, self.names)
    }
}

impl JavaScript<'_> {
    fn statements(&self, statements: &[Statement], indent: usize) -> String {
        let space = " ".repeat(indent);
        let mut text = String::new();
        for statement in statements {
            match statement {
                Statement::Let(name, value) => {
                    text.push_str(&format!("{space}const {} = {};\n", self.name(*name), self.text(value)));
                }
                Statement::SinCos { angle, sine, cosine } => {
                    for (function, name) in [("sin", sine), ("cos", cosine)] {
                        if let Some(name) = name {
                            let (name, angle) = (self.name(*name), self.text(angle));
                            text.push_str(&format!("{space}const {name} = Math.{function}({angle});\n"));
                        }
                    }
                }
                Statement::Angles(_)
                | Statement::SinCosOfRows(_)
                | Statement::EachRow(_)
                | Statement::Store(..) => {
                    unreachable!("JavaScript is written from what is done for one pose")
                }
            }
        }
        text
    }
}
