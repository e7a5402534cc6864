//! Tolerances against what can be said in closed form or by trying everything.

#![allow(clippy::unwrap_used)]

use approx::assert_relative_eq;
use model_core::Chain;
use model_core::budget::{JointRange, Path, Poses};
use model_core::syntax::parse_amount;
use nalgebra::Vector3;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use super::*;

const LIDAR: &str = include_str!("../../../examples/mobile-lidar/mobile-lidar.chain");

/// The errors of these names at a target 10 m away, all joints running together.
fn lidar(errors: &[(&str, f64)], poses: usize) -> (Sensitivity, Vec<Tolerance>) {
    let chain = Chain::from_text(LIDAR).unwrap();
    let mut path = Path::default();
    for (name, amount) in [("alpha", "t"), ("beta", "t"), ("gamma", "t"), ("range", "10")] {
        path.assign(&chain, name, &parse_amount(amount).unwrap()).unwrap();
    }
    let mut sizes = vec![0.0; chain.symbols.len()];
    for (name, size) in errors {
        sizes[chain.find_symbol(name).unwrap().index()] = *size;
    }
    let target = chain.find_observable("target").unwrap();
    let sensitivity = Sensitivity::over(&chain, target, &sizes, &Poses::Path(path), poses).unwrap();
    let tolerances = uniform(&sensitivity, &sizes);
    (sensitivity, tolerances)
}

fn uniform(sensitivity: &Sensitivity, sizes: &[f64]) -> Vec<Tolerance> {
    let tolerance = |&error: &SymbolId| Tolerance {
        error,
        size: sizes[error.index()],
        distribution: Distribution::Uniform,
    };
    sensitivity.errors.iter().map(tolerance).collect()
}

/// A tilt about the beam's foot moves a target at 10 m by its tenfold; the outer tilt about y by |cos β| of it and less.
#[test]
fn one_error_is_what_geometry_says() {
    let (sensitivity, tolerances) = lidar(&[("db2", 1e-4), ("dx1", 3e-4)], 360);
    let now = root_sum_square(&sensitivity, &tolerances);
    let (tilt, shift) = (1e-3 / 3f64.sqrt(), 3e-4 / 3f64.sqrt());
    for value in &now.by_pose {
        assert_relative_eq!(*value, tilt.hypot(shift), max_relative = 1e-12);
    }
    assert_relative_eq!(now.rms, tilt.hypot(shift), max_relative = 1e-12);
    // In the order of the chain: the shift is declared first.
    assert_relative_eq!(now.shares[0], shift * shift / (tilt * tilt + shift * shift), max_relative = 1e-12);
    assert_relative_eq!(now.shares.iter().sum::<f64>(), 1.0, max_relative = 1e-12);
}

#[test]
fn the_worst_case_is_the_longest_of_all_signs() {
    let mut chance = ChaCha8Rng::seed_from_u64(3);
    for case in 0..60 {
        let mut columns: Vec<Vector3<f64>> =
            (0..9).map(|_| Vector3::from_fn(|_, _| chance.random_range(-1.0..1.0))).collect();
        // Columns of one direction, of one plane, along an axis, zero: what instruments have.
        match case % 5 {
            1 => columns[3] = columns[0] * -2.0,
            2 => columns[1..6].iter_mut().for_each(|column| column.z = 0.0),
            3 => columns.iter_mut().for_each(|column| column.y = 0.0),
            4 => columns.iter_mut().step_by(2).for_each(|column| *column = Vector3::new(column.x, 0.0, 0.0)),
            _ => columns[4] = Vector3::zeros(),
        }
        let tried = (0_u32..1 << columns.len()).map(|signs| {
            let signed =
                columns.iter().enumerate().map(|(at, c)| if signs >> at & 1 == 0 { *c } else { -*c });
            signed.sum::<Vector3<f64>>().norm()
        });
        assert_relative_eq!(
            worst::longest(columns.iter().copied()),
            tried.fold(0.0, f64::max),
            max_relative = 1e-12
        );
    }
    assert_eq!(worst::longest(std::iter::empty()), 0.0);
    assert_relative_eq!(worst::longest([Vector3::new(0.0, -2.0, 0.0)].into_iter()), 2.0);
}

/// A triangle over (-1, 1): variance 1/6, and a part p of the draws within 1 − √(1 − p).
#[test]
fn a_table_is_drawn_as_it_stands() {
    let shape = Shape::new(&[(-1.0, 0.0), (0.0, 7.0), (1.0, 0.0)]).unwrap();
    let triangle = Distribution::Table(shape);
    assert_relative_eq!(triangle.mean(), 0.0, epsilon = 1e-15);
    assert_relative_eq!(triangle.standard_deviation(), 6f64.sqrt().recip(), max_relative = 1e-14);
    let (sensitivity, mut tolerances) = lidar(&[("db2", 1e-4)], 5);
    tolerances[0].distribution = triangle;
    let drawn = simulate(&sensitivity, &tolerances, None, 200_000, 1);
    for part in [0.1, 0.5, 0.9, 0.99] {
        let expected = 1e-3 * (1.0 - (1.0_f64 - part).sqrt());
        // Four standard errors of the part, by the density at the place.
        let slack = 4.0 * (part * (1.0 - part) / 200_000.0).sqrt() / (2.0 * (1.0 - expected / 1e-3)) * 1e-3;
        for sample in [&drawn.rms, &drawn.largest, &drawn.single] {
            assert!(
                (sample.percentile(part) - expected).abs() < slack,
                "{part}: {}",
                sample.percentile(part)
            );
        }
        assert!((drawn.largest.within(expected) - part).abs() < 0.005);
    }
    // Lopsided: mean 1/3, and the expected square is that of the mean and the variance.
    let lopsided = Distribution::Table(Shape::new(&[(-1.0, 0.0), (1.0, 1.0)]).unwrap());
    assert_relative_eq!(lopsided.mean(), 1.0 / 3.0, max_relative = 1e-14);
    tolerances[0].distribution = lopsided;
    let now = root_sum_square(&sensitivity, &tolerances);
    assert_relative_eq!(now.rms, 1e-3 * (1.0 / 3.0_f64).sqrt(), max_relative = 1e-12);
    let wish = Wish { wanted: 1e-4, costs: vec![1.0], finest: vec![0.0] };
    assert_eq!(allocate(&sensitivity, &tolerances, &wish), Err(NotAllocated::Mean));
}

#[test]
fn draws_are_the_same_whatever_the_threads() {
    let errors = [("db2", 5e-5), ("dx1", 3e-4), ("dtheta_y3", 5e-5), ("dg4", 1e-4)];
    let (sensitivity, tolerances) = lidar(&errors, 11);
    let with = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| simulate(&sensitivity, &tolerances, None, 20_001, seed))
    };
    let once = with(1, 7);
    assert_eq!(once, with(3, 7));
    assert_ne!(once, with(1, 8));
    // One draw, no draw.
    assert!(simulate(&sensitivity, &tolerances, None, 1, 1).rms.percentile(0.5) > 0.0);
    assert!(simulate(&sensitivity, &tolerances, None, 0, 1).rms.percentile(0.5).is_nan());
}

#[test]
fn allocated_sizes_keep_what_is_wanted_at_the_least_cost() {
    let (sensitivity, tolerances) =
        lidar(&[("db2", 5e-5), ("dx1", 3e-4), ("dtheta_y1", 5e-5), ("dg4", 5e-5)], 90);
    let costs = vec![1.0, 4.0, 1.0, 1.0];
    let wish = Wish { wanted: 2e-4, costs: costs.clone(), finest: vec![0.0; 4] };
    let found = allocate(&sensitivity, &tolerances, &wish).unwrap();
    // A turn about the beam does nothing.
    assert_eq!(found.sizes.iter().filter(|size| size.is_none()).count(), 1);
    let with = |sizes: &[Option<f64>]| -> Vec<Tolerance> {
        let pairs = tolerances.iter().zip(sizes);
        pairs.map(|(t, size)| Tolerance { size: size.unwrap_or(t.size), ..t.clone() }).collect()
    };
    assert_relative_eq!(root_sum_square(&sensitivity, &with(&found.sizes)).rms, 2e-4, max_relative = 1e-9);
    let cost = |sizes: &[Option<f64>]| -> f64 {
        (0..4).filter_map(|at| sizes[at].map(|size| costs[at] * tolerances[at].size / size)).sum()
    };
    assert_relative_eq!(found.costs.1, cost(&found.sizes), max_relative = 1e-9);
    // Any other sizes that do as much cost more.
    let mut chance = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..50 {
        let other = found
            .sizes
            .iter()
            .map(|size| size.map(|size| size * chance.random_range(0.8..1.25)))
            .collect::<Vec<_>>();
        let factor = 2e-4 / root_sum_square(&sensitivity, &with(&other)).rms;
        let other: Vec<Option<f64>> = other.iter().map(|size| size.map(|size| size * factor)).collect();
        assert!(cost(&other) >= found.costs.1 * (1.0 - 1e-9));
    }
    // What cannot be made finer takes its part first.
    let finest: Vec<f64> = tolerances.iter().map(|t| 0.5 * t.size).collect();
    let halved: Vec<Tolerance> =
        tolerances.iter().map(|t| Tolerance { size: 0.5 * t.size, ..t.clone() }).collect();
    let smallest = root_sum_square(&sensitivity, &halved).rms;
    let held = |wanted: f64| {
        allocate(&sensitivity, &tolerances, &Wish { wanted, costs: costs.clone(), finest: finest.clone() })
    };
    match held(0.9 * smallest) {
        Err(NotAllocated::Unreachable { smallest: told, .. }) => {
            assert_relative_eq!(told, smallest, max_relative = 1e-9)
        }
        other => panic!("{other:?}"),
    }
    let kept = held(1.05 * smallest).unwrap();
    assert!(kept.sizes.iter().zip(&finest).all(|(size, finest)| size.is_none_or(|size| size >= *finest)));
    assert_relative_eq!(
        root_sum_square(&sensitivity, &with(&kept.sizes)).rms,
        1.05 * smallest,
        max_relative = 1e-9
    );
}

/// One tilt seen n times: 1/σ² + n c²/s². What is never seen stays as it was.
#[test]
fn what_remains_of_one_error_is_in_closed_form() {
    let (sensitivity, tolerances) = lidar(&[("db2", 1e-4), ("dg4", 1e-4)], 40);
    let remains =
        after(&sensitivity, &Campaign { sensitivity: sensitivity.clone(), sigma: 1e-4 }, &tolerances);
    let sigma = tolerances[0].standard_deviation();
    let expected = (sigma.powi(-2) + 40.0 * (10.0_f64 / 1e-4).powi(2)).powf(-0.5);
    assert_relative_eq!(remains.standard_deviations[0], expected, max_relative = 1e-12);
    assert_relative_eq!(remains.standard_deviations[1], sigma, max_relative = 1e-12);
    assert_relative_eq!(remains.spread.rms, 10.0 * expected, max_relative = 1e-12);
    // By hand, d ln V / d ln σ² = V / σ².
    assert_relative_eq!(remains.spread.shares[0], (expected / sigma).powi(2), max_relative = 1e-9);
    assert_relative_eq!(remains.share_of_noise, 1.0 - (expected / sigma).powi(2), max_relative = 1e-9);
    let drawn = simulate(&sensitivity, &tolerances, Some(&remains.root), 100_000, 1);
    // Half of a normal number is within 0.67449 of its deviation.
    assert_relative_eq!(drawn.rms.percentile(0.5), 0.674_49 * remains.spread.rms, max_relative = 0.01);
}

/// A tilt of the ground is what a registration finds; a tilt within the instrument is not.
#[test]
fn a_registration_takes_out_what_moves_everything() {
    let chain = Chain::from_text(LIDAR).unwrap();
    let mut sizes = vec![0.0; chain.symbols.len()];
    let names = ["dtheta_y1", "dtheta_x1", "dx1", "dz1", "db2"];
    for name in names {
        sizes[chain.find_symbol(name).unwrap().index()] = 1e-4;
    }
    for (observable, ranges) in [
        ("target", vec![JointRange { symbol: chain.find_symbol("range").unwrap(), low: 5.0, high: 50.0 }]),
        ("pointing", Vec::new()),
    ] {
        let id = chain.find_observable(observable).unwrap();
        let all = Sensitivity::over(&chain, id, &sizes, &Poses::Ranges(ranges), 200).unwrap();
        let seen = registered(&all);
        let tolerances = uniform(&all, &sizes);
        let [before, left] = [&all, &seen].map(|s| root_sum_square(s, &tolerances));
        let share = |spread: &Spread, name: &str| {
            let at = all.errors.iter().position(|error| chain.symbol(*error).name == name).unwrap();
            spread.shares[at] * spread.rms * spread.rms
        };
        for name in ["dtheta_y1", "dtheta_x1", "dz1"] {
            assert!(share(&left, name) < 1e-20 * before.rms * before.rms, "{observable} {name}");
        }
        assert!(share(&left, "db2") > 0.2 * share(&before, "db2"), "{observable}");
    }
}

#[test]
fn what_is_no_distribution_is_named() {
    for (text, wanted) in [
        ("unifrom", "did you mean `uniform`?"),
        ("gaussian", "write `uniform`, `normal 2` or `table FILE.csv`"),
        ("normal", "write `normal 2`"),
        ("normal zwei", "`zwei` is no number"),
        ("normal -1", "above zero"),
        ("normal inf", "above zero"),
        ("uniform 3", "takes nothing behind it"),
        ("table", "does not say which"),
        ("", "write `uniform`"),
    ] {
        let error = Distribution::parse(text).unwrap_err().to_string();
        assert!(error.contains(wanted), "{text}: {error}");
    }
    for (rows, wanted) in [
        (&[(0.0, 1.0)][..], "two rows"),
        (&[(0.0, 1.0), (1.5, 1.0)], "row 2: the value 1.5 is beyond the size"),
        (&[(0.0, 1.0), (0.0, 1.0)], "row 2: the value does not rise"),
        (&[(0.0, 1.0), (1.0, -1.0)], "row 2: -1 cannot say"),
        (&[(0.0, 0.0), (1.0, 0.0)], "frequency 0"),
        (&[(f64::NAN, 0.0), (1.0, 1.0)], "row 1"),
        (&[(0.0, f64::INFINITY), (1.0, 1.0)], "row 1: inf"),
    ] {
        let error = Shape::new(rows).unwrap_err().to_string();
        assert!(error.contains(wanted), "{rows:?}: {error}");
    }
}
