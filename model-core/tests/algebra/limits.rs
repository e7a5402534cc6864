//! What a user may type is answered in bounded time and memory, with a reason.

use super::expressions::{E, add, call, canonical, div, mul, number, pow, resolve, symbol};
use model_core::algebra::{AlgebraError, DecimalError, Poly, Rational};
use model_core::amount::LowerError;
use model_core::expr::Function;

fn lower(expression: &E) -> Result<Poly, LowerError<()>> {
    Poly::from_expr(expression, resolve, |id| id.0 >= 3)
}

fn refused(expression: &E) -> AlgebraError {
    match lower(expression) {
        Err(LowerError::Algebra { error, .. }) => error,
        Err(other) => panic!("not refused by the algebra: {other}"),
        Ok(poly) => panic!("not refused: {} terms", poly.len()),
    }
}

#[test]
fn a_huge_power_is_refused() {
    let sum = add(symbol("a"), symbol("b"));
    assert_eq!(refused(&pow(sum.clone(), 1_000_000)), AlgebraError::TooLarge);
    assert_eq!(refused(&pow(number(2, 1), i32::MAX)), AlgebraError::TooLarge);
    assert_eq!(lower(&pow(number(1, 1), i32::MAX)), Ok(Poly::one()));
    // Powers of powers multiply.
    assert_eq!(refused(&pow(pow(pow(symbol("a"), 900), 900), 900)), AlgebraError::TooLarge);
    // Powers of wide sums.
    let wave = |n, name| call(Function::Sin, mul(number(n, 1), symbol(name)));
    let wide = (1..7)
        .fold(symbol("a"), |sum, n| (1..7).fold(sum, |sum, m| add(sum, mul(wave(n, "t"), wave(m, "u")))));
    assert_eq!(refused(&pow(wide, 12)), AlgebraError::TooLarge);
}

#[test]
fn long_products_and_high_poles_are_refused() {
    let cosine = || call(Function::Cos, symbol("t"));
    let product =
        |factor: &dyn Fn() -> E, count| (1..count).fold(factor(), |product, _| mul(product, factor()));
    assert_eq!(refused(&product(&cosine, 8_000)), AlgebraError::TooLarge);
    assert_eq!(refused(&product(&|| symbol("a"), 8_000)), AlgebraError::TooLarge);
    let poles = |function| pow(call(function, symbol("t")), 300);
    assert_eq!(refused(&mul(poles(Function::Csc), poles(Function::Sec))), AlgebraError::TooLarge);
    assert!(lower(&pow(call(Function::Tan, symbol("t")), 20)).is_ok());
}

#[test]
fn huge_coefficients_stay_exact() {
    let big = pow(number(i64::MAX, 3), 40);
    let ratio = div(big.clone(), pow(number(i64::MAX, 3), 39));
    assert_eq!(canonical(&ratio), Poly::constant(Rational::new(i64::MAX, 3).unwrap()));
    let one_more = add(big.clone(), number(1, 1));
    assert_ne!(canonical(&one_more), canonical(&big));
}

#[test]
fn deep_sums_do_not_exhaust_the_stack() {
    let sum = (0..5_000).fold(number(0, 1), |sum, _| add(sum, symbol("a")));
    assert_eq!(canonical(&sum), canonical(&mul(number(5_000, 1), symbol("a"))));
}

#[test]
fn only_angle_sums_have_a_sine() {
    let sine = |argument| refused(&call(Function::Sin, argument));
    assert_eq!(sine(mul(symbol("t"), symbol("u"))), AlgebraError::NotAnAngle);
    assert_eq!(sine(number(1, 2)), AlgebraError::NotAnAngle);
    assert_eq!(sine(mul(number(1, 2), symbol("t"))), AlgebraError::NotAnAngle);
    assert_eq!(sine(mul(number(5_000_000, 1), symbol("t"))), AlgebraError::TooLarge);
    assert!(
        matches!(lower(&call(Function::Cos, symbol("a"))), Err(LowerError::SineOf { name, .. }) if name == "a")
    );
}

#[test]
fn only_numbers_and_single_waves_divide() {
    assert_eq!(refused(&div(number(1, 1), symbol("a"))), AlgebraError::NotDivisible);
    let sum = call(Function::Cos, add(symbol("t"), symbol("u")));
    assert_eq!(refused(&div(number(1, 1), sum)), AlgebraError::NotDivisible);
    let zero = add(symbol("a"), mul(number(-1, 1), symbol("a")));
    assert!(matches!(lower(&div(number(1, 1), zero)), Err(LowerError::DivisionByZero { .. })));
    let quarter = call(Function::Tan, mul(number(1, 2), symbol("pi")));
    assert!(matches!(lower(&quarter), Err(LowerError::DivisionByZero { .. })));
    assert!(
        matches!(lower(&symbol("nobody")), Err(LowerError::UnknownSymbol { name, .. }) if name == "nobody")
    );
}

#[test]
fn decimals_are_exact() {
    let read = |text: &str| Rational::parse_decimal(text);
    assert_eq!(read("0.1"), Ok(Rational::new(1, 10).unwrap()));
    assert_eq!(read("-12.50e-1"), Ok(Rational::new(-5, 4).unwrap()));
    assert_eq!(read("3e2"), Ok(Rational::from(300)));
    assert_eq!(read("1e30").unwrap().to_f64(), 1e30);
    for malformed in ["", ".", "-", "1.2.3", "1e", "e5", "0x10", "1e1.5", "nan", "½"] {
        assert_eq!(read(malformed), Err(DecimalError::Malformed(malformed.to_owned())), "{malformed}");
    }
    for long in ["1e1000000", "1e-9223372036854775808", "0.1e-400"] {
        assert_eq!(read(long), Err(DecimalError::TooLong(long.to_owned())), "{long}");
    }
}
