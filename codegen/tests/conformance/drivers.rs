//! Programs that call generated code and print a number a line: for every chain and form the single poses, then rows
//! of the batch.

use std::fmt::Write;

use codegen::Form;

use crate::case::{COMPARED, Case, FORMS, ROWS, SINGLE};

/// A library without `std` of all generated files.
pub fn rust_library(cases: &[Case]) -> String {
    let mut text = String::from("//! Generated.\n#![no_std]\n#![warn(missing_docs)]\n");
    for case in cases {
        writeln!(text, "/// Generated.\n#[path = \"{0}.rs\"]\npub mod {0};", case.name).unwrap();
    }
    text
}

pub fn rust(cases: &[Case]) -> String {
    let mut text = String::from("#![allow(unused_mut)]\n");
    let mut main = String::from("fn main() {\n");
    for case in cases {
        let name = case.name;
        writeln!(main, "    {name}();").unwrap();
        let fields = |of: &dyn Fn(&str) -> String, ids: &[model_core::SymbolId]| -> String {
            ids.iter()
                .map(|&id| format!("{0}: {1}, ", case.symbol_name(id), of(case.symbol_name(id))))
                .collect()
        };
        writeln!(text, "fn {name}() {{\n    use generated::{name}::*;").unwrap();
        for &id in &case.joints {
            let column = case.column(id).join(", ");
            writeln!(text, "    let {}_column: [f64; {ROWS}] = [{column}];", case.symbol_name(id)).unwrap();
        }
        let errors: String = case
            .errors()
            .iter()
            .map(|&id| format!("{}: {}, ", case.symbol_name(id), case.column(id)[0]))
            .collect();
        writeln!(text, "    let errors = Errors {{ {errors} }};").unwrap();
        writeln!(
            text,
            "    let joints = |row: usize| Joints {{ {} }};",
            fields(&|name| format!("{name}_column[row]"), &case.joints)
        )
        .unwrap();
        writeln!(
            text,
            "    let columns = Columns {{ {} }};",
            fields(&|name| format!("&{name}_column"), &case.joints)
        )
        .unwrap();
        for (form, form_name) in FORMS {
            let kind: String =
                form_name.split('_').map(|word| word[..1].to_uppercase() + &word[1..]).collect();
            let flat = if form.is_jacobian() { ".into_iter().flatten()" } else { ".into_iter()" };
            let outputs =
                3 * case.observables.len() * if form.is_jacobian() { case.errors().len() } else { 1 };
            let one = if form.is_jacobian() {
                "core::array::from_fn(|_| core::array::from_fn(|_| slices.next().unwrap()))"
            } else {
                "core::array::from_fn(|_| slices.next().unwrap())"
            };
            let names: Vec<&str> =
                case.chain.observables.iter().map(|observable| observable.name.as_str()).collect();
            let print: String = names
                .iter()
                .map(|name| format!("        for x in out.{name}{flat} {{ println!(\"{{x:?}}\"); }}\n"))
                .collect();
            let without_branch = if form == Form::FirstOrderError {
                "        assert_eq!(out, FirstOrderError::prepare(&errors).eval_without_branch(&joints(row)));\n"
            } else {
                ""
            };
            let slices: String = names.iter().map(|name| format!("{name}: {one}, ")).collect();
            write!(
                text,
                "    for row in 0..{SINGLE} {{
        let out = {form_name}(&errors, &joints(row));
{without_branch}{print}    }}
    let mut rows = vec![[0.0; {ROWS}]; {outputs}];
    let mut slices = rows.iter_mut().map(|row| row.as_mut_slice());
    {kind}::prepare(&errors).eval_rows(&columns, Observed {{ {slices} }}).unwrap();
    for row in {COMPARED:?} {{ for out in &rows {{ println!(\"{{:?}}\", out[row]); }} }}
"
            )
            .unwrap();
        }
        text.push_str("}\n");
    }
    text + &main + "}\n"
}

pub fn c(cases: &[Case]) -> String {
    let mut text = String::from("#include <stdio.h>\n#include <string.h>\n");
    for case in cases {
        writeln!(text, "#include \"{}.h\"", case.name).unwrap();
    }
    // Called with the path that should be taken.
    let mut main = String::from("int main(int count, char **arguments)\n{\n");
    let compared = COMPARED.map(|row| row.to_string()).join(", ");
    for case in cases {
        let name = case.name;
        let prefix = codegen_prefix(case);
        writeln!(main, "    if (count != 2 || strcmp({prefix}_path_taken(), arguments[1]) != 0)\n        return 1;\n    {name}();").unwrap();
        writeln!(text, "static void {name}(void)\n{{").unwrap();
        for (index, &id) in case.joints.iter().enumerate() {
            writeln!(
                text,
                "    static const double column{index}[{ROWS}] = {{{}}};",
                case.column(id).join(", ")
            )
            .unwrap();
        }
        let list =
            |of: &dyn Fn(usize) -> String| (0..case.joints.len()).map(of).collect::<Vec<_>>().join(", ");
        let errors: Vec<String> = case.errors().iter().map(|&id| case.column(id)[0].clone()).collect();
        write!(
            text,
            "    const {prefix}_errors errors = {{{}}};
    const {prefix}_joints_rows columns = {{{}}};
    static const int compared[] = {{{compared}}};
    static double rows[400][{ROWS}];
    size_t row, output;
",
            errors.join(", "),
            list(&|index| format!("column{index}")),
        )
        .unwrap();
        for (form, form_name) in FORMS {
            let result = if form.is_jacobian() { "jacobian" } else { "observed" };
            let joints = list(&|index| format!("column{index}[row]"));
            let without_branch = if form == Form::FirstOrderError {
                format!(
                    "            {{
                {prefix}_{result} same;
                {prefix}_{form_name}_without_branch(&prepared, &joints, &same);
                if (memcmp(&same, &out, sizeof same) != 0)
                    return;
            }}
"
                )
            } else {
                String::new()
            };
            write!(
                text,
                "    {{
        {prefix}_{form_name}_prepared prepared;
        const size_t outputs = sizeof({prefix}_{result}) / sizeof(double);
        {prefix}_{result}_rows slices;
        {prefix}_{form_name}_prepare(&errors, &prepared);
        for (row = 0; row < {SINGLE}; row++) {{
            const {prefix}_joints joints = {{{joints}}};
            {prefix}_{result} out;
            {prefix}_{form_name}(&prepared, &joints, &out);
            for (output = 0; output < outputs; output++)
                printf(\"%.17g\\n\", ((const double *)&out)[output]);
{without_branch}        }}
        for (output = 0; output < outputs; output++)
            ((double **)&slices)[output] = rows[output];
        {prefix}_{form_name}_rows(&prepared, {ROWS}, &columns, &slices);
        for (row = 0; row < sizeof compared / sizeof compared[0]; row++)
            for (output = 0; output < outputs; output++)
                printf(\"%.17g\\n\", rows[output][compared[row]]);
    }}
"
            )
            .unwrap();
        }
        text.push_str("}\n");
    }
    text + &main + "    return 0;\n}\n"
}

/// What the public names of a chain begin with in C.
fn codegen_prefix(case: &Case) -> String {
    let mut prefix = String::new();
    for c in case.chain.name.chars() {
        if c.is_uppercase() && !prefix.is_empty() {
            prefix.push('_');
        }
        prefix.extend(c.to_lowercase());
    }
    prefix
}

pub fn javascript(cases: &[Case]) -> String {
    let mut text = String::new();
    let mut main = String::from(
        "
const lines = [];
const print = (x) => lines.push(Object.is(x, -0) ? '-0' : String(x));
const flat = (out) => Object.values(out).flat(Infinity);
const arrays = (out) => (typeof out === 'number' ? new Float64Array(ROWS)
  : Array.isArray(out) ? out.map(arrays)
  : Object.fromEntries(Object.entries(out).map(([name, value]) => [name, arrays(value)])));
",
    )
    .replace("ROWS", &ROWS.to_string());
    for case in cases {
        let name = case.name;
        writeln!(text, "import * as {name} from './{name}.js';").unwrap();
        let columns: String = case
            .joints
            .iter()
            .map(|&id| format!("{}: Float64Array.of({}), ", case.symbol_name(id), case.column(id).join(", ")))
            .collect();
        let errors: String = case
            .errors()
            .iter()
            .map(|&id| format!("{}: {}, ", case.symbol_name(id), case.column(id)[0]))
            .collect();
        writeln!(
            main,
            "{{\n  const errors = {{...{name}.noErrors, {errors}}};\n  const columns = {{{columns}}};"
        )
        .unwrap();
        for (_, form_name) in FORMS {
            let kind: String =
                form_name.split('_').map(|word| word[..1].to_uppercase() + &word[1..]).collect();
            let function = kind[..1].to_lowercase() + &kind[1..];
            let compared = COMPARED.map(|row| row.to_string()).join(", ");
            write!(
                main,
                "  {{
    const p = {name}.prepare{kind}(errors);
    const joints = (row) => Object.fromEntries(Object.entries(columns).map(([name, column]) => [name, column[row]]));
    for (let row = 0; row < {SINGLE}; row++) flat({name}.{function}(p, joints(row))).forEach(print);
    const out = arrays({name}.{function}(p, joints(0)));
    {name}.{function}Rows(p, columns, out);
    for (const row of [{compared}]) flat(out).forEach((array) => print(array[row]));
  }}
"
            )
            .unwrap();
        }
        main.push_str("}\n");
    }
    text + &main + "process.stdout.write(lines.join('\\n') + '\\n');\n"
}

pub fn numpy(cases: &[Case]) -> String {
    let mut text = String::from(
        "import dataclasses
import sys

import numpy as np


def show(out, rows):
    arrays = [getattr(out, field.name) for field in dataclasses.fields(out)]
    for row in rows:
        for array in arrays:
            values = array if row is None else array[..., row]
            for value in values.ravel():
                sys.stdout.write(repr(float(value)) + '\\n')

",
    );
    for case in cases {
        let name = case.name;
        let columns: Vec<String> =
            case.joints.iter().map(|&id| format!("np.array([{}])", case.column(id).join(", "))).collect();
        let errors: Vec<String> = case.errors().iter().map(|&id| case.column(id)[0].clone()).collect();
        write!(
            text,
            "
import {name}

columns = [{}]
errors = {name}.Errors({})
",
            columns.join(", "),
            errors.join(", ")
        )
        .unwrap();
        for (_, form_name) in FORMS {
            write!(
                text,
                "p = {name}.prepare_{form_name}(errors)
for row in range({SINGLE}):
    show({name}.{form_name}(p, {name}.Joints(*[float(column[row]) for column in columns])), [None])
show({name}.{form_name}(p, {name}.Joints(*columns)), {COMPARED:?})
"
            )
            .unwrap();
        }
    }
    text
}
