//! Claims of how bodies are turned.

use claims::checker::{Checker, ClosedForm, Order, PrintedVector};
use claims::latex::PrintedSymbols;
use model_core::{Chain, SymbolKind};

fn chain() -> Chain {
    let end = super::READINGS.trim_end().trim_end_matches('}');
    let text = format!("{end} observe turned: orientation of tube; }}");
    Chain::from_text(&text).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

/// By hand: each error turns the tube about the axis of its joint, as that axis stands.
const TURNED: [&str; 3] = [
    "tilt_x + cross*cos(azimuth) + (index_e - sag*cos(elevation))*sin(azimuth) - collimation*cos(azimuth)*sin(elevation)",
    "tilt_y + cross*sin(azimuth) - (index_e - sag*cos(elevation))*cos(azimuth) - collimation*sin(azimuth)*sin(elevation)",
    "index_a + collimation*cos(elevation)",
];

fn holds(chain: &Chain, texts: [&str; 3]) -> bool {
    let id = chain.find_observable("turned").unwrap();
    let (symbols, shown) = (PrintedSymbols::of_chain(chain), chain.observable(id));
    let printed = PrintedVector::read_shown(chain, &symbols, shown, &texts, Order::UpTo(1)).unwrap();
    let kept = chain.symbols_of(SymbolKind::Error).collect();
    let claim = ClosedForm { observable: id, order: Order::UpTo(1), only: None, faces: None, kept, printed };
    Checker::new(chain).closed_form(&claim).unwrap().differences.is_empty()
}

#[test]
fn claims_on_rotation_vectors_are_decided() {
    let chain = chain();
    let shown = chain.find_observable("turned").map(|id| chain.observable(id)).unwrap();
    assert!(shown.is_orientation() && shown.labels().eq(["rotation_x", "rotation_y", "rotation_z"]));
    assert!(holds(&chain, TURNED));
    let [x, y, z] = TURNED;
    let slip = y.replace("- collimation*sin(azimuth)", "+ collimation*sin(azimuth)");
    assert_ne!(slip, y);
    assert!(!holds(&chain, [x, &slip, z]));
}
