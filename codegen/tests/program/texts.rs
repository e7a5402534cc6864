//! What generated files look like, for a reader: a turntable with two errors, in every language. The text of the
//! vector sine and cosine, the same in each file, is left out.

use codegen::{Form, LANGUAGES, Unit, generate, vector};
use model_core::ObservableId;

use crate::support::read;

const TURNTABLE: &str = "/// A turntable on a bench.
chain Turntable {
    const radius: length = 0.25;
    body table on ground {
        motion: Rz(turn);
        motion_error:
            /// Encoder off centre, along its zero.
            Rz(eccentricity*sin(turn)),
            /// Height of the table.
            Tz(height);
    }
    /// A mark on the rim.
    observe mark: point(radius, 0, 0) of table;
    symbol eccentricity = r\"\\epsilon\";
    symbol turn = r\"\\theta\";
}
";

#[test]
fn generated_files() {
    let chain = read("turntable", TURNTABLE);
    let remarks =
        ["First order, mark: off by at most 1.25e-7 m while errors stay within box.toml".to_owned()];
    let forms = [Form::ExactError, Form::FirstOrderJacobian];
    let unit = Unit { remarks: &remarks, ..Unit::new(&chain, TURNTABLE, &[ObservableId(0)], &forms) };
    for (name, language) in LANGUAGES {
        for file in generate(&unit, language, "turntable").unwrap() {
            let mut text = file.text;
            for kernel in vector::RUST.into_iter().chain([vector::C]) {
                text = text.replace(kernel, "[vector sine and cosine]\n");
            }
            insta::assert_snapshot!(format!("{name}_{}", file.extension), text);
        }
    }
}

#[test]
fn versions_and_declarations_stand_in_every_file() {
    let chain = read("turntable", TURNTABLE);
    let unit = Unit::new(&chain, TURNTABLE, &[ObservableId(0)], &[Form::ExactValue]);
    for (name, language) in LANGUAGES {
        for file in generate(&unit, language, "turntable").unwrap() {
            assert!(file.text.contains(&format!("trueaxis {}", env!("CARGO_PKG_VERSION"))), "{name}");
            assert!(file.text.contains("Rz(eccentricity*sin(turn)),"), "{name}");
        }
    }
}

fn rust(text: &str) -> String {
    let chain = read("still", text);
    let forms = [Form::ExactError, Form::ExactJacobian];
    let unit = Unit::new(&chain, text, &[ObservableId(0)], &forms);
    generate(&unit, LANGUAGES[0].1, "still").unwrap().remove(0).text
}

#[test]
fn a_chain_without_joints_has_one_pose() {
    let text = rust(
        "chain Still { body post on ground { position_error: Rz(tilt); } observe tip: point(1, 0, 0) of post; }",
    );
    assert!(text.contains("fn eval(") && text.contains("fn exact_jacobian("));
    assert!(!text.contains("eval_rows") && !text.contains("Joint"));
}

#[test]
fn a_chain_without_errors_has_no_jacobians() {
    let text = rust(
        "chain Perfect { body arm on ground { motion: Rz(turn); } observe tip: point(1, 0, 0) of arm; }",
    );
    assert!(text.contains("fn exact_error(") && !text.contains("exact_jacobian"));
}
