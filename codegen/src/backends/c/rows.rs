//! C over structure of arrays: blocks of rows through the paths of [`crate::vector`].

use super::code::C;
use super::{File, result};
use model_core::ObservableId;

use crate::backends::notation::Scope;
use crate::backends::unit::{Function, Group, Precision, form_name};
use crate::lower::{Block, Fixed, block};

const ACCURACY: &str = "Sines and cosines are at
// most 0.9 units in the last place off for angles up to 1e6 rad, and right for any angle.";

/// How a caller asks for the path that functions of many poses take.
pub(super) fn declaration_of_path(prefix: &str) -> String {
    format!(
        "
// The instructions that functions of many poses run on here: \"portable\" (those of every processor of the target),
// \"x86-64-v3\" (AVX2 and FMA) or \"x86-64-v4\" (AVX-512 too).
const char *{prefix}_path_taken(void);
"
    )
}

/// Its definition.
pub(super) fn definition_of_path(prefix: &str) -> String {
    format!(
        "
const char *{prefix}_path_taken(void)
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
"
    )
}

/// What a form declares for many poses, with what it needs: for Jacobians, the type of their blocks.
pub(super) fn declarations(file: &File<'_>, function: &Function) -> String {
    let (prefix, name) = (&file.prefix, form_name(function.form));
    let mut text = String::new();
    if function.form.is_jacobian() {
        let distinct = lowered(function).distinct;
        let columns = file.shared.columns.len();
        let observables = file.shared.unit.observables.iter();
        let observables = observables.map(|&id| (file.names.observable(id), file.shared.shown(id)));
        let fields: String = observables
            .map(|(name, shown)| format!("    unsigned short {name}[{shown}][{columns}];\n"))
            .collect();
        let signature = block_signature(file, function);
        text.push_str(&format!(
            "
// A block of {name}: 64 poses. Derivatives that are the same function are held once, and columns are longer than a block,
// so that they do not all meet in the same places of the cache. One that starts at a multiple of 64 bytes is fastest.
typedef struct {{
    double values[{distinct}][72];
}} {prefix}_{name}_block;

// Which of a block's values each derivative is.
typedef struct {{
{fields}}} {prefix}_{name}_places;
extern const {prefix}_{name}_places {prefix}_{name}_place;

// At most 64 poses, left in a block, so that they are still in the cache when they are used. {ACCURACY}
{signature};
"
        ));
    }
    let signature = rows_signature(file, function);
    text.push_str(&format!(
        "
// The same for many poses, but products may be fused with sums. {ACCURACY} Arrays must not overlap.
{signature};
"
    ));
    text
}

/// The definitions.
pub(super) fn definitions(file: &File<'_>, function: &Function) -> String {
    let lowered = lowered(function);
    let mut text = compute(file, function, &lowered);
    text.push_str(&if function.form.is_jacobian() {
        of_jacobian(file, function, &lowered)
    } else {
        of_components(file, function, &lowered)
    });
    text
}

fn lowered(function: &Function) -> Block {
    block(&function.program, Fixed::InLoop)
}

/// `const x_joint_rows *joints, const x_input_rows *inputs`
fn parameters(file: &File<'_>) -> String {
    let prefix = &file.prefix;
    file.of_pose(&|group| format!("const {prefix}_{}_rows *{}, ", group.singular(), group.argument))
}

/// `joints, inputs, `
fn arguments(file: &File<'_>) -> String {
    file.of_pose(&|group| format!("{}, ", group.argument))
}

fn rows_signature(file: &File<'_>, function: &Function) -> String {
    let (prefix, name, result) = (&file.prefix, form_name(function.form), result(function.form));
    let pose = parameters(file);
    format!(
        "void {prefix}_{name}_rows(const {prefix}_{name}_prepared *prepared, size_t rows,\n    {pose}const {prefix}_{result}_rows *out)"
    )
}

fn block_signature(file: &File<'_>, function: &Function) -> String {
    let (prefix, name) = (&file.prefix, form_name(function.form));
    let pose = parameters(file);
    format!(
        "void {prefix}_{name}_rows_of_block(const {prefix}_{name}_prepared *prepared, size_t rows,\n    {pose}{prefix}_{name}_block *block)"
    )
}

/// The columns that a block reads: `joints->alpha`.
fn columns(file: &File<'_>, lowered: &Block) -> Vec<String> {
    let column = |&id| {
        let group = file.shared.pose.iter().find(|group| group.symbols.contains(&id));
        format!("{}->{}", group.map_or("", |group| group.argument), file.names.symbol(id))
    };
    lowered.columns.iter().map(column).collect()
}

/// What is done with a block of rows, `…_compute`. With sines and cosines in the loop over rows, that loop is a function
/// of its own, and `…_compute` asks first whether all angles are narrow.
fn compute(file: &File<'_>, function: &Function, lowered: &Block) -> String {
    let (prefix, name) = (&file.prefix, form_name(function.form));
    let column = |&id| format!("column_{}", file.names.symbol(id));
    let columns: Vec<String> = lowered.columns.iter().map(column).collect();
    let outs: Vec<String> = if function.form.is_jacobian() {
        vec!["out".to_owned()]
    } else {
        (0..lowered.places.len()).map(|index| format!("out{index}")).collect()
    };
    let out_type = if function.form.is_jacobian() { "(*restrict out)[72]" } else { "*restrict " };
    let out = |out: &String| match function.form.is_jacobian() {
        true => format!(", double {out_type}"),
        false => format!(", double {out_type}{out}"),
    };
    let parameters: String = columns
        .iter()
        .map(|column| format!(", const double *restrict {column}"))
        .chain(outs.iter().map(out))
        .collect();

    let asks = !lowered.angles_in_loop.is_empty();
    let (kind, narrow, scope) = if asks {
        ("compute_rows", ", const int narrow", Scope::RowWithWaves)
    } else {
        ("compute", "", Scope::Row)
    };
    let kept: String = (0..function.program.carried().len())
        .map(|place| format!("    const double p{place} = p[{place}];\n"))
        .collect();
    let c = C {
        chain: file.shared.unit.chain,
        names: file.names,
        scope,
        precision: Precision::Double,
        sin_cos: "",
    };
    let body = c.statements(&lowered.body, 4);
    let mut text = format!(
        "
TRUEAXIS_INLINE void {prefix}_{name}_{kind}(const int fused{narrow}, const double *p{parameters})
{{
    int row;
{kept}    (void)p;
    (void)fused;
{body}}}
"
    );
    if asks {
        let are_narrow: Vec<String> = lowered
            .angles_in_loop
            .iter()
            .map(|id| format!("trueaxis_is_narrow(fused, {})", column(id)))
            .collect();
        let (are_narrow, arguments) = (are_narrow.join(" && "), [columns, outs].concat().join(", "));
        text.push_str(&format!(
            "
TRUEAXIS_INLINE void {prefix}_{name}_compute(const int fused, const double *p{parameters})
{{
    if ({are_narrow})
        {prefix}_{name}_compute_rows(fused, 1, p, {arguments});
    else
        {prefix}_{name}_compute_rows(fused, 0, p, {arguments});
}}
"
        ));
    }
    text
}

/// A function `…_on` for each path, all with the same parameters, and the choice between them.
struct Paths {
    definitions: String,
    choice: String,
}

fn paths(name: &str, parameters: &str, passed: &str, given: &str) -> Paths {
    let definitions = format!(
        "
#ifdef TRUEAXIS_HAS_PATHS
TRUEAXIS_TARGET_V3 static void {name}_v3({parameters})
{{
    {name}_on(1, {passed});
}}

TRUEAXIS_TARGET_V4 static void {name}_v4({parameters})
{{
    {name}_on(1, {passed});
}}
#endif
"
    );
    let choice = format!(
        "    switch (trueaxis_path()) {{
#ifdef TRUEAXIS_HAS_PATHS
    case TRUEAXIS_V4:
        {name}_v4({given});
        break;
    case TRUEAXIS_V3:
        {name}_v3({given});
        break;
#endif
    default:
        {name}_on(0, {given});
    }}
"
    );
    Paths { definitions, choice }
}

/// Forms with few outputs: arrays of any length, block by block.
fn of_components(file: &File<'_>, function: &Function, lowered: &Block) -> String {
    let (prefix, name, result) = (&file.prefix, form_name(function.form), result(function.form));
    let (pose, passed) = (parameters(file), arguments(file));
    let parameters = format!(
        "const {prefix}_{name}_prepared *prepared, size_t rows,\n    {pose}const {prefix}_{result}_rows *out"
    );
    let arguments = format!("prepared, rows, {passed}out");
    let Paths { definitions, choice } =
        paths(&format!("{prefix}_{name}"), &parameters, &arguments, &arguments);
    let columns: String = columns(file, lowered).iter().map(|column| format!(", {column} + first")).collect();
    let places = file.shared.places(function.form, file.names);
    let outs: String = places.iter().map(|place| format!(", out->{place} + first")).collect();
    let unread = file.of_pose(&|group| format!("    (void){};\n", group.argument));
    let poses = file.of_pose(&|group| format!("            {prefix}_{0} {1};\n", group.argument, one(group)));
    let pose: String = file.of_pose(&|group| {
        let load = |&id| {
            let name = file.names.symbol(id);
            format!("            {}.{name} = {}->{name}[start];\n", one(group), group.argument)
        };
        group.symbols.iter().map(load).collect()
    });
    let poses_of_one = file.of_pose(&|group| format!("&{}, ", one(group)));
    let stores: String =
        places.iter().map(|place| format!("            out->{place}[start] = one.{place};\n")).collect();
    let signature = rows_signature(file, function);
    format!(
        "
TRUEAXIS_INLINE void {prefix}_{name}_on(const int fused, {parameters})
{{
    size_t start;
{unread}    for (start = 0; start < rows; start += TRUEAXIS_ROWS) {{
        /* The last block may do rows again that the one before it did. */
        const size_t first = start + TRUEAXIS_ROWS <= rows ? start : rows - TRUEAXIS_ROWS;
        {prefix}_{name}_compute(fused, prepared->values{columns}{outs});
    }}
}}
{definitions}
{signature}
{{
    if (rows < TRUEAXIS_ROWS) {{
        size_t start;
        for (start = 0; start < rows; start++) {{
{poses}            {prefix}_{result} one;
{pose}            {prefix}_{name}(prepared, {poses_of_one}&one);
{stores}        }}
        return;
    }}
{choice}}}
"
    )
}

/// The variable of one pose's joints or inputs.
fn one(group: &Group) -> String {
    format!("these_{}", group.argument)
}

/// Jacobians: a block at a time, so that it is still in the cache when it is used.
fn of_jacobian(file: &File<'_>, function: &Function, lowered: &Block) -> String {
    let (prefix, name) = (&file.prefix, form_name(function.form));
    let parameters = format!("const double *p, const double *const *columns, {prefix}_{name}_block *block");
    let Paths { definitions, choice } = paths(
        &format!("{prefix}_{name}"),
        &parameters,
        "p, columns, block",
        "prepared->values, columns, block",
    );
    let read = columns(file, lowered);
    let columns: String = (0..read.len()).map(|index| format!(", columns[{index}]")).collect();
    let whole = whole(file, &read);
    let columns_out = file.shared.columns.len();
    let rows: Vec<String> = lowered
        .places
        .chunks(columns_out.max(1))
        .map(|row| format!("{{{}}}", row.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")))
        .collect();
    let fields: String = file
        .shared
        .by_observable(&rows)
        .into_iter()
        .map(|(_, rows)| format!("    {{{}}},\n", rows.join(", ")))
        .collect();
    let parts = file.of_pose(&|group| {
        let (singular, argument) = (group.singular(), group.argument);
        let start = |&id| {
            let name = file.names.symbol(id);
            format!("        part_of_{argument}.{name} = {argument}->{name} + start;\n")
        };
        let fields: String = group.symbols.iter().map(start).collect();
        format!("        {prefix}_{singular}_rows part_of_{argument} = *{argument};\n{fields}")
    });
    let parts_passed = file.of_pose(&|group| format!("&part_of_{}, ", group.argument));
    let copy = |&id: &ObservableId| {
        let observable = file.names.observable(id);
        format!(
            "                for (row = 0; row < count; row++)
                    out->{observable}[component][column][start + row] =
                        block.values[{prefix}_{name}_place.{observable}[component][column]][row];
"
        )
    };
    // Observables that show as many numbers are copied together.
    let mut counts: Vec<usize> =
        file.shared.unit.observables.iter().map(|&id| file.shared.shown(id)).collect();
    counts.sort_unstable();
    counts.dedup();
    let copies: String = counts
        .into_iter()
        .map(|count| {
            let alike = file.shared.unit.observables.iter().filter(|&&id| file.shared.shown(id) == count);
            let copies: String = alike.map(copy).collect();
            format!(
                "        for (component = 0; component < {count}; component++) {{
            for (column = 0; column < {columns_out}; column++) {{
{copies}            }}
        }}
"
            )
        })
        .collect();
    let (block_signature, rows_signature) = (block_signature(file, function), rows_signature(file, function));
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
{block_signature}
{{
{whole}{choice}}}

{rows_signature}
{{
    size_t start, component, column, row;
    for (start = 0; start < rows; start += TRUEAXIS_ROWS) {{
        const size_t count = rows - start < TRUEAXIS_ROWS ? rows - start : TRUEAXIS_ROWS;
        TRUEAXIS_ALIGNED {prefix}_{name}_block block;
{parts}        {prefix}_{name}_rows_of_block(prepared, count, {parts_passed}&block);
{copies}    }}
}}
"
    )
}

/// The columns of a block as whole ones: those of fewer rows are filled up with zeros.
fn whole(file: &File<'_>, read: &[String]) -> String {
    let unread = file.of_pose(&|group| format!("    (void){};\n", group.argument));
    if read.is_empty() {
        return format!("    const double *const *const columns = 0;\n    (void)rows;\n{unread}");
    }
    let (count, read) = (read.len(), read.join(", "));
    format!(
        "    const double *columns[{count}] = {{{read}}};
    double padded[{count}][TRUEAXIS_ROWS];
{unread}    if (rows < TRUEAXIS_ROWS) {{
        size_t column, row;
        for (column = 0; column < {count}; column++) {{
            for (row = 0; row < TRUEAXIS_ROWS; row++)
                padded[column][row] = row < rows ? columns[column][row] : 0.0;
            columns[column] = padded[column];
        }}
    }}
"
    )
}
