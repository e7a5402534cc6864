//! Budgets that can be said in closed form.

use std::f64::consts::PI;

use approx::assert_relative_eq;

use super::*;
use crate::syntax;

const LIDAR: &str = include_str!("../../../examples/mobile-lidar/mobile-lidar.chain");

fn chain() -> Chain {
    Chain::from_text(LIDAR).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

fn path(chain: &Chain, text: &[(&str, &str)]) -> Path {
    let mut path = Path::default();
    for (name, amount) in text {
        let amount = syntax::parse_amount(amount).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        path.assign(chain, name, &amount).unwrap_or_else(|error| panic!("{error}"));
    }
    path
}

fn sizes(chain: &Chain, errors: &[(&str, f64)]) -> Vec<f64> {
    let mut sizes = vec![0.0; chain.symbols.len()];
    for (name, size) in errors {
        let id = chain.find_symbol(name).unwrap_or_else(|| panic!("{name}"));
        sizes[id.index()] = *size;
    }
    sizes
}

fn observable(chain: &Chain, name: &str) -> ObservableId {
    chain.find_observable(name).unwrap_or_else(|| panic!("{name}"))
}

/// A tilt of the inner axis by δ turns the beam by δ at every pose; a turn about the beam does nothing; a tilt of the
/// outer frame about y acts as δ cos β to first order.
#[test]
fn tilts_do_what_geometry_says() {
    let chain = chain();
    let delta = 5e-5;
    let sizes = sizes(&chain, &[("db1", delta), ("db2", delta), ("dg2", delta)]);
    let path = path(&chain, &[("alpha", "t"), ("beta", "t"), ("gamma", "t")]);
    for poses in [Poses::Path(path), Poses::Ranges(Vec::new())] {
        let budget = Budget::measure(&chain, observable(&chain, "pointing"), &sizes, &poses)
            .unwrap_or_else(|error| panic!("{error}"));
        let [tilt, full, none] = budget.influences.as_slice() else { panic!("{budget:?}") };
        assert_relative_eq!(full.summary.sup, delta, max_relative = 1e-12);
        assert_relative_eq!(full.summary.rms, delta, max_relative = 1e-12);
        assert!(none.summary.sup < 1e-20, "{none:?}");
        // sin(influence/2) = sin(δ/2)|cos β|, so that the largest influence is δ.
        assert_relative_eq!(tilt.summary.sup, delta, max_relative = 1e-12);
        assert_relative_eq!(tilt.summary.rms, delta / 2f64.sqrt(), max_relative = 1e-8);
        assert_relative_eq!(budget.worst_case.sup, 2.0 * delta, max_relative = 1e-12);
        assert_relative_eq!(budget.root_sum_square.sup, 2f64.sqrt() * delta, max_relative = 1e-12);
        assert_relative_eq!(budget.root_sum_square.rms, 1.5f64.sqrt() * delta, max_relative = 1e-8);
    }
}

#[test]
fn the_largest_influence_is_found_between_the_nodes_and_at_the_edge() {
    let chain = chain();
    let delta = 1e-3;
    let sizes = sizes(&chain, &[("delta_y3", delta), ("db1", delta)]);
    let beta = chain.find_symbol("beta").unwrap_or(SymbolId::PI);
    // The influence of db1 on the pointing, δ|cos β|, is largest at the edge of this range.
    let poses = Poses::Ranges(vec![JointRange { symbol: beta, low: 0.3, high: 1.3 }]);
    let budget = Budget::measure(&chain, observable(&chain, "pointing"), &sizes, &poses)
        .unwrap_or_else(|error| panic!("{error}"));
    let db1 = &budget.influences[0];
    assert_relative_eq!(
        db1.summary.sup,
        2.0 * ((delta / 2.0).sin() * 0.3f64.cos()).asin(),
        max_relative = 1e-12
    );
    assert_relative_eq!(db1.summary.at[1], 0.3);
    // The mean of cos² β over (0.3, 1.3).
    let mean = 0.5 + (2.6f64.sin() - 0.6f64.sin()) / 4.0;
    assert_relative_eq!(db1.summary.rms, delta * mean.sqrt(), max_relative = 1e-6);
    // A shift moves the lens by itself wherever the joints stand.
    let budget = Budget::measure(&chain, observable(&chain, "position"), &sizes, &poses)
        .unwrap_or_else(|error| panic!("{error}"));
    assert_relative_eq!(budget.influences[1].summary.sup, delta, max_relative = 1e-12);
}

#[test]
fn curves_pass_through_the_sizes_in_equal_steps() {
    let chain = chain();
    let sizes = sizes(&chain, &[("db1", 1e-5)]);
    let path = path(&chain, &[("alpha", "0"), ("beta", "t/2 + pi/4"), ("gamma", "sin(t)")]);
    let curves = Curves::along(&chain, observable(&chain, "pointing"), &sizes, &path, 5, 5)
        .unwrap_or_else(|error| panic!("{error}"));
    assert_relative_eq!(curves.t.as_slice(), [0.0, PI / 2.0, PI, 1.5 * PI, 2.0 * PI].as_slice());
    assert_eq!(curves.curves.len(), 5);
    for (step, curve) in (1..=5).zip(&curves.curves) {
        assert_relative_eq!(curve.size, f64::from(step) * 2e-6, max_relative = 1e-15);
        let expected = curves.t.iter().map(|t| curve.size * (t / 2.0 + PI / 4.0).cos().abs());
        for (influence, expected) in curve.influence.iter().zip(expected) {
            assert_relative_eq!(*influence, expected, epsilon = 1e-15);
        }
    }
}

#[test]
fn what_the_poses_leave_open_is_said() {
    let chain = chain();
    let sizes = sizes(&chain, &[("db1", 1e-5)]);
    let measure = |name: &str, poses: &Poses| {
        Budget::measure(&chain, observable(&chain, name), &sizes, poses)
            .map_err(|error| error.to_string())
            .err()
    };
    let short = path(&chain, &[("alpha", "t"), ("beta", "t")]);
    assert_eq!(
        measure("pointing", &Poses::Path(short)).as_deref(),
        Some("pointing depends on gamma, and nothing says over which values it goes")
    );
    assert_eq!(
        measure("target", &Poses::Ranges(Vec::new())).as_deref(),
        Some("target depends on range, and nothing says over which values it goes")
    );
    let mut path = Path::default();
    let amount = |text: &str| syntax::parse_amount(text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    assert!(matches!(path.assign(&chain, "db1", &amount("t")), Err(PathError::NotMovable(_))));
    assert!(matches!(path.assign(&chain, "alpha", &amount("beta")), Err(PathError::Amount(_))));
    assert!(path.assign(&chain, "alpha", &amount("t")).is_ok());
    assert!(matches!(path.assign(&chain, "alpha", &amount("t")), Err(PathError::Twice(_))));
}

fn measured(text: &str, error: &str, poses: &Poses) -> Result<Budget, BudgetError> {
    let chain = Chain::from_text(text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let sizes = sizes(&chain, &[(error, 1e-6)]);
    Budget::measure(&chain, observable(&chain, "axis"), &sizes, poses)
}

/// Five nodes a joint, as six joints have, see cos 5q as the same at each; 1024 waves are the same at 256 nodes.
#[test]
fn means_over_full_turns_do_not_alias() {
    let six: String = (1..=6)
        .map(|n| {
            format!(
                "body b{n} on {} {{ motion: Rz(q{n}); }}",
                if n == 1 { "base".into() } else { format!("b{}", n - 1) }
            )
        })
        .collect();
    for harmonic in [1, 2, 3, 5, 10, 24, 1024] {
        let text = format!(
            "chain Six {{ body base on ground {{ position_error: Ry(wobble*cos({harmonic}*q3)*cos(5*q6)), Rx(tilt); }} {six}
             observe axis: direction(0, 0, 3) of b6; }}"
        );
        let whole = Poses::Ranges(Vec::new());
        let budget = measured(&text, "wobble", &whole).unwrap_or_else(|error| panic!("{error}"));
        assert_relative_eq!(budget.influences[0].summary.rms, 0.5e-6, max_relative = 1e-12);
        assert_relative_eq!(budget.root_sum_square.rms, 0.5e-6, max_relative = 1e-12);
        assert_relative_eq!(budget.worst_case.rms, 0.5e-6, max_relative = 0.05);
    }
}

#[test]
fn means_over_a_range_or_a_path_follow_the_waves() {
    let text = "chain One { body b on ground { position_error: Ry(wobble*cos(1024*q)); motion: Rz(q); }
                observe axis: direction(0, 0, 1) of b; }";
    let chain = Chain::from_text(text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let q = chain.find_symbol("q").unwrap_or(SymbolId::PI);
    let range = Poses::Ranges(vec![JointRange { symbol: q, low: 0.1, high: 1.7 }]);
    let along = Poses::Path(path(&chain, &[("q", "2*t")]));
    // The mean of cos² 1024q over (0.1, 1.7).
    let mean = 0.5 + ((2048.0_f64 * 1.7).sin() - (2048.0_f64 * 0.1).sin()) / (4096.0 * 1.6);
    for (poses, mean) in [(range, mean), (along, 0.5)] {
        let budget = measured(text, "wobble", &poses).unwrap_or_else(|error| panic!("{error}"));
        assert_relative_eq!(budget.influences[0].summary.rms, 1e-6 * mean.sqrt(), max_relative = 1e-8);
    }
    let fast = text.replace("1024", "1000000");
    let poses = Poses::Ranges(vec![JointRange { symbol: q, low: 0.1, high: 1.7 }]);
    let budget = measured(&fast, "wobble", &poses).unwrap_or_else(|error| panic!("{error}"));
    assert!(budget.is_sampled);
    assert_relative_eq!(budget.influences[0].summary.rms, 0.5e-6 * 2f64.sqrt(), max_relative = 0.02);
}

/// A ramp has no part in the Fourier series: its mean is that of the nodes.
#[test]
fn a_ramp_of_a_turning_joint_has_the_mean_of_its_nodes() {
    let text = "chain One { body b on ground { position_error: Ry(give*ramp(q, 1, 3)); motion: Rz(q); }
                observe axis: direction(0, 0, 1) of b; }";
    let budget = measured(text, "give", &Poses::Ranges(Vec::new())).unwrap_or_else(|error| panic!("{error}"));
    // The mean of the square over (0, 2π): 2/3 for the slope from 1 to 3, and 2π − 3 at one.
    let mean = (2.0 / 3.0 + 2.0 * PI - 3.0) / (2.0 * PI);
    assert_relative_eq!(budget.influences[0].summary.rms, 1e-6 * mean.sqrt(), max_relative = 1e-2);
}

const MOUNT: &str = "chain Mount {
    body mount on ground { position_error: Rx(an); motion: Rz(azimuth); motion_error: Rz(scale*tan(elevation)); }
    body tube on mount { motion: Ry(-elevation); motion_error: Rz(col); }
    observe axis: direction(1, 0, 0) of tube;
    observe sky: azimuth of direction(1, 0, 0) of tube;
    observe height: elevation of direction(1, 0, 0) of tube;
}";

/// Ranges and paths that pass the zenith have no budget of what is lost there, and those that keep away have one.
#[test]
fn poles_are_said_and_never_measured() {
    let chain = Chain::from_text(MOUNT).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let elevation = chain.find_symbol("elevation").unwrap_or(SymbolId::PI);
    let range = |low: f64, high: f64| Poses::Ranges(vec![JointRange { symbol: elevation, low, high }]);
    let along = |text: &str| Poses::Path(path(&chain, &[("azimuth", "t"), ("elevation", text)]));
    let refused = |name: &str, error: &str, poses: &Poses| {
        let (id, sizes) = (observable(&chain, name), sizes(&chain, &[(error, 1e-5)]));
        let budget = Budget::measure(&chain, id, &sizes, poses).map_err(|error| error.to_string());
        let influences = influences_at(&chain, id, &sizes, poses, 50).map_err(|error| error.to_string());
        assert_eq!(budget.is_err(), influences.is_err(), "{name} {error}");
        budget.err()
    };
    let passing =
        [Poses::Ranges(Vec::new()), range(1.0, 2.0), along("t"), along("1.5 + 0.2*sin(3*t)"), along("t/4")];
    for poses in &passing {
        let why = refused("axis", "scale", poses).unwrap_or_else(|| panic!("{poses:?}"));
        assert!(
            why.contains("`elevation` passes a place where the cosine in a denominator is zero"),
            "{why}"
        );
        let why = refused("sky", "col", poses).unwrap_or_else(|| panic!("{poses:?}"));
        assert!(why.starts_with("the azimuth of `sky` is lost near"), "{why}");
        // What is left out has no pole, and an elevation is none.
        assert_eq!(refused("axis", "col", poses), None);
        assert_eq!(refused("height", "an", poses), None);
    }
    for poses in [range(-1.5, 1.5), range(1.6, 3.0), along("1.5*sin(t)"), along("t/5")] {
        assert_eq!(refused("axis", "scale", &poses), None, "{poses:?}");
        assert_eq!(refused("sky", "scale", &poses), None, "{poses:?}");
    }
    // What tolerances come to, over poses and at given ones, and curves.
    let scale = sizes(&chain, &[("scale", 1e-5)]);
    let axis = observable(&chain, "axis");
    assert!(matches!(Sensitivity::over(&chain, axis, &scale, &passing[1], 7), Err(BudgetError::Pole(_))));
    let azimuth = chain.find_symbol("azimuth").unwrap_or(SymbolId::PI);
    let readings = |second: f64| [(azimuth, vec![0.0, 0.0]), (elevation, vec![0.1, second])];
    let at = Sensitivity::at(&chain, axis, &scale, &readings(PI / 2.0)).map_err(|error| error.to_string());
    assert!(at.is_err_and(|why| why.starts_with("pose 2: `elevation` passes a place")));
    assert!(Sensitivity::at(&chain, axis, &scale, &readings(1.5)).is_ok());
    let Poses::Path(passing) = along("t") else { unreachable!("a path") };
    assert!(matches!(Curves::along(&chain, axis, &scale, &passing, 9, 1), Err(BudgetError::Pole(_))));
}

/// A range whose square has no root has no closed form, and an angle off the axis none either; both are measured.
#[test]
fn what_has_no_closed_form_is_measured() {
    let text = "chain Machine {
        body slide on ground { motion: Tx(x); motion_error: Ty(straightness), Rz(yaw); }
        observe far: range of point(3, 4, 0) of slide;
        observe off: off_axis of direction(1, 0, 0) of slide;
    }";
    let chain = Chain::from_text(text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let x = chain.find_symbol("x").unwrap_or(SymbolId::PI);
    let poses = Poses::Ranges(vec![JointRange { symbol: x, low: 0.0, high: 2.0 }]);
    let measure = |name: &str, error: &str| {
        Budget::measure(&chain, observable(&chain, name), &sizes(&chain, &[(error, 1e-6)]), &poses)
            .unwrap_or_else(|error| panic!("{error}"))
    };
    // The slope of the distance across the slide is 4/√((3 + x)² + 16), 0.8 at its start.
    let far = &measure("far", "straightness").influences[0].summary;
    assert_relative_eq!(far.sup, 0.8e-6, max_relative = 1e-6);
    // ∫ 16/((3 + x)² + 16) dx over (0, 2) is 4 (atan 5/4 − atan 3/4), and its mean half of that.
    let mean = 2.0 * (1.25f64.atan() - 0.75f64.atan());
    assert_relative_eq!(far.rms, 1e-6 * mean.sqrt(), max_relative = 1e-6);
    assert_relative_eq!(measure("off", "yaw").influences[0].summary.sup, 1e-6, max_relative = 1e-9);
}

/// Beyond a ramp its error is there in full, in the columns as in the curves.
#[test]
fn an_error_behind_a_ramp_has_its_column() {
    let chain = Chain::from_text(
        "chain M { body az on ground { motion: Rz(a); motion_error: Rz(give*ramp(a, 10 deg, 20 deg)); }
            observe sight: direction(0, 1, 0) of az; }",
    )
    .unwrap_or_else(|error| panic!("{error}"));
    let (a, sight) =
        (chain.find_symbol("a").unwrap_or_else(|| panic!("declared")), observable(&chain, "sight"));
    let sizes = sizes(&chain, &[("give", 1e-4)]);
    let readings = [(a, [5.0_f64, 15.0, 45.0].map(f64::to_radians).to_vec())];
    let found = Sensitivity::at(&chain, sight, &sizes, &readings).unwrap_or_else(|error| panic!("{error}"));
    for (pose, share) in [0.0, 0.5, 1.0].into_iter().enumerate() {
        let column = nalgebra::Vector3::from(found.at_pose(pose)[0]);
        assert_relative_eq!(column.norm(), share, epsilon = 1e-12);
    }
}
