//! Derivations in steps: one joint, two joints, and the paper's chain; each step is checked while it is made.

use model_core::forms;
use model_core::print::{self, Style};
use model_core::{Chain, SymbolKind};

const ONE: &str = "chain One { body table on ground { motion: Rz(turn); motion_error: Rz(index), Rx(wobble); } \
    observe edge: direction(1, 0, 0) of table; }";
const TWO: &str = "chain Two { const arm: length = 0.4; body a on ground { motion: Rz(azimuth); motion_error: Rz(index), Rx(tilt); } \
    body b on a { position: Tx(arm); position_error: Ty(shift), Rz(yaw); motion: Rx(elevation); motion_error: Rx(zero); } \
    observe mark: point(0, arm, 0) of b; }";
const LIDAR: &str = include_str!("../../../examples/mobile-lidar/mobile-lidar.chain");

fn derived(text: &str, observable: &str, style: Style) -> String {
    let chain = Chain::from_text(text).unwrap();
    let steps = forms::steps(&chain, chain.find_observable(observable).unwrap()).unwrap();
    print::steps(&steps, &chain, style)
}

#[test]
fn one_joint_at_the_board() {
    insta::assert_snapshot!(derived(ONE, "edge", Style::Text));
    insta::assert_snapshot!(derived(ONE, "edge", Style::Latex));
}

#[test]
fn two_joints_at_the_board() {
    insta::assert_snapshot!(derived(TWO, "mark", Style::Text));
    insta::assert_snapshot!(derived(TWO, "mark", Style::Markdown));
}

#[test]
fn the_papers_chain_at_the_board() {
    for observable in ["pointing", "position", "target"] {
        let text = derived(LIDAR, observable, Style::Text);
        assert!(text.contains("5. Collect."), "{observable}");
    }
    insta::assert_snapshot!(derived(LIDAR, "pointing", Style::Text));
}

/// What is collected is what `derive` prints.
#[test]
fn the_last_step_is_the_form() {
    for (text, observable) in [(ONE, "edge"), (TWO, "mark"), (LIDAR, "target")] {
        let chain = Chain::from_text(text).unwrap();
        let id = chain.find_observable(observable).unwrap();
        let steps = forms::steps(&chain, id).unwrap();
        let form = forms::derive(&chain, id, 1).unwrap();
        for (collected, component) in steps.collected.iter().zip(&form.components) {
            assert_eq!(*collected, component.above);
        }
        assert!(chain.symbols_of(SymbolKind::Error).count() > 1);
    }
}
