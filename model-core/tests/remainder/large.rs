//! Errors that no series is good for: a bound is never above what is possible.

use model_core::remainder::{Domain, Parts, bound, search};
use model_core::{Chain, SymbolKind};

const POLE: &str = "chain P {
    body ped on ground { position_error: Rx(-an), Ry(-aw); motion: Rz(-A); motion_error: Rz(ia); }
    body tube on ped { position_error: Ry(-npae); motion: Rx(E); motion_error: Rx(ie), Rz(ca), Rx(tf*cot(E)); }
    observe v: direction(0, 1, 0) of tube;
}";

const ARM: &str = "chain Arm {
    const upper: length = 0.4;
    body a on ground { motion: Rz(p); motion_error: Rx(e1), Ry(e2), Tx(s1); position: Tx(upper), Rx(0.3); }
    body b on a { motion: Ry(q); motion_error: Rz(e3), Rx(e4), Tz(s2); }
    observe tip: point(0.1, 0.2, 0.3) of b;
}";

/// A box of one size for all errors, with the elevation away from its pole.
fn domain(chain: &Chain, size: f64) -> Domain {
    let mut domain = Domain::new(chain);
    for error in chain.symbols_of(SymbolKind::Error) {
        domain.set_size(chain, error, size).unwrap();
    }
    if let Some(elevation) = chain.find_symbol("E") {
        domain.set_range(chain, elevation, 0.17, 1.4).unwrap();
    }
    domain
}

#[test]
fn a_direction_moves_by_no_more_than_two() {
    let chain = Chain::from_text(POLE).unwrap();
    let id = chain.find_observable("v").unwrap();
    for size in [0.1, 0.35, 1.0, 3.0, 30.0] {
        let domain = domain(&chain, size);
        let bound = bound(&chain, id, &domain).unwrap();
        // Two turns of the unit vector, and the first order of seven errors, one of them times the cotangent.
        let possible = 2.0 + 6.0 * size + size / 0.17_f64.tan();
        assert!(bound.value <= possible * (1.0 + 1e-12), "{size}: {} {possible}", bound.value);
        let found = search(&chain, id, &domain, 10, 1).unwrap().value;
        assert!(found <= bound.value && bound.value < 3.0 * found, "{size}: {} {found}", bound.value);
        if let Parts::Vector { second_order, tail, is_sum, .. } = bound.parts {
            assert_eq!(is_sum, bound.value >= (second_order + tail) * (1.0 - 1e-12), "{size}");
        }
    }
}

#[test]
fn points_are_bounded_by_their_levers() {
    let chain = Chain::from_text(ARM).unwrap();
    let id = chain.find_observable("tip").unwrap();
    for size in [1e-4, 0.1, 0.5, 2.0, 10.0] {
        let domain = domain(&chain, size);
        let bound = bound(&chain, id, &domain).unwrap().value;
        let found = search(&chain, id, &domain, 10, 1).unwrap().value;
        assert!(found <= bound && bound < 4.0 * found, "{size}: {bound} {found}");
    }
}
