//! C over structure of arrays: the loop around the evaluated stage.

use std::fmt::Write;

use super::c::{C, Names, statements};
use super::listing::list;
use super::unit::{Function, form_name};

/// The function that does many poses, as declared.
pub(super) fn declaration(c: &C<'_>, function: &Function) -> String {
    let (prefix, name, result) = (&c.prefix, form_name(function.form), c.result(function.form));
    format!(
        "void {prefix}_{name}_rows(const {prefix}_{name}_prepared *prepared, size_t rows,\n    const {prefix}_joints_rows *joints, const {prefix}_{result}_rows *out)"
    )
}

/// Its definition.
pub(super) fn definition(c: &C<'_>, function: &Function) -> String {
    let listing = list(&function.program, &Names { c, row: "[row]" });
    let mut text = format!(
        "\n{}\n{{\n    const double *const p = prepared->values;\n    size_t row;\n    (void)p;\n    (void)joints;\n    for (row = 0; row < rows; row++) {{\n{}",
        declaration(c, function),
        statements(&listing.evaluated, "trueaxis_sin_cos_with(0, ", 8)
    );
    for (place, value) in c.places(function.form).iter().zip(&listing.outputs) {
        let _ = writeln!(text, "        out->{place}[row] = {value};");
    }
    text.push_str("    }\n}\n");
    text
}
