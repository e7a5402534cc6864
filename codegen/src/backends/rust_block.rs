//! Rust over one block of rows: the function that [`super::rust_rows`] compiles for every path.

use std::fmt::Write;

use super::unit::Function;
use crate::vector::{Angle, Rows};

/// The function `compute`, inside the method that uses it. With sines and cosines in the loop over rows, that loop is a
/// function of its own, and `compute` asks first whether all angles are narrow.
pub(super) fn block(function: &Function, loops: &Rows, read: &[&str]) -> String {
    let is_jacobian = function.form.is_jacobian();
    let count = function.program.carried().len();
    let carried: Vec<String> = (0..count).map(|index| format!("p{index}")).collect();
    let carried = format!("&[{}]: &[f64; {count}]", carried.join(", "));
    let (outs, kind): (Vec<String>, _) = if is_jacobian {
        (vec!["out".into()], format!("[[f64; ROWS + 8]; {}]", loops.distinct))
    } else {
        let outs = (0..loops.places.len()).map(|index| format!("out{index}"));
        (outs.collect(), "[f64; ROWS]".into())
    };
    let columns = read.iter().map(|name| format!("column_{name}: &[f64; ROWS]"));
    let parameters: Vec<String> =
        columns.chain(outs.iter().map(|out| format!("{out}: &mut {kind}"))).collect();
    let parameters = parameters.join(", ");

    let mut text = String::new();
    if loops.in_one_loop {
        let angles: Vec<String> = loops.angles.iter().map(|angle| format!("column_{}", angle.name)).collect();
        let columns: String = read.iter().map(|name| format!("column_{name}, ")).collect();
        let arguments = columns + &outs.join(", ");
        let _ = write!(
            text,
            "        #[inline(always)]
        fn compute<A: sine_cosine::Arithmetic>(arithmetic: A, prepared: &[f64; {count}], {parameters}) {{
            if sine_cosine::are_narrow([{}]) {{
                compute_rows::<A, true>(arithmetic, prepared, {arguments});
            }} else {{
                compute_rows::<A, false>(arithmetic, prepared, {arguments});
            }}
        }}
        #[inline(always)]
        fn compute_rows<A: sine_cosine::Arithmetic, const NARROW: bool>(arithmetic: A, {carried}, {parameters}) {{
",
            angles.join(", "),
        );
    } else {
        let _ = write!(
            text,
            "        #[inline(always)]
        fn compute<A: sine_cosine::Arithmetic>(arithmetic: A, {carried}, {parameters}) {{
"
        );
        loops.angles.iter().for_each(|angle| text.push_str(&waves_of_block(angle)));
    }
    text.push_str("            for row in 0..ROWS {\n");
    if loops.in_one_loop {
        for Angle { name, .. } in &loops.angles {
            let _ = writeln!(
                text,
                "                let (sine_{name}, cosine_{name}) = sine_cosine::sin_cos_in_loop::<A, NARROW>(arithmetic, column_{name}[row]);"
            );
        }
    }
    // A Jacobian's block has its fixed values from the start.
    let fixed = if is_jacobian { &[] } else { loops.fixed.as_slice() };
    for statement in loops.in_row(fixed.iter().chain(&loops.statements), is_jacobian) {
        let _ = writeln!(text, "                {statement}");
    }
    text.push_str("            }\n        }\n");
    text
}

/// An angle's sines and cosines of all rows, in arrays.
fn waves_of_block(Angle { name, computed }: &Angle) -> String {
    let mut text = String::new();
    let source = match computed {
        None => format!("column_{name}"),
        Some((statements, value)) => {
            let _ = writeln!(text, "            let mut angle_{name} = [0.0; ROWS];");
            text.push_str("            for row in 0..ROWS {\n");
            for statement in statements {
                let _ = writeln!(text, "                {statement}");
            }
            let _ = writeln!(text, "                angle_{name}[row] = {value};\n            }}");
            format!("&angle_{name}")
        }
    };
    let _ = writeln!(
        text,
        "            let mut waves_{name} = sine_cosine::Waves::NEW;
            let (sine_{name}, cosine_{name}) = sine_cosine::sin_cos_rows(arithmetic, {source}, &mut waves_{name});"
    );
    text
}
