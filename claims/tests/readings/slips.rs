//! Claims of readings, and the slips of taking one reading for another.

use super::chain;
use claims::checker::{Checker, ClosedForm, Order, PrintedVector};
use claims::latex::PrintedSymbols;
use model_core::{Chain, SymbolKind};

fn said(chain: &Chain, observable: &str, texts: &[&str]) -> Vec<String> {
    let id = chain.find_observable(observable).unwrap();
    let symbols = PrintedSymbols::of_chain(chain);
    let printed =
        PrintedVector::read_shown(chain, &symbols, chain.observable(id), texts, Order::UpTo(1)).unwrap();
    let mut kept: Vec<_> = ["tilt_x", "cross", "collimation", "index_a", "index_e"]
        .map(|name| chain.find_symbol(name).unwrap())
        .to_vec();
    kept.sort_unstable();
    assert!(kept.iter().all(|&id| chain.symbol(id).kind == SymbolKind::Error));
    let claim = ClosedForm { observable: id, order: Order::UpTo(1), only: None, faces: None, kept, printed };
    let verdict = Checker::new(chain).closed_form(&claim).unwrap();
    assert_eq!(verdict.differences.is_empty(), verdict.slips.is_empty(), "{:?}", verdict.differences);
    verdict.slips.iter().map(|slip| slip.describe(chain, id)).collect()
}

const AZIMUTH: &str = "index_a - (tilt_x*cos(azimuth) + cross)*tan(elevation) + collimation/cos(elevation)";
const ACROSS: &str = "index_a*cos(elevation) - (tilt_x*cos(azimuth) + cross)*sin(elevation) + collimation";
const ELEVATION: &str = "index_e + tilt_x*sin(azimuth)";

#[test]
fn right_formulas_hold() {
    let chain = chain();
    let none = Vec::<String>::new();
    let negative = |text: &str| format!("-({text})");
    assert_eq!(said(&chain, "sky", &[AZIMUTH, ELEVATION]), none);
    assert_eq!(said(&chain, "arcs", &[ACROSS, &negative(ELEVATION)]), none);
    assert_eq!(said(&chain, "clock", &[&negative(AZIMUTH), ELEVATION]), none);
    assert_eq!(said(&chain, "other", &[AZIMUTH, &negative(ELEVATION), &negative(ACROSS)]), none);
}

#[test]
fn another_reading_is_named() {
    let chain = chain();
    assert_eq!(
        said(&chain, "sky", &[ACROSS, ELEVATION]),
        [
            "another reading: this is the error of the azimuth from x through y times the cosine of the elevation (ΔA cos E), \
          not of the azimuth from x through y (ΔA)"
        ]
    );
    assert_eq!(
        said(&chain, "arcs", &[AZIMUTH, &format!("-({ELEVATION})")]),
        [
            "another reading: this is the error of the azimuth from x through y (ΔA), not of the azimuth from x through y times \
          the cosine of the elevation (ΔA cos E)"
        ]
    );
    assert_eq!(
        said(&chain, "arcs", &[ACROSS, ELEVATION]),
        ["another reading: this is the error of the elevation towards z, not of the zenith distance from z"]
    );
    assert_eq!(
        said(&chain, "clock", &[AZIMUTH, ELEVATION]),
        [
            "another reading: this is the error of the hour angle from x through y (ΔA), not of the hour angle from x through -y \
          (ΔA)"
        ]
    );
}
