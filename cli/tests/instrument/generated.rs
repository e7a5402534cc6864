//! Code that is generated of an instrument says how sure its correction is and whether it was measured there, as `apply` does.

use std::process::Command;

use crate::packed;
use crate::support::Folder;

const SAMPLE: &str = include_str!("version-1.toml");

/// Azimuth and elevation in degrees, and the side; the last two are outside what was measured.
const POSES: [(f64, f64, i32); 5] =
    [(-90.0, 30.0, 1), (45.0, 72.5, -1), (12.0, 20.25, 1), (0.0, 10.0, 1), (100.0, 80.0, -1)];

fn generate(folder: &Folder, more: &[&str]) -> crate::support::Run {
    let fixed = ["generate", "i.toml", "--language", "c", "--out", "mount.c"];
    folder.trueaxis(&[&fixed, more].concat())
}

#[test]
fn uncertainty_and_region_are_those_of_apply() {
    let folder = Folder::new("instrument-generated");
    folder.write("i.toml", SAMPLE.replace("2020-02-29", "2999-02-28"));
    let mut table = "Az,zenith,pier\n".to_owned();
    let mut poses = String::new();
    for (azimuth, elevation, side) in POSES {
        table.push_str(&format!("{},{},{side}\n", azimuth / 0.9, packed(90.0 - elevation)));
        let [azimuth, elevation] = [azimuth, elevation].map(f64::to_radians);
        poses.push_str(&format!("        {{{azimuth:?}, {elevation:?}, {side}}},\n"));
    }
    folder.write("new.csv", table);
    let apply =
        ["apply", "i.toml", "--data", "new.csv", "--as", "vector", "--uncertainty", "--out", "out.csv"];
    let run = folder.trueaxis(&apply);
    assert_eq!(run.code, 0, "{run}");
    let applied = folder.read("out.csv");
    let mut rows = applied.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let header = rows.next().expect("a header");
    let at = |name: &str| {
        header.iter().position(|cell| cell.starts_with(name)).unwrap_or_else(|| panic!("{name}: {header:?}"))
    };
    let columns = ["pointing_x_uncertainty", "pointing_y_uncertainty", "pointing_z_uncertainty"].map(at);
    let region = at("measured_region");

    let run = generate(&folder, &[]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run}");
    let main = format!(
        "#include <stdio.h>\n#include \"mount.h\"\nint main(void) {{
    static const double poses[][3] = {{\n{poses}    }};
    mount_uncertainty_prepared prepared;
    int row;
    mount_uncertainty_prepare(&prepared);
    puts(mount_valid_until);
    for (row = 0; row < {}; row++) {{
        const mount_joints joints = {{poses[row][0], poses[row][1]}};
        const mount_inputs inputs = {{poses[row][2]}};
        mount_observed out;
        mount_uncertainty(&prepared, &joints, &inputs, &out);
        printf(\"%.17g %.17g %.17g %s\\n\", out.pointing[0], out.pointing[1], out.pointing[2],
               mount_in_measured_region(&joints, &inputs) ? \"inside\" : \"outside\");
    }}
    return 0;
}}
",
        POSES.len()
    );
    folder.write("main.c", main);
    let cc = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let built = Command::new(cc)
        .args(["-std=c99", "-O1", "-Wall", "-Wextra", "-Werror", "-o", "main", "main.c", "mount.c"])
        .current_dir(&folder.0)
        .output()
        .expect("a compiler");
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    let printed = Command::new(folder.0.join("main")).output().expect("it starts").stdout;
    let printed = String::from_utf8(printed).expect("UTF-8");
    let mut lines = printed.lines();
    assert_eq!(lines.next(), Some("2999-02-28"));
    let mut outside = 0;
    for (line, row) in lines.zip(rows) {
        let words: Vec<&str> = line.split(' ').collect();
        for (word, column) in words.iter().zip(columns) {
            let [found, expected] = [*word, &row[column]].map(|cell| cell.parse::<f64>().expect("a number"));
            assert!((found - expected).abs() <= 1e-9 * expected, "{found} is not {expected}");
            assert!(expected > 1e-10, "some uncertainty is there");
        }
        assert_eq!(words[3], row[region]);
        outside += usize::from(words[3] == "outside");
    }
    assert_eq!((printed.lines().count(), outside), (POSES.len() + 1, 2));
}

#[test]
fn a_day_that_is_over_is_a_warning_or_refused() {
    let folder = Folder::new("instrument-generated-valid");
    folder.write("i.toml", SAMPLE);
    let run = generate(&folder, &[]);
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stderr.contains("was valid until 2020-02-29"), "{run}");
    assert!(folder.read("mount.h").contains("valid until 2020-02-29"));
    for (text, words) in [
        (SAMPLE.to_owned(), "was valid until 2020-02-29"),
        (SAMPLE.replace("valid-until = 2020-02-29", ""), "does not say until when it is valid"),
    ] {
        folder.write("i.toml", text);
        let run = generate(&folder, &["--valid"]);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{run}");
        assert!(run.stderr.contains(words), "{run}");
    }
    folder.write("m.chain", crate::MOUNT);
    let run = folder.trueaxis(&["generate", "m.chain", "--language", "c", "--out", "m.c", "--valid"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("is a declaration"), "{run}");
}

/// Without a covariance there is no uncertainty, and who asks for it is told what to do.
#[test]
fn uncertainty_needs_a_covariance() {
    let folder = Folder::new("instrument-generated-unsure");
    let start = SAMPLE.find("[covariance]").expect("it has one");
    let end = SAMPLE.find("# What the columns").expect("it goes on");
    folder.write(
        "i.toml",
        format!("{}{}", &SAMPLE[..start], &SAMPLE[end..]).replace("2020-02-29", "2999-02-28"),
    );
    let run = generate(&folder, &[]);
    assert_eq!(run.code, 0, "{run}");
    assert!(!folder.read("mount.h").contains("uncertainty"));
    let run = generate(&folder, &["--only", "uncertainty"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("has [covariance]"), "{run}");
}
