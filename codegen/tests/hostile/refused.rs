//! What has no code is refused, and says why.

use codegen::{Form, GenerateError, Language, Unit, generate};
use model_core::{Chain, ObservableId};

const TABLE: &str = "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); } \
                     observe edge: direction(1, 0, 0) of top; }";

fn refusal(text: &str, observables: &[ObservableId], forms: &[Form], file_name: &str) -> GenerateError {
    let chain = Chain::from_text(text).unwrap();
    generate(&Unit::new(&chain, text, observables, forms), Language::C, file_name).unwrap_err()
}

#[test]
fn what_has_no_code() {
    let (edge, value) = (ObservableId(0), Form::ExactValue);
    assert_eq!(refusal(TABLE, &[], &[value], "table"), GenerateError::NoObservable);
    assert_eq!(
        refusal(TABLE, &[edge, edge], &[value], "table"),
        GenerateError::RepeatedObservable { name: "edge".into() }
    );
    assert_eq!(
        refusal(TABLE, &[edge], &[value, value], "table"),
        GenerateError::RepeatedForm { form: value }
    );
    let perfect =
        "chain Table { body top on ground { motion: Rz(turn); } observe edge: direction(1, 0, 0) of top; }";
    assert_eq!(refusal(perfect, &[edge], &[Form::ExactJacobian], "table"), GenerateError::NoForm);
    for name in ["a\"b", "a\nb", "a\\b", "a\u{2028}b"] {
        assert_eq!(refusal(TABLE, &[edge], &[value], name), GenerateError::FileName { name: name.into() });
    }
}

#[test]
fn numbers_beyond_f64() {
    let text = "chain Far { body top on ground { motion: Rz(turn); motion_error: Rz(1e200*1e200*index); } \
                observe edge: direction(1, 0, 0) of top; }";
    let form = Form::FirstOrderError;
    assert_eq!(refusal(text, &[ObservableId(0)], &[form], "far"), GenerateError::NotFinite { form });
    let text = "chain Far { const far: length = 1e400; body top on ground { motion: Rz(turn); position: Tx(far); } \
                observe edge: point(1, 0, 0) of top; }";
    // The declaration is refused, or the file is.
    if Chain::from_text(text).is_ok() {
        let form = Form::ExactValue;
        assert_eq!(refusal(text, &[ObservableId(0)], &[form], "far"), GenerateError::NotFinite { form });
    }
}

#[test]
fn values_of_what_is_no_error() {
    let chain = Chain::from_text(TABLE).unwrap();
    let (turn, index) = (chain.find_symbol("turn").unwrap(), chain.find_symbol("index").unwrap());
    for (values, name) in [
        (vec![(turn, 0.1)], "turn"),
        (vec![(index, f64::NAN)], "index"),
        (vec![(index, 1e-3), (index, 2e-3)], "index"),
    ] {
        let unit =
            Unit { values: &values, ..Unit::new(&chain, TABLE, &[ObservableId(0)], &[Form::ExactValue]) };
        let refusal = generate(&unit, Language::Rust, "table").unwrap_err();
        assert_eq!(refusal, GenerateError::Value { name: name.into() });
    }
}
