//! The operations of the algebra against their defining properties and against values.

use super::expressions::{NAMES, expression, form, resolve};
use model_core::algebra::{AngleSum, Poly, Rational};
use model_core::symbol::SymbolId;
use proptest::prelude::*;

fn symbol(name: &str) -> SymbolId {
    resolve(name).unwrap()
}

fn angle(name: &str) -> AngleSum {
    AngleSum::symbol(symbol(name))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn sums_and_products_form_a_ring(x in expression(), y in expression(), z in expression()) {
        let (x, y, z) = (form(&x)?, form(&y)?, form(&z)?);
        prop_assert_eq!(&x * &y, &y * &x);
        prop_assert_eq!(&(&x + &y) + &z, &x + &(&y + &z));
        prop_assert_eq!(&x * &(&y + &z), &(&x * &y) + &(&x * &z));
        prop_assert!((&x - &x).is_zero());
    }

    #[test]
    fn derivatives_obey_leibniz_and_commute(x in expression(), y in expression()) {
        let (x, y) = (form(&x)?, form(&y)?);
        let (t, a) = (symbol("t"), symbol("a"));
        prop_assert_eq!(
            (&x * &y).derivative(t),
            &(&x.derivative(t) * &y) + &(&x * &y.derivative(t))
        );
        prop_assert_eq!(x.derivative(t).derivative(a), x.derivative(a).derivative(t));
    }

    #[test]
    fn substitution_is_a_homomorphism(x in expression(), y in expression()) {
        let (x, y) = (form(&x)?, form(&y)?);
        let a = symbol("a");
        let replacement = &Poly::cos(&angle("u")) + &Poly::symbol(symbol("b"));
        let put = |poly: &Poly| poly.substitute(a, &replacement).unwrap();
        prop_assert_eq!(put(&(&x * &y)), &put(&x) * &put(&y));
        prop_assert_eq!(put(&(&x + &y)), &put(&x) + &put(&y));
    }

    #[test]
    fn grades_add_up(x in expression()) {
        let x = form(&x)?;
        let chosen = |id: SymbolId| id == symbol("a") || id == symbol("b");
        let degree = x.degree_in(chosen);
        let sum = (0..=degree).fold(Poly::zero(), |sum, order| &sum + &x.graded_part(chosen, order));
        prop_assert_eq!(&sum, &x);
        let again = x.collect_by(chosen).into_iter().fold(Poly::zero(), |sum, (monomial, part)| {
            assert_eq!(part, x.coefficient_of(&monomial, chosen));
            let monomial = monomial
                .into_iter()
                .fold(Poly::one(), |product, (id, n)| &product * &Poly::symbol(id).pow(n).unwrap());
            &sum + &(&monomial * &part)
        });
        prop_assert_eq!(again, x);
    }

    #[test]
    fn rationals_never_overflow(
        a in any::<i64>(), b in 1..i64::MAX, c in any::<i64>(), d in 1..i64::MAX,
    ) {
        let (x, y) = (Rational::new(a, b).unwrap(), Rational::new(c, d).unwrap());
        prop_assert_eq!(&(&x + &y) - &y, x.clone());
        prop_assert_eq!(&x * &y, &y * &x);
        if let Some(inverse) = y.recip() {
            prop_assert_eq!(&(&x * &y) * &inverse, x.clone());
        }
        let fourth = &(&x * &x) * &(&x * &x);
        prop_assert!((fourth.to_f64() - x.to_f64().powi(4)).abs() <= 1e-12 * fourth.to_f64());
        prop_assert_eq!(x < y, x.to_f64() < y.to_f64() || (x.to_f64() == y.to_f64() && (&x - &y).is_negative()));
    }
}

#[test]
fn derivatives_of_each_basis_function() {
    let t = symbol("t");
    let (sin, cos) = (Poly::sin(&angle("t")), Poly::cos(&angle("t")));
    let (over_sin, over_cos) = (sin.recip().unwrap(), cos.recip().unwrap());
    assert_eq!(sin.derivative(t), cos);
    assert_eq!(cos.derivative(t), -&sin);
    // (1/f)′ = −f′/f², to the fourth power
    for (f, inverse) in [(&sin, &over_sin), (&cos, &over_cos)] {
        for k in 1..5u32 {
            let power = inverse.pow(k).unwrap();
            let slope =
                (&inverse.pow(k + 1).unwrap() * &f.derivative(t)).scale(&Rational::from(-i64::from(k)));
            assert_eq!(power.derivative(t), slope);
            for g in [&sin, &cos] {
                let product = &(&g.derivative(t) * &power) + &(g * &slope);
                assert_eq!((g * &power).derivative(t), product);
            }
        }
    }
}

#[test]
fn a_gear_harmonic_is_one_term() {
    let gear = angle("t").times(400).unwrap();
    assert_eq!(Poly::cos(&gear).len(), 1);
    let square = &(&Poly::cos(&gear) * &Poly::cos(&gear)) + &(&Poly::sin(&gear) * &Poly::sin(&gear));
    assert_eq!(square, Poly::one());
}

#[test]
fn a_high_harmonic_over_a_pole_is_reduced_exactly() {
    // sin 40t / sin t is a polynomial; times sin t it comes back.
    let quotient = &Poly::sin(&angle("t").times(40).unwrap()) * &Poly::sin(&angle("t")).recip().unwrap();
    assert!(quotient.terms().all(|term| term.poles.is_empty()));
    assert_eq!(&quotient * &Poly::sin(&angle("t")), Poly::sin(&angle("t").times(40).unwrap()));
}

#[test]
fn symbols_are_listed_once_in_order() {
    let poly = &(&Poly::symbol(symbol("b")) * &Poly::cos(&angle("u"))) + &Poly::symbol(symbol("a"));
    let names: Vec<&str> = poly.symbols().iter().map(|id| NAMES[id.index()]).collect();
    assert_eq!(names, ["a", "b", "u"]);
}
