//! C over structure of arrays: blocks of rows through the paths of [`crate::vector`].

use std::fmt::Write;

use model_core::SymbolId;

use super::c::C;
use super::c_block::block;
use super::unit::{Function, form_name};
use crate::vector::{self, Dialect, Rows};

const ACCURACY: &str = "Sines and cosines are at
// most 0.9 units in the last place off for angles up to 1e6 rad, and right for any angle.";

/// How a caller asks for the path that functions of many poses take.
pub(super) fn declaration_of_path(c: &C<'_>) -> String {
    format!(
        "
// The instructions that functions of many poses run on here: \"portable\" (those of every processor of the target),
// \"x86-64-v3\" (AVX2 and FMA) or \"x86-64-v4\" (AVX-512 too).
const char *{}_path_taken(void);
",
        c.prefix
    )
}

/// Its definition.
pub(super) fn definition_of_path(c: &C<'_>) -> String {
    format!(
        "
const char *{}_path_taken(void)
{{
    switch (trueaxis_path()) {{
    case TRUEAXIS_V4:
        return \"x86-64-v4\";
    case TRUEAXIS_V3:
        return \"x86-64-v3\";
    default:
        return \"portable\";
    }}
}}
",
        c.prefix
    )
}

/// What a form declares for many poses, with what it needs: for Jacobians, the type of their blocks.
pub(super) fn declarations(c: &C<'_>, function: &Function) -> String {
    let mut text = String::new();
    if function.form.is_jacobian() {
        let loops = loops(c, function);
        let (prefix, name) = (&c.prefix, form_name(function.form));
        let columns = c.unit.errors().len();
        let fields = c
            .observable_fields()
            .fold(String::new(), |text, name| format!("{text}    unsigned short {name}[3][{columns}];\n"));
        let _ = write!(
            text,
            "
// A block of {name}: 64 poses. Derivatives that are the same function are held once, and columns are longer than a block,
// so that they do not all meet in the same places of the cache. One that starts at a multiple of 64 bytes is fastest.
typedef struct {{
    double values[{}][72];
}} {prefix}_{name}_block;

// Which of a block's values each derivative is.
typedef struct {{
{fields}}} {prefix}_{name}_places;
extern const {prefix}_{name}_places {prefix}_{name}_place;

// At most 64 poses, left in a block, so that they are still in the cache when they are used. {ACCURACY}
{};
",
            loops.distinct,
            block_signature(c, function),
        );
    }
    let _ = write!(
        text,
        "
// The same for many poses, but products may be fused with sums. {ACCURACY} Arrays must not overlap.
{};
",
        rows_signature(c, function)
    );
    text
}

/// The definitions.
pub(super) fn definitions(c: &C<'_>, function: &Function) -> String {
    let loops = loops(c, function);
    let mut text = block(c, function, &loops);
    text.push_str(&if function.form.is_jacobian() {
        blocks(c, function, &loops)
    } else {
        slices(c, function, &loops)
    });
    text
}

fn loops(c: &C<'_>, function: &Function) -> Rows {
    let name = |id: SymbolId| c.name(id);
    let dialect = Dialect {
        name: &name,
        binding: "const double",
        mul_add: "trueaxis_mul_add(fused, ",
        saturate: "trueaxis_saturate(",
        step: "trueaxis_step(",
    };
    vector::rows(&function.program, &dialect)
}

fn rows_signature(c: &C<'_>, function: &Function) -> String {
    let (prefix, name, result) = (&c.prefix, form_name(function.form), c.result(function.form));
    format!(
        "void {prefix}_{name}_rows(const {prefix}_{name}_prepared *prepared, size_t rows,\n    const {prefix}_joints_rows *joints, const {prefix}_{result}_rows *out)"
    )
}

fn block_signature(c: &C<'_>, function: &Function) -> String {
    let (prefix, name) = (&c.prefix, form_name(function.form));
    format!(
        "void {prefix}_{name}_rows_of_block(const {prefix}_{name}_prepared *prepared, size_t rows,\n    const {prefix}_joints_rows *joints, {prefix}_{name}_block *block)"
    )
}

/// A function for each path, all with the same parameters and the same body, and the choice between them.
fn paths(name: &str, parameters: &str, arguments: &str) -> (String, String) {
    let definitions = format!(
        "
#ifdef TRUEAXIS_HAS_PATHS
TRUEAXIS_TARGET_V3 static void {name}_v3({parameters})
{{
    {name}_on(1, {arguments});
}}

TRUEAXIS_TARGET_V4 static void {name}_v4({parameters})
{{
    {name}_on(1, {arguments});
}}
#endif
"
    );
    let choice = format!(
        "    switch (trueaxis_path()) {{
#ifdef TRUEAXIS_HAS_PATHS
    case TRUEAXIS_V4:
        {name}_v4({arguments});
        break;
    case TRUEAXIS_V3:
        {name}_v3({arguments});
        break;
#endif
    default:
        {name}_on(0, {arguments});
    }}
"
    );
    (definitions, choice)
}

/// Forms with few outputs: arrays of any length, block by block.
fn slices(c: &C<'_>, function: &Function, loops: &Rows) -> String {
    let (prefix, name, result) = (&c.prefix, form_name(function.form), c.result(function.form));
    let parameters = format!(
        "const {prefix}_{name}_prepared *prepared, size_t rows,\n    const {prefix}_joints_rows *joints, const {prefix}_{result}_rows *out"
    );
    let (definitions, choice) =
        paths(&format!("{prefix}_{name}"), &parameters, "prepared, rows, joints, out");
    let columns: String =
        loops.columns.iter().map(|&id| format!(", joints->{} + first", c.name(id))).collect();
    let places = c.places(function.form);
    let outs: String = places.iter().map(|place| format!(", out->{place} + first")).collect();
    let mut pose: String = c.joints.iter().map(|&id| c.name(id)).fold(String::new(), |text, name| {
        format!("{text}            pose.{name} = joints->{name}[start];\n")
    });
    if pose.is_empty() {
        pose.push_str("            pose.none = 0.0;\n");
    }
    let stores = places
        .iter()
        .fold(String::new(), |text, place| format!("{text}            out->{place}[start] = one.{place};\n"));
    format!(
        "
TRUEAXIS_INLINE void {prefix}_{name}_on(const int fused, {parameters})
{{
    size_t start;
    (void)joints;
    for (start = 0; start < rows; start += TRUEAXIS_ROWS) {{
        /* The last block may do rows again that the one before it did. */
        const size_t first = start + TRUEAXIS_ROWS <= rows ? start : rows - TRUEAXIS_ROWS;
        {prefix}_{name}_compute(fused, prepared->values{columns}{outs});
    }}
}}
{definitions}
{}
{{
    if (rows < TRUEAXIS_ROWS) {{
        size_t start;
        for (start = 0; start < rows; start++) {{
            {prefix}_joints pose;
            {prefix}_{result} one;
{pose}            {prefix}_{name}(prepared, &pose, &one);
{stores}        }}
        return;
    }}
{choice}}}
",
        rows_signature(c, function)
    )
}

/// Jacobians: a block at a time, so that it is still in the cache when it is used.
fn blocks(c: &C<'_>, function: &Function, loops: &Rows) -> String {
    let (prefix, name) = (&c.prefix, form_name(function.form));
    let parameters = format!("const double *p, const double *const *columns, {prefix}_{name}_block *block");
    let (definitions, choice) =
        paths(&format!("{prefix}_{name}"), &parameters, "prepared->values, columns, block");
    let definitions = definitions.replace("prepared->values", "p");
    let columns: String = (0..loops.columns.len()).map(|index| format!(", columns[{index}]")).collect();
    let read: Vec<String> = loops.columns.iter().map(|&id| format!("joints->{}", c.name(id))).collect();
    let count = read.len();
    let whole = if read.is_empty() {
        "    const double *const *const columns = 0;\n    (void)rows;\n    (void)joints;\n".to_owned()
    } else {
        format!(
            "    const double *columns[{count}] = {{{}}};
    double padded[{count}][TRUEAXIS_ROWS];
    if (rows < TRUEAXIS_ROWS) {{
        size_t column, row;
        for (column = 0; column < {count}; column++) {{
            for (row = 0; row < TRUEAXIS_ROWS; row++)
                padded[column][row] = row < rows ? columns[column][row] : 0.0;
            columns[column] = padded[column];
        }}
    }}
",
            read.join(", ")
        )
    };
    let columns_out = c.unit.errors().len();
    let mut places = loops.places.chunks(columns_out);
    let fields = c.observable_fields().fold(String::new(), |mut text, _| {
        text.push_str("    {");
        for row in places.by_ref().take(3) {
            let row: Vec<String> = row.iter().map(usize::to_string).collect();
            let _ = write!(text, "{{{}}}, ", row.join(", "));
        }
        text + "},\n"
    });
    let part =
        c.joints.iter().map(|&id| c.name(id)).fold(String::new(), |text, name| {
            format!("{text}        part.{name} = joints->{name} + start;\n")
        });
    let copies = c.observable_fields().fold(String::new(), |text, observable| {
        format!(
            "{text}                for (row = 0; row < count; row++)
                    out->{observable}[component][column][start + row] =
                        block.values[{prefix}_{name}_place.{observable}[component][column]][row];
"
        )
    });
    format!(
        "
const {prefix}_{name}_places {prefix}_{name}_place = {{
{fields}}};

TRUEAXIS_INLINE void {prefix}_{name}_on(const int fused, {parameters})
{{
    (void)columns;
    {prefix}_{name}_compute(fused, p{columns}, block->values);
}}
{definitions}
{}
{{
{whole}{choice}}}

{}
{{
    size_t start, component, column, row;
    for (start = 0; start < rows; start += TRUEAXIS_ROWS) {{
        const size_t count = rows - start < TRUEAXIS_ROWS ? rows - start : TRUEAXIS_ROWS;
        {prefix}_joints_rows part = *joints;
        TRUEAXIS_ALIGNED {prefix}_{name}_block block;
{part}        {prefix}_{name}_rows_of_block(prepared, count, &part, &block);
        for (component = 0; component < 3; component++) {{
            for (column = 0; column < {columns_out}; column++) {{
{copies}            }}
        }}
    }}
}}
",
        block_signature(c, function),
        rows_signature(c, function),
    )
}
