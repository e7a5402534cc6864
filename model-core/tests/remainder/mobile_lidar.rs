//! The published scanner with all angular errors at 10″ and all linear ones at 0.5 mm.

use model_core::remainder::{Domain, Parts, bound, search};
use model_core::{Chain, Quantity, SymbolKind};

const ARCSEC_RAD: f64 = std::f64::consts::PI / 648_000.0;

fn chain() -> Chain {
    Chain::from_text(include_str!("../../../examples/mobile-lidar/mobile-lidar.chain")).unwrap()
}

fn domain(chain: &Chain) -> Domain {
    let mut domain = Domain::new(chain);
    for id in chain.symbols_of(SymbolKind::Error) {
        let size = match chain.symbol(id).quantity {
            Quantity::Angle => 10.0 * ARCSEC_RAD,
            _ => 0.5e-3,
        };
        domain.set_size(chain, id, size).unwrap();
    }
    let range = chain.find_symbol("range").unwrap();
    domain.set_range(chain, range, 1.0, 100.0).unwrap();
    domain
}

#[test]
fn the_bound_is_within_twice_the_largest_difference_found() {
    let chain = chain();
    let domain = domain(&chain);
    for observable in ["pointing", "position", "target"] {
        let id = chain.find_observable(observable).unwrap();
        let bound = bound(&chain, id, &domain).unwrap();
        let found = search(&chain, id, &domain, 60, 1).unwrap();
        let ratio = bound.value / found.value;
        assert!((1.0..=2.0).contains(&ratio), "{observable}: {ratio}");
        let Parts::Vector { second_order, tail, shares, is_sum: true } = &bound.parts else {
            unreachable!("a vector")
        };
        let shares: f64 = shares.iter().map(|pair| pair.share).sum();
        assert!((shares - 1.0).abs() < 1e-12, "{observable}: {shares}");
        assert!(bound.value <= (second_order + tail) * (1.0 + 1e-15));
    }
}
