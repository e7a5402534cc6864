//! Names that mean something in some language, or that some language takes for one and the same.

use codegen::{Form, Unit};
use model_core::{Chain, ObservableId};

use super::{FORMS, compiles, folder};

/// Errors with these names.
const NAMES: [&str; 46] = [
    "NULL",
    "_Bool",
    "_Complex",
    "__GNUC__",
    "INT_MAX",
    "EOF",
    "errno",
    "linux",
    "unix",
    "TRUEAXIS_ROWS",
    "ROWS",
    "double",
    "int",
    "register",
    "template",
    "class",
    "class_",
    "None",
    "lambda",
    "global_",
    "__init__",
    "__class__",
    "__x",
    "union",
    "auto",
    "p",
    "p0",
    "t1",
    "row",
    "rows",
    "out",
    "out0",
    "errors",
    "joints",
    "arithmetic",
    "é",
    "e\u{301}",
    "ﬁ",
    "fi",
    "end",
    "endfunction",
    "Joints",
    "Span",
    "_a",
    "a_name_that_is_longer_than_any_that_a_language_of_matrices_takes_1",
    "a_name_that_is_longer_than_any_that_a_language_of_matrices_takes_2",
];

#[test]
fn names_of_every_kind_compile() {
    let factors: Vec<String> = NAMES.iter().map(|name| format!("Rx({name})")).collect();
    let text = format!(
        "chain Register {{
            const offsetof: length = -0.5;
            input delete: length;
            body table on ground {{
                position: Tx(-offsetof);
                position_error: {};
                motion: Rz(__proto__), Ry(constructor), Rx(def);
            }}
            observe readout: point(0, 0, delete) of table;
            observe output: direction(0, 1, 0) of table;
            observe value: direction(0, 1, 0) of table;
            observe new: direction(1, 0, 0) of table;
            observe __proto__: direction(1, 1, 0) of table;
            observe rows: direction(1, 1, 0) of table;
            observe to: direction(1, 1, 0) of table;
            observe TRUEAXIS_pointers: direction(1, 1, 0) of table;
        }}",
        factors.join(", ")
    );
    let chain =
        Chain::from_text(&text).unwrap_or_else(|mistakes| panic!("{}", mistakes.render("names", &text)));
    let observables: Vec<ObservableId> = (0..8).map(ObservableId).collect();
    compiles(&Unit::new(&chain, &text, &observables, &FORMS), &folder("names"));
}

/// Small files: without joints, without errors, without either, with values for all errors, without rows.
#[test]
fn files_with_little_in_them_compile() {
    for (index, (text, values)) in [
        ("chain Still { body post on ground { position_error: Rz(tilt); } observe tip: point(1, 0, 0) of post; }", None),
        ("chain Still { body post on ground { position_error: Rz(tilt); } observe tip: point(1, 0, 0) of post; }", Some(2e-3)),
        ("chain Perfect { body arm on ground { motion: Rz(turn); } observe tip: point(1, 0, 0) of arm; }", None),
        ("chain Fixed { body post on ground { } observe tip: direction(1, 0, 0) of post; }", None),
        ("chain Far { input range: length; body post on ground { position_error: Rz(tilt); } observe tip: point(range, 0, 0) of post; }", None),
        ("chain Turn { const arm: length = -2; body post on ground { position: Tx(-arm); motion: Rz(turn); motion_error: Rx(tilt); } observe tip: point(arm, 0, 0) of post; }", Some(-1e-3)),
    ]
    .into_iter()
    .enumerate()
    {
        let chain = Chain::from_text(text).unwrap();
        let values: Vec<_> = values.into_iter().filter_map(|value| Some((chain.find_symbol("tilt")?, value))).collect();
        for rows in [true, false] {
            let unit = Unit { values: &values, rows, ..Unit::new(&chain, text, &[ObservableId(0)], &FORMS) };
            compiles(&unit, &folder(&format!("small-{index}")));
        }
        let unit = Unit::new(&chain, text, &[ObservableId(0)], &[Form::ExactValue]);
        compiles(&unit, &folder(&format!("small-{index}")));
    }
}
