//! Against singular values in 300-bit arithmetic (`tests/reference/make_ranks.py`), and relations that hang on
//! constants.

use model_core::identify::{identify, text};
use model_core::{Chain, SymbolId};

fn chain(name: &str) -> Chain {
    let text = match name {
        "mobile-lidar" => include_str!("../../../examples/mobile-lidar/mobile-lidar.chain"),
        _ => include_str!("../reference/gimbal.chain"),
    };
    Chain::from_text(text).unwrap()
}

#[test]
fn validate_ranks_and_invisible_errors() {
    let mut count = 0;
    for line in include_str!("../reference/ranks.txt").lines() {
        let [name, observables, rank, invisible] = line.split(' ').collect::<Vec<_>>().try_into().unwrap();
        let chain = chain(name);
        let ids: Vec<_> = observables.split('+').map(|name| chain.find_observable(name).unwrap()).collect();
        let found = identify(&chain, &ids).unwrap();
        assert_eq!(found.estimable.len().to_string(), rank, "{line}");
        let names: Vec<&str> = found.invisible.iter().map(|id| chain.symbol(*id).name.as_str()).collect();
        assert_eq!(names.join(","), invisible, "{line}");
        count += 1;
    }
    assert_eq!(count, 9);
}

#[test]
fn a_shift_and_a_tilt_at_the_end_of_a_constant_arm_are_one() {
    let chain = chain("gimbal");
    let weight = chain.find_observable("weight").unwrap();
    insta::assert_snapshot!(text(&identify(&chain, &[weight]).unwrap(), &chain));
}

/// What is said to act alike does: the columns times the ratios agree, with constants at their values.
#[test]
fn verify_dependent_columns_at_values() {
    let text = "chain Robot {
        const upper: length = 0.4; const lower: length = 0.3; const none: length = 0;
        body arm on ground { motion: Rz(q1); motion_error: Rz(i1), Ty(s1); }
        body wrist on arm { position: Tx(upper), Tx(none); position_error: Rz(p), Ty(t), Rz(w), Tx(r); }
        body hand on wrist { position: Tx(lower); position_error: Rz(g), Ty(h); }
        observe tool: point(lower, 0, 0) of hand;
        observe end: point(none, 0, 0) of arm;
    }";
    let chain = Chain::from_text(text).unwrap();
    let tool = chain.find_observable("tool").unwrap();
    let found = identify(&chain, &[tool]).unwrap();
    let values = chain.nominal_values();
    let columns = model_core::forms::derive(&chain, tool, 1).unwrap().columns(&chain);
    let at = |id: SymbolId| {
        let column = &columns.iter().find(|(error, _)| *error == id).unwrap().1;
        let mut values = values.clone();
        values[chain.find_symbol("q1").unwrap().index()] = 0.7;
        column.each_ref().map(|component| component.eval(&values))
    };
    let mut checked = 0;
    for group in &found.alike {
        for member in group {
            let ratio = member.ratio.numerator.eval(&values) / member.ratio.denominator.eval(&values);
            for (one, first) in at(member.error).iter().zip(at(group[0].error)) {
                assert!((one - ratio * first).abs() < 1e-14);
                checked += 1;
            }
        }
    }
    for dependence in &found.combinations {
        let mut sum = [0.0; 3];
        for (error, ratio) in &dependence.others {
            let ratio = ratio.numerator.eval(&values) / ratio.denominator.eval(&values);
            for (sum, part) in sum.iter_mut().zip(at(*error)) {
                *sum += ratio * part;
            }
        }
        for (one, sum) in at(dependence.error).iter().zip(sum) {
            assert!((one - sum).abs() < 1e-14);
            checked += 1;
        }
    }
    assert!(checked >= 9, "{checked}");
    insta::assert_snapshot!(model_core::identify::text(&found, &chain));
    // A constant that is zero has no leverage: a turn about the end is not seen there.
    let end = chain.find_observable("end").unwrap();
    let found = identify(&chain, &[end]).unwrap();
    assert!(found.invisible.contains(&chain.find_symbol("i1").unwrap()));
}
