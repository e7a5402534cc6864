//! How a body is turned, and constants without a value, through every command.

use super::support::Folder;

const CHAIN: &str = "chain Gimbal {
    body base on ground { motion: Rz(az); motion_error: Rz(e); }
    body tube on base { motion: Ry(el); motion_error: Ry(f), Rx(g); }
    observe turned: orientation of tube;
    observe seen: rotation_y of orientation of tube in base;
}";

#[test]
fn an_orientation_goes_through_every_command_or_is_refused_in_words() {
    let folder = Folder::new("orientation");
    folder
        .write("g.chain", CHAIN)
        .write("e.toml", "e = 1e-3\nf = 2e-3\ng = 0\n")
        .write("poses.csv", "az,el\n0,0\n1,2\n");
    let run = folder.trueaxis(&["derive", "g.chain", "--observable", "turned"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for said in [
        "of the orientation of tube",
        "rotation_z = e - g*sin(el)",
        "component x of the small rotation vector",
        "in rad",
    ] {
        assert!(run.stdout.contains(said), "{said}: {}", run.stdout);
    }
    let run =
        folder.trueaxis(&["eval", "g.chain", "--data", "poses.csv", "--errors", "e.toml", "--out", "-"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let lines: Vec<&str> = run.stdout.lines().collect();
    let columns =
        "turned_rotation_x [rad],turned_rotation_y [rad],turned_rotation_z [rad],seen_rotation_y [rad]";
    assert!(lines[0].replace(" [rad]", "").ends_with(&columns.replace(" [rad]", "")), "{}", lines[0]);
    // exp(e z) exp(f y) at the origin: to second order (-ef/2, f, e).
    let numbers: Vec<f64> = lines[1].split(',').map(|field| field.parse().unwrap_or(f64::NAN)).collect();
    for (found, expected) in numbers[2..].iter().zip([-1e-6, 2e-3, 1e-3, 2e-3]) {
        assert!((found - expected).abs() < 2e-9, "{found} is not {expected}: {}", run.stdout);
    }
    let run = folder.trueaxis(&["identify", "g.chain", "--observable", "turned"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert!(run.stdout.contains("3"), "{}", run.stdout);
    let run = folder.trueaxis(&["bound", "g.chain", "--sizes", "e.toml", "--observable", "turned"]);
    // The two turns do not commute: exp(e z) exp(f y) has -ef/2 about x, and so has the search found.
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for said in ["rotation x: 1.00", "largest found by search 1.0000e-6 rad"] {
        assert!(run.stdout.contains(said), "{said}: {}", run.stdout);
    }
    for language in ["rust", "c", "latex", "numpy", "javascript"] {
        let run = folder.trueaxis(&["generate", "g.chain", "--language", language, "--out", "out"]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{language}: {}", run.stdout);
    }
}

const ARM: &str = "chain Arm {
    const reach: length;
    body arm on ground { motion: Rz(q); motion_error: Rz(e), Ry(g); }
    body hand on arm { position: Tx(reach); }
    observe end: point(0, 0, 0) of hand;
}";

#[test]
fn commands_that_need_numbers_name_the_constant_without_a_value() {
    let folder = Folder::new("unvalued");
    folder.write("arm.chain", ARM).write("e.toml", "e = 1e-3\n").write("poses.csv", "q\n0\n");
    for arguments in [
        &["derive", "arm.chain"][..],
        &["derive", "arm.chain", "--certificate", "arm.v"],
        &["identify", "arm.chain"],
    ] {
        let run = folder.trueaxis(arguments);
        assert_eq!(run.code, 0, "{arguments:?}: {}", run.stderr);
    }
    for arguments in [
        &["eval", "arm.chain", "--data", "poses.csv", "--errors", "e.toml", "--out", "out"][..],
        &["generate", "arm.chain", "--language", "c", "--out", "out"],
        &["bound", "arm.chain", "--errors", "e.toml"],
        &["budget", "arm.chain", "--errors", "e.toml", "--path", "q=t"],
        &[
            "simulate",
            "arm.chain",
            "--errors",
            "e.toml",
            "--poses",
            "3",
            "--noise",
            "0",
            "--seed",
            "1",
            "--out",
            "out",
        ],
        &["apply", "arm.chain", "--data", "poses.csv", "--errors", "e.toml", "--out", "out"],
    ] {
        let run = folder.trueaxis(arguments);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{arguments:?}");
        assert!(run.stderr.contains("the constant `reach` has no value"), "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains("const reach: length = 0.25;"), "{arguments:?}: {}", run.stderr);
        assert!(!folder.0.join("out").exists(), "{arguments:?}");
    }
}
