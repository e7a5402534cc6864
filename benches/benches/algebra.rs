//! The algebra: deriving forms, deciding equality, bounding the remainder, and how the time grows with the chain.
//!
//! Best peers on the 30-error scanner, first order: 0.66 ms by truncating by hand, 3.7 ms from the product; an equality
//! 2.2 ms. The growth runs along a chain with axes z, x, y, z, … and ten errors a joint, the worst case for the
//! number of terms.
#![allow(missing_docs)]

use claims::checker::{Checker, ClosedForm, Order, PrintedVector};
use claims::latex::PrintedSymbols;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use model_core::algebra::Poly;
use model_core::remainder::{Domain, bound};
use model_core::{Chain, ObservableId, Quantity, SymbolKind, forms, identify, print, syntax};
use std::fmt::Write;
use std::hint::black_box;

const MOBILE_LIDAR: &str = include_str!("../../examples/mobile-lidar/mobile-lidar.chain");
const ARCSEC_RAD: f64 = std::f64::consts::PI / 648_000.0;

fn parsed(text: &str) -> Option<Chain> {
    Chain::from_text(text).ok()
}

/// A chain of so many joints, each with ten errors.
fn long_chain(joints: usize) -> Option<Chain> {
    let mut text = "chain Long {\n".to_owned();
    for joint in 0..joints {
        let lower = joint.checked_sub(1).map_or("ground".to_owned(), |lower| format!("b{lower}"));
        let axis = ["z", "x", "y"][joint % 3];
        let errors: Vec<String> = (0..10)
            .map(|error| format!("{}(e{joint}_{error})", ["Rx", "Ry", "Rz", "Tx", "Ty", "Tz"][error % 6]))
            .collect();
        let errors = errors.join(", ");
        let _ = writeln!(
            text,
            "body b{joint} on {lower} {{ motion: R{axis}(q{joint}); motion_error: {errors}; }}"
        );
    }
    let last = joints - 1;
    let _ = writeln!(text, "observe pointing: direction(0, 0, 1) of b{last};");
    let _ = writeln!(text, "observe position: point(0, 0, 0) of b{last};\n}}");
    parsed(&text)
}

/// The first two observables of both chains: a direction and a point.
const BOTH: [ObservableId; 2] = [ObservableId(0), ObservableId(1)];

fn derive(criterion: &mut Criterion) {
    let Some(chain) = parsed(MOBILE_LIDAR) else { return };
    let mut group = criterion.benchmark_group("derive both forms of the 30-error scanner");
    for order in 1..=3 {
        group.bench_with_input(BenchmarkId::new("order", order), &order, |bencher, &order| {
            bencher.iter(|| BOTH.map(|id| forms::derive(black_box(&chain), id, order)));
        });
    }
    group.finish();
    let mut group = criterion.benchmark_group("derive both forms of a long chain");
    for joints in [3, 6, 9, 12] {
        let Some(chain) = long_chain(joints) else { return };
        group.bench_with_input(BenchmarkId::new("joints", joints), &chain, |bencher, chain| {
            bencher.iter(|| BOTH.map(|id| forms::derive(black_box(chain), id, 1)));
        });
    }
    group.finish();
}

/// A formula as typed (the derived one, printed) against the derived one: reading, canonical form, comparison.
fn decide(criterion: &mut Criterion) {
    let Some(chain) = parsed(MOBILE_LIDAR) else { return };
    let Ok(form) = forms::derive(&chain, BOTH[0], 1) else { return };
    let component = &form.components[0].above;
    let Ok(typed) = syntax::parse_amount(&print::text(component, &chain)) else { return };
    criterion.bench_function("decide whether a typed formula equals the derived one", |bencher| {
        bencher.iter(|| {
            let typed = Poly::from_expr(black_box(&typed), |name| chain.find_symbol(name), |_| true);
            typed.is_ok_and(|typed| typed == *component)
        });
    });
    criterion.bench_function("tell apart the errors of the 30-error scanner", |bencher| {
        bencher.iter(|| identify::identify(black_box(&chain), &BOTH));
    });
}

fn remainder(criterion: &mut Criterion) {
    let Some(chain) = parsed(MOBILE_LIDAR) else { return };
    let mut domain = Domain::new(&chain);
    for id in chain.symbols_of(SymbolKind::Error) {
        let size = if chain.symbol(id).quantity == Quantity::Angle { 10.0 * ARCSEC_RAD } else { 0.5e-3 };
        let _ = domain.set_size(&chain, id, size);
    }
    for id in BOTH {
        let name = &chain.observable(id).name;
        criterion.bench_function(&format!("bound the remainder of {name}"), |bencher| {
            bencher.iter(|| bound(black_box(&chain), id, &domain));
        });
    }
}

/// An arm of twelve joints with ten errors each, and ten constants that are not zero in its geometry.
fn arm_with_constants() -> Option<Chain> {
    let mut text = "chain Arm {\n".to_owned();
    for constant in 0..10 {
        let _ = writeln!(text, "const l{constant}: length = 0.{}1;", constant + 1);
    }
    for joint in 0..12 {
        let lower = if joint == 0 { "ground".to_owned() } else { format!("b{}", joint - 1) };
        let axis = ["Rz", "Rx", "Ry"][joint % 3];
        let (one, other) = (joint % 10, (joint + 3) % 10);
        let _ = writeln!(
            text,
            "body b{joint} on {lower} {{
                position: Tx(l{one}), Tz(l{other});
                position_error: Tx(dx{joint}), Ty(dy{joint}), Tz(dz{joint}), Rx(rx{joint}), Ry(ry{joint}), Rz(rz{joint});
                motion: {axis}(q{joint});
                motion_error: Rx(a{joint}), Ry(b{joint}), Tx(c{joint}), Ty(d{joint});
            }}"
        );
    }
    let _ = writeln!(text, "observe tip: point(l9, 0, l2) of b11; }}");
    parsed(&text)
}

/// At most a second: what an arm with constants can tell of its errors. At most five milliseconds: a claim, the right one and
/// one with a slip.
fn limits(criterion: &mut Criterion) {
    let Some(arm) = arm_with_constants() else { return };
    criterion.bench_function("tell apart 120 errors of twelve joints with ten constants", |bencher| {
        bencher.iter(|| identify::identify(black_box(&arm), &[ObservableId(0)]));
    });
    let Some(chain) = parsed(MOBILE_LIDAR) else { return };
    let Ok(form) = forms::derive(&chain, BOTH[0], 1) else { return };
    let right: Vec<String> = form.components.iter().map(|part| print::text(&part.above, &chain)).collect();
    let slip: Vec<String> = right.iter().map(|text| text.replacen("cos(beta)", "sin(beta)", 1)).collect();
    for (name, texts) in [("that holds", right), ("with a slip in each component", slip)] {
        let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
        criterion.bench_function(&format!("check a claim of 30 errors {name}"), |bencher| {
            bencher.iter(|| {
                let symbols = PrintedSymbols::of_chain(&chain);
                let printed = PrintedVector::read(&chain, &symbols, black_box(&texts)).ok()?;
                let kept = chain.symbols_of(SymbolKind::Error).collect();
                let (observable, order) = (BOTH[0], Order::UpTo(1));
                let claim = ClosedForm { observable, order, only: None, faces: None, kept, printed };
                Checker::new(&chain).closed_form(&claim).ok()
            });
        });
    }
}

criterion_group!(benches, derive, decide, remainder, limits);
criterion_main!(benches);
