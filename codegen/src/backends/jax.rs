//! Python with JAX: pure functions of named tuples, for `jit`, `vmap`, `grad` and arrays of many poses.

use model_core::SymbolKind;
use model_core::escape::comments;

use super::names::{Names, Rules};
use super::notation::Notation as _;
use super::numpy::{Python, RESERVED};
use super::unit::{self, Group, Shared, describe_form, form_name};
use crate::lower::pose;

/// Fields of named tuples have no underscore in front.
const RULES: Rules = Rules { words: &RESERVED, starts: &["_"], takes_letters: true, longest: usize::MAX };

/// How the file is used.
const USE: &str = "
Functions are pure: jax.jit, jax.vmap, jax.grad and jax.jacfwd take them. JAX computes in single precision unless it is
told otherwise before: jax.config.update(\"jax_enable_x64\", True). Sines and cosines, and their accuracy, are JAX's.
";

/// Puts components and columns together; what does not depend on the pose is the same in each.
const STACK: &str = "

def _poses(*arguments):
    return jnp.broadcast_shapes(*(jnp.shape(value) for argument in arguments for value in argument))


def _stack(values, shape, poses):
    return jnp.stack([jnp.broadcast_to(value, poses) for value in values]).reshape(shape + poses)
";

/// Newton's steps from the joint readings, as many as double precision needs.
const INVERSE: &str = "
    seen, added = EXACT_VALUE, EXACT_ERROR
    target = getattr(seen, observable) - getattr(added, observable)
    start = jnp.stack([jnp.asarray(value, dtype=target.dtype) for value in joints])

    def shown(values):
        return getattr(exact_value(value, MOVED), observable)

    def better(_, at):
        left = target - shown(at)
        moved = at + jnp.linalg.pinv(jax.jacfwd(shown)(at), 1e-9) @ left
        return jnp.where(jnp.linalg.norm(target - shown(moved)) < jnp.linalg.norm(left), moved, at)

    at = jax.lax.fori_loop(0, 10, better, start)
    return Joints(*(at - start)), jnp.linalg.norm(target - shown(at))
";

/// The text of the file.
pub(crate) fn write(shared: &Shared<'_>) -> String {
    let names = Names::new(shared.unit.chain, RULES);
    let file = File { shared, names: &names };
    let mut text =
        format!("r\"\"\"{}\n\"\"\"\n", comments::python_doc(&format!("{}{USE}", shared.preamble())));
    text.push_str("\nfrom typing import Any, NamedTuple\n\nimport jax\nimport jax.numpy as jnp\n");
    for group in shared.pose.iter().chain(&shared.errors) {
        text.push_str(&file.group(group));
    }
    let observables = shared.unit.observables.iter();
    let fields =
        observables.map(|&id| (format!("{}: \"Any\"", names.observable(id)), shared.describe_observable(id)));
    text.push_str(&class(
        "Observed",
        "An array for each observable: its components first, then the columns of a Jacobian, then the poses.",
        fields,
    ));
    text.push_str(STACK);
    for function in &shared.functions {
        text.push_str(&file.form(function));
    }
    text.push_str(&super::numpy::region(shared, &names, "jnp"));
    text.push_str(&file.inverse());
    text
}

/// A named tuple; kinds of fields are quoted, so that no field before is taken for one.
fn class(name: &str, about: &str, fields: impl Iterator<Item = (String, String)>) -> String {
    let fields: String =
        fields.map(|(field, about)| format!("    {field}  {}", comments::python(&about))).collect();
    format!("\n\nclass {name}(NamedTuple):\n    \"\"\"{about}\"\"\"\n\n{fields}")
}

/// One file.
struct File<'a> {
    shared: &'a Shared<'a>,
    names: &'a Names,
}

impl File<'_> {
    fn group(&self, group: &Group) -> String {
        let (about, kind) = match group.kind {
            SymbolKind::Error => (group.about.to_owned(), "\"Any\" = 0.0"),
            _ => (format!("{} Numbers, or arrays of many poses.", group.about), "\"Any\""),
        };
        let field = |&id| (format!("{}: {kind}", self.names.symbol(id)), self.shared.describe(id));
        class(&group.type_name(), &about, group.symbols.iter().map(field))
    }

    /// `, joints, inputs`
    fn parameters(&self) -> String {
        self.shared.pose.iter().map(|group| format!(", {}", group.argument)).collect()
    }

    fn form(&self, function: &unit::Function) -> String {
        let (form, shared) = (function.form, self.shared);
        let (name, about) = (form_name(form), describe_form(form));
        let lowered = pose(&function.program);
        let python = Python { chain: shared.unit.chain, names: self.names, library: "jnp" };
        let prepared = python.statements(&lowered.prepared);
        let kept: String =
            lowered.kept.iter().map(|value| format!("        {},\n", python.text(value))).collect();
        let evaluated = python.statements(&lowered.evaluated);
        let errors = shared.errors.as_ref().map_or("", |group| group.argument);
        let parameters = self.parameters();
        let arguments = parameters.trim_start_matches(", ");
        let columns = shared.columns_of(form);
        let outputs: Vec<String> =
            lowered.outputs.iter().map(|value| format!("            {},\n", python.text(value))).collect();
        let rows: Vec<String> = outputs.chunks(columns.max(1)).map(<[_]>::concat).collect();
        let stack = |(id, rows): (_, &[String])| {
            let shown = shared.shown(id);
            let shape =
                if form.is_jacobian() { format!("({shown}, {columns})") } else { format!("({shown},)") };
            format!("        _stack([\n{}        ], {shape}, poses),\n", rows.concat())
        };
        let stacks: String = shared.by_observable(&rows).into_iter().map(stack).collect();
        format!(
            "

def prepare_{name}({errors}):
    \"\"\"Does what {name} needs once for a set of errors.\"\"\"
{prepared}    return (
{kept}    )


def {name}(p{parameters}):
    \"\"\"{about}

    `p` is what prepare_{name} returned.
    \"\"\"
    poses = _poses({arguments})
{evaluated}    return Observed(
{stacks}    )
"
        )
    }

    /// The joint readings that make up for the errors.
    fn inverse(&self) -> String {
        if self.shared.joints_to_correct().is_none() || self.shared.with_inverse().next().is_none() {
            return String::new();
        }
        let parameters = self.parameters();
        let arguments = parameters.trim_start_matches(", ");
        let body = INVERSE
            .replace("EXACT_VALUE", &format!("exact_value(value, {arguments})"))
            .replace("EXACT_ERROR", &format!("exact_error(error, {arguments})"))
            .replace("MOVED", &arguments.replacen("joints", "Joints(*values)", 1));
        let named = self.shared.with_inverse().map(|id| format!("\"{}\"", self.names.observable(id)));
        let named = named.collect::<Vec<_>>().join(", ");
        format!(
            "

def inverse_correction(observable, value, error{parameters}):
    \"\"\"What to add to the joint readings of one pose so that an observable with the errors is what it is at these readings
    without them; and the distance that remains: more than rounding where no readings do that. jax.vmap takes many poses.

    `observable` is one of {named}; `value` is what prepare_exact_value returned, `error` what prepare_exact_error did.
    \"\"\"{body}"
        )
    }
}
