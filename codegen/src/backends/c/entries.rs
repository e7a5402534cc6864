//! One function a form for callers that know no structures: errors, columns and results by their places.
//!
//! It is what a program calls that loads a compiled file while it runs: sizes and fields of structures are known here.

use super::{File, result};
use crate::backends::unit::{Function, Group, form_name};

/// Rows that are worked on between two looks at a number that stands for a whole column. A multiple of a block, so that
/// blocks are those of all rows at once.
const STRIDE: usize = 256;

/// How many times a number that stands for a whole column must stand in memory.
pub(crate) const REPEATED: usize = 2 * STRIDE - 1;

/// The name of a form's entry.
pub(super) fn name(file: &File<'_>, function: &Function) -> String {
    format!("{}_{}_of_places", file.prefix, form_name(function.form))
}

/// A source that includes the generated one, and adds an entry for each form.
pub(super) fn source(file: &File<'_>, file_name: &str) -> String {
    let mut text = format!(
        "#include \"{file_name}.c\"

#if defined(__GNUC__) || defined(__clang__)
#define TRUEAXIS_ENTRY __attribute__((visibility(\"default\")))
#else
#define TRUEAXIS_ENTRY
#endif
"
    );
    for function in &file.shared.functions {
        text.push_str(&entry(file, function));
    }
    text
}

/// Rows from `start` to before `end` of `rows`. `pose` holds a column for each joint and input; its row is the one of all
/// times `steps`, which is 0 for a number. `out` holds all rows of the first number that comes out, then of the next; a
/// Jacobian puts out the `count` errors that `columns` lists.
fn entry(file: &File<'_>, function: &Function) -> String {
    let (prefix, form, name) = (&file.prefix, form_name(function.form), name(file, function));
    let (given, passed) = match &file.shared.errors {
        Some(group) => (given(file, group), "&given, "),
        None => ("    (void)errors;\n".to_owned(), ""),
    };
    let body = match (file.shared.has_rows(), function.form.is_jacobian()) {
        (true, true) => jacobian_of_blocks(file, function),
        (true, false) => components_of_rows(file, function),
        (false, true) => jacobian_of_one(file, function),
        (false, false) => components_of_one(file, function),
    };
    format!(
        "
TRUEAXIS_ENTRY void {name}(const double *errors, const double *const *pose, const size_t *steps, size_t rows, size_t start,
    size_t end, const size_t *columns, size_t count, double *out);
void {name}(const double *errors, const double *const *pose, const size_t *steps, size_t rows, size_t start,
    size_t end, const size_t *columns, size_t count, double *out)
{{
    size_t first;
    {prefix}_{form}_prepared prepared;
{given}    (void)pose;
    (void)steps;
    (void)columns;
    (void)count;
    {prefix}_{form}_prepare({passed}&prepared);
{body}}}
"
    )
}

/// The structure of errors, filled.
fn given(file: &File<'_>, group: &Group) -> String {
    let fields = group.symbols.iter().enumerate().map(|(place, &id)| {
        let name = file.names.symbol(id);
        format!("    given.{name} = errors[{place}];\n")
    });
    format!("    {}_errors given;\n{}", file.prefix, fields.collect::<String>())
}

/// The structures of columns, from row `first` on.
fn columns(file: &File<'_>) -> String {
    let mut place = 0;
    file.of_pose(&|group| format!("        {}_{}_rows {};\n", file.prefix, group.singular(), group.argument))
        + &file
            .shared
            .pose
            .iter()
            .flat_map(|group| group.symbols.iter().map(move |&id| (group, id)))
            .map(|(group, id)| {
                let (argument, name) = (group.argument, file.names.symbol(id));
                let line = format!("        {argument}.{name} = pose[{place}] + first * steps[{place}];\n");
                place += 1;
                line
            })
            .collect::<String>()
}

/// `&joints, &inputs, `
fn passed(file: &File<'_>) -> String {
    file.of_pose(&|group| format!("&{}, ", group.argument))
}

fn components_of_rows(file: &File<'_>, function: &Function) -> String {
    let (prefix, form, seen) = (&file.prefix, form_name(function.form), result(function.form));
    let places = file.shared.places(function.form, file.names);
    let outs: String = places
        .iter()
        .enumerate()
        .map(|(at, place)| format!("        seen.{place} = out + {at} * rows + first;\n"))
        .collect();
    let (columns, passed) = (columns(file), passed(file));
    format!(
        "    for (first = start; first < end;) {{
        const size_t left = end - first, some = left > {REPEATED} ? {STRIDE} : left;
        {prefix}_{seen}_rows seen;
{columns}{outs}        {prefix}_{form}_rows(&prepared, some, {passed}&seen);
        first += some;
    }}
"
    )
}

/// A few blocks are done before their derivatives are copied out: each derivative lies in pages of its own, and going to many of
/// them for one block's rows costs more than the arithmetic. Blocks too large for the stack are done one by one.
fn jacobian_of_blocks(file: &File<'_>, function: &Function) -> String {
    let (prefix, form) = (&file.prefix, form_name(function.form));
    let copies = each_derivative(
        file,
        &|observable| format!("const size_t place = {prefix}_{form}_place.{observable}[component][columns[column]]"),
        "for (first = 0; first < some; first += TRUEAXIS_ROWS) {
                    const double *from = blocks[first / TRUEAXIS_ROWS].values[place];
                    const size_t rest = some - first, rows_of_block = rest < TRUEAXIS_ROWS ? rest : TRUEAXIS_ROWS;
                    for (row = 0; row < rows_of_block; row++)
                        to[first + row] = from[row];
                }",
    );
    let (columns, passed) = (columns(file), passed(file));
    format!(
        "    enum {{ together = sizeof({prefix}_{form}_block) <= 65536 ? 4 : 1 }};
    size_t group;
    for (group = start; group < end; group += together * TRUEAXIS_ROWS) {{
        const size_t left = end - group, some = left < together * TRUEAXIS_ROWS ? left : together * TRUEAXIS_ROWS;
        size_t component, column, row, block = 0;
        double *to = out + group;
        TRUEAXIS_ALIGNED {prefix}_{form}_block blocks[together];
        for (first = group; first < group + some; first += TRUEAXIS_ROWS, block++) {{
        const size_t rest = group + some - first, rows_of_block = rest < TRUEAXIS_ROWS ? rest : TRUEAXIS_ROWS;
{columns}        {prefix}_{form}_rows_of_block(&prepared, rows_of_block, {passed}&blocks[block]);
        }}
{copies}    }}
"
    )
}

/// Without joints and inputs every row is the same.
fn components_of_one(file: &File<'_>, function: &Function) -> String {
    let (prefix, form, seen) = (&file.prefix, form_name(function.form), result(function.form));
    let places = file.shared.places(function.form, file.names);
    let stores: String = places
        .iter()
        .enumerate()
        .map(|(at, place)| format!("        out[{at} * rows + first] = seen.{place};\n"))
        .collect();
    format!(
        "    for (first = start; first < end; first++) {{
        {prefix}_{seen} seen;
        {prefix}_{form}(&prepared, &seen);
{stores}    }}
"
    )
}

fn jacobian_of_one(file: &File<'_>, function: &Function) -> String {
    let (prefix, form, seen) = (&file.prefix, form_name(function.form), result(function.form));
    let copies = each_derivative(
        file,
        &|observable| format!("const double from = seen.{observable}[component][columns[column]]"),
        "to[0] = from;",
    );
    format!(
        "    for (first = start; first < end; first++) {{
        size_t component, column;
        double *to = out + first;
        {prefix}_{seen} seen;
        {prefix}_{form}(&prepared, &seen);
{copies}    }}
"
    )
}

/// Loops over the derivatives that are wanted, in the order in which they come out; `to` is where each goes.
fn each_derivative(file: &File<'_>, from: &dyn Fn(&str) -> String, copy: &str) -> String {
    let observables = file.shared.unit.observables.iter();
    let loops = observables.map(|&id| {
        let (shown, from) = (file.shared.shown(id), from(file.names.observable(id)));
        format!(
            "        for (component = 0; component < {shown}; component++)
            for (column = 0; column < count; column++, to += rows) {{
                {from};
                {copy}
            }}
"
        )
    });
    loops.collect()
}
