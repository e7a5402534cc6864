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
    for name in ["mobile-lidar", "gimbal", "ramps"] {
        let chain = chain(name);
        for observable in &chain.observables {
            let id = chain.find_observable(&observable.name).unwrap();
            for order in 1..=3 {
                for component in forms::derive(&chain, id, order).unwrap().components {
                    let component = component.above;
                    let text = print::text(&component, &chain);
                    let read = syntax::parse_amount(&text).unwrap();
                    assert_eq!(chain.amount(&read).unwrap(), component, "{name} {} {order}", observable.name);
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
            assert_eq!(zeroed(exact.derivative(error)), zeroed(first.above.derivative(error)));
        }
    }
}

#[test]
fn a_form_beyond_all_reading_is_refused() {
    use std::fmt::Write;
    let mut text = "chain Long {\n".to_owned();
    for joint in 0..9 {
        let lower = if joint == 0 { "ground".to_owned() } else { format!("b{}", joint - 1) };
        let axis = ["z", "x", "y"][joint % 3];
        let errors: Vec<String> =
            (0..10).map(|n| format!("R{}(e{joint}_{n})", ["x", "y", "z"][n % 3])).collect();
        let errors = errors.join(", ");
        writeln!(text, "body b{joint} on {lower} {{ motion: R{axis}(q{joint}); motion_error: {errors}; }}")
            .unwrap();
    }
    text += "observe sight: direction(0, 0, 1) of b8;\n}";
    let chain = model_core::Chain::from_text(&text).unwrap();
    let sight = chain.find_observable("sight").unwrap();
    assert!(forms::derive(&chain, sight, 1).is_ok());
    let refused = forms::derive(&chain, sight, 3).unwrap_err();
    let too_large = model_core::algebra::AlgebraError::TooLarge;
    assert!(matches!(refused, forms::FormError::Factor { error, .. } if error == too_large), "{refused}");
}
