//! A program can print its own formula: the text that a module carries reads back as the form that was derived.
#![allow(clippy::unwrap_used)]

use trueaxis::model_core::algebra::Poly;
use trueaxis::model_core::{Chain, SymbolKind, forms, print, syntax};

use super::chains::alt_azimuth::AltAzimuth;
use super::chains::mobile_lidar::MobileLidar;
use super::chains::{CASES, encoder::Encoder};

#[test]
fn the_text_reads_back_as_the_derived_form() {
    for (file, observable, text, latex) in [
        (
            "examples/mobile-lidar/mobile-lidar.chain",
            "pointing",
            MobileLidar::POINTING_FIRST_ORDER,
            MobileLidar::POINTING_FIRST_ORDER_LATEX,
        ),
        (
            "examples/mobile-lidar/mobile-lidar.chain",
            "target",
            MobileLidar::TARGET_FIRST_ORDER,
            MobileLidar::TARGET_FIRST_ORDER_LATEX,
        ),
        (
            "examples/alt-azimuth/alt-azimuth.chain",
            "sight",
            AltAzimuth::SIGHT_FIRST_ORDER,
            AltAzimuth::SIGHT_FIRST_ORDER_LATEX,
        ),
        ("tests/chains/encoder.chain", "beam", Encoder::BEAM_FIRST_ORDER, Encoder::BEAM_FIRST_ORDER_LATEX),
    ] {
        let case = CASES.iter().find(|case| case.file == file && case.observable == observable).unwrap();
        let (chain, id) = case.chain();
        let form = forms::derive(&chain, id, 1).unwrap();
        for ((text, latex), derived) in text.into_iter().zip(latex).zip(&form.components) {
            let derived = &derived.above;
            assert_eq!(read(text, &chain), *derived, "{file} {observable}");
            assert_eq!(latex, print::latex(derived, &chain));
        }
    }
}

fn read(text: &str, chain: &Chain) -> Poly {
    let amount = syntax::parse_amount(text).unwrap();
    Poly::from_expr(&amount, |name| chain.find_symbol(name), |id| chain.symbol(id).kind != SymbolKind::Error)
        .unwrap()
}

#[test]
fn names_are_in_the_order_of_the_chain() {
    let (chain, _) = CASES[3].chain();
    let errors: Vec<&str> =
        chain.symbols_of(SymbolKind::Error).map(|id| chain.symbol(id).name.as_str()).collect();
    assert_eq!(MobileLidar::ERROR_NAMES.to_vec(), errors);
    assert_eq!(MobileLidar::JOINT_NAMES, ["alpha", "beta", "gamma"]);
    assert_eq!(MobileLidar::INPUT_NAMES, ["range"]);
    assert_eq!(MobileLidar::NAME, "MobileLidar");
}
