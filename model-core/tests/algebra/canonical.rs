//! Equal functions have one form; different functions have two.

use super::expressions::{expression, form, perturbed, rewritten, value};
use proptest::prelude::*;

/// Values for π and the symbols, away from the zeros of sines and cosines.
fn point() -> impl Strategy<Value = Vec<f64>> {
    let angle = || prop_oneof![0.2f64..1.3, 1.8f64..2.9];
    (0.5f64..2.0, -2.0f64..-0.5, angle(), angle(), angle())
        .prop_map(|(a, b, t, u, v)| vec![std::f64::consts::PI, a, b, t, u, v])
}

/// Sum of absolute values of the terms: what rounding is relative to.
fn size(poly: &model_core::algebra::Poly, values: &[f64]) -> f64 {
    use model_core::algebra::{Poly, Wave};
    let mut size = 1.0;
    for term in poly.terms() {
        let mut product = Poly::constant(term.coefficient.abs());
        for (symbol, power) in term.powers {
            product = &product * &Poly::symbol(symbol).pow(power).unwrap();
        }
        let mut magnitude = product.eval(values).abs();
        for pole in term.poles {
            let angle = values[pole.symbol.index()];
            magnitude /=
                (angle.sin().powi(pole.sin_power as i32) * angle.cos().powi(pole.cos_power as i32)).abs();
        }
        debug_assert!(term.waves.iter().all(|wave| matches!(wave.wave, Wave::Sin | Wave::Cos)));
        size += magnitude;
    }
    size
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn rewriting_by_true_identities_keeps_the_form(
        original in expression(),
        choices in prop::collection::vec(any::<u8>(), 0..12),
        more in prop::collection::vec(any::<u8>(), 0..6),
    ) {
        let once = rewritten(&original, &mut choices.clone());
        let twice = rewritten(&once, &mut more.clone());
        prop_assert_eq!(form(&original)?, form(&twice)?);
    }

    #[test]
    fn the_form_has_the_value_of_the_expression(original in expression(), values in point()) {
        let poly = form(&original)?;
        let tolerance = 1e-9 * size(&poly, &values);
        let (expected, found) = (value(&original, &values), poly.eval(&values));
        prop_assert!((expected - found).abs() <= tolerance.max(1e-9 * expected.abs()), "{expected} {found}");
    }

    /// Equality decided by the form agrees with the values, for expressions that differ in one leaf.
    #[test]
    fn perturbed_expressions_do_not_meet(
        original in expression(),
        leaf in 0usize..8,
        one in point(),
        two in point(),
    ) {
        let other = perturbed(&original, &mut leaf.clone());
        let (left, right) = (form(&original)?, form(&other)?);
        let difference = &left - &right;
        prop_assert_eq!(left == right, difference.is_zero());
        if left == right {
            for values in [one, two] {
                let (x, y) = (value(&original, &values), value(&other, &values));
                prop_assert!((x - y).abs() <= 1e-9 * (size(&left, &values) + x.abs()), "{x} {y}");
            }
        } else {
            // A difference that is not identically zero is not zero at both of two random points.
            prop_assert!(difference.eval(&one) != 0.0 || difference.eval(&two) != 0.0);
        }
    }
}
