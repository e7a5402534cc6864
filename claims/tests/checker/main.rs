//! Random slips in correct formulas of eight chains: each is found where it was made, and nothing else is.

#![allow(clippy::unwrap_used, reason = "a test may fail loudly")]

mod angles;
mod counts;
mod slips;

use std::path::Path;

use claims::checker::{Checker, ClosedForm, FormVerdict, Order, PrintedVector};
use claims::latex::PrintedSymbols;
use model_core::{Axis, Chain, ObservableId, SymbolKind, forms};

use slips::{Expected, Formula, Slip};
use testkit::Random;

/// Mounts, scanners, arms, a tree; below the root of the workspace.
const CHAINS: [&str; 8] = [
    "examples/mobile-lidar/mobile-lidar.chain",
    "examples/alt-azimuth/alt-azimuth.chain",
    "codegen/tests/chains/arm.chain",
    "codegen/tests/chains/equatorial.chain",
    "codegen/tests/chains/gimbal.chain",
    "codegen/tests/chains/tracker.chain",
    "codegen/tests/chains/tree.chain",
    "codegen/tests/chains/turntable.chain",
];

fn chain(path: &str) -> Chain {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join(path);
    Chain::from_text(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn observables(chain: &Chain) -> Vec<ObservableId> {
    chain.observables.iter().map(|observable| chain.find_observable(&observable.name).unwrap()).collect()
}

fn verdict(
    checker: &mut Checker<'_>,
    chain: &Chain,
    observable: ObservableId,
    texts: &[String; 3],
) -> FormVerdict {
    let texts = texts.each_ref().map(String::as_str);
    let printed = PrintedVector::read(chain, &PrintedSymbols::of_chain(chain), &texts)
        .unwrap_or_else(|mistakes| panic!("{texts:#?}\n{mistakes:#?}"));
    let kept = chain.symbols_of(SymbolKind::Error).collect();
    let order = Order::UpTo(1);
    checker.closed_form(&ClosedForm { observable, order, only: None, faces: None, kept, printed }).unwrap()
}

#[test]
fn correct_formulas_hold() {
    for path in CHAINS {
        let chain = chain(path);
        let mut checker = Checker::new(&chain);
        for observable in observables(&chain) {
            for style in [model_core::print::Style::Latex, model_core::print::Style::Text] {
                let form = forms::derive(&chain, observable, 1).unwrap();
                let formula = Formula::new(&chain, &form, style);
                let verdict = verdict(&mut checker, &chain, observable, &formula.texts());
                assert!(verdict.differences.is_empty(), "{path}: {:?}", verdict.differences);
            }
        }
    }
}

#[test]
fn two_hundred_random_slips_are_found_where_they_were_made() {
    let mut random = Random::new(2019);
    let mut made = [0; Slip::ALL.len()];
    for path in CHAINS {
        let chain = chain(path);
        let observables = observables(&chain);
        let mut checker = Checker::new(&chain);
        for round in 0..25 {
            let observable = observables[random.below(observables.len())];
            let form = forms::derive(&chain, observable, 1).unwrap();
            let style = [model_core::print::Style::Latex, model_core::print::Style::Text][round % 2];
            let mut formula = Formula::new(&chain, &form, style);
            let (slip, expected) = formula.slip(&mut random);
            made[slip as usize] += 1;
            let texts = formula.texts();
            let verdict = verdict(&mut checker, &chain, observable, &texts);
            let found: Vec<(Axis, String)> = verdict
                .differences
                .iter()
                .map(|difference| (difference.component, difference.error_name(&chain)))
                .collect();
            let Expected { places, is_right } = expected;
            assert_eq!(found, places, "{path}, {slip:?}: {texts:#?}");
            for difference in &verdict.differences {
                let diagnosis = difference.slip.as_ref();
                assert!(diagnosis.is_some_and(is_right), "{path}, {slip:?}, {diagnosis:?}: {texts:#?}");
            }
        }
    }
    // Each kind was tried often enough to mean something.
    assert!(made.iter().all(|&count| count >= 10), "{made:?}");
}
