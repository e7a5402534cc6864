//! How bodies are turned: the small rotation vector against 120-digit arithmetic, and what the language says of it.

use model_core::remainder::{self, Domain};
use model_core::syntax::Declaration;
use model_core::{Chain, SymbolKind, exact, forms, print};

use super::numbers::lines;

fn chain() -> Chain {
    let end = super::READINGS.trim_end().trim_end_matches('}');
    let text =
        format!("{end} observe turned: orientation of tube; observe held: orientation of table in mount; }}");
    Chain::from_text(&text).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

const REFERENCE: &str = include_str!("../reference/orientations.csv");

#[test]
fn validate_rotation_vectors_to_twelve_digits_however_small_they_are() {
    let chain = chain();
    let lines = lines(&chain, REFERENCE);
    assert_eq!(lines.len(), 24);
    for line in lines {
        let path = exact::Path::new(&chain, chain.find_observable(line.observable).unwrap());
        let (value, error) =
            (path.shown(&line.values)[line.shown], path.shown_error(&line.values)[line.shown]);
        let expected = line.numbers[1];
        assert!(value.to_bits() == error.to_bits(), "it is an error by itself");
        let what = format!("{} {} {}", line.observable, line.shown, line.size);
        assert!((error - expected).abs() <= 1e-12 * line.sum, "{what}: {error:?} is not {expected:?}");
    }
}

#[test]
fn validate_the_forms_of_rotation_vectors_to_third_order() {
    let chain = chain();
    for line in lines(&chain, REFERENCE) {
        let id = chain.find_observable(line.observable).unwrap();
        let mut values = line.values.clone();
        for error in chain.symbols_of(SymbolKind::Error) {
            values[error.index()] /= line.size;
        }
        let form = |order| forms::derive(&chain, id, order).unwrap().components[line.shown].eval(&values);
        let [first, second, third] = [form(1), form(2), form(3)];
        let [_, _, expected @ ..] = line.numbers;
        for (found, expected) in [first, second - first, third - second].into_iter().zip(expected) {
            let what = format!("{} {} {}", line.observable, line.shown, line.size);
            assert!((found - expected).abs() <= 1e-9, "{what}: {found:?} is not {expected:?}");
        }
    }
}

/// A whole turn about one axis is that turn, and none is none.
#[test]
fn one_turn_is_itself() {
    let text =
        "chain C { body a on ground { motion: Rx(q); motion_error: Rz(e); } observe t: orientation of a in b;
        body b on ground { motion: Rx(q); } }";
    let chain = Chain::from_text(text).unwrap();
    let id = chain.find_observable("t").unwrap();
    let form = forms::derive(&chain, id, 3).unwrap();
    let texts: Vec<String> = form.components.iter().map(|part| print::text(&part.above, &chain)).collect();
    assert_eq!(texts, ["0", "0", "e"]);
    let mut values = chain.nominal_values();
    assert_eq!(exact::Path::new(&chain, id).shown(&values), [0.0; 3]);
    values[chain.find_symbol("e").unwrap().index()] = 3.0;
    values[chain.find_symbol("q").unwrap().index()] = 1.0;
    let shown = exact::Path::new(&chain, id).shown(&values);
    assert!((shown[2] - 3.0).abs() < 1e-14 && shown[0].abs() < 1e-15 && shown[1].abs() < 1e-15, "{shown:?}");
}

#[test]
fn orientations_are_bounded_up_to_a_radian_of_errors() {
    let chain = chain();
    let id = chain.find_observable("turned").unwrap();
    let mut domain = Domain::new(&chain);
    assert_eq!(remainder::bound(&chain, id, &domain).unwrap().value, 0.0);
    for error in chain.symbols_of(SymbolKind::Error) {
        domain.set_size(&chain, error, 3.0).unwrap();
    }
    let why = remainder::bound(&chain, id, &domain).unwrap_err().to_string();
    assert!(why.contains("state smaller sizes"), "{why}");
}

#[test]
fn the_declaration_reads_back_as_it_is_written() {
    let text = "chain C { body a on ground { motion: Rz(q); motion_error: Rx(e); } body b on a { motion_error: Ry(f); }
        observe t: orientation of b in a; observe u: rotation_z, rotation_x of orientation of b; }";
    let declaration: Declaration = model_core::validate::read(text.parse().unwrap()).unwrap().0;
    let printed = declaration.to_string();
    assert!(printed.contains("observe t: orientation of b in a;"), "{printed}");
    assert!(printed.contains("observe u: rotation_z, rotation_x of orientation of b;"), "{printed}");
    assert_eq!(Chain::from_text(&printed).unwrap(), Chain::from_text(text).unwrap());
}

#[test]
fn what_no_orientation_is_is_refused() {
    let refusal = |observe: &str| {
        let text =
            format!("chain C {{ body a on ground {{ motion: Rz(q); motion_error: Rx(e); }} {observe} }}");
        Chain::from_text(&text).unwrap_err().to_string()
    };
    for (observe, said) in [
        ("observe t: orientation(0, 0, 1) of a;", "expected `of`"),
        ("observe t: azimuth of orientation of a;", "an orientation has no `azimuth`"),
        ("observe t: rotation_x of direction(0, 0, 1) of a;", "a direction has no `rotation_x`"),
        ("observe t: rotation_x(y) of orientation of a;", "takes no axes"),
        ("observe t: rotation_x, rotation_x of orientation of a;", "read twice"),
        ("observe t: rotation_w of orientation of a;", "did you mean `rotation_"),
        ("observe t: orientation of ground;", "never moves"),
        ("observe t: orientation of a in a;", "never moves in its own frame"),
        ("observe t: orientaton of a;", "expected three components"),
        ("observe t: orientation of b;", "`b`"),
    ] {
        let found = refusal(observe);
        assert!(found.contains(said), "{observe}: {found}");
    }
}
