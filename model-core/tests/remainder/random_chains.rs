//! No joints and errors in the box ever exceed the bound, in any of many random chains.

use std::fmt::Write;

use model_core::exact::Path;
use model_core::remainder::{Domain, bound, search};
use model_core::{Chain, ObservableId, SymbolKind};
use proptest::prelude::*;
use proptest::test_runner::RngAlgorithm;

/// A factor of a random chain: its text, with `E`, `F` for fresh errors and `Q` for the joint of its body.
const ERRORS: [&str; 12] = [
    "Rx(E)",
    "Ry(E)",
    "Rz(E)",
    "Tx(E)",
    "Ty(E)",
    "Tz(E)",
    "Rx(E*cos(Q) + F*sin(Q))",
    "Rz(E*Q)",
    "Ry(E*F)",
    "Ty(E*tan(Q))",
    "Rx(E*warmth + F^2)",
    "Tz(E*cos(3*Q))",
];
const NOMINAL: [&str; 6] = ["Rx(pi/2)", "Ry(-pi/2)", "Rz(pi)", "Tx(arm)", "Ty(-2*arm)", "Rx(tilt)"];

#[derive(Debug, Clone)]
struct Body {
    nominal: Vec<usize>,
    before: Vec<usize>,
    axis: usize,
    after: Vec<usize>,
}

fn body() -> impl Strategy<Value = Body> {
    let errors = || prop::collection::vec(0..ERRORS.len(), 0..4);
    (prop::collection::vec(0..NOMINAL.len(), 0..3), errors(), 0usize..3, errors())
        .prop_map(|(nominal, before, axis, after)| Body { nominal, before, axis, after })
}

fn text(bodies: &[Body]) -> String {
    let mut fresh = 0..;
    let mut text = "chain Random {\n const arm: length = 0.7;\n const tilt: angle = 0.4;\n\
                    input warmth;\n input range: length;\n"
        .to_owned();
    for (index, body) in bodies.iter().enumerate() {
        let lower = index.checked_sub(1).map_or("ground".to_owned(), |lower| format!("b{lower}"));
        writeln!(text, "body b{index} on {lower} {{").unwrap();
        let mut group = |role: &str, factors: Vec<&str>| {
            if !factors.is_empty() {
                let factors: Vec<String> = factors
                    .iter()
                    .map(|factor| {
                        let mut fresh = || format!("e{}", fresh.next().unwrap());
                        factor
                            .replace('E', &fresh())
                            .replace('F', &fresh())
                            .replace('Q', &format!("q{index}"))
                    })
                    .collect();
                writeln!(text, "{role}: {};", factors.join(", ")).unwrap();
            }
        };
        group("position", body.nominal.iter().map(|&n| NOMINAL[n]).collect());
        group("position_error", body.before.iter().map(|&n| ERRORS[n]).collect());
        group("motion", vec![["Rx(Q)", "Ry(Q)", "Rz(Q)"][body.axis]]);
        group("motion_error", body.after.iter().map(|&n| ERRORS[n]).collect());
        writeln!(text, "}}").unwrap();
    }
    let last = bodies.len() - 1;
    writeln!(text, "observe sight: direction(0, 0, 1) of b{last};").unwrap();
    writeln!(text, "observe spot: point(arm, 0, range) of b{last};\n}}").unwrap();
    text
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 64,
        rng_algorithm: RngAlgorithm::ChaCha,
        ..ProptestConfig::default()
    })]

    #[test]
    fn the_bound_is_never_exceeded(
        bodies in prop::collection::vec(body(), 1..5),
        exponent in -7.0f64..-0.7,
        fractions in prop::collection::vec(prop::collection::vec(-1.0f64..=1.0, 80), 40),
        seed in any::<u64>(),
    ) {
        let text = text(&bodies);
        let chain = Chain::from_text(&text).unwrap_or_else(|mistakes| panic!("{}", mistakes.render("random", &text)));
        let mut domain = Domain::new(&chain);
        let mut ranges = Vec::new();
        for (index, symbol) in (0u16..).zip(&chain.symbols) {
            let id = model_core::SymbolId(index);
            let (low, high) = match symbol.kind {
                SymbolKind::Pi | SymbolKind::Constant | SymbolKind::Ramp | SymbolKind::SightAngle => continue,
                SymbolKind::Error => (-10f64.powf(exponent), 10f64.powf(exponent)),
                // Away from the poles of the tangent.
                SymbolKind::Joint => (-1.2, 1.3),
                SymbolKind::Input => (-3.0, 8.0),
            };
            domain.set_range(&chain, id, low, high).unwrap();
            ranges.push((id, low, high));
        }
        for observable in 0..2 {
            let id = ObservableId(observable);
            let bound = bound(&chain, id, &domain).unwrap();
            let path = Path::new(&chain, id);
            for fractions in &fractions {
                let mut values = chain.nominal_values();
                for ((symbol, low, high), fraction) in ranges.iter().zip(fractions.iter().cycle()) {
                    // Ends of the box as often as its inside: that is where remainders are large.
                    let fraction = if fraction.abs() > 0.5 { fraction.signum() } else { 2.0 * fraction };
                    values[symbol.index()] = low + (high - low) * (fraction + 1.0) / 2.0;
                }
                let length = path.remainder(&values).norm();
                prop_assert!(length <= bound.value, "{length:e} > {:e}\n{text}", bound.value);
            }
            let found = search(&chain, id, &domain, 2, seed).unwrap();
            prop_assert!(found.value <= bound.value, "{:e} > {:e}\n{text}", found.value, bound.value);
        }
    }
}

/// The remainder without cancellation is what is left of the exact error when the first-order form is taken off.
#[test]
fn verify_the_remainder_is_exact_minus_first_order() {
    let text = include_str!("../reference/gimbal.chain");
    let chain = Chain::from_text(text).unwrap();
    for (index, observable) in (0u16..).zip(&chain.observables) {
        let id = ObservableId(index);
        let form = model_core::forms::derive(&chain, id, 1).unwrap();
        let path = Path::new(&chain, id);
        for step in 1..40 {
            let mut values = chain.nominal_values();
            for (place, symbol) in chain.symbols.iter().enumerate() {
                let wave = (step as f64 * (place as f64 + 1.7)).sin();
                match symbol.kind {
                    SymbolKind::Error => values[place] = 0.03 * wave,
                    SymbolKind::Joint | SymbolKind::Input => values[place] = 0.8 + 0.5 * wave,
                    SymbolKind::Pi | SymbolKind::Constant | SymbolKind::Ramp | SymbolKind::SightAngle => {}
                }
            }
            let (error, remainder) = (path.error(&values), path.remainder(&values));
            for axis in 0..3 {
                let expected = error[axis] - form.components[axis].eval(&values);
                assert!((remainder[axis] - expected).abs() < 1e-14, "{} {axis}", observable.name);
            }
        }
    }
}
