//! Targets that are observed in several rounds: each stands a little wrong, the same way in every round.

use calibration::diagnose::{Caution, Diagnosis};
use model_core::Chain;
use observe::{Measure, Measured, Observations, tangent_frame};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use study::Study;

use crate::simulated::{lidar, observed_alone, pointing, search};

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;
const PLACES: usize = 60;
const ROUNDS: usize = 5;

/// The scanner at 60 targets in five rounds, each row with noise of 2 arcsec.
#[derive(Default)]
struct Rounds {
    /// How far each target is off.
    off_rad: f64,
    /// How far everything is off in each round, which is declared a group; none is where it is zero.
    shift_rad: f64,
    /// How far off centre beta is, once a turn.
    eccentric_rad: f64,
    /// Within which angle each target is aimed at anew.
    aimed_rad: f64,
}

/// What the search makes of it.
fn report(seed: u64, Rounds { off_rad, shift_rad, eccentric_rad, aimed_rad }: Rounds) -> Diagnosis {
    let text = lidar();
    let chain = Chain::from_text(&text).unwrap();
    let study = "chain = \"c\"\nobservable = \"pointing\"\ndata = \"d\"\n[observed]\nkind = \"direction\"\n";
    let plan = Study::from_text(study).unwrap().plan(&chain).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let targets: Vec<[f64; 3]> =
        (0..PLACES).map(|_| [(); 3].map(|()| random.random_range(-3.0..3.0))).collect();
    let mut normal = || -> f64 { random.sample(StandardNormal) };
    let off: Vec<[f64; 2]> = (0..PLACES).map(|_| [normal(), normal()]).collect();
    let shift: Vec<[f64; 2]> = (0..ROUNDS).map(|_| [normal(), normal()]).collect();
    let names = ["alpha", "beta", "gamma"];
    let mut columns: Vec<_> =
        names.iter().map(|name| (chain.find_symbol(name).unwrap(), Vec::new())).collect();
    let mut observed = Vec::new();
    for row in 0..PLACES * ROUNDS {
        let readings = targets[row % PLACES].map(|q| q + aimed_rad * normal());
        columns.iter_mut().zip(readings).for_each(|((_, column), reading)| column.push(reading));
        let beta = readings[1] + eccentric_rad * readings[1].cos();
        let aim = pointing(&chain, &[], [readings[0], beta, readings[2], 0.0, 0.0]);
        let [across, along] = tangent_frame(&aim);
        let [right, up] = [0, 1].map(|at| {
            2.0 * ARCSEC * normal() + off_rad * off[row % PLACES][at] + shift_rad * shift[row / PLACES][at]
        });
        observed.push(Measured::Direction((aim + across * right + along * up).normalize()));
    }
    let alone = observed_alone(&chain, "pointing", Measure::Direction, columns, observed);
    let rows = 0..(PLACES * ROUNDS) as u32;
    let groups = rows.map(|row| if shift_rad > 0.0 { row / PLACES as u32 } else { row }).collect();
    let observations = Observations { groups, ..alone };
    search(&text, &plan, &observations).diagnosis
}

/// How many places the report counts as groups, if it does.
fn places(report: &Diagnosis) -> Option<usize> {
    let of = |caution: &Caution| match *caution {
        Caution::OfOnePlace { rows, places, .. } => {
            assert_eq!(rows, PLACES * ROUNDS);
            Some(places)
        }
        _ => None,
    };
    report.cautions.iter().find_map(of)
}

/// One of six at most; where every row counted for itself it was every one.
#[test]
fn what_a_target_is_off_by_is_no_effect() {
    let mut accepted = Vec::new();
    for seed in 0..6 {
        let aimed_rad = if seed % 2 == 0 { 0.0 } else { 0.003 };
        let report = report(seed, Rounds { off_rad: 2.0 * ARCSEC, aimed_rad, ..Rounds::default() });
        assert!(places(&report).is_some_and(|places| (58..=60).contains(&places)), "{:?}", report.cautions);
        accepted.extend(report.effects.into_iter().map(|effect| (seed, effect.names)));
    }
    assert!(accepted.len() <= 1, "{accepted:?}");
}

/// An effect is found beside what targets are off by, and where they are not.
#[test]
fn an_effect_is_found_in_rounds() {
    for off_rad in [2.0 * ARCSEC, 0.0] {
        let report = report(11, Rounds { off_rad, eccentric_rad: 12.0 * ARCSEC, ..Rounds::default() });
        // The cosine of beta alone is what gravity does too.
        let here = report.effects.iter().any(|effect| effect.body == "middle" && effect.dof == "Rx");
        assert!(here, "{off_rad}: {:?}", report.effects);
    }
}

/// Where rows of one place share nothing, each counts for itself; chance says otherwise in one of twenty.
#[test]
fn rows_that_share_nothing_count_each() {
    let grouped = (20..24).filter(|seed| places(&report(*seed, Rounds::default())).is_some()).count();
    assert!(grouped <= 1, "{grouped} of 4");
}

/// Every target in every declared group: the places count, and what groups share is noise beside them. Where groups alone counted,
/// all were told an effect.
#[test]
fn declared_groups_do_not_hide_what_targets_are_off_by() {
    let (off_rad, shift_rad) = (2.0 * ARCSEC, 2.0 * ARCSEC);
    let mut accepted = Vec::new();
    for seed in 30..34 {
        let report = report(seed, Rounds { off_rad, shift_rad, ..Rounds::default() });
        assert_eq!(places(&report), Some(PLACES));
        accepted.extend(report.effects.into_iter().map(|effect| (seed, effect.names)));
    }
    assert!(accepted.len() <= 1, "{accepted:?}");
    // Larger than both by far, and found.
    let report = report(34, Rounds { off_rad, shift_rad, eccentric_rad: 12.0 * ARCSEC, aimed_rad: 0.0 });
    let here = report.effects.iter().any(|effect| effect.body == "middle" && effect.dof == "Rx");
    assert!(here, "{:?}", report.effects);
}

/// Where rows of one place share nothing, groups stay what was declared, whatever those share.
#[test]
fn places_that_share_nothing_leave_declared_groups_as_they_are() {
    let report = report(40, Rounds { shift_rad: 2.0 * ARCSEC, ..Rounds::default() });
    assert_eq!(places(&report), None);
}
