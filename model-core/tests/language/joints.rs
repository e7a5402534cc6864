//! The order of joints is that of the motions: an error that depends on a joint further up changes no answer's columns.
#![allow(clippy::unwrap_used)]

use model_core::{Chain, SymbolKind};

/// The joints of a mount whose base has these factors beside its motion.
fn joints(more: &str) -> Vec<String> {
    let text = format!(
        "chain Mount {{
            body base on ground {{ {more} motion: Rz(azimuth); }}
            body tube on base {{ motion: Rx(elevation); }}
            observe sight: direction(0, 1, 0) of tube;
        }}"
    );
    let chain = Chain::from_text(&text).unwrap();
    chain.symbols_of(SymbolKind::Joint).map(|id| chain.symbol(id).name.clone()).collect()
}

#[test]
fn joints_come_in_the_order_of_their_motions() {
    assert_eq!(joints(""), ["azimuth", "elevation"]);
    assert_eq!(joints("position_error: Rx(sag*cos(elevation));"), ["azimuth", "elevation"]);
    assert_eq!(joints("motion_error: Rx(sag*cos(elevation));"), ["azimuth", "elevation"]);
}
