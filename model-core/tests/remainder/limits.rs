//! Domains that do not do are refused with the name of what is missing.

use model_core::remainder::{Domain, DomainError, bound};
use model_core::{Chain, ObservableId};

fn gimbal() -> (Chain, Domain) {
    let chain = Chain::from_text(include_str!("../reference/gimbal.chain")).unwrap();
    let mut domain = Domain::new(&chain);
    for name in ["an", "ecc", "scale", "tx", "cte"] {
        domain.set_size(&chain, chain.find_symbol(name).unwrap(), 1e-4).unwrap();
    }
    (chain, domain)
}

fn set(chain: &Chain, domain: &mut Domain, name: &str, low: f64, high: f64) -> Result<(), DomainError> {
    domain.set_range(chain, chain.find_symbol(name).unwrap(), low, high)
}

#[test]
fn what_stands_outside_of_sines_needs_a_range() {
    let (chain, mut domain) = gimbal();
    let refused = |domain: &Domain| bound(&chain, ObservableId(0), domain).unwrap_err();
    assert_eq!(refused(&domain), DomainError::RangeNeeded { name: "azimuth".to_owned() });
    set(&chain, &mut domain, "azimuth", -3.2, 3.2).unwrap();
    assert_eq!(refused(&domain), DomainError::Singular { name: "elevation".to_owned(), function: "sine" });
    set(&chain, &mut domain, "elevation", -0.1, 1.0).unwrap();
    assert_eq!(refused(&domain), DomainError::Singular { name: "elevation".to_owned(), function: "sine" });
    set(&chain, &mut domain, "elevation", 0.2, 1.0).unwrap();
    assert_eq!(refused(&domain), DomainError::RangeNeeded { name: "temperature".to_owned() });
    set(&chain, &mut domain, "temperature", -10.0, 40.0).unwrap();
    assert!(bound(&chain, ObservableId(0), &domain).unwrap().value > 0.0);
}

#[test]
fn a_range_runs_upward_between_finite_numbers() {
    let (chain, mut domain) = gimbal();
    for (low, high) in [(1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
        assert!(matches!(set(&chain, &mut domain, "azimuth", low, high), Err(DomainError::NoRange { .. })));
    }
    let size = domain.set_size(&chain, chain.find_symbol("an").unwrap(), -1.0);
    assert!(matches!(size, Err(DomainError::NoRange { .. })));
}

#[test]
fn without_errors_the_bound_is_zero() {
    let (chain, _) = gimbal();
    let mut domain = Domain::new(&chain);
    for (name, low, high) in [("azimuth", 0.0, 1.0), ("elevation", 0.3, 1.0), ("temperature", 0.0, 1.0)] {
        set(&chain, &mut domain, name, low, high).unwrap();
    }
    assert_eq!(bound(&chain, ObservableId(0), &domain).unwrap().value, 0.0);
}
