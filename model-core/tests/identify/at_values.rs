//! Chains whose constants are out of reach for formulas: the answer at their declared values has the rank of the numbers.

use model_core::exact::Path;
use model_core::identify::{Candidate, Holds, Identifiability, identify, mistaken_for, mistaken_text, text};
use model_core::{BodyId, Chain, ObservableId, Role, SymbolKind};
use nalgebra::DMatrix;

/// Three constant angles, eighteen errors.
const TWISTED: &str = "chain Twisted {
    const a: angle = 0.7; const b: angle = 0.4; const c: angle = 0.3;
    body l1 on ground {
        motion: Rz(q1); motion_error: Rz(e1), Rx(e2), Ry(e3);
        position: Rx(a), Ry(b); position_error: Rx(e4), Ry(e5), Rz(e6);
    }
    body l2 on l1 {
        motion: Rz(q2); motion_error: Rz(e7), Rx(e8), Ry(e9);
        position: Rx(c), Ry(a); position_error: Rx(e10), Ry(e11), Rz(e12);
    }
    body l3 on l2 {
        motion: Rx(q3); motion_error: Rz(e13), Rx(e14), Ry(e15);
        position: Ry(b), Rz(c); position_error: Rx(e16), Ry(e17), Rz(e18);
    }
    observe d: direction(0.3, 0.2, 1) of l3;
    observe angles: azimuth, elevation of direction(0.3, 0.2, 1) of l3;
    observe turned: orientation of l3;
    observe tip: point(0.3, 0.2, 1) of l3;
}";

/// The columns in floating point, from differences of the exact form.
fn numbers(chain: &Chain, observables: &[ObservableId]) -> DMatrix<f64> {
    const SMALL: f64 = 1e-7;
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let errors: Vec<_> = chain.symbols_of(SymbolKind::Error).collect();
    let paths: Vec<Path> = observables.iter().map(|&id| Path::new(chain, id)).collect();
    let mut rows = Vec::new();
    for _ in 0..2 * errors.len() {
        let mut values = chain.nominal_values();
        for moved in chain.symbols_of(SymbolKind::Joint).chain(chain.symbols_of(SymbolKind::Input)) {
            values[moved.index()] = 6.0 * random();
        }
        let differences: Vec<Vec<f64>> = errors
            .iter()
            .map(|error| {
                let mut with = values.clone();
                with[error.index()] = SMALL;
                paths.iter().flat_map(|path| path.shown_error(&with)).map(|part| part / SMALL).collect()
            })
            .collect();
        for row in 0..differences[0].len() {
            rows.extend(differences.iter().map(|column| column[row]));
        }
    }
    DMatrix::from_row_slice(rows.len() / errors.len(), errors.len(), &rows)
}

fn found(chain: &Chain, names: &[&str]) -> (Identifiability, DMatrix<f64>) {
    let ids: Vec<ObservableId> = names.iter().map(|name| chain.find_observable(name).unwrap()).collect();
    (identify(chain, &ids).unwrap(), numbers(chain, &ids))
}

#[test]
fn three_constant_tilts_are_answered() {
    let chain = Chain::from_text(TWISTED).unwrap();
    for (names, rank) in [(&["d"][..], 6), (&["tip"], 6), (&["turned"], 7), (&["d", "tip"], 6)] {
        let (found, numbers) = found(&chain, names);
        // Of how the body is turned there are formulas.
        let by_formulas = names == ["turned"];
        assert_eq!(found.holds == Holds::Everywhere, by_formulas, "{names:?}");
        assert_eq!(numbers.rank(1e-4), rank, "{names:?}");
        assert_eq!(found.estimable.len(), rank, "{names:?}");
    }
    insta::assert_snapshot!(text(&found(&chain, &["d"]).0, &chain));
}

/// Where the axes need a root that is no canonical form, formulas have no answer, numbers do.
#[test]
fn angles_without_a_closed_form_are_answered() {
    let chain = Chain::from_text(TWISTED).unwrap();
    let (found, numbers) = found(&chain, &["angles"]);
    assert_eq!(found.estimable.len(), numbers.rank(1e-4));
}

/// Each error whose column is said to be a combination of others is that combination in numbers.
#[test]
fn verify_combinations_in_numbers() {
    let chain = Chain::from_text(TWISTED).unwrap();
    let (found, numbers) = found(&chain, &["d"]);
    let errors: Vec<_> = chain.symbols_of(SymbolKind::Error).collect();
    let column = |id| numbers.column(errors.iter().position(|error| *error == id).unwrap()).clone_owned();
    let values = chain.nominal_values();
    assert!(!found.combinations.is_empty());
    for dependence in &found.combinations {
        let mut left = column(dependence.error);
        for (other, ratio) in &dependence.others {
            left -= column(*other) * ratio.numerator.eval(&values);
        }
        assert!(left.amax() < 1e-5, "{}", chain.symbol(dependence.error).name);
    }
    for group in &found.alike {
        for member in group {
            let left = column(member.error) - column(group[0].error) * member.ratio.numerator.eval(&values);
            assert!(left.amax() < 1e-5, "{}", chain.symbol(member.error).name);
        }
    }
    for &error in &found.invisible {
        assert!(column(error).amax() < 1e-5);
    }
}

#[test]
fn candidates_have_a_verdict_at_values() {
    let chain = Chain::from_text(TWISTED).unwrap();
    let d = chain.find_observable("d").unwrap();
    let verdict = |effect: &str| {
        let candidate = Candidate::parse(&chain, BodyId(0), Role::MotionError, effect).unwrap();
        mistaken_text(&mistaken_for(&candidate, &[d]).unwrap())
    };
    assert_eq!(verdict("Rz(-2*x)"), "x: would be mistaken for -2*e6 (or e7)\n");
    assert_eq!(verdict("Rx(x*cos(q2))"), "x: can be told apart from every declared error\n");
}
