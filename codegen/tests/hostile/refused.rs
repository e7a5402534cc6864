//! What has no code is refused, and says why.

use codegen::{Calibrated, Covariance, Form, GenerateError, Language, Precision, Unit, generate};
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

/// The file of MATLAB is called as its function.
#[test]
fn names_that_are_no_function() {
    let chain = Chain::from_text(TABLE).unwrap();
    let unit = Unit::new(&chain, TABLE, &[ObservableId(0)], &[Form::ExactValue]);
    let long = "a".repeat(64);
    for name in ["", "1st", "a-b", "a.b", "_a", "end", "é", "x()", long.as_str()] {
        let refusal = generate(&unit, Language::Matlab, name).unwrap_err();
        assert_eq!(refusal, GenerateError::FunctionName { name: name.into() });
    }
    assert!(generate(&unit, Language::Matlab, "table_2").is_ok());
}

#[test]
fn calibrations_that_say_too_little() {
    let chain = Chain::from_text(TABLE).unwrap();
    let of = [chain.find_symbol("index").unwrap()];
    let refusal = |calibrated: Calibrated<'_>, precision| {
        let plain = Unit::new(&chain, TABLE, &[ObservableId(0)], &[Form::Uncertainty]);
        generate(&Unit { calibrated, precision, ..plain }, Language::C, "table").map(|_| ())
    };
    let double = Precision::Double;
    assert_eq!(refusal(Calibrated::default(), double), Err(GenerateError::NoCovariance));
    for rows in [vec![], vec![vec![1e-9, 0.0]], vec![vec![f64::NAN]]] {
        let covariance = Some(Covariance { of: &of, rows: &rows });
        let refused = refusal(Calibrated { covariance, ..Calibrated::default() }, double);
        assert_eq!(refused, Err(GenerateError::Covariance { count: 1 }));
    }
    let rows = [vec![1e-9]];
    let known = Calibrated { covariance: Some(Covariance { of: &of, rows: &rows }), ..Calibrated::default() };
    assert_eq!(refusal(known, double), Ok(()));
    assert_eq!(refusal(known, Precision::Single), Err(GenerateError::SingleUncertainty));
    for day in ["", "2027-6-30", "2027-06-30\"; injected", "2027/06/30"] {
        let refused = refusal(Calibrated { valid_until: Some(day), ..known }, double);
        assert_eq!(refused, Err(GenerateError::Date { text: day.into() }));
    }
}
