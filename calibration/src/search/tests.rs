//! The search on synthetic matrices.
#![allow(clippy::unwrap_used)]

use faer::Mat;
use faer::linalg::solvers::SolveLstsq;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

use super::apart::apart;
use super::context::Found;
use super::state::State;
use super::*;
use effects::candidate::EffectId;

/// A problem of n rows: `p` declared columns, `count` candidates of one or two columns that are smooth functions of
/// three angles, one of them planted with `amplitude` (in σ), unit noise.
fn problem(n: usize, p: usize, count: usize, planted: Option<(usize, f64)>, seed: u64) -> Problem {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = |_: usize, _: usize| -> f64 { StandardNormal.sample(&mut random) };
    let declared = Mat::from_fn(n, p, &mut normal);
    let candidates = Mat::from_fn(n, 2 * count, &mut normal);
    let mut residual: Vec<f64> = (0..n).map(|i| normal(i, 0)).collect();
    if let Some((which, amplitude)) = planted {
        for (i, r) in residual.iter_mut().enumerate() {
            *r += amplitude * candidates[(i, 2 * which)];
        }
    }
    let blocks: Vec<_> = (0..count).map(|c| 2 * c..2 * c + 2).collect();
    let groups: Vec<u32> = (0..n as u32).map(|i| i / 2).collect();
    Problem::new(declared.as_ref(), candidates.as_ref(), &blocks, &residual, &groups, 10, seed).unwrap()
}

#[test]
fn a_planted_effect_is_found_and_nothing_else() {
    let problem = problem(400, 10, 60, Some((17, 0.5)), 3);
    let sets = confounded_sets(&problem);
    assert_eq!(sets.len(), 60);
    let found = select(&problem, &sets, &[], |_| true, &Options::default());
    let names: Vec<SetId> = found.accepted.iter().map(|a| a.set).collect();
    assert_eq!(names, [SetId(17)]);
    let held = nested(&problem, |fold| {
        let found = select(&problem, &sets, &[], |other| other != fold, &Options::default());
        (found.accepted.iter().map(|accepted| accepted.set).collect(), found.state)
    });
    assert!((held.share(SetId(17)) - 1.0).abs() < 1e-12);
    let (before, after) = held.sums_of_squares(&problem);
    assert!(after < 0.9 * before);
}

#[test]
fn the_false_alarm_rate_is_as_stated() {
    let mut alarms = 0;
    let tries = 200;
    for seed in 0..tries {
        let problem = problem(200, 10, 60, None, 100 + seed);
        let sets = confounded_sets(&problem);
        let options = Options { flips: 199, ..Options::default() };
        let found = select(&problem, &sets, &[], |_| true, &options);
        alarms += usize::from(found.remaining_p <= 0.05 || !found.accepted.is_empty());
    }
    // 200 tries at 5 %: binomial, 10 ± 3.1; three standard deviations either way.
    assert!((1..=20).contains(&alarms), "{alarms} of {tries}");
}

/// What is stated of coefficients, of declared columns and of candidates, counts as rows that every set of folds has.
#[test]
fn a_prior_is_rows_that_belong_to_no_fold() {
    let (n, p) = (60, 4);
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut normal = |_: usize, _: usize| -> f64 { StandardNormal.sample(&mut random) };
    let (declared, candidate) = (Mat::from_fn(n, p, &mut normal), Mat::from_fn(n, 1, &mut normal));
    let stated = Mat::from_fn(3, p, |i, j| 4.0 * normal(i, j));
    let residual: Vec<f64> = (0..n).map(|i| normal(i, 0)).collect();
    let known = [0.7, -1.2, 2.0];
    let groups: Vec<u32> = (0..n as u32).collect();
    let block = std::slice::from_ref(&(0..1));
    let problem =
        Problem::new(declared.as_ref(), candidate.as_ref(), block, &residual, &groups, 5, 3).unwrap();
    let size = 0.3;
    let problem = problem.with_prior(stated.as_ref(), &known, &[size]);
    for without in 0..5 {
        let mut state = State::declared(&problem, |fold| fold != without);
        let column = problem.block(EffectId(0)).start;
        state.add(&[column]);
        let found = state.coefficients().iter().find(|(own, _)| *own == column).unwrap().1;
        // The same by all columns as they are.
        let rows = problem.rows_of_folds(|fold| fold != without);
        let all = Mat::from_fn(rows.len() + 4, p + 1, |i, j| match (i.checked_sub(rows.len()), j < p) {
            (None, true) => declared[(rows[i], j)],
            (None, false) => candidate[(rows[i], 0)],
            (Some(3), of_declared) => f64::from(u8::from(!of_declared)) / size,
            (Some(at), true) => stated[(at, j)],
            (Some(_), false) => 0.0,
        });
        let left = Mat::from_fn(rows.len() + 4, 1, |i, _| match i.checked_sub(rows.len()) {
            None => residual[rows[i]],
            Some(3) => 0.0,
            Some(at) => known[at],
        });
        let direct = all.qr().solve_lstsq(&left)[(p, 0)];
        approx::assert_relative_eq!(found / problem.length(column), direct, epsilon = 1e-10);
    }
}

/// Rows that state something by themselves lie in the folds of their units; those without one are part of every set.
#[test]
fn stated_rows_are_held_out_with_their_units_alone() {
    let (n, p) = (40, 3);
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut normal = |_: usize, _: usize| -> f64 { StandardNormal.sample(&mut random) };
    let units = [Some(0), Some(0), Some(1), None];
    // Declared columns, one candidate, the residual; what is stated is of the declared columns alone.
    let rows = Mat::from_fn(n + units.len(), p + 2, |i, j| if i >= n && j == p { 0.0 } else { normal(i, j) });
    let groups: Vec<u32> = (0..n as u32).collect();
    let folds = Folds::deal(&groups, 4, 1).with_stated(&units);
    let in_fold = |row: usize, fold: usize| folds.of_row(row) == fold;
    assert_eq!((n..n + 4).map(|row| folds.of_row(row)).collect::<Vec<_>>(), [0, 0, 1, 4]);
    assert_eq!((folds.groups(), folds.count()), (n, 4));
    let block = std::slice::from_ref(&(0..1));
    let problem = Problem::of_rows(rows.clone(), p, block, &[0.0], folds.clone()).unwrap();
    for without in 0..4 {
        let mut state = State::declared(&problem, |fold| fold != without);
        let kept: Vec<usize> = (0..n + units.len()).filter(|&row| !in_fold(row, without)).collect();
        assert_eq!(state.rows, kept.len());
        let column = problem.block(EffectId(0)).start;
        state.add(&[column]);
        let found = state.coefficients().iter().find(|(own, _)| *own == column).unwrap().1;
        let all = Mat::from_fn(kept.len(), p + 1, |i, j| rows[(kept[i], j)]);
        let left = Mat::from_fn(kept.len(), 1, |i, _| rows[(kept[i], p + 1)]);
        let direct = all.qr().solve_lstsq(&left)[(p, 0)];
        approx::assert_relative_eq!(found / problem.length(column), direct, epsilon = 1e-10);
    }
}

/// What a contest excludes is no longer one with what it does not, and the effect that is written stands for its set.
#[test]
fn a_contest_splits_sets() {
    let set = |members: &[usize]| ConfoundedSet {
        members: members.iter().copied().map(EffectId).collect(),
        rank: 2,
    };
    let found = |effect: usize, may_be: &[usize]| Found {
        effect: EffectId(effect),
        p_value: 0.001,
        alike: vec![EffectId(effect)],
        shares: may_be.iter().map(|&own| (EffectId(own), 0.5)).collect(),
    };
    let sets = vec![set(&[0, 3, 4]), set(&[1, 2]), set(&[5])];
    assert_eq!(apart(sets.clone(), &[found(4, &[])]), sets);
    let expected = [set(&[4, 3]), set(&[0]), set(&[2]), set(&[1]), set(&[5])];
    assert_eq!(apart(sets.clone(), &[found(4, &[3, 4, 2])]), expected);
    // Two effects of one set, each with its own causes.
    let expected = [set(&[4]), set(&[0, 3]), set(&[1, 2]), set(&[5])];
    assert_eq!(
        apart(sets, &[found(0, &[0, 3]), found(4, &[4])]),
        [&expected[1], &expected[0], &expected[2], &expected[3]].map(Clone::clone)
    );
}
