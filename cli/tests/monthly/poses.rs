//! Readings to set for whole poses: a program goes in, and an arm with errors stands where one without would.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use testkit::{Random, rotation};

use super::ARCSEC;
use super::support::{Folder, Run, root};

const ERRORS: [(&str, f64); 5] =
    [("index2", 200.0), ("twist3", -150.0), ("index5", 90.0), ("length2", 0.7e-3), ("offset4", -0.4e-3)];

/// Place and orientation of the flange by matrices of the test's own.
fn arm(joints: &[f64], with: bool) -> (Vector3<f64>, Matrix3<f64>) {
    let error = |name: String| {
        let own = ERRORS.iter().find(|(known, _)| *known == name).map_or(0.0, |(_, size)| *size);
        let is_angle = name.starts_with("index") || name.starts_with("twist");
        if with { own * if is_angle { ARCSEC } else { 1.0 } } else { 0.0 }
    };
    let half = std::f64::consts::FRAC_PI_2;
    let links = [
        (0.1273, 0.0, half),
        (0.0, -0.612, 0.0),
        (0.0, -0.5723, 0.0),
        (0.163_941, 0.0, half),
        (0.1157, 0.0, -half),
        (0.0922, 0.0, 0.0),
    ];
    let (mut place, mut turned) = (Vector3::zeros(), Matrix3::identity());
    for (at, (along_z, along_x, twist)) in links.into_iter().enumerate() {
        let of = |kind: &str| error(format!("{kind}{}", at + 1));
        turned *= rotation(2, joints[at] + of("index"));
        place += turned * Vector3::new(along_x + of("length"), 0.0, along_z + of("offset"));
        turned *= rotation(0, of("twist")) * rotation(0, twist);
    }
    (place, turned)
}

/// Programs away from singular places, with the elbow up.
fn programs(seed: u64) -> Vec<Vec<f64>> {
    let mut random = Random::new(seed);
    let centres = [0.3, -1.2, -1.4, -0.8, 1.3, 0.2];
    (0..40).map(|_| centres.iter().map(|centre| centre + 0.4 * (random.even() - 0.5)).collect()).collect()
}

fn table(headings: &[String], rows: impl Iterator<Item = Vec<f64>>) -> String {
    let mut text = headings.join(",");
    for row in rows {
        text.push('\n');
        text.push_str(&row.iter().map(|cell| format!("{cell:?}")).collect::<Vec<_>>().join(","));
    }
    text.push('\n');
    text
}

fn numbered(before: &str, behind: &str) -> Vec<String> {
    (1..=6).map(|at| format!("{before}{at}{behind}")).collect()
}

fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    let chain =
        std::fs::read_to_string(root().join("examples/six-joint-arm/six-joint-arm.chain")).expect("the arm");
    folder.write("arm.chain", chain);
    let size = |(name, size): &(&str, f64)| {
        let unit = if name.starts_with("length") || name.starts_with("offset") { "m" } else { "arcsec" };
        format!("{name} = \"{size} {unit}\"\n")
    };
    folder.write("errors.toml", ERRORS.iter().map(size).collect::<String>());
    folder
}

fn solve(folder: &Folder, more: &[&str]) -> Run {
    let usual = [
        "apply",
        "arm.chain",
        "--errors",
        "errors.toml",
        "--data",
        "in.csv",
        "--solve",
        "--observable",
        "tip",
    ];
    folder.trueaxis(&[&usual[..], more, &["--out", "out.csv"]].concat())
}

/// The joints that were written, rad, with what remains and the words.
fn written(folder: &Folder, degrees: bool) -> Vec<(Vec<f64>, [f64; 2], String)> {
    let text = folder.read("out.csv");
    let (heading, lines) = text.split_once('\n').expect("a heading");
    let names: Vec<&str> = heading.split(',').collect();
    let at =
        |name: &str| names.iter().position(|own| *own == name).unwrap_or_else(|| panic!("{name}: {heading}"));
    let joints = if degrees { numbered("q", " [deg]") } else { numbered("q", " [rad]") };
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |name: &str| cells[at(name)].parse::<f64>().expect("a number");
        let own = joints.iter().map(|name| if degrees { number(name).to_radians() } else { number(name) });
        let remain = [number("tip_remaining [m]"), number("tip_turn_remaining [rad]")];
        (own.collect(), remain, cells[at("tip_solved")].to_owned())
    };
    lines.lines().map(row).collect()
}

fn same(pose: &(Vector3<f64>, Matrix3<f64>), other: &(Vector3<f64>, Matrix3<f64>)) -> bool {
    (pose.0 - other.0).norm() < 2e-9 && (pose.1 - other.1).norm() < 4e-9
}

#[test]
fn a_program_of_joints_comes_out_compensated() {
    let folder = folder("poses-joints");
    let programs = programs(4_711);
    folder.write(
        "in.csv",
        table(
            &numbered("q", " [deg]"),
            programs.iter().map(|own| own.iter().map(|q| q.to_degrees()).collect()),
        ),
    );
    let run = solve(&folder, &["--pose", "joints"]);
    assert_eq!(run.code, 0, "{run}");
    let out = written(&folder, true);
    assert_eq!(out.len(), programs.len());
    for (program, (joints, _, word)) in programs.iter().zip(&out) {
        assert_eq!(word, "yes");
        assert!(same(&arm(joints, true), &arm(program, false)), "{program:?} {joints:?}");
        // The same branch.
        assert!(joints.iter().zip(program).all(|(own, wanted)| (own - wanted).abs() < 0.02));
    }
}

#[test]
fn every_way_to_write_a_pose_says_the_same() {
    let folder = folder("poses-forms");
    let programs = programs(4_712);
    let forms: [(&str, &[&str]); 4] = [
        ("quaternion", &["qw", "qx", "qy", "qz"]),
        ("matrix", &["r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"]),
        ("vector", &["rx", "ry", "rz"]),
        ("euler-zyx", &["e1", "e2", "e3"]),
    ];
    for (form, parts) in forms {
        let mut headings: Vec<String> =
            ["x", "y", "z"].iter().chain(parts).map(|part| format!("tip_{part}")).collect();
        headings.extend(numbered("q", ""));
        let row = |joints: &Vec<f64>| {
            let (place, turned) = arm(joints, false);
            let rotated = Rotation3::from_matrix_unchecked(turned);
            let quaternion = UnitQuaternion::from_rotation_matrix(&rotated);
            let numbers = match form {
                "quaternion" => vec![quaternion.w, quaternion.i, quaternion.j, quaternion.k],
                "matrix" => turned.transpose().as_slice().to_vec(),
                "vector" => quaternion.scaled_axis().as_slice().to_vec(),
                _ => {
                    let (roll, pitch, yaw) = rotated.euler_angles();
                    vec![yaw, pitch, roll]
                }
            };
            place.iter().copied().chain(numbers).chain(joints.iter().copied()).collect()
        };
        folder.write("in.csv", table(&headings, programs.iter().map(row)));
        let run = solve(&folder, &["--pose", form]);
        assert_eq!(run.code, 0, "{run}");
        let text = folder
            .read("out.csv")
            .replace(",q1,q2,q3,q4,q5,q6", &format!(",{}", numbered("q", " [rad]").join(",")));
        folder.write("out.csv", text);
        for (program, (joints, _, _)) in programs.iter().zip(written(&folder, false)) {
            assert!(same(&arm(&joints, true), &arm(program, false)), "{form}: {program:?} {joints:?}");
        }
    }
}

#[test]
fn poses_out_of_reach_and_limits_are_told_by_row() {
    let folder = folder("poses-lost");
    let headings =
        [numbered("q", ""), ["x", "y", "z", "rx", "ry", "rz"].map(|part| format!("tip_{part}")).to_vec()]
            .concat();
    let start = &programs(4_713)[0];
    let (place, turned) = arm(start, false);
    let vector =
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turned)).scaled_axis();
    let row = |place: Vector3<f64>| start.iter().chain(place.iter()).chain(vector.iter()).copied().collect();
    folder.write("in.csv", table(&headings, [row(place), row(place * 5.0)].into_iter()));
    let run = solve(&folder, &["--pose", "vector"]);
    assert_eq!(run.code, 0, "{run}");
    let text = folder.read("out.csv");
    let words: Vec<&str> = text.lines().skip(1).filter_map(|line| line.rsplit(',').next()).collect();
    assert_eq!(words, ["yes", "out of reach"], "{text}");
    assert!(
        run.stderr.contains("1 of 2 poses are not reached") && run.stderr.contains("row 2 (out of reach"),
        "{run}"
    );
    // What ends at a limit is told so.
    let run = solve(&folder, &["--pose", "vector", "--range", "q1=2 rad..2.2 rad"]);
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stderr.contains("row 2 (at a limit"), "{run}");
}

#[test]
fn refused() {
    let folder = folder("poses-refused");
    folder.write("in.csv", "tip_x,tip_y,tip_z,tip_qw,tip_qx,tip_qy,tip_qz\n0.1,0.2,0.3,1,1,0,0\n");
    let said = |more: &[&str]| {
        let run = solve(&folder, more);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{run}");
        assert!(!folder.0.join("out.csv").exists());
        run.stderr
    };
    let all = [
        (said(&["--pose", "quaternion"]), "row 1: w, x, y, z is no unit quaternion: its length is 1.414214"),
        (said(&["--pose", "joints"]), "q1"),
        (said(&["--pose", "matrix"]), "tip_r11"),
        (said(&["--pose", "euler-zzx"]), "write quaternion, matrix, vector, joints"),
        (said(&["--pose", "quaternion", "--range", "q9=1 rad..2 rad"]), "no joint or input `q9`"),
    ];
    for (message, part) in all {
        let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(message.contains(part), "{part}: {message}");
    }
}
