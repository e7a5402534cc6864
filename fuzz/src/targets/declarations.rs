//! Declarations, and what is written into one.

use calibration::amend::{Addition, NewInput, Spot, amend};
use model_core::{BodyId, Chain, Role, syntax};
use tables::units::Amount;

use super::{is_seen, text};

/// A declaration, and its pieces: an amount, a printed formula, a quantity.
pub fn read(input: &[u8]) {
    let text = text(input);
    if let Err(mistakes) = Chain::from_text(&text) {
        assert!(mistakes.iter().next().is_some(), "refused without a mistake");
        is_seen(&mistakes.render("f.chain", &text));
    }
    let line = text.lines().next().unwrap_or_default();
    let _ = syntax::parse_amount(line);
    let _ = Amount::parse(line);
}

/// A declaration that is amended, with the input's first line as the name of what was found: refused, or said once more.
pub fn amended(input: &[u8]) {
    let text = text(input);
    let (name, declaration) = text.split_once('\n').unwrap_or(("", &text));
    let Ok(chain) = Chain::from_text(declaration) else { return };
    if chain.bodies.is_empty() {
        return;
    }
    let addition = Addition {
        spot: Spot::Factor(BodyId(0), Role::MotionError),
        text: "Rx(found_by_fuzzing)".to_owned(),
        documentation: vec![name.to_owned()],
    };
    let input = NewInput { name: "fuzzed_input".to_owned(), meaning: None, documentation: name.to_owned() };
    let Ok(amended) = amend(declaration, &chain, &[addition], &[input]) else {
        unreachable!("what is well meant can be added:\n{text}")
    };
    let Ok(read) = Chain::from_text(&amended) else { unreachable!("it has been read already") };
    assert_eq!(read.bodies[0].factors.len(), chain.bodies[0].factors.len() + 1);
    assert_eq!(read.observables.len(), chain.observables.len());
}
