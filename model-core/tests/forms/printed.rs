//! Closed forms as printed, and read back.

use super::chain;
use model_core::algebra::Poly;
use model_core::print::Style;
use model_core::{forms, print, syntax};

fn printed(name: &str, observable: &str, order: u32, style: Style) -> String {
    let chain = chain(name);
    let form = forms::derive(&chain, chain.find_observable(observable).unwrap(), order).unwrap();
    print::form(&form, &chain, style)
}

#[test]
fn the_pointing_error_of_the_mobile_lidar() {
    insta::assert_snapshot!(printed("mobile-lidar", "pointing", 1, Style::Text));
    insta::assert_snapshot!(printed("mobile-lidar", "pointing", 1, Style::Latex));
}

#[test]
fn the_position_error_of_the_mobile_lidar() {
    insta::assert_snapshot!(printed("mobile-lidar", "position", 1, Style::Markdown));
}

#[test]
fn constants_harmonics_and_poles() {
    insta::assert_snapshot!(printed("gimbal", "weight", 1, Style::Text));
    insta::assert_snapshot!(printed("gimbal", "weight", 1, Style::Latex));
}

#[test]
fn printed_text_reads_back_as_the_same_form() {
    for name in ["mobile-lidar", "gimbal"] {
        let chain = chain(name);
        for observable in &chain.observables {
            let id = chain.find_observable(&observable.name).unwrap();
            for order in 1..=3 {
                for component in forms::derive(&chain, id, order).unwrap().components {
                    let text = print::text(&component, &chain);
                    let read = syntax::parse_amount(&text).unwrap();
                    let again = Poly::from_expr(&read, |name| chain.find_symbol(name), |_| true);
                    assert_eq!(again.unwrap(), component, "{name} {} {order}", observable.name);
                }
            }
        }
    }
}

/// The parts of degree up to three of the untruncated form are the truncated forms.
#[test]
fn verify_truncation_commutes_with_the_product() {
    let chain = chain("mobile-lidar");
    let id = chain.find_observable("pointing").unwrap();
    let exact = forms::exact_symbolic(&chain, id).unwrap();
    let first = forms::derive(&chain, id, 1).unwrap();
    for (exact, first) in exact.iter().zip(&first.components) {
        for error in chain.symbols_of(model_core::SymbolKind::Error) {
            let zeroed = |poly: Poly| {
                chain
                    .symbols_of(model_core::SymbolKind::Error)
                    .fold(poly, |poly, id| poly.substitute(id, &Poly::zero()).unwrap())
            };
            assert_eq!(zeroed(exact.derivative(error)), zeroed(first.derivative(error)));
        }
    }
}
