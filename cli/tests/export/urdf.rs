//! A robot's URDF: made a declaration by `init`, calibrated, and written back with other origins.

use std::array::from_fn;

use crate::support::{Folder, Run};
use crate::{instrument, said};

/// Three joints, the last about an axis that lies along none of its frame's, and a flange; a camera that is not on the way.
const ROBOT: &str = "<?xml version=\"1.0\"?>
<!-- a robot of a test -->
<robot name=\"test-arm\">
  <link name=\"base_link\"/>
  <link name=\"shoulder\"><inertial><mass value=\"3\"/></inertial></link>
  <joint name=\"pan-joint\" type=\"revolute\">
    <parent link=\"base_link\"/> <child link=\"shoulder\"/>
    <origin xyz=\"0 0 0.16\" rpy=\"0 0 0\"/>   <axis xyz=\"0 0 1\"/>
    <limit lower=\"-3.1\" upper=\"3.1\" effort=\"9\" velocity=\"1\"/>
  </joint>
  <joint name=\"lift\" type=\"continuous\">
    <origin rpy='1.57079632679 0.1 0' xyz='0 0.13 0' />
    <parent link=\"shoulder\"/><child link=\"upper\"/><axis xyz=\"0 -1 0\"/>
  </joint>
  <joint name=\"slide\" type=\"prismatic\"><parent link=\"upper\"/><child link=\"fore\"/>
    <axis xyz=\"0.6 0 0.8\"/><limit lower=\"0\" upper=\"0.4\" effort=\"9\" velocity=\"1\"/></joint>
  <joint name=\"flange-joint\" type=\"fixed\"><origin xyz=\"0.05 0 0\"/><parent link=\"fore\"/><child link=\"flange\"/></joint>
  <joint name=\"eye\" type=\"fixed\"><parent link=\"shoulder\"/><child link=\"camera\"/></joint>
</robot>
";

/// What the declaration has of it.
const ERRORS: [(&str, &str); 6] = [
    ("pan_joint_tilt_x", "60 arcsec"),
    ("pan_joint_shift_y", "0.4 mm"),
    ("lift_tilt_z", "-90 arcsec"),
    ("lift_shift_x", "-0.3 mm"),
    ("slide_tilt_x", "50 arcsec"),
    ("slide_tilt_y", "-30 arcsec"),
];

fn errors() -> String {
    ERRORS.iter().map(|(name, value)| format!("{name} = \"{value}\"\n")).collect()
}

const FOUND: &str = "[found-over]\nslide = [\"0 m\", \"0.4 m\"]\nlift = [\"-80 deg\", \"60 deg\"]\n";

/// Exports the instrument into the robot's own description.
fn written(folder: &Folder, out: &str) -> Run {
    let what = ["export", "instrument.toml", "--form", "urdf", "--template", "robot.urdf", "--out"];
    folder.trueaxis(&[&what[..], &[out]].concat())
}

/// A folder with the robot and its declaration.
fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("robot.urdf", ROBOT);
    let run = folder.trueaxis(&["init", "--urdf", "robot.urdf", "--out", "arm.toml"]);
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stderr.contains("3 joints that move, from `base_link` to `flange`"), "{run}");
    folder
}

type Place = ([[f64; 3]; 3], [f64; 3]);

fn times(a: &Place, b: &Place) -> Place {
    let turned = from_fn(|row| from_fn(|column| (0..3).map(|at| a.0[row][at] * b.0[at][column]).sum()));
    let shift = from_fn(|row| a.1[row] + (0..3).map(|at| a.0[row][at] * b.1[at]).sum::<f64>());
    (turned, shift)
}

/// About an axis of length one.
fn turn(axis: [f64; 3], angle: f64) -> Place {
    let (sine, cosine) = angle.sin_cos();
    let cross = [[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]];
    let entry = |row: usize, column: usize| {
        let same = if row == column { cosine } else { 0.0 };
        same + sine * cross[row][column] + (1.0 - cosine) * axis[row] * axis[column]
    };
    (from_fn(|row| from_fn(|column| entry(row, column))), [0.0; 3])
}

/// The origin of a joint, as its text says it.
fn origin(text: &str, joint: &str) -> Place {
    let (_, from) = text.split_once(&format!("name=\"{joint}\"")).expect("the joint");
    let (own, _) = from.split_once("</joint>").expect("its end");
    let numbers = |key: &str| -> [f64; 3] {
        let Some((_, value)) = own
            .split_once("<origin")
            .and_then(|(_, own)| own.split_once('>')?.0.split_once(&format!("{key}=")))
        else {
            return [0.0; 3];
        };
        let quote = value.chars().next().expect("a quote");
        let value = value[1..].split(quote).next().expect("a value");
        let read: Vec<f64> =
            value.split_whitespace().map(|number| number.parse().expect("a number")).collect();
        read.try_into().expect("three numbers")
    };
    let [roll, pitch, yaw] = numbers("rpy");
    let turned = times(
        &times(&turn([0.0, 0.0, 1.0], yaw), &turn([0.0, 1.0, 0.0], pitch)),
        &turn([1.0, 0.0, 0.0], roll),
    );
    (turned.0, numbers("xyz"))
}

/// Where the flange is, by a description alone.
fn flange(text: &str, [pan, lift, slide]: [f64; 3]) -> [f64; 3] {
    let shift = ([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [0.6 * slide, 0.0, 0.8 * slide]);
    let parts = [
        origin(text, "pan-joint"),
        turn([0.0, 0.0, 1.0], pan),
        origin(text, "lift"),
        turn([0.0, -1.0, 0.0], lift),
        origin(text, "slide"),
        shift,
        origin(text, "flange-joint"),
    ];
    parts.iter().skip(1).fold(parts[0], |place, next| times(&place, next)).1
}

/// Where the declaration with some errors has it.
fn evaluated(folder: &Folder, errors: &str, [pan, lift, slide]: [f64; 3]) -> [f64; 3] {
    folder.write("instrument.toml", instrument(&folder.read("arm.chain"), errors, FOUND));
    folder.write("pose.csv", format!("pan_joint [rad],lift [rad],slide [m]\n{pan},{lift},{slide}\n"));
    let run = folder.trueaxis(&[
        "eval",
        "instrument.toml",
        "--data",
        "pose.csv",
        "--quantity",
        "value",
        "--out",
        "-",
    ]);
    assert_eq!(run.code, 0, "{run}");
    let row = run.stdout.lines().nth(1).expect("a row");
    let cells: Vec<f64> = row.split(',').skip(3).map(|cell| cell.parse().expect("a number")).collect();
    cells.try_into().expect("a point")
}

const POSE: [f64; 3] = [0.7, -0.4, 0.25];

#[test]
fn the_declaration_is_the_robot() {
    let folder = folder("urdf-declared");
    let (own, declared) = (flange(ROBOT, POSE), evaluated(&folder, "", POSE));
    for axis in 0..3 {
        assert!((own[axis] - declared[axis]).abs() < 1e-10, "{own:?} {declared:?}");
    }
    let chain = folder.read("arm.chain");
    assert!(chain.contains("Joint `pan-joint` turns, from -3.1 to 3.1."), "{chain}");
    let run = folder.trueaxis(&["init", "--urdf", "robot.urdf", "--out", "arm.toml"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("nothing is overwritten"), "{run}");
}

#[test]
fn origins_are_those_of_the_calibrated_robot_and_every_other_byte_stays() {
    let folder = folder("urdf-written");
    let declared = evaluated(&folder, &errors(), POSE);
    let run = written(&folder, "new.urdf");
    let said = said(&run);
    assert!(said.contains("pan-joint: turned by 60.0″"), "{run}");
    assert!(said.contains("The form carries every error"), "{run}");
    let text = folder.read("new.urdf");
    let own = flange(&text, POSE);
    for axis in 0..3 {
        assert!((own[axis] - declared[axis]).abs() < 1e-10, "{own:?} {declared:?}");
    }
    // Only numbers in origins differ.
    let without = |text: &str| -> String {
        let mut rest = String::new();
        for (at, part) in text.split("<origin").enumerate() {
            rest.push_str(if at == 0 { part } else { part.split_once("/>").expect("an end").1 });
        }
        rest
    };
    assert_eq!(without(&text), without(ROBOT));
    let changed = text.lines().zip(ROBOT.lines()).filter(|(a, b)| a != b).count();
    assert!(changed <= 5, "{text}");
    let origin_of_eye = text.lines().find(|line| line.contains("eye")).expect("the camera");
    assert!(ROBOT.contains(origin_of_eye));
}

#[test]
fn a_template_that_is_another_robot_is_refused() {
    let folder = folder("urdf-refused");
    folder.write("instrument.toml", instrument(&folder.read("arm.chain"), &errors(), FOUND));
    let refused = |text: &str, why: &str| {
        folder.write("other.urdf", text);
        let run = folder.trueaxis(&[
            "export",
            "instrument.toml",
            "--form",
            "urdf",
            "--template",
            "other.urdf",
            "--out",
            "new.urdf",
        ]);
        assert_eq!(run.code, 2, "{why}: {run}");
        assert!(run.stderr.contains(why), "{why}: {run}");
        assert!(!folder.names().contains(&"new.urdf".to_owned()), "{why}");
    };
    refused(
        &ROBOT.replace("\"lift\"", "\"lifts\""),
        "there is no joint `lift` of the declaration; it has `lifts`",
    );
    refused(&ROBOT.replace("0 0.13 0", "0.01 0.13 0"), "beside that of the declaration");
    refused(&ROBOT.replace("\"0 -1 0\"", "\"0 1 0\""), "is turned by");
    refused(&ROBOT.replace("type=\"continuous\"", "type=\"prismatic\""), "moves in another way");
    refused("", "this is no XML");
    refused("<html></html>", "is no robot");
    refused(&ROBOT.replace("</robot>", ""), "this is no XML");
    refused(&folder.read("arm.chain"), "this is no XML");
    let run = folder.trueaxis(&["export", "instrument.toml", "--form", "urdf", "--out", "new.urdf"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("name that file with --template"), "{run}");
    let run = written(&folder, "robot.urdf");
    assert_eq!(run.code, 2, "{run}");
    assert_eq!(folder.read("robot.urdf"), ROBOT);
}

#[test]
fn a_robot_that_cannot_be_declared_is_refused() {
    let folder = Folder::new("urdf-init-refused");
    for (text, more, why) in [
        (
            ROBOT.replace("revolute", "floating").replace("continuous", "floating"),
            &[][..],
            "several degrees of freedom",
        ),
        (ROBOT.to_owned(), &["--tip", "flang"][..], "did you mean `flange`?"),
        (ROBOT.to_owned(), &["--tip", "base_link"][..], "no joint on the way"),
        (
            ROBOT.replace(
                "link=\"shoulder\"/><child link=\"camera\"",
                "link=\"camera\"/><child link=\"camera\"",
            ),
            &[][..],
            "hang",
        ),
    ] {
        folder.write("robot.urdf", text);
        let run = folder.trueaxis(&[&["init", "--urdf", "robot.urdf", "--out", "arm.toml"], more].concat());
        assert_eq!(run.code, 2, "{why}: {run}");
        assert!(run.stderr.contains(why), "{why}: {run}");
    }
    let run = folder.trueaxis(&["init"]);
    assert_eq!(run.code, 2, "{run}");
}

/// Data beside the description make a study, whose calibration finds what was planted.
#[test]
fn data_with_the_names_of_the_joints_make_a_study() {
    let folder = folder("urdf-study");
    let mut data = "pan-joint [deg],lift [deg],slide [mm],x [mm],y [mm],z [mm]\n".to_owned();
    folder.write("instrument.toml", instrument(&folder.read("arm.chain"), &errors(), FOUND));
    let poses: Vec<[f64; 3]> = (0..40)
        .map(|row| {
            let row = f64::from(row);
            [(row * 2.4).sin() * 2.0, -0.5 + 0.8 * (row * 1.7).sin(), 0.2 + 0.19 * (row * 0.9).cos()]
        })
        .collect();
    let table: String = poses.iter().map(|[pan, lift, slide]| format!("{pan},{lift},{slide}\n")).collect();
    folder.write("poses.csv", format!("pan_joint [rad],lift [rad],slide [m]\n{table}"));
    let run = folder.trueaxis(&[
        "eval",
        "instrument.toml",
        "--data",
        "poses.csv",
        "--quantity",
        "value",
        "--out",
        "-",
    ]);
    assert_eq!(run.code, 0, "{run}");
    for (at, line) in run.stdout.lines().skip(1).enumerate() {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().expect("a number")).collect();
        let noise = |number: usize| 1e-3 * ((at * 3 + number) as f64 * 12.9898).sin();
        data.push_str(&format!(
            "{},{},{},{:.6},{:.6},{:.6}\n",
            cells[0].to_degrees(),
            cells[1].to_degrees(),
            1e3 * cells[2],
            1e3 * cells[3] + noise(0),
            1e3 * cells[4] + noise(1),
            1e3 * cells[5] + noise(2)
        ));
    }
    folder.write("measured.csv", data);
    let run = folder.trueaxis(&["init", "measured.csv", "--urdf", "robot.urdf"]);
    assert_eq!(run.code, 0, "{run}");
    let study = folder.read("measured.toml");
    assert!(study.contains("pan_joint = { column = \"pan-joint [deg]\", unit = \"deg\" }"), "{study}");
    let run = folder.trueaxis(&["calibrate", "measured.toml", "--out", "result"]);
    assert!(run.code == 0 || run.code == 1, "{run}");
    let run = folder.trueaxis(&[
        "export",
        "result/instrument.toml",
        "--form",
        "urdf",
        "--template",
        "robot.urdf",
        "--out",
        "new.urdf",
    ]);
    let own = flange(&folder.read("new.urdf"), POSE);
    let declared = evaluated(&folder, &errors(), POSE);
    for axis in 0..3 {
        assert!((own[axis] - declared[axis]).abs() < 2e-5, "{own:?} {declared:?}: {run}");
    }
}
