//! Texts that are amended: however they are written, they say afterwards what they said before, and what was found.

use calibration::amend::{Addition, AmendError, NewInput, Spot, amend};
use model_core::{BodyId, Chain, Role};
use proptest::prelude::*;

const PLAIN: &str = "chain Shaft {
    input ambient;
    body shaft on ground {
        motion: Rz(q);
        motion_error: Rz(index + drift*ambient);
    }
    observe mark: direction(0, 1, 0) of shaft;
}
";

fn addition(factor: &str, documentation: &str) -> Addition {
    Addition {
        spot: Spot::Factor(BodyId(0), Role::MotionError),
        text: factor.to_owned(),
        documentation: vec![documentation.to_owned()],
    }
}

fn amended(text: &str, factor: &str, documentation: &str, inputs: &[NewInput]) -> Result<String, AmendError> {
    let chain = Chain::from_text(text)?;
    amend(text, &chain, &[addition(factor, documentation)], inputs)
}

fn input(name: &str, documentation: &str) -> NewInput {
    NewInput { name: name.to_owned(), meaning: None, documentation: documentation.to_owned() }
}

/// The factors of the only body, and its inputs.
fn says(text: &str) -> (Vec<String>, Vec<String>) {
    let chain = Chain::from_text(text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
    let factor = |factor: &model_core::Factor| model_core::print::text(&factor.amount, &chain);
    let inputs = chain.symbols_of(model_core::SymbolKind::Input);
    (
        chain.bodies[0].factors.iter().map(factor).collect(),
        inputs.map(|id| chain.symbol(id).name.clone()).collect(),
    )
}

/// The statements of the body written in other ways; each says the same.
const WAYS: [(&str, &str); 9] = [
    ("", ""),
    ("drift*ambient);", "drift*ambient); // a remark"),
    ("drift*ambient);", "drift*ambient); /* a remark */"),
    ("drift*ambient);", "drift*ambient); /* one /* in */ another; */"),
    ("input ambient;", "input ambient /* one /* in ; */ another; */ ; // and more"),
    ("input ambient;", "input ambient // a remark; a lie\n    ;"),
    ("input ambient;", "input ambient; /// The shaft."),
    ("motion_error: Rz(index + drift*ambient);\n", "motion_error: Rz(index + drift*ambient); }"),
    ("Rz(q);", "Rz(q); /// What errs."),
];

#[test]
fn however_it_is_written_the_same_is_added() {
    let expected = says(&amended(PLAIN, "Rx(tilt)", "Found.", &[input("humidity", "Measured.")]).unwrap());
    assert_eq!(expected.0.len(), 3);
    assert_eq!(expected.1, ["ambient", "humidity"]);
    for (from, to) in WAYS {
        let text = PLAIN.replacen(from, to, 1);
        // The brace has moved up.
        let text = if to.ends_with('}') { text.replacen("; }    }\n", "; }\n", 1) } else { text };
        for text in [text.clone(), text.replace('\n', "\r\n")] {
            let original = Chain::from_text(&text).unwrap();
            let amended = amended(&text, "Rx(tilt)", "Found.", &[input("humidity", "Measured.")]).unwrap();
            assert_eq!(says(&amended), expected, "{amended}");
            let read = Chain::from_text(&amended).unwrap();
            assert_eq!(read.bodies[0].documentation, original.bodies[0].documentation, "{amended}");
            let lone = amended.replace("\r\n", "").contains(if text.contains('\r') { '\n' } else { '\r' });
            assert!(!lone, "line ends are mixed: {amended:?}");
        }
    }
}

/// `Rx(-138 deg)` is a constant of its own, whose name nobody may declare.
#[test]
fn a_body_may_be_turned_by_a_number() {
    let text = PLAIN.replace("motion: Rz(q);", "position: Rx(-138 deg);\n        motion: Rz(q);");
    let amended = amended(&text, "Rx(tilt)", "Found.", &[]).expect("an amended text");
    assert!(amended.contains("Rx(-138 deg)") && amended.contains("Rx(tilt)"), "{amended}");
}

#[test]
fn nothing_is_added_that_was_not_meant() {
    let refused = |factor: &str, inputs: &[NewInput]| {
        matches!(amended(PLAIN, factor, "Found.", inputs), Err(AmendError::NotAsMeant(_)))
    };
    assert!(!refused("Rx(tilt)", &[]));
    for factor in ["Rx(tilt*fn)", "Rx(tilt*temp x)", "Rx(tilt", "Rx(tilt) }", "Rx(a); motion: Rx(b)"] {
        assert!(refused(factor, &[]), "{factor}");
    }
    for name in ["mirror-temp", "fn", "temp x", "x; input y", "ambient", "", "x // "] {
        assert!(refused("Rx(tilt)", &[input(name, "Measured.")]), "{name}");
    }
    // An input of a chain that no declaration could declare: what it is called would be read as something else.
    for name in ["mirror-temp", "fn", "temp x"] {
        let mut chain = Chain::from_text(PLAIN).unwrap();
        let ambient = chain.find_symbol("ambient").unwrap();
        chain.symbols[ambient.index()].name = name.to_owned();
        let added = [addition(&format!("Rx(tilt*{name})"), "Found.")];
        assert!(matches!(amend(PLAIN, &chain, &added, &[]), Err(AmendError::NotAsMeant(_))), "{name}");
    }
}

proptest! {
    #[test]
    fn documentation_stays_documentation(line in "[a-z{}();:/*#\"'\\\\\n\r\u{2028}\u{85}\u{0}é ]{0,40}") {
        let amended = amended(PLAIN, "Rx(tilt)", &line, &[input("humidity", &line)]).unwrap();
        let plain = super::amended::amended(PLAIN, "Rx(tilt)", "Found.", &[input("humidity", "Measured.")]).unwrap();
        prop_assert_eq!(says(&amended), says(&plain));
    }
}
