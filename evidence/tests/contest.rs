//! Whole contests on small simulated problems: what is told, what is not, and what bad input gets.
#![allow(clippy::unwrap_used)]

mod simulated;

use evidence::families::{Driver, Law};
use evidence::{Error, Policy, Problem, contest, contest_among};
use simulated::{Plan, problem};

fn named(problem: &Problem) -> Vec<(String, Law, Driver)> {
    let policy = Policy::default();
    let outcome = contest(problem, &policy, None).unwrap();
    let told = outcome.findings().iter().filter(|found| found.named);
    told.map(|found| {
        let family = &outcome.families()[found.family];
        (outcome.name(found.family), family.law, family.driver)
    })
    .collect()
}

#[test]
fn nothing_is_named_in_white_noise() {
    for seed in 0..6 {
        assert_eq!(named(&problem(&Plan { seed, ..Plan::default() })), Vec::new(), "seed {seed}");
    }
}

#[test]
fn a_harmonic_is_named_at_its_place_with_its_driver() {
    let told = named(&problem(&Plan { amplitude: 3.0, order: 3.0, ..Plan::default() }));
    assert_eq!(told.len(), 1, "{told:?}");
    assert_eq!((told[0].1, told[0].2), (Law::Harmonic(3), Driver::Joint(0)));
    assert!(told[0].0.ends_with("base.Rz"), "{}", told[0].0);
}

#[test]
fn outliers_do_not_hide_an_effect() {
    let told = named(&problem(&Plan { amplitude: 2.0, order: 3.0, outliers: 0.05, ..Plan::default() }));
    assert_eq!(told.iter().map(|told| told.1).collect::<Vec<_>>(), [Law::Harmonic(3)]);
}

#[test]
fn a_step_of_the_levelling_is_a_setup_and_no_cause() {
    let problem = problem(&Plan { rows: 120, moved: 8.0, ..Plan::default() });
    let policy = Policy::default();
    let outcome = contest(&problem, &policy, None).unwrap();
    assert!(outcome.findings().iter().all(|found| !found.named));
    let noise: Vec<Law> = outcome.noise().iter().map(|&family| outcome.families()[family].law).collect();
    assert!(noise.contains(&Law::Setups(2)), "{noise:?}");
    assert!(outcome.cuts()[0].abs_diff(60) <= 2, "{:?}", outcome.cuts());
}

#[test]
fn the_outcome_is_the_same_twice_and_its_shares_are_whole() {
    let problem = problem(&Plan { amplitude: 0.5, order: 2.0, ..Plan::default() });
    let policy = Policy::default();
    let (first, second) =
        (contest(&problem, &policy, None).unwrap(), contest(&problem, &policy, None).unwrap());
    assert_eq!(first.findings(), second.findings());
    assert_eq!(first.steps(), second.steps());
    assert_eq!(first.declared(), second.declared());
    for found in first.findings() {
        assert!((found.shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        assert_eq!(found.shares.len(), found.set.len() + 1);
    }
    let told: Vec<usize> = first.active().iter().map(|&(family, _)| family).collect();
    for competitor in first.contest() {
        let last = competitor.steps.last();
        assert!(!told.contains(&competitor.family) || last.is_some(), "what is told came at some step");
    }
}

#[test]
fn what_is_not_told_is_explained_by_the_size_that_it_would_need() {
    let problem = problem(&Plan { amplitude: 3.0, order: 3.0, ..Plan::default() });
    let policy = Policy::default();
    let outcome = contest(&problem, &policy, None).unwrap();
    let find =
        |name: &str| (0..outcome.families().len()).find(|&family| outcome.name(family) == name).unwrap();
    let told = outcome.explain(find("harmonic 3|azimuth|base.Rz")).unwrap();
    assert!(told.told && told.gain > told.price && told.shows > told.needs.unwrap(), "{told:?}");
    let other = outcome.explain(find("harmonic 5|azimuth|base.Rz")).unwrap();
    assert!(!other.told && other.gain < other.price && other.shows < other.needs.unwrap(), "{other:?}");
    // The declared index of azimuth is a constant there.
    let absorbed = outcome.explain(find("constant||base.Rz")).unwrap();
    assert!(absorbed.needs.is_none() && absorbed.gain == f64::NEG_INFINITY, "{absorbed:?}");
    assert!(outcome.explain(usize::MAX).is_none());
}

#[test]
fn only_what_a_caller_lets_compete_is_told() {
    let problem = problem(&Plan { amplitude: 3.0, order: 3.0, ..Plan::default() });
    let policy = Policy::default();
    let harmonics = |family: &evidence::families::Family| matches!(family.law, Law::Harmonic(1));
    let outcome = contest_among(&problem, &policy, None, &|family, _| harmonics(family)).unwrap();
    assert!(outcome.families().iter().all(|family| harmonics(family) || family.is_noise()));
    assert!(outcome.findings().iter().all(|found| !found.named));
}

#[test]
fn declared_errors_do_not_hang_on_the_unit_of_the_data() {
    let plan = Plan { amplitude: 1.0, order: 2.0, ..Plan::default() };
    let small = problem(&plan);
    let mut large = small.clone();
    large.residual.iter_mut().for_each(|value| *value *= 1e6);
    let policy = Policy::default();
    let estimate = |problem: &Problem| contest(problem, &policy, None).unwrap().declared().unwrap();
    for (small, large) in estimate(&small).iter().zip(estimate(&large)) {
        assert!((small.value * 1e6 - large.value).abs() < 1e-6 * large.uncertainty, "{small:?} {large:?}");
        assert!((small.uncertainty * 1e6 / large.uncertainty - 1.0).abs() < 1e-6);
    }
}

#[test]
fn few_rows_and_useless_columns_are_judged_or_refused_in_words() {
    for rows in [4, 5, 7, 12, 19] {
        let problem = problem(&Plan { rows, seed: 3, ..Plan::default() });
        let policy = Policy::default();
        let outcome = contest(&problem, &policy, None).unwrap();
        for estimate in outcome.declared().unwrap() {
            assert!(estimate.value.is_finite() && estimate.uncertainty > 0.0, "{rows} rows: {estimate:?}");
        }
        assert!(outcome.quantile() > 1.96);
    }
    let mut zero = problem(&Plan::default());
    zero.declared[0].column.fill(0.0);
    let policy = Policy::default();
    let outcome = contest(&zero, &policy, None).unwrap();
    let estimates = outcome.declared().unwrap();
    assert!(!estimates[0].determined && estimates[1].determined);
    let mut labelled = problem(&Plan::default());
    labelled.rows.labels = Some((0..labelled.rows.count).map(|row| usize::MAX - row).collect());
    labelled.declared[0].name = "\u{202e}\0 | name".repeat(1000);
    let families = contest(&labelled, &policy, None).unwrap().families().to_vec();
    assert!(families.iter().all(|family| family.law != Law::Sessions));
    let mut bare = problem(&Plan::default());
    (bare.declared, bare.places, bare.frames) = (Vec::new(), Vec::new(), Vec::new());
    assert!(contest(&bare, &policy, None).unwrap().findings().is_empty());
}

#[test]
fn bad_input_is_refused_with_its_place() {
    let policy = Policy::default();
    let refused = |change: &dyn Fn(&mut Problem)| {
        let mut problem = problem(&Plan::default());
        change(&mut problem);
        contest(&problem, &policy, None).err().expect("refused")
    };
    let rows = Plan::default().rows;
    assert_eq!(refused(&|problem| problem.components = 0), Error::Empty);
    assert!(matches!(refused(&|problem| problem.residual[3] = f64::NAN), Error::NotFinite { at: 3, .. }));
    assert!(matches!(
        refused(&|problem| {
            problem.residual.pop();
        }),
        Error::Length { .. }
    ));
    assert!(matches!(refused(&|problem| problem.residual.fill(0.0)), Error::NoNoise));
    assert!(matches!(
        refused(&|problem| problem.sigma = Some(vec![0.0; 2 * rows])),
        Error::Sigma { at: 0, .. }
    ));
    let wrong_frame = refused(&|problem| problem.places[0].frame = 9);
    assert_eq!(
        wrong_frame.to_string(),
        "the frame of place `base.Rx` refers to number 9 of frames, and there are only 2; name one that is listed"
    );
    assert!(matches!(refused(&|problem| problem.rows.labels = Some(vec![1])), Error::Length { .. }));
    let one_row = problem(&Plan { rows: 1, ..Plan::default() });
    assert!(matches!(contest(&one_row, &policy, None), Err(Error::NoFreedom { values: 2, rank: 2 })));
}

#[test]
fn every_threshold_has_a_name_a_meaning_and_a_source_and_can_be_set() {
    let table = Policy::default().table();
    assert!(table.len() <= 60, "{} thresholds", table.len());
    for line in &table {
        assert!(!line.meaning.is_empty() && !line.source.is_empty(), "{}", line.name);
        let mut policy = Policy::default();
        assert!(policy.set(line.name, 2.0 * line.value + 1.0));
        assert_ne!(policy, Policy::default(), "{}", line.name);
    }
    assert!(!Policy::default().set("no such name", 1.0));
}
