//! C over one block of rows: the function that [`super::c_rows`] compiles for every path.

use std::fmt::Write;

use super::c::C;
use super::unit::{Function, form_name};
use crate::vector::{Angle, Rows};

/// The function `…_compute`. With sines and cosines in the loop over rows, that loop is a function of its own, and
/// `…_compute` asks first whether all angles are narrow.
pub(super) fn block(c: &C<'_>, function: &Function, loops: &Rows) -> String {
    let (prefix, name) = (&c.prefix, form_name(function.form));
    let is_jacobian = function.form.is_jacobian();
    let columns: Vec<String> = loops.columns.iter().map(|&id| format!("column_{}", c.name(id))).collect();
    let mut parameters: String =
        columns.iter().map(|column| format!(", const double *restrict {column}")).collect();
    let outs: Vec<String> = if is_jacobian {
        parameters.push_str(", double (*restrict out)[72]");
        vec!["out".into()]
    } else {
        let outs: Vec<String> = (0..loops.places.len()).map(|index| format!("out{index}")).collect();
        outs.iter().for_each(|out| parameters.push_str(&format!(", double *restrict {out}")));
        outs
    };

    let (kind, narrow) =
        if loops.in_one_loop { ("compute_rows", ", const int narrow") } else { ("compute", "") };
    let mut text = format!(
        "\nTRUEAXIS_INLINE void {prefix}_{name}_{kind}(const int fused{narrow}, const double *p{parameters})\n{{\n    int row;\n"
    );
    for index in 0..function.program.carried().len() {
        let _ = writeln!(text, "    const double p{index} = p[{index}];");
    }
    text.push_str("    (void)p;\n    (void)fused;\n");
    if !loops.in_one_loop {
        loops.angles.iter().for_each(|angle| text.push_str(&waves_of_block(angle)));
    }
    text.push_str("    for (row = 0; row < TRUEAXIS_ROWS; row++) {\n");
    if loops.in_one_loop {
        for Angle { name, .. } in &loops.angles {
            let _ = writeln!(
                text,
                "        double sine_{name}, cosine_{name};
        trueaxis_sin_cos_in_loop(fused, narrow, column_{name}[row], &sine_{name}, &cosine_{name});"
            );
        }
    }
    for statement in loops.in_row(loops.fixed.iter().chain(&loops.statements), is_jacobian) {
        let _ = writeln!(text, "        {statement}");
    }
    text.push_str("    }\n}\n");

    if loops.in_one_loop {
        let are_narrow: Vec<String> = loops
            .angles
            .iter()
            .map(|angle| format!("trueaxis_is_narrow(fused, column_{})", angle.name))
            .collect();
        let arguments = [columns, outs].concat().join(", ");
        let _ = write!(
            text,
            "
TRUEAXIS_INLINE void {prefix}_{name}_compute(const int fused, const double *p{parameters})
{{
    if ({})
        {prefix}_{name}_compute_rows(fused, 1, p, {arguments});
    else
        {prefix}_{name}_compute_rows(fused, 0, p, {arguments});
}}
",
            are_narrow.join(" && "),
        );
    }
    text
}

/// An angle's sines and cosines of all rows, in arrays.
fn waves_of_block(Angle { name, computed }: &Angle) -> String {
    let mut text = String::new();
    let source = match computed {
        None => format!("column_{name}"),
        Some((statements, value)) => {
            let _ = writeln!(text, "    double angle_{name}[TRUEAXIS_ROWS];");
            text.push_str("    for (row = 0; row < TRUEAXIS_ROWS; row++) {\n");
            for statement in statements {
                let _ = writeln!(text, "        {statement}");
            }
            let _ = writeln!(text, "        angle_{name}[row] = {value};\n    }}");
            format!("angle_{name}")
        }
    };
    let _ = writeln!(
        text,
        "    TRUEAXIS_ALIGNED double sine_{name}[TRUEAXIS_ROWS], cosine_{name}[TRUEAXIS_ROWS];
    trueaxis_sin_cos_rows(fused, {source}, sine_{name}, cosine_{name});"
    );
    text
}
