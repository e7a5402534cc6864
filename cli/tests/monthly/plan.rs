//! What a planned campaign promises is what a calibration reaches.

use serde_json::Value;

use super::support::{Folder, Run, root};
use super::{ARCSEC, Errors, pointing, rows};

const CHAIN: &str = "chain Mount {
    body fork on ground {
        position_error: Rx(tilt_x), Ry(tilt_y);
        motion: Rz(-azimuth);
    }
    body tube on fork {
        motion: Rx(elevation);
        motion_error: Rx(index), Rz(collimation);
    }
    /// The tube's own end, which looks along the same line.
    body end on tube {
        position_error: Rx(seat), Ry(roll);
    }
    observe pointing: direction(0, 1, 0) of tube;
    observe mark: direction(0, 1, 0) of end;
}
";

const STUDY: &str = "chain = \"mount.chain\"
observable = \"pointing\"
data = \"data.csv\"

[columns]
azimuth = { column = \"az\", unit = \"deg\" }
elevation = { column = \"el\", unit = \"deg\" }

[observed]
kind = \"spherical\"
azimuth = { column = \"true_az\", unit = \"deg\" }
elevation = { column = \"true_el\", unit = \"deg\" }
";

const NAMES: [&str; 4] = ["tilt_x", "tilt_y", "index", "collimation"];

fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("mount.chain", CHAIN);
    folder
}

/// `plan` with a noise of 2″ and elevations from 10° to 80°.
fn plan(folder: &Folder, more: &[&str]) -> Run {
    let limits = ["--sigma", "2 arcsec", "--range", "elevation=10 deg..80 deg"];
    folder.trueaxis(&[&["plan", "mount.chain"], more, &limits].concat())
}

fn json(run: &Run) -> Value {
    serde_json::from_str(&run.stdout).unwrap_or_else(|error| panic!("{error}: {run}"))
}

/// The poses of `plan.csv`, degrees.
fn poses(folder: &Folder) -> Vec<[f64; 2]> {
    let text = folder.read("out/plan.csv");
    let (heading, lines) = text.split_once('\n').expect("a heading");
    assert_eq!(heading, "azimuth [deg],elevation [deg]");
    let number = |cell: &str| cell.parse().expect("a number");
    lines.lines().filter_map(|line| line.split_once(',')).map(|(a, e)| [number(a), number(e)]).collect()
}

#[test]
fn what_is_promised_is_reached() {
    let folder = folder("plan-promise");
    let wanted = ["--for", "*", "--within", "0.3 arcsec", "--observable", "pointing", "--out", "out"];
    let run =
        plan(&folder, &[&wanted[..2], &["--for", "tilt_*"], &wanted[2..], &["--format", "json"]].concat());
    // `seat` and `roll` do not move this observable.
    assert_eq!(run.code, 1, "{run}");
    let run = plan(
        &folder,
        &[&["--for", "tilt_*", "--for", "index", "--for", "coll*"], &wanted[2..], &["--format", "json"]]
            .concat(),
    );
    assert_eq!(run.code, 0, "{run}");
    let planned = json(&run);
    let expected: Vec<f64> = NAMES
        .iter()
        .map(|name| {
            let errors = planned["errors"].as_array().expect("errors");
            let own = errors.iter().find(|own| own["name"] == *name).expect("every one");
            own["expected"].as_f64().expect("determined")
        })
        .collect();
    assert!(expected.iter().all(|sigma| *sigma <= 0.3 * ARCSEC), "{expected:?}");
    let poses = poses(&folder);
    assert_eq!(Some(poses.len() as u64), planned["count"].as_u64());
    assert!(poses.iter().flatten().all(|value| value.fract() == 0.0), "{poses:?}");
    let errors: Errors = [40.0, -25.0, 60.0, 15.0];
    let (mut ratios, mut misses) = (Vec::new(), Vec::new());
    folder.write("study.toml", STUDY);
    for seed in 0..4 {
        folder.write("data.csv", rows(errors, &poses, 2.0, 71_100 + seed));
        let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "result"]);
        assert_eq!(run.code, 0, "{run}");
        let report: Value = serde_json::from_str(&folder.read("result/report.json")).expect("JSON");
        for ((name, expected), truth) in NAMES.iter().zip(&expected).zip(errors) {
            let own = report["errors"].as_array().expect("errors").iter().find(|own| own["name"] == *name);
            let own = own.expect("every one");
            ratios.push(own["standard_uncertainty"].as_f64().expect("a ±") / expected);
            misses.push((own["value"].as_f64().expect("a value") - truth * ARCSEC) / expected);
        }
    }
    let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
    assert!((mean - 1.0).abs() < 0.1, "{mean}: {ratios:?}");
    let scatter = (misses.iter().map(|miss| miss * miss).sum::<f64>() / misses.len() as f64).sqrt();
    // Of 16 values.
    assert!((0.6..1.5).contains(&scatter), "{scatter}: {misses:?}");
}

/// The information of the poses by differences of matrices of the test's own.
#[test]
fn the_promise_is_that_of_an_independent_program() {
    let folder = folder("plan-independent");
    let wanted = [
        "--for",
        "tilt_*",
        "--for",
        "index",
        "--for",
        "collimation",
        "--within",
        "1 arcsec",
        "--observable",
        "pointing",
        "--out",
        "out",
    ];
    let run = plan(&folder, &[&wanted[..], &["--poses", "12", "--format", "json"]].concat());
    assert_eq!(run.code, 0, "{run}");
    let poses = poses(&folder);
    assert_eq!(poses.len(), 12);
    let mut information = nalgebra::Matrix4::zeros();
    for [azimuth, elevation] in poses.iter().map(|pose| pose.map(f64::to_radians)) {
        let columns = [0, 1, 2, 3].map(|at: usize| {
            let moved = |by: f64| {
                let mut errors = [0.0; 4];
                errors[at] = by;
                pointing(errors, azimuth, elevation)
            };
            (moved(1.0) - moved(-1.0)) / 2.0
        });
        information += nalgebra::Matrix4::from_fn(|i, j| columns[i].dot(&columns[j]));
    }
    let covariance =
        (information / (2.0 * ARCSEC).powi(2)).try_inverse().expect("determined") * ARCSEC.powi(2);
    for (at, own) in json(&run)["errors"].as_array().expect("errors").iter().enumerate() {
        let expected = own["expected"].as_f64().expect("determined");
        assert!((expected / covariance[(at, at)].sqrt() - 1.0).abs() < 1e-6, "{own}");
    }
}

#[test]
fn what_no_pose_separates_is_said() {
    let folder = folder("plan-lost");
    let run = plan(
        &folder,
        &["--for", "index", "--for", "collimation", "--within", "1 arcsec", "--observable", "mark"],
    );
    assert_eq!(run.code, 1, "{run}");
    let said = run.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        said.contains("POSES DO NOT REACH ALL. No number of poses shows 1 wanted error well enough"),
        "{run}"
    );
    assert!(
        said.contains("No pose separates `index` from other errors. `mark` shows only `index + seat`"),
        "{run}"
    );
}

#[test]
fn constraints_hold_at_each_pose() {
    let folder = folder("plan-where");
    let wanted = ["--for", "tilt_*", "--within", "1 arcsec", "--observable", "pointing", "--out", "out"];
    let more = ["--where", "elevation + 0.5*azimuth < 90 deg", "--where", "azimuth >= 10 deg"];
    let run = plan(&folder, &[&wanted[..], &more].concat());
    assert_eq!(run.code, 0, "{run}");
    for [azimuth, elevation] in poses(&folder) {
        assert!(elevation + 0.5 * azimuth < 90.0 && azimuth >= 10.0, "{azimuth} {elevation}");
    }
    assert_eq!(folder.names(), ["mount.chain", "out"]);
    assert!(
        folder.read("out/plan.svg").starts_with("<svg") && folder.read("out/plan.html").contains("tilt_x")
    );
    // The same again is the same.
    let first = folder.read("out/plan.csv");
    plan(&folder, &[&wanted[..], &more].concat());
    assert_eq!(folder.read("out/plan.csv"), first);
}

#[test]
fn refused() {
    let folder = folder("plan-refused");
    let said = |more: &[&str]| {
        let run = plan(&folder, more);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{run}");
        run.stderr
    };
    let own = |more: &[&'static str]| {
        let usual = ["--for", "tilt_x", "--within", "1 arcsec", "--observable", "pointing"];
        [&usual, more].concat()
    };
    let all = [
        (said(&["--for", "tilt_x", "--within", "1 arcsec"]), "say which of `pointing`, `mark` is measured"),
        (
            said(&["--for", "tild_x", "--within", "1 arcsec", "--observable", "pointing"]),
            "did you mean `tilt_x`?",
        ),
        (
            said(&["--for", "tilt_x", "--within", "1 mm", "--observable", "pointing"]),
            "how surely is `tilt_x` wanted?",
        ),
        (
            said(&["--for", "tilt_x", "--within", "1", "--observable", "pointing"]),
            "how surely is `tilt_x` wanted?",
        ),
        (
            said(&["--for", "tilt_x", "--within", "0 arcsec", "--observable", "pointing"]),
            "write one above zero",
        ),
        (said(&own(&["--within", "1 mm"])), "no wanted error is of this kind"),
        (said(&own(&["--where", "elevation"])), "write one comparison"),
        (said(&own(&["--where", "elevatio < 20 deg"])), "did you mean `elevation`?"),
        (said(&own(&["--where", "elevation < < 20 deg"])), "write one comparison"),
        (
            said(&own(&["--where", "elevation > 85 deg"])),
            "no pose within the limits meets `elevation > 85 deg`",
        ),
        (said(&own(&["--where", "elevation < )"])), "--where"),
        (said(&own(&["--where", "1 < 2"])), "it names no joint"),
    ];
    for (message, part) in all {
        let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(message.contains(part), "{part}: {message}");
    }
}

#[test]
fn the_picture_in_the_book_is_the_one_that_is_drawn() {
    let folder = Folder::new("plan-picture");
    let chain = root().join("examples/course/mount.chain");
    let chain = chain.to_str().expect("UTF-8");
    let asked =
        ["plan", chain, "--for", "*", "--within", "2 arcsec", "--sigma", "3 arcsec", "--out", "campaign"];
    let run = folder.trueaxis(&asked);
    assert_eq!(run.code, 0, "{run}");
    let kept = std::fs::read_to_string(root().join("docs/src/commands/plan.svg")).expect("a picture");
    assert!(folder.read("campaign/plan.svg") == kept, "copy {}/campaign/plan.svg anew", folder.0.display());
}
