//! Programs that call generated code and print a number a line: for every chain and form the single poses, then rows
//! of the batch.

use std::fmt::Write;

use codegen::Form;
use model_core::SymbolId;

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
        let fields = |of: &dyn Fn(&str) -> String, ids: &[SymbolId]| -> String {
            ids.iter()
                .map(|&id| format!("{0}: {1}, ", case.symbol_name(id), of(case.symbol_name(id))))
                .collect()
        };
        writeln!(text, "fn {name}() {{\n    use generated::{name}::*;").unwrap();
        for id in case.pose_symbols() {
            let column = case.column(id).join(", ");
            writeln!(text, "    let {}_column: [f64; {ROWS}] = [{column}];", case.symbol_name(id)).unwrap();
        }
        let errors: String = case
            .errors()
            .iter()
            .map(|&id| format!("{}: {}, ", case.symbol_name(id), case.column(id)[0]))
            .collect();
        writeln!(text, "    let errors = Errors {{ {errors} }};").unwrap();
        for (argument, symbols) in &case.pose {
            let (kind, rows) =
                if *argument == "joints" { ("Joints", "JointRows") } else { ("Inputs", "InputRows") };
            let one = fields(&|name| format!("{name}_column[row]"), symbols);
            let many = fields(&|name| format!("&{name}_column"), symbols);
            writeln!(text, "    let {argument} = |row: usize| {kind} {{ {one} }};").unwrap();
            writeln!(text, "    let {argument}_rows = {rows} {{ {many} }};").unwrap();
        }
        let one_pose = case.of_pose(&|argument, _| format!("&{argument}(row)"));
        let many_poses = case.of_pose(&|argument, _| format!("&{argument}_rows"));
        for (form, form_name) in FORMS {
            let kind: String =
                form_name.split('_').map(|word| word[..1].to_uppercase() + &word[1..]).collect();
            let flat = if form.is_jacobian() { ".into_iter().flatten()" } else { ".into_iter()" };
            let outputs = case.shown() * if form.is_jacobian() { case.errors().len() } else { 1 };
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
                format!(
                    "        assert_eq!(out, FirstOrderError::prepare(&errors).eval_without_branch({one_pose}));\n"
                )
            } else {
                String::new()
            };
            let slices: String = names.iter().map(|name| format!("{name}: {one}, ")).collect();
            write!(
                text,
                "    for row in 0..{SINGLE} {{
        let out = {form_name}(&errors, {one_pose});
{without_branch}{print}    }}
    let mut rows = vec![[0.0; {ROWS}]; {outputs}];
    let mut slices = rows.iter_mut().map(|row| row.as_mut_slice());
    {kind}::prepare(&errors).eval_rows({many_poses}, Observed {{ {slices} }}).unwrap();
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
        let prefix = codegen::snake_case(&case.chain.name);
        writeln!(main, "    if (count != 2 || strcmp({prefix}_path_taken(), arguments[1]) != 0)\n        return 1;\n    {name}();").unwrap();
        writeln!(text, "static void {name}(void)\n{{").unwrap();
        for id in case.pose_symbols() {
            let (index, column) = (id.index(), case.column(id).join(", "));
            writeln!(text, "    static const double column{index}[{ROWS}] = {{{column}}};").unwrap();
        }
        let list = |symbols: &[SymbolId], end: &str| -> String {
            let columns = symbols.iter().map(|id| format!("column{}{end}", id.index()));
            columns.collect::<Vec<_>>().join(", ")
        };
        let errors: Vec<String> = case.errors().iter().map(|&id| case.column(id)[0].clone()).collect();
        writeln!(text, "    const {prefix}_errors errors = {{{}}};", errors.join(", ")).unwrap();
        for (argument, symbols) in &case.pose {
            let singular = argument.trim_end_matches('s');
            let columns = list(symbols, "");
            writeln!(text, "    const {prefix}_{singular}_rows {argument}_rows = {{{columns}}};").unwrap();
        }
        writeln!(
            text,
            "    static const int compared[] = {{{compared}}};\n    static double rows[400][{ROWS}];\n    size_t row, output;"
        )
        .unwrap();
        let poses: String = case
            .pose
            .iter()
            .map(|(argument, symbols)| {
                format!(
                    "            const {prefix}_{argument} {argument} = {{{}}};\n",
                    list(symbols, "[row]")
                )
            })
            .collect();
        let one_pose = case.of_pose(&|argument, _| format!("&{argument}"));
        let many_poses = case.of_pose(&|argument, _| format!("&{argument}_rows"));
        for (form, form_name) in FORMS {
            let result = if form.is_jacobian() { "jacobian" } else { "observed" };
            let without_branch = if form == Form::FirstOrderError {
                format!(
                    "            {{
                {prefix}_{result} same;
                {prefix}_{form_name}_without_branch(&prepared, {one_pose}, &same);
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
{poses}            {prefix}_{result} out;
            {prefix}_{form_name}(&prepared, {one_pose}, &out);
            for (output = 0; output < outputs; output++)
                printf(\"%.17g\\n\", ((const double *)&out)[output]);
{without_branch}        }}
        for (output = 0; output < outputs; output++)
            ((double **)&slices)[output] = rows[output];
        {prefix}_{form_name}_rows(&prepared, {ROWS}, {many_poses}, &slices);
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

pub fn cpp(cases: &[Case]) -> String {
    let mut text =
        String::from("#include <cstdio>\n#include <cstdlib>\n#include <cstring>\n#include <vector>\n");
    for case in cases {
        writeln!(text, "#include \"{}.hpp\"", case.name).unwrap();
    }
    text.push_str(
        "
template <class Of> void print(const Of& of) {
    for (std::size_t at = 0; at < sizeof(Of) / sizeof(double); at++)
        std::printf(\"%.17g\\n\", reinterpret_cast<const double*>(&of)[at]);
}
template <class Of> void same(const Of& one, const Of& other) {
    if (std::memcmp(&one, &other, sizeof(Of)) != 0)
        std::exit(1);
}
",
    );
    let mut main = String::from("int main() {\n");
    let compared = COMPARED.map(|row| row.to_string()).join(", ");
    for case in cases {
        let (name, namespace) = (case.name, codegen::snake_case(&case.chain.name));
        writeln!(main, "    run_{name}();").unwrap();
        writeln!(text, "static void run_{name}() {{\n    namespace of = trueaxis::{namespace};").unwrap();
        for id in case.pose_symbols() {
            let (index, column) = (id.index(), case.column(id).join(", "));
            writeln!(text, "    const std::vector<double> column{index} = {{{column}}};").unwrap();
        }
        let list = |symbols: &[SymbolId], end: &str| -> String {
            symbols.iter().map(|id| format!("column{}{end}", id.index())).collect::<Vec<_>>().join(", ")
        };
        let errors: Vec<String> = case.errors().iter().map(|&id| case.column(id)[0].clone()).collect();
        writeln!(text, "    const of::Errors errors = {{{}}};", errors.join(", ")).unwrap();
        for (argument, symbols) in &case.pose {
            let kind = if *argument == "joints" { "Joint" } else { "Input" };
            let columns = list(symbols, "");
            writeln!(text, "    const of::{kind}Rows {argument}_rows = {{{columns}}};").unwrap();
        }
        let poses: String = case
            .pose
            .iter()
            .map(|(argument, symbols)| {
                let kind = if *argument == "joints" { "Joints" } else { "Inputs" };
                format!("            const of::{kind} {argument} = {{{}}};\n", list(symbols, "[row]"))
            })
            .collect();
        let one_pose = case.of_pose(&|argument, _| argument.to_owned());
        let many_poses = case.of_pose(&|argument, _| format!("{argument}_rows"));
        for (form, form_name) in FORMS {
            let kind: String =
                form_name.split('_').map(|word| word[..1].to_uppercase() + &word[1..]).collect();
            let result = if form.is_jacobian() { "Jacobian" } else { "Observed" };
            let without_branch = if form == Form::FirstOrderError {
                format!("            same(out, form.without_branch({one_pose}));\n")
            } else {
                String::new()
            };
            let observable = &case.chain.observables[0].name;
            let last = if form.is_jacobian() { "[0][0]" } else { "[0]" };
            let mapped = if form.is_jacobian() { "(0, 0)" } else { "[0]" };
            write!(
                text,
                "    {{
        const of::{kind} form(errors);
        for (std::size_t row = 0; row < {SINGLE}; row++) {{
{poses}            const of::{result} out = form({one_pose});
            print(out);
{without_branch}#ifdef TRUEAXIS_HAS_EIGEN
            same(trueaxis::eigen(out.{observable}){mapped}, out.{observable}{last});
#endif
        }}
        constexpr std::size_t outputs = sizeof(of::{result}) / sizeof(double);
        std::vector<std::vector<double>> rows(outputs, std::vector<double>({ROWS}));
        of::{result}Rows out;
        for (std::size_t output = 0; output < outputs; output++)
            reinterpret_cast<trueaxis::Span<double>*>(&out)[output] = rows[output];
        if (!form.rows({many_poses}, out))
            std::exit(1);
        for (const std::size_t row : {{{compared}}})
            for (const auto& column : rows)
                std::printf(\"%.17g\\n\", column[row]);
        reinterpret_cast<trueaxis::Span<double>*>(&out)[outputs - 1] = {{rows[0].data(), 3}};
        if (form.rows({many_poses}, out))
            std::exit(1);
    }}
"
            )
            .unwrap();
        }
        text.push_str("}\n");
    }
    text + &main + "}\n"
}

pub fn javascript(cases: &[Case]) -> String {
    let mut text = String::new();
    let mut main = String::from(
        "
const lines = [];
const print = (x) => lines.push(Object.is(x, -0) ? '-0' : String(x));
const at = (columns, row) => Object.fromEntries(Object.entries(columns).map(([name, column]) => [name, column[row]]));
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
            .pose
            .iter()
            .map(|(argument, symbols)| {
                let columns: String = symbols
                    .iter()
                    .map(|&id| {
                        format!("{}: Float64Array.of({}), ", case.symbol_name(id), case.column(id).join(", "))
                    })
                    .collect();
                format!("  const {argument} = {{{columns}}};\n")
            })
            .collect();
        let one_pose = |row: &str| case.of_pose(&|argument, _| format!("at({argument}, {row})"));
        let many_poses = case.of_pose(&|argument, _| argument.to_owned());
        let errors: String = case
            .errors()
            .iter()
            .map(|&id| format!("{}: {}, ", case.symbol_name(id), case.column(id)[0]))
            .collect();
        writeln!(main, "{{\n  const errors = {{...{name}.noErrors, {errors}}};\n{columns}").unwrap();
        for (_, form_name) in FORMS {
            let kind: String =
                form_name.split('_').map(|word| word[..1].to_uppercase() + &word[1..]).collect();
            let function = kind[..1].to_lowercase() + &kind[1..];
            let compared = COMPARED.map(|row| row.to_string()).join(", ");
            write!(
                main,
                "  {{
    const p = {name}.prepare{kind}(errors);
    for (let row = 0; row < {SINGLE}; row++) flat({name}.{function}(p, {})).forEach(print);
    const out = arrays({name}.{function}(p, {}));
    {name}.{function}Rows(p, {many_poses}, out);
    for (const row of [{compared}]) flat(out).forEach((array) => print(array[row]));
  }}
",
                one_pose("row"),
                one_pose("0")
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
        let columns: String = case
            .pose
            .iter()
            .map(|(argument, symbols)| {
                let columns: Vec<String> =
                    symbols.iter().map(|&id| format!("np.array([{}])", case.column(id).join(", "))).collect();
                format!("{argument} = [{}]\n", columns.join(", "))
            })
            .collect();
        let kind = |argument: &str| if argument == "joints" { "Joints" } else { "Inputs" };
        let one_pose = case.of_pose(&|argument, _| {
            format!("{name}.{}(*[float(column[row]) for column in {argument}])", kind(argument))
        });
        let many_poses = case.of_pose(&|argument, _| format!("{name}.{}(*{argument})", kind(argument)));
        let errors: Vec<String> = case.errors().iter().map(|&id| case.column(id)[0].clone()).collect();
        write!(
            text,
            "
import {name}

{columns}errors = {name}.Errors({})
",
            errors.join(", ")
        )
        .unwrap();
        for (_, form_name) in FORMS {
            write!(
                text,
                "p = {name}.prepare_{form_name}(errors)
for row in range({SINGLE}):
    show({name}.{form_name}(p, {one_pose}), [None])
show({name}.{form_name}(p, {many_poses}), {COMPARED:?})
"
            )
            .unwrap();
        }
    }
    text
}
