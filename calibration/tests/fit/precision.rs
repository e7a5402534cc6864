//! What the data can say, and where to measure next.

use calibration::design::{Criterion, propose};
use calibration::diagnose::{Caution, of_data, precision};
use fit::{FitOptions, fit};

use model_core::identify::identify;
use model_core::{Chain, ObservableId, ObservableKind, SymbolId, SymbolKind};

use crate::simulated::{Simulation, swapped};

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;
const MOUNT: &str = include_str!("../../../examples/alt-azimuth/alt-azimuth.chain");

/// A mount observed between two elevations.
fn mount(low: f64, high: f64, rows: usize) -> Simulation {
    let mut simulation = Simulation::new(MOUNT, 1);
    simulation.column("azimuth", rows, -3.1..3.1);
    simulation.column("elevation", rows, low..high);
    simulation.draw_errors("*", 30.0 * ARCSEC);
    simulation
}

#[test]
fn what_poses_owe_is_told_from_what_nothing_can_separate() {
    // At one elevation, index and collimation and non-perpendicularity in azimuth are one.
    let mut simulation = mount(0.7, 0.7 + 1e-15, 100);
    let observations = simulation.directions("sight", 2.0 * ARCSEC);
    let result = fit(&simulation.chain, &observations, &FitOptions::for_chain(&simulation.chain)).unwrap();
    let said = precision(&simulation.chain, &observations, &result);
    assert_eq!(said.rank, [4, 6]);
    let [set] = said.not_separable.as_slice() else { panic!("{:?}", said.not_separable) };
    assert_eq!(set.names, ["azimuth_index", "nonperpendicularity", "collimation"]);
    assert!(!set.structural);

    let mut lidar = Simulation::lidar(300, 2);
    let observations = lidar.directions("pointing", 2.0 * ARCSEC);
    let result = fit(&lidar.chain, &observations, &FitOptions::for_chain(&lidar.chain)).unwrap();
    let said = precision(&lidar.chain, &observations, &result);
    assert!(said.not_separable.iter().all(|set| set.structural));
    let together = |a: &str, b: &str| {
        said.not_separable.iter().any(|set| [a, b].iter().all(|name| set.names.iter().any(|own| own == name)))
    };
    assert!(together("dtheta_y3", "db2"), "{:?}", said.not_separable);
}

#[test]
fn a_narrow_range_inflates_variances_and_new_poses_mend_it() {
    let mut simulation = mount(0.7, 0.8, 100);
    let observations = simulation.directions("sight", 2.0 * ARCSEC);
    let result = fit(&simulation.chain, &observations, &FitOptions::for_chain(&simulation.chain)).unwrap();
    let said = precision(&simulation.chain, &observations, &result);
    let collimation = said.determined.iter().find(|one| one.name == "collimation").unwrap();
    assert!(collimation.variance_inflation > 100.0, "{collimation:?}");
    assert!(said.correlations.iter().any(|(a, b, _)| a == "nonperpendicularity" && b == "collimation"));

    let elevation = simulation.chain.find_symbol("elevation").unwrap();
    for criterion in [Criterion::D, Criterion::A] {
        let ranges = [(elevation, 0.2..1.4)];
        let proposal = propose(&simulation.chain, &observations, &result, 10, &ranges, criterion).unwrap();
        assert_eq!(proposal.poses.len(), 10);
        let promised =
            |name: &str| proposal.uncertainties.iter().find(|(own, _, _)| own == name).unwrap().clone();
        let (_, now, then) = promised("collimation");
        assert!(then < now / 5.0, "{criterion:?}: {then} against {now}");
        // Measured, they keep the promise.
        let mut more = observations.clone();
        for (at, (_, values)) in more.poses.columns.iter_mut().enumerate() {
            values.extend(proposal.poses.iter().map(|pose| pose[at]));
        }
        let mut together = Simulation::new(MOUNT, 3);
        together.values = simulation.values.clone();
        together.columns = more.poses.columns;
        let observations = together.directions("sight", 2.0 * ARCSEC);
        let kept = fit(&together.chain, &observations, &FitOptions::for_chain(&together.chain)).unwrap();
        let id = together.chain.find_symbol("collimation").unwrap();
        let ratio = kept.standard_uncertainty(id).unwrap() / then;
        assert!((0.7..1.4).contains(&ratio), "{criterion:?}: {ratio}");
    }
}

#[test]
fn wrong_signs_and_axes_are_hinted_at() {
    let said = |change: &dyn Fn(&mut observe::Observations)| {
        let mut simulation = mount(0.2, 1.3, 100);
        let mut observations = simulation.directions("sight", 2.0 * ARCSEC);
        change(&mut observations);
        let result =
            fit(&simulation.chain, &observations, &FitOptions::for_chain(&simulation.chain)).unwrap();
        of_data(&simulation.chain, &observations, &result)
    };
    let any = |said: &[Caution], is: fn(&Caution) -> bool| assert!(said.iter().any(is), "{said:?}");
    assert_eq!(said(&|_| {}), []);
    let column = |at: usize, factor: f64| {
        move |observations: &mut observe::Observations| {
            observations.poses.columns[at].1.iter_mut().for_each(|value| *value *= factor);
        }
    };
    any(&said(&column(0, -1.0)), |caution| {
        matches!(caution, Caution::OutOfPlace { .. } | Caution::ErrorNotSmall { .. })
    });
    any(
        &said(&|observations| observations.measured.iter_mut().for_each(|u| *u = swapped(*u, 0, 2))),
        |caution| matches!(caution, Caution::OutOfPlace { .. } | Caution::ErrorNotSmall { .. }),
    );
}

/// What these data cannot tell apart is what no data could, set by set, when poses go all round.
#[test]
fn sets_are_those_of_the_declaration() {
    let lidar = include_str!("../../../examples/mobile-lidar/mobile-lidar.chain");
    let turntable = include_str!("../../../examples/turntable/turntable.chain");
    for (text, observable) in
        [(lidar, "pointing"), (lidar, "position"), (turntable, "pointing"), (MOUNT, "sight")]
    {
        let mut simulation = Simulation::new(text, 4);
        let joints: Vec<String> = simulation
            .chain
            .symbols_of(SymbolKind::Joint)
            .map(|id| simulation.chain.symbol(id).name.clone())
            .collect();
        for joint in joints {
            simulation.column(&joint, 400, -3.1..3.1);
        }
        simulation.draw_errors("*", 20.0 * ARCSEC);
        let id = simulation.chain.find_observable(observable).unwrap();
        let point = simulation.chain.observable(id).kind == ObservableKind::Point;
        let observations = if point {
            simulation.points(observable, 1e-5)
        } else {
            simulation.directions(observable, 2.0 * ARCSEC)
        };
        let result =
            fit(&simulation.chain, &observations, &FitOptions::for_chain(&simulation.chain)).unwrap();
        let said = precision(&simulation.chain, &observations, &result);
        assert!(said.not_separable.iter().all(|set| set.structural), "{:?}", said.not_separable);
        let mut found: Vec<Vec<String>> = said.not_separable.into_iter().map(|set| set.names).collect();
        found.iter_mut().for_each(|set| set.sort());
        found.sort();
        assert_eq!(found, declared_sets(&simulation.chain, id), "{observable}");
    }
}

/// The sets that the declaration's own columns link: what combinations hold together.
fn declared_sets(chain: &Chain, observable: ObservableId) -> Vec<Vec<String>> {
    let known = identify(chain, &[observable]).unwrap();
    let alike = known.alike.iter().map(|group| group.iter().map(|member| member.error).collect());
    let combined = known.combinations.iter().map(|dependence| {
        std::iter::once(dependence.error).chain(dependence.others.iter().map(|(other, _)| *other)).collect()
    });
    let mut sets: Vec<Vec<SymbolId>> = Vec::new();
    for link in alike.chain(combined) {
        let link: Vec<SymbolId> = link;
        let (joined, mut rest): (Vec<_>, Vec<_>) =
            sets.into_iter().partition(|set| set.iter().any(|id| link.contains(id)));
        rest.push(joined.into_iter().flatten().chain(link).collect());
        sets = rest;
    }
    let mut named: Vec<Vec<String>> = sets
        .into_iter()
        .map(|mut set| {
            set.sort_unstable();
            set.dedup();
            let mut names: Vec<String> = set.into_iter().map(|id| chain.symbol(id).name.clone()).collect();
            names.sort();
            names
        })
        .collect();
    named.sort();
    named
}
